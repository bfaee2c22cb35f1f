// Elementary functions and tensor series of the material kernels against the C library and eigenvalues.
// Tolerances: exp and log are polynomials with remainders below 5e-18 and about ten roundings: 4 eps (exp of a large
// argument also carries the rounding of the argument, 1 eps of |x|). Series: the remainders stated in
// tensor_series.hpp.
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "structure_solver/elements/lane_math.hpp"
#include "structure_solver/elements/tensor_series.hpp"

namespace standoff::structure {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(LaneMath_Exponential, OverItsRange_AgreesWithTheLibrary) {
  for (double x = -690.0; x < 690.0; x += 0.737) {
    const double expected = std::exp(x);
    EXPECT_NEAR(exponential(x) / expected, 1.0, 4.0 * eps) << "x = " << x;
  }
  EXPECT_EQ(exponential(0.0), 1.0);
}

TEST(LaneMath_Logarithm, OverItsRange_AgreesWithTheLibrary) {
  for (double e = -290.0; e < 290.0; e += 0.317) {
    const double x = std::pow(10.0, e);
    EXPECT_NEAR(logarithm(x), std::log(x), 4.0 * eps * std::max(1e-3, std::fabs(std::log(x)))) << "x = " << x;
  }
  for (const double near : {1.0 - 1e-9, 1.0 + 1e-9, 0.75, 1.4}) {
    EXPECT_NEAR(logarithm(near) / std::log(near), 1.0, 4.0 * eps) << "x = " << near;
  }
  EXPECT_EQ(logarithm(1.0), 0.0);
}

TEST(LaneMath_FourLanes, AnyArguments_HoldTheBitsOfTheScalarFunction) {
  const std::array<double, 4> x = {1e-12, 0.37, 1.0, 5.4e3};
  const Pack4 pack(Pack4::Raw{x[0], x[1], x[2], x[3]});
  const Pack4 e = exponential(pack), l = logarithm(pack), r = raise(pack, 0.82);
  for (int i = 0; i < 4; ++i) {
    const double s = x[static_cast<std::size_t>(i)];
    EXPECT_EQ(lane(e, i), exponential(s));
    EXPECT_EQ(lane(l, i), logarithm(s));
    EXPECT_EQ(lane(r, i), raise(s, 0.82));
  }
}

Sym3<double> sample(double size) {
  return {0.31 * size, -0.52 * size, 0.17 * size, 0.4 * size, -0.23 * size, 0.19 * size};
}

double distance(const Sym3<double>& a, const Sym3<double>& b) {
  const Sym3<double> d{a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.zx - b.zx};
  return std::sqrt(contract(d, d));
}

TEST(TensorSeries_Logarithm, InsideItsRange_EqualsTheEigenvalueForm) {
  for (const double size : {1e-14, 1e-8, 1e-3, 0.02, 0.05}) {  // |sample(1)| = 0.98
    const Sym3<double> x = sample(size);
    const double error = distance(log_one_plus(x), by_eigenvalues(x, [](double v) { return std::log1p(v); }));
    EXPECT_LT(error, size * 1e-14) << "size " << size;
  }
}

TEST(TensorSeries_Exponential, InsideItsRange_EqualsTheEigenvalueForm) {
  for (const double size : {1e-14, 1e-8, 1e-3, 0.02, 0.05}) {
    const Sym3<double> z = sample(size);
    const double error = distance(exp_minus_one(z), by_eigenvalues(z, [](double v) { return std::expm1(v); }));
    EXPECT_LT(error, size * 1e-14) << "size " << size;
  }
}

// Beyond the range the eigenvalue route takes over; exp(log) must come back over a wide range of strains.
TEST(TensorSeries_LargeStrain, ExponentialOfLogarithm_ReturnsTheTensor) {
  for (const double size : {0.059, 0.0625, 0.3, 1.2}) {
    const Sym3<double> x = sample(size);
    EXPECT_LT(distance(exp_minus_one(log_one_plus(x)), x), size * 1e-13) << "size " << size;
  }
}

TEST(TensorSeries_MixedLanes, OneLaneOutside_LeavesTheOthersTheirBits) {
  Sym3<Pack4> x;
  const double sizes[4] = {0.01, 0.5, 1e-6, 0.04};
  for (int i = 0; i < 4; ++i) set_lane(x, i, sample(sizes[i]));
  const Sym3<Pack4> result = log_one_plus(x);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(lane(result, i).xy, log_one_plus(sample(sizes[i])).xy) << "lane " << i;
  }
}

}  // namespace
}  // namespace standoff::structure
