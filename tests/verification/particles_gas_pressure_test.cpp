// Law: a fluid of hard spheres has p V = Z N k T with Z = (1 + f + f^2 - f^3) / (1 - f)^3 at fill fraction f
// [Carnahan & Starling, J. Chem. Phys. 51 (1969) 635]; Z is measured from the virial, Z = 1 + sum |J| d / (3 N k T
// time). Internal energy does not enter, so it is on. Tolerance: 1 %, the accuracy asked of the collision stage (the
// fit itself is good to 0.3 %), plus three standard errors of the mean, taken from 16 blocks of the run; the run must
// be long enough for the standard error to be below 0.4 %.
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles {
namespace {

struct Measured {
  double z = 0.0, standard_error = 0.0;
};

Measured measure(double fill, int warm_up, int steps) {
  constexpr int blocks = 16;
  GasState gas = test::lattice_gas(7, fill, 1.4, 2.0 / 3.0);
  GasCollideOptions options;
  options.periodic.period = period_of({1.0, 1.0, 1.0});
  GasCollide collide(options);
  double virial = 0.0, work = 0.0;  // work: sum of 3 N k T h
  std::vector<double> z;
  int step = -warm_up;
  test::run_gas(collide, gas, nullptr, nullptr, warm_up + steps, 1e9, [&](const GasCollideCounts& counts, double h) {
    if (step++ < 0) return;
    virial += counts.pair_virial, work += 2.0 * gas_totals(gas).kinetic * h;
    if (step % (steps / blocks) != 0) return;
    z.push_back(1.0 + virial / work);
    virial = work = 0.0;
  });
  Measured result;
  double square = 0.0;
  for (const double value : z) result.z += value / static_cast<double>(z.size());
  for (const double value : z) square += (value - result.z) * (value - result.z);
  const double n = static_cast<double>(z.size());
  result.standard_error = std::sqrt(square / (n * (n - 1.0)));
  return result;
}

class HardSphereFluid : public testing::TestWithParam<double> {};

TEST_P(HardSphereFluid, DefaultStep_PressureIsCarnahanStarling) {
  const double f = GetParam(), exact = (1 + f + f * f - f * f * f) / std::pow(1 - f, 3);
  const Measured measured = measure(f, 160, f > 0.3 ? 960 : 480);
  EXPECT_LT(measured.standard_error, 0.004 * exact) << "too short a run to tell";
  EXPECT_NEAR(measured.z, exact, 0.01 * exact + 3.0 * measured.standard_error)
      << "fill " << f << ": off by " << 100 * (measured.z / exact - 1) << " %";
}
INSTANTIATE_TEST_SUITE_P(Fills, HardSphereFluid, testing::Values(0.02, 0.10, 0.20, 0.35, 0.45));

}  // namespace
}  // namespace standoff::particles
