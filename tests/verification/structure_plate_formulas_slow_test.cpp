// Uniform impulses on the clamped plate: the peak against a converged reference, the rest beside two formulas.
//   asserted  10 x 10 against 20 x 20 elements, 130 N s: cubic elements converge with the square of their size or
//   better
//             where plastic hinges form at the clamp; 0.5 % of the peak
//   reported  Nurick & Martin, Int. J. Impact Eng. 8 (1989) 171: w/h = 0.48 phi + 0.277, phi = I / (2 h^2 a sqrt(rho
//   A)), a
//             fit to experiments on mild steel with a scatter of one thickness; Jones, Structural Impact (1989),
//             sec. 7.4, rigid-plastic, neither rate nor hardening: w/h = sqrt(1 + lambda/6) - 1, lambda = rho V^2 a^2 /
//             (A h^2), an upper side. No gate: both take the initial yield stress A for the whole way, AL-6XN hardens
//             fourfold.
#include <cstdio>

#include <gtest/gtest.h>

#include "structure_solver/relaxation/relaxation.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

constexpr double side = 0.406, thickness = 0.0034, density = 8060.0, yield = 410e6;

/// Every free node starts with the velocity of a uniform impulse [N s] on the full plate.
void give_uniform_impulse(PlateHex64& model, double impulse) {
  const PlateMesh& mesh = model.plate().mesh();
  std::vector<double> u(static_cast<std::size_t>(model.relaxation()->dofs()), 0.0), v;
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    for (const auto component : {fixed_x, fixed_y, fixed_z})
      if ((mesh.fixed[i] & component) == 0)
        v.push_back(component == fixed_z ? -impulse / (density * thickness * side * side) : 0.0);
  model.relaxation()->set_state(u, v);
}

double peak_of(PlateHex64& model, double until) {
  double peak = 0.0;
  while (model.time() < until) {
    model.step(model.stable_step());
    peak = std::max(peak, model.centre_deflection());
  }
  return peak;
}

TEST(ImpulsivePlate_Mesh, TenByTenAgainstTwentyByTwenty_PeakAgrees) {
  PlateHex64 coarse(testing::plate_case(10, true), 2), fine(testing::plate_case(20, true), 2);
  give_uniform_impulse(coarse, 130.0), give_uniform_impulse(fine, 130.0);
  const double reference = peak_of(fine, 0.9e-3), peak = peak_of(coarse, 0.9e-3);
  std::printf("  peak %.3f mm with 10 x 10, %.3f mm with 20 x 20\n", 1e3 * peak, 1e3 * reference);
  EXPECT_NEAR(peak, reference, 0.005 * reference) << "m";
}

TEST(ImpulsivePlate_Formulas, ThreeImpulses_AreReportedBesideNurickAndJones) {
  std::printf(
      "| impulse N s | peak mm | permanent mm | Nurick and Martin mm | Jones mm |\n| --: | --: | --: | --: | --: |\n");
  for (const double impulse : {130.0, 250.0, 400.0}) {
    PlateHex64 model(testing::plate_case(10, true), 2);
    give_uniform_impulse(model, impulse);
    RelaxationOptions options;
    options.peak_kinetic_energy = model.ledger().kinetic;
    const double peak = peak_of(model, 1e-3);
    const RelaxationResult rest = relax_to_rest(*model.relaxation(), options);
    EXPECT_TRUE(rest.at_rest) << rest.message;
    EXPECT_GT(peak, model.centre_deflection());
    const double phi = impulse / (2.0 * thickness * thickness * side * std::sqrt(density * yield));
    const double speed = impulse / (density * thickness * side * side);
    const double lambda = density * speed * speed * side * side / (yield * thickness * thickness);
    const double nurick = thickness * (0.48 * phi + 0.277), jones = thickness * (std::sqrt(1.0 + lambda / 6.0) - 1.0);
    std::printf("| %.0f | %.1f | %.1f | %.1f | %.1f |\n", impulse, 1e3 * peak, 1e3 * model.centre_deflection(),
                1e3 * nurick, 1e3 * jones);
    const std::string at = "_mm_at_" + std::to_string(static_cast<int>(impulse)) + "_Ns";
    RecordProperty("permanent" + at, std::to_string(1e3 * model.centre_deflection()));
    RecordProperty("nurick_and_martin" + at, std::to_string(1e3 * nurick));
    RecordProperty("jones" + at, std::to_string(1e3 * jones));
  }
}

}  // namespace
}  // namespace standoff::structure
