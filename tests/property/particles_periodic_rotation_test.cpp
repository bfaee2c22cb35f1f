// Law: grains that turn do so across the faces of a scene that repeats as in its middle. Their places are multiples of
// 1/64 of a period of 1 m, so they begin with the same bits; paths of 40 steps add as many roundings of 2^-53 of
// numbers of size 1 to overlaps of 1e-2: 1e-12 of velocities and spins, as for grains that do not turn
// (particles_periodic_pairs_test.cpp). About any point that rests, a pair keeps the angular momentum of its paths and
// spins to rounding: in each step both places, of size 1/2 m, are rounded by 2^-54 m, against momenta of 4 kg m/s: 40
// times that, both, are 2e-14 kg m2/s, and sums of parts of 0.4 kg m2/s as much again; 1e-13 is asked for. In a scene
// the books of energy close within half a percent, as in particles_rotation_books_test.cpp.
#include <gtest/gtest.h>

#include "tests/unit/particles_periodic_case.hpp"
#include "tests/unit/particles_periodic_scenes.hpp"
#include "tests/unit/particles_side.hpp"
#include "tests/unit/particles_turning_builders.hpp"

namespace standoff::particles {
namespace {

using namespace standoff::particles::test;

/// The middle, then across a face and across an edge of the scene.
const Vec3 places[] = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0.5, 0.5, 0}};

struct Turned {
  SandState sand;
  double rotation, energy, friction_loss;  // J
  Vec3 turned;                             // kg m2/s, change of the angular momentum about where the pair met
};

/// The nearest images of the grains to `place`, so that the pair is whole.
SandState around(const Vec3& place, SandState sand) {
  for (Vec3& x : sand.position) x = nearest_image(x - place, sides.period);
  return sand;
}

Turned press_and_turn(const Vec3& place) {
  SandState sand = grains({place - Vec3{3.5 / 64, 2.5 / 64, 0}, place + Vec3{3.5 / 64, 2.5 / 64, 1.0 / 64}},
                          {{1, -0.5, 0.125}, {-1, 0, 0}});
  let_grains_turn(sand);
  sand.spin = {{4, -2, 8}, {0, 1, 3}};
  SandPairs pairs({{1e4, 0.3, 0.0}, {}, Vec3{1, 1, 0}, 0.2, 1, true});
  pairs.forces(sand, 0.0);
  const Vec3 start = angular_momentum(around(place, sand));
  const double energy = all_energy(sand, pairs);
  for (int step = 0; step < 40; ++step) turning_step(sand, pairs, 1e-3), wrap(sides, nullptr, &sand);
  return {sand, rotation_energy(sand), all_energy(sand, pairs) / energy, pairs.books().friction_loss,
          angular_momentum(around(place, sand)) - start};
}

TEST(PeriodicRotation, GrainsThatRub_TurnAcrossFacesAsInTheMiddle) {
  const Turned middle = press_and_turn(places[0]);
  EXPECT_GT(middle.friction_loss, 0.0);
  EXPECT_NE(middle.sand.spin[0], (Vec3{4, -2, 8})) << "they must have turned each other";
  for (const Vec3& place : places) {
    const Turned there = press_and_turn(place);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(norm(there.sand.spin[i] - middle.sand.spin[i]), 1e-12 / radius) << place.x << ", " << place.y;
      EXPECT_LE(norm(there.sand.velocity[i] - middle.sand.velocity[i]), 1e-12) << place.x << ", " << place.y;
    }
    EXPECT_NEAR(there.rotation, middle.rotation, 1e-12 * middle.rotation) << "J";
    EXPECT_NEAR(there.energy, 1.0, 0.005) << "of the energy at the start";
    EXPECT_LT(norm(there.turned), 1e-13) << "kg m2/s about where the pair met";
  }
}

TEST(PeriodicRotation_OfSandThatIsThrownThroughFaces, KeepsTheBooksAndNoThreadOrStopChangesABit) {
  const CaseSpec spec = periodic_case("dry", "[contact]\nsurface_friction = 0.3\n[effects]\ngrain_rotation = \"on\"\n",
                                      {{"run.stand_off", "80 mm"}});
  Side whole(spec, 1, flat_mesh(4, 0.05, 1e-2));
  ParticleLedger ledger;
  ledger.open(whole.loop.energy(), whole.loop.momentum_everywhere());
  std::string saved;
  for (int k = 0; k < 40; ++k) {
    whole.run(k, k + 1), ledger.observe(whole.loop.energy());
    if (k == 30) saved = whole.saved();
  }
  EXPECT_LT(ledger.energy_error(), 0.005);
  EXPECT_LT(norm(whole.loop.momentum_everywhere() - ledger.initial_momentum()),
            1e-11 * (1.0 + whole.loop.impulse_scale()));
  EXPECT_GT(whole.loop.energy().sand_rotation, 0.0);
  EXPECT_EQ(whole.loop.energy().sand_rotation, rotation_energy(whole.scene.sand));
  EXPECT_EQ(whole.loop.energy().escaped(), 0.0);
  Side resumed(spec, 2, flat_mesh(4, 0.05, 1e-2));
  resumed.read(saved);
  resumed.run(31, 40);
  EXPECT_TRUE(resumed.state() == whole.state());
}

}  // namespace
}  // namespace standoff::particles
