// Order of convergence of cubic elements: frequencies of a smooth mode converge with h^(2 p) = h^6, p = 3. The thick
// pinned plate (h / a = 0.2) has Navier's mode, sin and cos in the plane, without a singularity at the edge; its
// thickness is one element throughout, so the limit is that of infinitely many elements in the plane, taken from the
// finest mesh. The first mode of 2, 4 and 8 elements: 5.5 of 6 asked, for the coarsest is not yet in the asymptotic
// range.
#include "tests/unit/structure_plate_case.hpp"
#include "tests/verification/structure_frequency.hpp"

namespace standoff::structure {
namespace {

double frequency_of(int elements) {
  CaseSpec spec = testing::plate_case(elements, true);
  spec.plate.edges = "pinned";
  spec.plate.size.z = 0.0812;
  PlateHex64 model(spec, 1);
  return testing::first_frequency(model);
}

TEST(Hex64_Convergence, FirstFrequencyOfAThickPinnedPlate_HasTheSixthOrder) {
  const double finest = frequency_of(12), coarse = frequency_of(2) - finest, middle = frequency_of(4) - finest;
  ASSERT_GT(middle, 0.0) << "Hz; a Rayleigh quotient comes from above";
  EXPECT_GT(std::log2(coarse / middle), 5.5) << coarse << " and " << middle << " Hz above " << finest;
}

}  // namespace
}  // namespace standoff::structure
