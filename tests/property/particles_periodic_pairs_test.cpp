// Law: in a scene that repeats a pair whose ends lie at opposite faces is the same pair as in the middle. Places are
// multiples of 1/64 of a period of 1 m, so that gaps have the same bits wherever the pair is, and with them the
// impulse: velocities after a hit are compared without tolerance. Places at the end are off by the rounding of numbers
// of size 1: 4 x 2^-53. The line of centres of a second hit is off by that over the contact distance, 1/8 m, its
// impulse by 4 m/s of it: 32 times. Paths of many steps (springs)
// add 40 such roundings to overlaps of 1e-2: 1e-12 of the velocities.
#include <gtest/gtest.h>

#include "particle_solver/step/hard_core.hpp"
#include "tests/unit/particles_periodic_scenes.hpp"

namespace standoff::particles {
namespace {

using namespace standoff::particles::test;

constexpr double rounding = 4 * 0x1p-53;

/// The middle, then across a face and across an edge of the scene.
const Vec3 places[] = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0.5, 0.5, 0}};

void expect_same(const Outcome& there, const Outcome& middle, const Vec3& place, double tolerance) {
  ASSERT_GT(middle.hits, 0) << "the pair must meet";
  EXPECT_EQ(there.hits, middle.hits) << place.x << ", " << place.y;
  for (std::size_t i = 0; i < middle.velocity.size(); ++i) {
    EXPECT_LE(norm(there.velocity[i] - middle.velocity[i]), tolerance) << place.x << ", " << place.y;
    const Vec3 apart = nearest_image(there.position[i] - middle.position[i] - place, sides.period);
    EXPECT_LE(norm(apart), rounding + tolerance);
  }
}
template <class Run>
void compare_places(Run&& run, double tolerance = 0.0) {
  const Outcome middle = run(places[0]);
  for (const Vec3& place : places) expect_same(run(place), middle, place, tolerance);
}
TEST(PeriodicPairs, GasAndGas_MeetAcrossFacesAsInTheMiddle) {
  compare_places([](const Vec3& place) {
    const Vec3 a{-4.0 / 64, -3.0 / 64, 0.0}, b{4.0 / 64, 3.0 / 64, 1.0 / 64};
    return after_sub_step(spheres({place + a, place + b}, {{2, 1, 0}, {-2, -0.5, 0}}), nullptr, nullptr);
  });
}

TEST(PeriodicPairs, AGrainBetweenTwoGasSpheres_IsHitByBothAcrossFaces) {
  compare_places(
      [](const Vec3& place) {
        const Vec3 a{-7.0 / 64, -5.0 / 64, 0.0}, b{7.0 / 64, 5.0 / 64, 0.0};
        SandState sand = grains({place}, {{0.25, 0.25, 0}});
        return after_sub_step(spheres({place + a, place + b}, {{2, 1, 0}, {-2, -1.5, 0}}), &sand, nullptr);
      },
      32 * rounding);
}

TEST(PeriodicPairs, AirAndGrain_MeetAcrossFacesAsInTheMiddle) {
  compare_places([](const Vec3& place) {
    const auto air = air_in({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0.125, 2.0});
    const double size = air->particles.radius;
    static_cast<GasState&>(air->particles) = spheres({place + Vec3{2.0 / 64, 1.0 / 64, 0}}, {{-2, -1.5, 0}});
    air->particles.radius = size, air->particles.disturbed.assign(1, 0);
    air->particles.plate_rebound.assign(1, std::numeric_limits<double>::quiet_NaN());
    SandState sand = grains({place - Vec3{3.0 / 64, 2.0 / 64, 0}}, {{0.25, 0, 0}});
    const AirDriftCounts counts = AirDrift({}, 1, sides).run(*air, &sand, nullptr, sub_step);
    return Outcome{{air->particles.velocity[0], sand.velocity[0]},
                   {air->particles.position[0], sand.position[0]},
                   counts.sand_hits};
  });
}

/// A third grain is taken out while they press, and one of the two is seen at its image: lists are made anew, springs
/// and displacements go on.
TEST(PeriodicPairs, GrainsThatPressAndSlide_DoSoAcrossFacesAsInTheMiddle) {
  compare_places(
      [](const Vec3& place) {
        SandState sand =
            grains({place - Vec3{3.5 / 64, 2.5 / 64, 0}, place + Vec3{3.5 / 64, 2.5 / 64, 1.0 / 64}, {0.25, 0.25, 0.4}},
                   {{1, -0.5, 0.125}, {-1, 0, 0}, {}});
        SandPairs pairs({{1e4, 0.3, 0.05}, {}, Vec3{1, 1, 0}, 0.2, 1});
        pairs.forces(sand, 0.0);
        Outcome outcome;
        for (int step = 0; step < 40; ++step) {
          if (step == 20) {
            if (place != places[0]) sand.position[0].x += 1.0;
            sand.position.pop_back(), sand.velocity.pop_back(), sand.force.pop_back(), sand.id.pop_back();
          }
          sand_step(sand, pairs, 1e-3, 1);
          wrap(sides, nullptr, &sand);
          outcome.hits += pairs.books().most_contacts;
        }
        EXPECT_GT(pairs.books().friction_loss, 0.0);
        outcome.velocity = sand.velocity, outcome.position = sand.position;
        return outcome;
      },
      1e-12);
}

TEST(PeriodicPairs, GrainsPressedToTheCore_BounceAcrossFacesAsInTheMiddle) {
  compare_places([](const Vec3& place) {
    SandState sand = grains({place - Vec3{2.0 / 64, 1.0 / 64, 0}, place + Vec3{2.0 / 64, 1.0 / 64, 1.0 / 64}},
                            {{1, 0, 0}, {-1, 0, 0}});
    SandPairs pairs({{1e4, 0.0, 0.0}, {}, Vec3{1, 1, 0}, 0.2, 1});
    pairs.forces(sand, 0.0);
    const HardCoreCounts counts = HardCore().run(sand, pairs);
    return Outcome{sand.velocity, sand.position, counts.hits};
  });
}

}  // namespace
}  // namespace standoff::particles
