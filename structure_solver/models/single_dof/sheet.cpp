#include "structure_solver/models/single_dof/sheet.hpp"

#include <cmath>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {
namespace {

using Solve = FlowResult<double> (*)(const JohnsonCook&, const FlowProblem<double>&, double guess);

template <Hardening Hard, bool Softening, RateLaw Rate>
FlowResult<double> solve(const JohnsonCook& law, const FlowProblem<double>& problem, double guess) {
  return solve_flow<Hard, Softening, Rate>(law, problem, true, guess);
}

template <Hardening Hard, bool Softening>
Solve choose_by_rate(RateLaw rate) {
  if (rate == RateLaw::power) return &solve<Hard, Softening, RateLaw::power>;
  if (rate == RateLaw::logarithmic) return &solve<Hard, Softening, RateLaw::logarithmic>;
  return &solve<Hard, Softening, RateLaw::none>;
}

template <Hardening Hard>
Solve choose_by_heat(bool softening, RateLaw rate) {
  return softening ? choose_by_rate<Hard, true>(rate) : choose_by_rate<Hard, false>(rate);
}

Solve choose(const MetalEffects& effects, RateLaw rate) {
  if (effects.hardening == Hardening::power) return choose_by_heat<Hardening::power>(effects.heating, rate);
  if (effects.hardening == Hardening::table) return choose_by_heat<Hardening::table>(effects.heating, rate);
  return choose_by_heat<Hardening::none>(effects.heating, rate);
}

}  // namespace

Sheet::Sheet(const CaseSpec& spec)
    : modulus_(spec.plate.material.youngs_modulus / (1.0 - spec.plate.material.poissons_ratio)),
      metal_(metal_parameters(spec.plate.material)) {
  const MetalEffects effects = metal_effects(spec);
  yields_ = effects.plasticity;
  rated_ = effects.rate != RateLaw::none;
  if (!effects.heating) metal_.heating = 0.0;
  flow_ = choose(effects, effects.rate);
  static_flow_ = choose(effects, RateLaw::none);
}

SheetState Sheet::at_rest() const {
  SheetState state;
  state.temperature = metal_.flow.room_temperature;
  state.static_stress = metal_.flow.A;
  return state;
}

double Sheet::stretch(double eps, double dt, SheetState& s) const {
  const double stress = modulus_ * (eps - s.plastic_stretch), trial = std::fabs(stress);
  if (!yields_ || trial <= s.static_stress + yield_tolerance * metal_.flow.A) return stress;
  const bool moving = dt > 0.0;
  FlowProblem<double> problem{trial, 1.0, s.strain, s.temperature, 0.5 * modulus_, moving ? metal_.heating : 0.0, 0.0};
  const bool rated = rated_ && moving;
  if (rated) problem.rate_strain = metal_.flow.reference_rate * dt;
  const double guess = rated ? s.x : (trial - s.static_stress) / problem.triple_shear;
  const FlowResult<double> flow = (rated ? flow_ : static_flow_)(metal_.flow, problem, guess);
  s.plastic_stretch += std::copysign(0.5 * flow.increment, stress);
  s.strain += flow.increment;
  s.temperature = flow.temperature, s.static_stress = flow.static_stress;
  if (rated) s.x = flow.x;
  return std::copysign(trial - problem.triple_shear * flow.increment, stress);
}

}  // namespace standoff::structure
