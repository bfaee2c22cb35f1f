// A charge that is a cylinder (packing/charge.hpp): whole spheres within its radius, none overlaps, energy exact,
// spread evenly along the axis and over the section. For n independent uniform points the means of z/L and (r/R)^2
// scatter by 0.29 and 0.29 over sqrt(n); the stratified packing must be within three of those. Released in the order of
// the front.
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "particle_solver/packing/charge.hpp"

namespace standoff::particles {
namespace {

ChargeSpec cylinder(long particles) {
  ChargeSpec charge;
  charge.present = true;
  charge.explosive = {"c4", 1601.0, 8.7e9, 1.4, 0.20, 8190.0};
  charge.radius = 0.012715, charge.length = 0.1, charge.detonator = {0.0, 0.0, 0.1}, charge.particles = particles;
  charge.mass = 1601.0 * 3.141592653589793 * charge.radius * charge.radius * charge.length;
  return charge;
}

TEST(PackedCylinder, WholeAndQuarter_LieWithinAndAreEven) {
  for (const int copies : {1, 4}) {
    const ChargeSpec charge = cylinder(8000);
    const GasState gas = build_charge(charge, {0.0, 0.0, 0.05}, copies, 3);
    const double n = static_cast<double>(gas.size()), inner = charge.radius - gas.radius;
    ASSERT_EQ(gas.size(), 8000u / static_cast<unsigned>(copies));
    double z = 0.0, square = 0.0, energy = 0.0, smallest = 1.0;
    for (std::size_t i = 0; i < gas.size(); ++i) {
      const Vec3& x = gas.position[i];
      EXPECT_LE(std::hypot(x.x, x.y), inner * (1.0 + 1e-12));
      EXPECT_TRUE(x.z >= 0.0 && x.z <= 0.1);
      if (copies == 4) {
        EXPECT_GE(std::min(x.x, x.y), 0.0);
      }
      z += x.z / 0.1 / n, square += (x.x * x.x + x.y * x.y) / (inner * inner) / n;
      energy += 0.5 * gas.mass * squared_norm(gas.velocity[i]) + gas.internal_energy[i];
      for (std::size_t k = 0; k < i; ++k) smallest = std::min(smallest, norm(x - gas.position[k]));
      EXPECT_DOUBLE_EQ(gas.release_time[i], norm(x - charge.detonator) / 8190.0);
    }
    EXPECT_GE(smallest, 2.0 * gas.radius);
    EXPECT_NEAR(energy / (charge.mass / 1601.0 * 8.7e9 / copies), 1.0, 1e-12);
    EXPECT_NEAR(z, 0.5, 3.0 * 0.29 / std::sqrt(n));
    EXPECT_NEAR(square, 0.5, 3.0 * 0.29 / std::sqrt(n)) << "r^2 is uniform";
  }
}

TEST(PackedCylinder, TooFewSpheres_AreRefused) {
  EXPECT_THROW(build_charge(cylinder(20), {}, 1, 1), Stop) << "they would fill 0.54";
}

}  // namespace
}  // namespace standoff::particles
