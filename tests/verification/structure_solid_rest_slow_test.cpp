// Permanent deflection of the impulsively loaded solid plates beside plate_hex64: 130 N s with the shape
// cos^2(theta)/d^2, 1 ms of free flight, then damped to rest. plate_hex64 keeps 20.42 and 20.44 mm on its finer meshes
// (structure_plate_rest_slow_test.cpp), peak 24.91 mm. Asked: 3 %, peak 1 %. Measured:
//   plate_hex27   21.03 mm at 10 a side (peak 25.05), 20.60 mm at 20 (24.91)
//   plate_hex8    20.36 mm at 10 a side, 30 x 30 bricks (24.86)
#include <gtest/gtest.h>

#include "structure_solver/relaxation/relaxation.hpp"
#include "tests/verification/structure_solid_case.hpp"

namespace standoff::structure {
namespace {

class SolidPlateAtRest : public ::testing::TestWithParam<const char*> {};

TEST_P(SolidPlateAtRest, HundredAndThirtyNewtonSeconds_KeepsTheDeflectionOfCubicElements) {
  const auto model = testing::solid_plate(GetParam(), 10, true);
  testing::give_impulse(*model, 130.0);
  const double energy = model->ledger().kinetic, start = model->ledger().balance();
  double peak = 0.0;
  while (model->time() < 1e-3) {
    model->step(model->stable_step());
    peak = std::max(peak, model->centre_deflection());
  }
  EXPECT_NEAR(1e3 * peak, 24.91, 0.01 * 24.91) << "mm";
  RelaxationOptions options;
  options.peak_kinetic_energy = energy;
  const RelaxationResult rest = relax_to_rest(*model->relaxation(), options);
  EXPECT_TRUE(rest.at_rest) << rest.message;
  EXPECT_NEAR(1e3 * model->centre_deflection(), 20.44, 0.03 * 20.44) << "mm";
  EXPECT_LT(std::fabs(model->ledger().balance() - start), 1e-3 * energy) << "J";
}

INSTANTIATE_TEST_SUITE_P(Models, SolidPlateAtRest, ::testing::Values("plate_hex27", "plate_hex8"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace standoff::structure
