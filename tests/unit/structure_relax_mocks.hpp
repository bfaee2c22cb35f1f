#pragma once
// Small structures with closed forms to relax: a chain of springs that yield (1 spring: the elastoplastic oscillator),
// and a shallow two-bar truss under a dead load. Both count what is asked of them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "coupling/base/state_hash.hpp"
#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace standoff::structure::test {

/// Keeps state and counts; a structure adds its force law.
class CountingProblem : public RelaxationProblem {
 public:
  CountingProblem(std::vector<double> masses) : masses_(std::move(masses)), u(masses_.size()), v(masses_.size()) {}
  long dofs() const override { return static_cast<long>(masses_.size()); }
  std::span<const double> mass() const override { return masses_; }
  void get_state(std::span<double> uo, std::span<double> vo) const override {
    std::copy(u.begin(), u.end(), uo.begin());
    std::copy(v.begin(), v.end(), vo.begin());
  }
  void set_state(std::span<const double> un, std::span<const double> vn) override {
    u.assign(un.begin(), un.end());
    v.assign(vn.begin(), vn.end());
  }
  double centre_deflection(std::span<const double> at) const override { return at.back(); }
  void book_damping(double joule) override { damping += joule; }
  double kinetic() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * masses_[i] * v[i] * v[i];
    return sum;
  }
  double energy() { return kinetic() + elastic_energy(u) + plastic_work(); }

 protected:
  std::vector<double> masses_;

 public:
  std::vector<double> u, v;
  double damping = 0.0;
  long commits = 0, static_commits = 0, forces = 0, static_forces = 0, stiffnesses = 0;
  double smallest_dt = std::numeric_limits<double>::infinity();
  bool no_static_force = false;  // as if an element inverted in every static solve
  double stiffness_error = 0.0;  // N/m added to the diagonal of K: a wrong or indefinite tangent
};

struct Spring {
  double stiffness = 0.0;                                  // N/m
  double yield = std::numeric_limits<double>::infinity();  // N
  double hardening = 0.0;                                  // N/m
  double cubic = 0.0;                                      // N/m^3, an elastic spring in parallel
  double viscosity = 0.0;                                  // N s/m, overstress per rate of plastic extension
};

/// wall --spring 0-- mass 0 --spring 1-- mass 1 ... ; force k (d - p) + cubic d^3 - load on the last mass, backward
/// Euler in p.
class SpringChain : public CountingProblem {
 public:
  SpringChain(std::vector<double> masses, std::vector<Spring> springs)
      : CountingProblem(std::move(masses)),
        springs_(std::move(springs)),
        plastic(springs_.size()),
        hardened(springs_.size()) {}

  bool internal_force(std::span<const double> at, double dt, std::span<double> f) override {
    ++forces;
    if (dt == 0.0) ++static_forces;
    if (dt > 0.0) smallest_dt = std::min(smallest_dt, dt);
    if (dt == 0.0 && no_static_force) return false;
    std::fill(f.begin(), f.end(), 0.0);
    f.back() = -load;
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      const double d = extension(at, i), pull = trial(i, d, dt).force + springs_[i].cubic * d * d * d;
      f[i] += pull;
      if (i > 0) f[i - 1] -= pull;
    }
    return true;
  }
  void commit(std::span<const double> at, double dt) override {
    ++(dt == 0.0 ? static_commits : commits);
    peak = std::max(peak, std::abs(at.back()));
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      const Trial now = trial(i, extension(at, i), dt);
      plastic[i] += now.flow;
      hardened[i] += std::abs(now.flow);
      work += now.force * now.flow;
    }
  }
  Eigen::SparseMatrix<double> stiffness(std::span<const double> at) override {
    ++stiffnesses;
    Eigen::SparseMatrix<double> k(dofs(), dofs());
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      const double d = extension(at, i), s = springs_[i].stiffness + 3.0 * springs_[i].cubic * d * d;
      const auto row = static_cast<Eigen::Index>(i);
      k.coeffRef(row, row) += s + stiffness_error;
      if (i > 0) k.coeffRef(row - 1, row - 1) += s, k.coeffRef(row, row - 1) -= s, k.coeffRef(row - 1, row) -= s;
    }
    return k;
  }
  double plastic_work() const override { return work; }
  double elastic_energy(std::span<const double> at) override {
    double sum = -load * at.back();
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      const double d = extension(at, i), e = d - plastic[i];
      sum += 0.5 * springs_[i].stiffness * e * e + 0.25 * springs_[i].cubic * d * d * d * d;
    }
    return sum;
  }
  std::uint64_t hash() const {
    StateHash h;
    for (const auto* values : {&u, &v, &plastic, &hardened}) h.add(std::span<const double>(*values));
    h.add(work);
    return h.value();
  }

 private:
  struct Trial {
    double force, flow;
  };
  double extension(std::span<const double> at, std::size_t i) const { return at[i] - (i > 0 ? at[i - 1] : 0.0); }
  Trial trial(std::size_t i, double d, double dt) const {
    const Spring& s = springs_[i];
    const double elastic = s.stiffness * (d - plastic[i]),
                 excess = std::abs(elastic) - s.yield - s.hardening * hardened[i];
    if (!(excess > 0.0)) return {elastic, 0.0};
    const double overstress = dt > 0.0 ? s.viscosity / dt : 0.0;  // dt = 0: flow without rate effect
    const double flow = std::copysign(excess / (s.stiffness + s.hardening + overstress), elastic);
    return {elastic - s.stiffness * flow, flow};
  }
  std::vector<Spring> springs_;

 public:
  std::vector<double> plastic, hardened;  // m, per spring
  double work = 0.0, load = 0.0;
  double peak = 0.0;  // m, largest committed displacement of the last mass
};

/// Two bars of stiffness k from (+-half, 0) to an apex at height, pushed down by a dead load: u is the way down.
/// f(u) = 2 k (rest length / length - 1) (height - u) - load. The force peaks at the limit point, where K = 0.
class ShallowTruss : public CountingProblem {
 public:
  ShallowTruss(double mass, double stiffness, double half, double height)
      : CountingProblem({mass}), k_(stiffness), half_(half), height_(height), rest_(std::hypot(half, height)) {}
  double bar_force(double at) const {
    return 2.0 * k_ * (rest_ / std::hypot(half_, height_ - at) - 1.0) * (height_ - at);
  }
  double bar_stiffness(double at) const {
    const double length = std::hypot(half_, height_ - at), drop = height_ - at;
    return 2.0 * k_ * (1.0 - rest_ / length + rest_ * drop * drop / (length * length * length));
  }
  bool internal_force(std::span<const double> at, double, std::span<double> f) override {
    f[0] = bar_force(at[0]) - load;
    return true;
  }
  void commit(std::span<const double>, double) override { ++commits; }
  Eigen::SparseMatrix<double> stiffness(std::span<const double> at) override {
    Eigen::SparseMatrix<double> k(1, 1);
    k.insert(0, 0) = bar_stiffness(at[0]);
    return k;
  }
  double plastic_work() const override { return 0.0; }
  double elastic_energy(std::span<const double> at) override {
    const double stretch = std::hypot(half_, height_ - at[0]) - rest_;
    return k_ * stretch * stretch - load * at[0];
  }

 private:
  double k_, half_, height_, rest_;

 public:
  double load = 0.0;
};

}  // namespace standoff::structure::test
