#pragma once
// The resistance of the equivalent plate, hinges in parallel with the sheet, and its motion as the relaxation sees it.
#include "structure_solver/models/single_dof/equivalent_plate.hpp"
#include "structure_solver/models/single_dof/sheet.hpp"
#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace standoff::structure {

class PlateSpring {
 public:
  explicit PlateSpring(const CaseSpec& spec);

  struct Answer {
    double force = 0.0;                   // N
    double elastic = 0.0, plastic = 0.0;  // J: stored now; work on hinges and sheet since the committed state
  };
  /// At deflection w from the committed history, which is left alone. dt = 0: no rate, no heat.
  Answer trial(double w, double dt) const;
  /// The same, and makes it the committed one.
  Answer commit(double w, double dt);
  /// dF/dw with plastic flow frozen.
  double stiffness(double w) const;
  const EquivalentPlate& plate() const { return plate_; }
  const SheetState& sheet() const { return history_.sheet; }

  template <class Archive>
  void archive(Archive& a) {
    SheetState& s = history_.sheet;
    a(history_.hinge_slip, s.plastic_stretch, s.strain, s.temperature, s.static_stress, s.x);
  }

 private:
  struct History {
    double hinge_slip = 0.0;  // m, plastic part of w in the hinges
    SheetState sheet;
  };
  Answer answer(double w, double dt, History& history) const;

  EquivalentPlate plate_;
  Sheet sheet_;
  bool yields_;
  History history_;
};

class SpringMotion final : public RelaxationProblem {
 public:
  explicit SpringMotion(const CaseSpec& spec) : spring(spec) {}

  /// One explicit step, central differences, under the held force `push`.
  void step(double push, double dt);

  long dofs() const override { return 1; }
  std::span<const double> mass() const override { return {&spring.plate().mass, 1}; }
  void get_state(std::span<double> u, std::span<double> v) const override { u[0] = w, v[0] = velocity; }
  void set_state(std::span<const double> u, std::span<const double> v) override;
  bool internal_force(std::span<const double> u, double dt, std::span<double> f) override;
  void commit(std::span<const double> u, double dt) override;
  Eigen::SparseMatrix<double> stiffness(std::span<const double> u) override;
  double plastic_work() const override { return plastic; }
  double elastic_energy(std::span<const double> u) override { return spring.trial(u[0], 0.0).elastic; }
  double centre_deflection(std::span<const double> u) const override { return u[0]; }
  void book_damping(double joule) override { damping += joule; }

  template <class Archive>
  void archive(Archive& a) {
    a(spring, w, velocity, internal, elastic, plastic, damping, work);
  }

  PlateSpring spring;
  double w = 0.0, velocity = 0.0;                                  // m, m/s, away from the charge
  double internal = 0.0;                                           // N, resistance at w
  double elastic = 0.0, plastic = 0.0, damping = 0.0, work = 0.0;  // J; work of the load

 private:
  void take(const PlateSpring::Answer& answer);
};

}  // namespace standoff::structure
