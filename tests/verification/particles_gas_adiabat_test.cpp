// Law: a gas that is compressed slowly without exchange of heat keeps its entropy, d ln E = -(gamma - 1) Z d ln V, with
// Z of hard spheres after Carnahan & Starling (J. Chem. Phys. 51 (1969) 635): E is all thermal, E = N k T / (gamma -
// 1). And the work of the moving face is the energy the gas gains, exactly. A box of unit cross-section: mirror planes
// at x = 0 and y = 0, specular walls at x = 1, y = 1, z = 1, and a sheet as piston from z = 0 to 0.3 at 4 % of the
// speed of sound. Tolerance of gamma: the piston feels about 5000 hits, each with the relative scatter of a
// flux-weighted normal velocity, sqrt(4/pi - 1) = 0.52, and Poisson's 1: the work scatters by 1.13 / sqrt(5000) = 1.6
// %, gamma - 1 with it. Three standard deviations: 4.8 % of gamma - 1; the wrong gamma, 5/3 for 1.4, is off by 67 %.
// The first wave of the piston makes entropy of the third order in its speed only.
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

constexpr double fill = 0.02, stroke = 0.3, piston_speed = 0.05;

/// Specular walls at 1, at the end of a sub-step: the part of the path beyond the wall is folded back.
void reflect_at_walls(GasState& gas) {
  const auto fold = [](double& x, double& v) {
    if (x > 1.0) x = 2.0 - x, v = -std::fabs(v);
  };
  for (std::size_t i = 0; i < gas.size(); ++i) {
    fold(gas.position[i].x, gas.velocity[i].x);
    fold(gas.position[i].y, gas.velocity[i].y);
    fold(gas.position[i].z, gas.velocity[i].z);
  }
}

/// Integral of Z d ln V over the stroke [-]; centres have the height 1 - z_piston - radius.
double compression(double radius) {
  constexpr int parts = 1000;
  double sum = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double height = 1.0 - radius - stroke * (k + 0.5) / parts, f = fill / height;
    sum += (1 + f + f * f - f * f * f) / std::pow(1 - f, 3) * stroke / parts / height;
  }
  return sum;
}

class SlowPiston : public testing::TestWithParam<bool> {};

TEST_P(SlowPiston, CompressesTheGas_AlongItsAdiabat) {
  const bool internal_energy = GetParam();
  const double gamma = internal_energy ? 1.4 : 5.0 / 3.0;
  GasState gas = test::lattice_gas(8, fill, gamma, internal_energy ? 2.0 / 3.0 : 0.0);
  for (Vec3& x : gas.position) x.z = gas.radius + x.z * (1.0 - gas.radius);
  const SurfaceMesh mesh = test::sheet_mesh(4, -0.5, 1.5, 1e9, [](double x, double y) { return Vec3{x, y, 0.0}; });
  SurfaceSheet sheet(mesh, {});
  GasCollideOptions options;
  options.internal_energy = internal_energy, options.mirrors.on = true;
  GasCollide collide(options);
  GasCollideCounts counts;
  const double energy = gas_totals(gas).energy();
  double time = 0.0, h = 0.0;
  long hits = 0;
  for (std::uint32_t step = 0; time < stroke / piston_speed; ++step) {
    SurfaceMotion motion = test::at_rest(mesh);
    for (Vec3& x : motion.position) x.z = piston_speed * time;
    for (Vec3& v : motion.velocity) v.z = piston_speed;
    sheet.begin_window(motion, true);
    h = collide.suggest_step(gas, counts, h, 0.02);
    counts = collide.run(gas, nullptr, &sheet, std::min(h, stroke / piston_speed - time), step);
    gas_drift(gas, nullptr, &sheet, std::min(h, stroke / piston_speed - time));
    reflect_at_walls(gas);
    hits += counts.sheet_hits;
    time += h;
  }
  const double gained = gas_totals(gas).energy() - energy;
  EXPECT_GT(hits, 4000);
  EXPECT_NEAR(gained, -sheet.total_work(), 1e-10 * energy) << "moving-wall work";
  const double measured = 1.0 + std::log(1.0 + gained / energy) / compression(gas.radius);
  EXPECT_NEAR(measured, gamma, 0.048 * (gamma - 1.0)) << "gamma of the adiabat";
  RecordProperty("gamma", std::to_string(measured));
}
INSTANTIATE_TEST_SUITE_P(WithAndWithoutInternalEnergy, SlowPiston, testing::Bool());

}  // namespace
}  // namespace standoff::particles
