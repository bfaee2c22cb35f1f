// Law: in a scene that repeats a pair whose ends lie at opposite faces is the same pair as in the middle. Places are
// multiples of 1/64 of a period of 1 m, so that gaps have the same bits wherever the pair is, and with them the
// impulse: velocities after a hit are compared without tolerance. Places at the end are off by the rounding of numbers
// of size 1: 4 x 2^-53. A second hit sees the places the first one left: four times that. Paths of many steps (springs)
// add 40 such roundings to overlaps of 1e-2: 1e-12 of the velocities.
#include <gtest/gtest.h>

#include "particle_solver/step/hard_core.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/wrap.hpp"
#include "tests/unit/particles_air_scenes.hpp"
#include "tests/unit/particles_gas_scenes.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

const PeriodicSides sides = periodic_sides(true, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
constexpr double radius = 1.0 / 16, h = 1.0 / 32;
constexpr double rounding = 4 * 0x1p-53;

/// The middle, then across a face and across an edge of the scene.
const Vec3 places[] = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0.5, 0.5, 0}};

struct Outcome {
  std::vector<Vec3> velocity, position;
  long hits = 0;
};

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
Vec3 home(const Vec3& x) {
  return image_inside(sides, x);
}

GasState spheres(const std::vector<Vec3>& at, const std::vector<Vec3>& velocity) {
  GasState gas;
  gas.mass = 1.0, gas.radius = radius, gas.gamma = 1.4;
  for (std::uint32_t i = 0; i < at.size(); ++i) gas.position.push_back(home(at[i])), gas.id.push_back(i);
  gas.velocity = velocity, gas.internal_energy.assign(at.size(), 0.5);
  return gas;
}
SandState grains(const std::vector<Vec3>& at, const std::vector<Vec3>& velocity) {
  std::vector<Vec3> inside;
  for (const Vec3& x : at) inside.push_back(home(x));
  SandState sand = make_grains(std::move(inside), radius, 3.0);
  sand.velocity = velocity;
  return sand;
}

Outcome after_sub_step(GasState gas, SandState* sand, SurfaceSheet* sheet) {
  GasCollideOptions options;
  options.periodic = sides;
  const GasCollideCounts counts = GasCollide(options).run(gas, sand, sheet, h, 1);  // of no call that sorts the arrays
  gas_drift(gas, sand, sheet, h);
  Outcome outcome{gas.velocity, gas.position, counts.hits()};
  if (sand == nullptr) return outcome;
  outcome.velocity.insert(outcome.velocity.end(), sand->velocity.begin(), sand->velocity.end());
  outcome.position.insert(outcome.position.end(), sand->position.begin(), sand->position.end());
  return outcome;
}

TEST(PeriodicPairs, GasAndGas_MeetAcrossFacesAsInTheMiddle) {
  compare_places([](const Vec3& place) {
    const Vec3 a{-5.0 / 64, 1.0 / 64, 0.0}, b{5.0 / 64, 0.0, 1.0 / 64};
    return after_sub_step(spheres({place + a, place + b}, {{2, 0, 0}, {-2, 0.5, 0}}), nullptr, nullptr);
  });
}

TEST(PeriodicPairs, AGrainBetweenTwoGasSpheres_IsHitByBothAcrossFaces) {
  compare_places(
      [](const Vec3& place) {
        const Vec3 a{-9.0 / 64, 1.0 / 64, 0.0}, b{9.0 / 64, 0.0, 0.0};
        SandState sand = grains({place}, {{0.25, 0.25, 0}});
        return after_sub_step(spheres({place + a, place + b}, {{2, 0, 0}, {-2, 0.5, 0}}), &sand, nullptr);
      },
      4 * rounding);
}

