#pragma once
// What the structure process remembers of a run for its history rows and its part of run.json.
#include <nlohmann/json.hpp>

#include "coupling/case/case_spec.hpp"
#include "coupling/contract/participant.hpp"
#include "structure_solver/models/structural_model.hpp"
#include "structure_solver/relaxation/relaxation.hpp"

namespace standoff::structure {

class StructureBooks {
 public:
  explicit StructureBooks(const CaseSpec& spec) : spec_(spec) {}

  /// Looks at the model after a window: peaks, and the largest gap in the energy books; throws Stop(guard) when they
  /// are open.
  void observe(const StructuralModel& model);
  /// Largest |balance| so far over the peak external work.
  double energy_error() const;
  double peak_kinetic() const { return peak_kinetic_; }
  double peak_deflection() const { return peak_deflection_; }

  /// Columns of histories.csv that the structure knows, full domain.
  NamedValues sample(const StructuralModel& model) const;
  /// Momentum books at the end of the loading phase, simulated part.
  void close_momentum(const StructuralModel& model);

  /// Nested as in run.json.
  nlohmann::json report(const StructuralModel& model, const RelaxationResult* relaxation, long steps,
                        const Participant::Times& times) const;
  template <class Archive>
  void archive(Archive& a) {
    a(peak_kinetic_, peak_deflection_, peak_work_, largest_gap_, momentum_residual_, impulse_scale_);
  }

 private:
  const CaseSpec& spec_;
  double peak_kinetic_ = 0.0, peak_deflection_ = 0.0, peak_work_ = 0.0, largest_gap_ = 0.0;
  Vec3 momentum_residual_;
  double impulse_scale_ = 0.0;
};

}  // namespace standoff::structure
