#pragma once
// The plate's metal as one sheet stretched alike in both directions: sigma = E / (1 - nu) (eps - eps_p) in each, Mises
// stress |sigma|, plastic strain rate dp = 2 |d eps_p| (the work 2 sigma d eps_p is sigma_y dp), so that
//   |sigma| = trial - E / (2 (1 - nu)) dp
// is the equation of materials/plastic_flow.hpp with this slope for 3 G: the same hardening, rate and heat as in the
// elements of the plate.
#include "coupling/case/case_spec.hpp"
#include "structure_solver/materials/finite_strain_metal.hpp"

namespace standoff::structure {

/// What a point of the sheet remembers.
struct SheetState {
  double plastic_stretch = 0.0;  // eps_p, along each direction
  double strain = 0.0;           // p
  double temperature = 0.0;      // K
  double static_stress = 0.0;    // Pa
  double x = 0.0;                // ln(1 + rate/rate0) of the last flow
};

class Sheet {
 public:
  explicit Sheet(const CaseSpec& spec);
  SheetState at_rest() const;
  /// Stress [Pa] at stretch eps; `state` becomes the trial state. dt = 0: no rate, no heat.
  double stretch(double eps, double dt, SheetState& state) const;
  double modulus() const { return modulus_; }

 private:
  using Solve = FlowResult<double> (*)(const JohnsonCook&, const FlowProblem<double>&, double guess);
  double modulus_;  // E / (1 - nu), Pa
  MetalParameters metal_;
  bool yields_ = false, rated_ = false;
  Solve flow_ = nullptr, static_flow_ = nullptr;
};

}  // namespace standoff::structure