TEST(PeriodicPairs, AirAndGrain_MeetAcrossFacesAsInTheMiddle) {
  compare_places([](const Vec3& place) {
    const auto air = air_in({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0.125, 2.0});
    const double size = air->particles.radius;
    static_cast<GasState&>(air->particles) = spheres({place + Vec3{5.0 / 64, 1.0 / 64, 0}}, {{-2, 0.5, 0}});
    air->particles.radius = size, air->particles.disturbed.assign(1, 0);
    air->particles.plate_rebound.assign(1, std::numeric_limits<double>::quiet_NaN());
    SandState sand = grains({place}, {{0.25, 0, 0}});
    const AirDriftCounts counts = AirDrift({}, 1, sides).run(*air, &sand, nullptr, h);
    return Outcome{{air->particles.velocity[0], sand.velocity[0]},
                   {air->particles.position[0], sand.position[0]},
                   counts.sand_hits};
  });
}

TEST(PeriodicPairs, GrainsThatPressAndSlide_DoSoAcrossFacesAsInTheMiddle) {
  compare_places(
      [](const Vec3& place) {
        SandState sand =
            grains({place - Vec3{4.5 / 64, 0, 0}, place + Vec3{4.5 / 64, 0, 1.0 / 64}}, {{1, 1, 0.125}, {-1, 0, 0}});
        SandPairs pairs({{1e4, 0.3, 0.05}, {}, Vec3{1, 1, 0}, 0.2, 1});
        pairs.forces(sand, 0.0);
        Outcome outcome;
        for (int step = 0; step < 40; ++step) {
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
    SandState sand =
        grains({place - Vec3{2.0 / 64, 0, 0}, place + Vec3{2.0 / 64, 0, 1.0 / 64}}, {{1, 0, 0}, {-1, 0, 0}});
    SandPairs pairs({{1e4, 0.0, 0.0}, {}, Vec3{1, 1, 0}, 0.2, 1});
    pairs.forces(sand, 0.0);
    const HardCoreCounts counts = HardCore().run(sand, pairs);
    return Outcome{sand.velocity, sand.position, counts.hits};
  });
}

/// A wall that does not give way and ends at the faces: what flies out over it meets the next one.
TEST(PeriodicPairs, GasAndAirThatLeaveWithinAStep_HitTheNextPlate) {
  for (const double x : {0.0, 29.0 / 64}) {
    SurfaceSheet sheet(test::flat_mesh(4, 0.5, 1.0), {.recedes = false});
    const Vec3 at{x, 0.0, 6.0 / 64}, velocity{4, 0, -2};
    const Outcome gas = after_sub_step(spheres({at}, {velocity}), nullptr, &sheet);
    EXPECT_EQ(gas.hits, 1) << "gas from x = " << x;
    EXPECT_NEAR(gas.velocity[0].z, 2.0, 1e-14);
    EXPECT_NEAR(sheet.total_impulse().z, -4.0, 1e-14);
    const auto air = air_in({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0.125, 2.0});
    static_cast<GasState&>(air->particles) = spheres({at}, {velocity});
    air->particles.disturbed.assign(1, 0), air->particles.plate_rebound.assign(1, 0.0);
    EXPECT_EQ(AirDrift({}, 1, sides).run(*air, nullptr, &sheet, h).sheet_hits, 1) << "air from x = " << x;
  }
}

TEST(PeriodicAir, DisturbedAtAFace_WakesAcrossItAndNothingFlowsInThere) {
  AirCells cells({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0.125, 0.0, 0.0, false, false, true});
  cells.disturb({0.49, -0.49, 0.1});
  cells.wake();
  EXPECT_EQ(cells.state_at({-0.49, 0.49, 0.1}), AirCell::awake) << "behind the edge";
  EXPECT_EQ(cells.state_at({-0.3, 0.3, 0.1}), AirCell::asleep);
  cells.wake_all();
  cells.wake();
  EXPECT_EQ(cells.sources().size(), 2u * 8 * 8) << "top and bottom";
  for (const AirSource& source : cells.sources()) EXPECT_EQ(source.axis, 2);
}

}  // namespace
}  // namespace standoff::particles
