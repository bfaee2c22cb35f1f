// The books of the explicit phase. Momentum: impulse received plus impulse of clamps and mirror planes is the momentum,
// to rounding (1e-12 of the impulses, 500 steps). Energy of a linear problem: external work equals stored plus kinetic
// energy up to dt^2/8 m a^2, which for a smooth load is (omega dt)^2 / 4 of the energy in each mode.
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using testing::plate_case;
using testing::pressure_force;

std::uint64_t hash_of(const StructuralModel& model) {
  StateHash hash;
  model.add_to(hash);
  return hash.value();
}

/// Uneven hits on random quads, another every five steps.
void hammer(PlateHex64& model, int steps) {
  CounterRandom random(3, RandomUse::test, 1);
  const SurfaceMesh& surface = model.surface();
  for (int i = 0; i < steps; ++i) {
    if (i % 5 == 0) {
      std::vector<Vec3> force(surface.position.size());
      for (int hit = 0; hit < 4; ++hit) {
        const auto quad = static_cast<std::size_t>(random.uniform() * static_cast<double>(surface.quads.size()));
        for (const auto node : surface.quads[quad])
          force[static_cast<std::size_t>(node)] +=
              Vec3{6e3 * random.normal(), 6e3 * random.normal(), -6e4 * random.uniform()};
      }
      model.set_surface_force(force);
    }
    model.step(model.stable_step());
  }
}

TEST(PlateBooks_Momentum, UnderUnevenHits_ReceivedPlusSupportsIsMomentum) {
  for (const bool quarter : {true, false}) {
    PlateHex64 model(plate_case(4, quarter), 1);
    hammer(model, 500);
    const StructureLedger l = model.ledger();
    const double scale = norm(l.momentum) + norm(l.impulse_received) + norm(l.impulse_of_supports);
    ASSERT_GT(norm(l.impulse_of_supports), 1e-3 * scale);
    EXPECT_LT(norm(l.momentum - l.impulse_received - l.impulse_of_supports), 1e-12 * scale) << "N s";
  }
}

// Without clamps nothing but the load gives momentum, and a pressure pulse moves the plate by impulse over mass.
TEST(PlateBooks_FreePlate, UnderPressure_MovesByImpulseOverMass) {
  CaseSpec spec = plate_case(4, false);
  spec.plate.edges = "free";
  PlateHex64 model(spec, 1);
  model.set_surface_force(pressure_force(model.plate().mesh(), 1e5));
  double impulse = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double dt = model.stable_step();
    model.step(dt);
    impulse -= 1e5 * 0.406 * 0.406 * dt;
  }
  const StructureLedger l = model.ledger();
  EXPECT_NEAR(l.impulse_received.z / impulse, 1.0, 1e-12);
  EXPECT_NEAR(l.momentum.z / impulse, 1.0, 1e-12);
  EXPECT_EQ(norm(l.impulse_of_supports), 0.0);
}

TEST(PlateBooks_Energy, ElasticPlateUnderASmoothPulse_Closes) {
  PlateHex64 model(plate_case(6, true, 1e12), 1);
  double peak = 0.0, worst = 0.0;
  const double duration = 60e-6;
  while (model.time() < 2.0 * duration) {
    const double phase = model.time() / duration;
    model.set_surface_force(
        pressure_force(model.plate().mesh(), phase < 1.0 ? 4e6 * std::pow(std::sin(M_PI * phase), 2) : 0.0));
    for (int i = 0; i < 10; ++i) model.step(model.stable_step());
    const StructureLedger l = model.ledger();
    peak = std::max(peak, l.external_work);
    worst = std::max(worst, std::fabs(l.balance()));
  }
  EXPECT_GT(peak, 1.0) << "J";
  EXPECT_LT(worst, 1e-3 * peak) << "J of " << peak;
}

// A plate nobody touches does not move in any bit.
TEST(PlateBooks_NoLoad, ManySteps_LeaveEveryBit) {
  PlateHex64 model(plate_case(4, true), 1);
  const std::uint64_t before = hash_of(model);
  model.set_surface_force(std::vector<Vec3>(model.surface().position.size()));
  for (int i = 0; i < 2000; ++i) model.step(model.stable_step());
  EXPECT_EQ(hash_of(model), before);
  EXPECT_EQ(model.ledger().balance(), 0.0);
}

TEST(PlateBooks_Threads, OneTwoAndThree_GiveTheSameBits) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3}) {
    PlateHex64 model(plate_case(8, false), threads);
    hammer(model, 30);
    EXPECT_EQ(model.plate().threads(), threads);
    EXPECT_GT(model.extremes().max_plastic_strain, 0.0) << "the load was meant to make it flow";
    StateHash hash;
    model.add_to(hash);
    const StructureLedger l = model.ledger();
    for (const double v : {l.external_work, l.plastic, l.elastic, l.kinetic}) hash.add(v);
    if (threads == 1) first = hash.value();
    EXPECT_EQ(hash.value(), first) << threads << " threads";
  }
}

// Publishing the motion is publishing N u and N v at the same time level: the work of a held surface force over a step
// is the force times the way of the surface.
TEST(PlateBooks_SurfaceMotion, OverAStep_WorkIsForceTimesWayOfTheSurface) {
  PlateHex64 model(plate_case(4, true), 1);
  const std::vector<Vec3> force = pressure_force(model.plate().mesh(), 3e6);
  model.set_surface_force(force);
  SurfaceMotion before, after;
  double work = 0.0;
  for (int i = 0; i < 50; ++i) {
    model.surface_motion(before);
    model.step(model.stable_step());
    model.surface_motion(after);
    for (std::size_t n = 0; n < force.size(); ++n) work += dot(force[n], after.position[n] - before.position[n]);
  }
  EXPECT_NEAR(work / model.ledger().external_work, 1.0, 1e-10);  // positions carry 1e-17 m, ways 1e-7 m: 1e-10 a step
}

}  // namespace
}  // namespace standoff::structure
