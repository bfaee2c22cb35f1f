// Model single_dof against its closed forms (single_dof/equivalent_plate.hpp), metal elastic or perfectly plastic:
//   small impulse   W = V/omega sin(omega t), omega^2 = k/m
//   large impulse   peak W where the kinetic energy is spent:
//                   m V^2/2 = R (W - R/2k) + v (2 A eps(W) - A^2/E'),  eps = W^2/4L^2, E' = E/(1 - nu)
//   at rest         hinges and sheet pull against each other, elastic since the peak:
//                   k (W - W_p) + v E' (eps(W) - eps_p) W/L^2 = 0
//   stiff metal     W/h = sqrt(1 + lambda/6) - 1, Jones, Structural Impact, ch. 7
// Central differences are of second order: (omega dt)^2 is below 1e-4 with one thickness transit as step, the stiffest
// tangent being 8e3 1/s; the peak is read at a step. 1e-4 of the deflection covers both.
#include <gtest/gtest.h>

#include "structure_solver/models/single_dof/single_dof.hpp"
#include "structure_solver/relaxation/relaxation.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure::testing {
namespace {

CaseSpec plain_case(double yield, double stiffer = 1.0) {
  CaseSpec spec = plate_case(12, false, yield);
  spec.plate.model = "single_dof";
  spec.plate.material.youngs_modulus *= stiffer;
  for (EffectDecision& effect : spec.effects) effect.on = effect.name == "plasticity";
  return spec;
}

void push(SingleDof& model, double velocity) {
  const double rest = 0.0;
  model.relaxation()->set_state({&rest, 1}, {&velocity, 1});
}

double run_to_peak(SingleDof& model) {
  double peak = -1.0;
  while (model.centre_deflection() > peak) {
    peak = model.centre_deflection();
    model.step(model.stable_step());
  }
  return peak;
}

struct PerfectlyPlastic {
  EquivalentPlate plate;
  double yield, modulus;
  double energy(double w) const {
    const double hinge = plate.hinge_force * (w - 0.5 * plate.hinge_force / plate.bending_stiffness);
    return hinge + plate.volume * (2.0 * yield * plate.strain(w) - yield * yield / modulus);
  }
  double peak(double kinetic) const {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 100; ++i) (energy(0.5 * (low + high)) < kinetic ? low : high) = 0.5 * (low + high);
    return low;
  }
  double rest(double peak) const {
    const double slip = peak - plate.hinge_force / plate.bending_stiffness;
    const double flowed = plate.strain(peak) - yield / modulus;
    double low = 0.5 * peak, high = peak;
    for (int i = 0; i < 100; ++i) {
      const double w = 0.5 * (low + high);
      const double force =
          plate.bending_stiffness * (w - slip) + plate.sheet_force(modulus * (plate.strain(w) - flowed), w);
      (force < 0.0 ? low : high) = w;
    }
    return low;
  }
};

TEST(SingleDof, SmallImpulse_SwingsAsAnOscillator) {
  SingleDof model(plain_case(1e12));
  const EquivalentPlate& plate = model.plate();
  const double omega = std::sqrt(plate.bending_stiffness / plate.mass), velocity = 1e-6 * omega;
  push(model, velocity);
  double largest = 0.0, worst = 0.0;
  while (model.time() < 2.0 * 2.0 * M_PI / omega) {
    model.step(model.stable_step());
    worst = std::max(worst, std::fabs(model.centre_deflection() - velocity / omega * std::sin(omega * model.time())));
    largest = std::max(largest, model.centre_deflection());
  }
  EXPECT_NEAR(largest, 1e-6, 1e-10) << "m";
  EXPECT_LT(worst, 1e-10) << "m";
}

TEST(SingleDof, PerfectlyPlasticImpulse_PeaksAndRestsAtTheClosedForm) {
  const CaseSpec spec = plain_case(410e6);
  const MaterialSpec& m = spec.plate.material;
  for (const double velocity : {90.0, 150.0, 250.0}) {
    SingleDof model(spec);
    const PerfectlyPlastic law{model.plate(), m.A, m.youngs_modulus / (1.0 - m.poissons_ratio)};
    push(model, velocity);
    const double kinetic = model.ledger().kinetic, peak = run_to_peak(model), expected = law.peak(kinetic);
    ASSERT_GT(expected, law.plate.hinge_force / law.plate.bending_stiffness) << "m, or the hinges have not yielded";
    EXPECT_NEAR(peak / expected, 1.0, 1e-4) << expected << " m, impulse " << model.plate().momentum * velocity;
    RelaxationOptions options;
    options.peak_kinetic_energy = kinetic;
    const RelaxationResult result = relax_to_rest(*model.relaxation(), options);
    EXPECT_TRUE(result.at_rest) << result.message;
    EXPECT_NEAR(model.centre_deflection() / law.rest(expected), 1.0, 1e-4) << "peak " << peak << " m";
    EXPECT_LE(std::fabs(kinetic + model.ledger().balance()), 1e-4 * kinetic) << "J";
  }
}

// Metal a thousand times stiffer is nearly rigid: elastic hinges add at most R/2k, 9 um of 7 mm. The surface samples
// the pyramid at 37 lines: int phi to 1e-3. Together below 5e-3.
TEST(SingleDof, StiffMetalUnderAUniformPulse_IsTheFormulaOfJones) {
  const CaseSpec spec = plain_case(410e6, 1000.0);
  for (const double impulse : {60.0, 130.0, 250.0}) {
    SingleDof model(spec);
    const SurfaceMesh& surface = model.surface();
    std::vector<Vec3> force(surface.position.size());
    const double dt = model.stable_step(), pressure = impulse / dt / (0.406 * 0.406);
    for (const auto& q : surface.quads)
      for (const std::int32_t node : q)
        force[static_cast<std::size_t>(node)].z -= 0.25 * pressure * std::pow(0.406 / 36, 2);
    model.set_surface_force(force);
    model.step(dt);
    model.set_surface_force(std::vector<Vec3>(force.size()));
    EXPECT_NEAR(model.ledger().impulse_received.z, -impulse, 1e-9 * impulse);
    const double h = 0.0034, speed = impulse / (8060.0 * h * 0.406 * 0.406);
    const double lambda = 4.0 * 8060.0 * std::pow(speed * 0.203, 2) / (410e6 * h * h);
    const double jones = h * (std::sqrt(1.0 + lambda / 6.0) - 1.0);
    EXPECT_NEAR(run_to_peak(model) / jones, 1.0, 5e-3) << jones << " m at " << impulse << " N s";
  }
}

TEST(SingleDof, HardeningRateAndHeat_ChangeTheDeflectionAsTheyMust) {
  const auto peak_with = [](const std::vector<std::string>& on) {
    CaseSpec spec = plain_case(410e6);
    for (EffectDecision& effect : spec.effects) effect.on = effect.on || std::ranges::find(on, effect.name) != on.end();
    SingleDof model(spec);
    push(model, 250.0);
    return run_to_peak(model);
  };
  const double plain = peak_with({}), hardening = peak_with({"hardening"}), rate = peak_with({"strain_rate"});
  const double heated = peak_with({"hardening", "heating"});
  EXPECT_LT(hardening, 0.999 * plain) << "m";
  EXPECT_LT(rate, 0.9 * plain) << "m: the rate term at some 1e2 per s is 1.3, deflection goes as its root";
  EXPECT_GT(heated, hardening) << "m";
}

}  // namespace
}  // namespace standoff::structure::testing
