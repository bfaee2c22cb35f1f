// The clamped plate at the paper's mesh, 40 x 40 x 1 (a quarter of 20 x 20): first frequency within 0.3 % of
// Kirchhoff's 175.84 Hz (Leissa, NASA SP-160, table 4.28: 35.985). Cubic elements converge from above, shear lowers by
// under 0.1 %.
#include "tests/unit/structure_plate_case.hpp"
#include "tests/verification/structure_frequency.hpp"

namespace standoff::structure {
namespace {

TEST(ClampedPlate_FirstFrequency, FortyByForty_IsWithinThreePermilleOfKirchhoff) {
  PlateHex64 model(testing::plate_case(40, true), 2);
  const double f = testing::first_frequency(model);
  RecordProperty("first_frequency_Hz", std::to_string(f));
  EXPECT_NEAR(f, 175.84, 0.003 * 175.84) << "Hz";
}

}  // namespace
}  // namespace standoff::structure
