// An impulsively loaded plate: 130 N s with the shape cos^2(theta)/d^2 of a charge at 150 mm, 10x10 elements.
// Reference: an independent code (updated Lagrangian tables of the same element, same mesh): peak 24.84 mm; its mesh
// converges to 24.91 mm. Tolerance 0.3 %: the spread between meshes. Energy balance below 1e-3 of the initial energy:
// central differences at 0.8 of the stable step, error of second order; an unstable step misses by far more.
#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using testing::give_impulse;
using testing::plate_case;

struct Flight {
  double peak = 0.0, energy_error = 0.0, start_energy = 0.0;
};

/// Runs to `until`; the balance starts at minus the kinetic energy that was given without work.
Flight fly(PlateHex64& model, double until, double step_factor = 1.0) {
  Flight r;
  r.start_energy = model.ledger().kinetic;
  const double start = model.ledger().balance();
  for (int i = 0; model.time() < until; ++i) {
    model.step(step_factor * model.stable_step());
    r.peak = std::max(r.peak, model.centre_deflection());
    if (i % 20 == 0)
      r.energy_error = std::max(r.energy_error, std::fabs(model.ledger().balance() - start) / r.start_energy);
  }
  return r;
}

TEST(ImpulsivePlate_Peak, HundredAndThirtyNewtonSeconds_DeflectsAsTheReference) {
  PlateHex64 model(plate_case(10, true), 1);
  give_impulse(model, 130.0);
  const Flight r = fly(model, 0.56e-3);
  EXPECT_NEAR(1e3 * r.peak, 24.84, 0.075) << "mm";
  EXPECT_LT(r.energy_error, 1e-3) << "of " << 4.0 * r.start_energy << " J";
  EXPECT_GE(model.max_deflection(), model.centre_deflection());
}

// Plasticity hides an unstable step: the deflection stays plausible. The books do not.
TEST(ImpulsivePlate_UnstableStep, TwoPercentBeyondTheLimit_ShowsInTheEnergyBalance) {
  PlateHex64 model(plate_case(6, true), 1);
  give_impulse(model, 130.0);
  double error = 0.0;
  try {
    error = fly(model, 0.2e-3, 1.03 / step_safety * 1.02)
                .energy_error;  // the element bound lies 1.7 % below the assembled limit
  } catch (const std::runtime_error&) {
    error = 1.0;  // torn apart: noticed as well
  }
  EXPECT_GT(error, 0.01) << "of the initial energy";
}

// A quarter with mirror planes and the whole plate carry the same plate, to rounding grown over the steps: each step
// adds eps of the displacement; flow is contractive.
TEST(ImpulsivePlate_Symmetry, QuarterAndWhole_AgreeInEveryFigure) {
  PlateHex64 quarter(plate_case(6, true), 1), whole(plate_case(6, false), 1);
  for (PlateHex64* model : {&quarter, &whole}) {
    give_impulse(*model, 130.0);
    while (model->time() < 0.1e-3) model->step(0.12e-6);
  }
  const StructureLedger q = quarter.ledger(), w = whole.ledger();
  EXPECT_NEAR(quarter.centre_deflection() / whole.centre_deflection(), 1.0, 1e-9);
  EXPECT_NEAR(4.0 * q.plastic / w.plastic, 1.0, 1e-9);
  EXPECT_NEAR(4.0 * q.elastic / w.elastic, 1.0, 1e-9);
  EXPECT_NEAR(4.0 * q.kinetic / w.kinetic, 1.0, 1e-9);
  EXPECT_NEAR(quarter.extremes().max_plastic_strain / whole.extremes().max_plastic_strain, 1.0, 1e-9);
  const auto pq = quarter.profile(), pw = whole.profile();
  ASSERT_EQ(pq.size(), pw.size());
  for (std::size_t i = 0; i < pq.size(); ++i) {
    EXPECT_NEAR(pq[i].x, pw[i].x, 1e-12);
    EXPECT_NEAR(pq[i].deflection, pw[i].deflection, 1e-9 * whole.centre_deflection());
  }
}

}  // namespace
}  // namespace standoff::structure
