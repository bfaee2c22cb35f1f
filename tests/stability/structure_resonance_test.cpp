// A mode of period three steps, omega dt = sqrt 3, is driven by the quadratic part of its own force: third-order
// resonance of central differences [Schlick, Mandziuk, Skeel, Srinivas, J. Comput. Phys. 140 (1998) 1]. A free elastic
// plate is given its fastest mode, as fast as sand makes it ring (30 to 100 m/s in a strong plate). A linear mode keeps
// v^2 + omega^2 u^2 (1 - (omega dt / 2)^2), so its energy swings between 1 and 1 / (1 - share^2) of the first.
#include <gtest/gtest.h>

#include "structure_solver/step/central_difference.hpp"
#include "tests/unit/structure_plate_case.hpp"
#include "tests/verification/structure_frequency.hpp"

namespace standoff::structure {
namespace {

using testing::fastest_mode;

/// Largest energy over the first, in `steps` steps from the fastest mode at `speed` [m/s].
double energy_gain(double share_of_stable_step, double speed, int steps) {
  CaseSpec spec = testing::plate_case(1, false);
  spec.plate.material.law = MaterialLaw::elastic;
  spec.plate.edges = "free";
  PlateHex64 model(spec, 1);
  const testing::FastestMode mode = fastest_mode(model, 2000);
  const Eigen::VectorXd v = speed * mode.shape;
  model.relaxation()->set_state(std::vector<double>(static_cast<std::size_t>(v.size()), 0.0),
                                std::vector<double>(v.data(), v.data() + v.size()));
  double first = 0.0, largest = 0.0;
  for (int i = 0; i < steps; ++i) {
    model.step(share_of_stable_step * mode.stability_limit());
    const StructureLedger books = model.ledger();
    const double energy = books.kinetic + books.elastic;
    if (i == 0) first = energy;
    largest = std::max(largest, energy);
    if (energy > 10.0 * first) break;
  }
  return largest / first;
}

TEST(Resonance_ElasticPlate, StepOfTheModel_EnergyStaysInItsSwing) {
  for (const double speed : {10.0, 30.0, 60.0, 100.0})
    EXPECT_LT(energy_gain(step_safety, speed, 1000), 1.0 / (1.0 - step_safety * step_safety)) << speed << " m/s";
}

// What the smaller step prevents: the step is stable in the sense of linear theory.
TEST(Resonance_ElasticPlate, PeriodOfThreeSteps_EnergyLeavesAllBounds) {
  const double share = std::sqrt(3.0) / 2.0;  // 0.866; the swing ends at 4
  for (const double speed : {30.0, 60.0, 100.0}) EXPECT_GT(energy_gain(share, speed, 1000), 10.0) << speed << " m/s";
}

}  // namespace
}  // namespace standoff::structure
