#pragma once
// Spherically symmetric flow of a ball of hot hard-sphere gas in an ideal gas, by finite volumes that move with the
// matter, so that the contact between the two stays sharp:
//   dr/dt = u,   m du/dt = -r^2 [p + q],   de = -(p + q) dV,   V = (r_out^3 - r_in^3) / 3 (per steradian)
//   p = (gamma - 1) rho e Z(f),  f = covolume rho,  Z of Carnahan & Starling (riemann_hard_spheres.hpp)
//   q = rho du (2 du + 0.3 c) where a zone shrinks, du what its faces approach each other with
// Source: von Neumann & Richtmyer, J. Appl. Phys. 21 (1950) 232; quadratic and linear q: Benson, Comput. Methods Appl.
// Mech. Eng. 99 (1992) 235, sec. 4. A shock is some four zones wide. The step is a fifth of the Courant limit.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/verification/riemann_hard_spheres.hpp"

namespace standoff::particles::test {

struct BlastOptions {
  double radius = 0.0;                                      // m, of the ball
  double density = 0.0, energy = 0.0, covolume = 0.0;       // kg/m3, J/kg, m3/kg of the ball
  double air_density = 0.0, air_energy = 0.0, gamma = 1.4;  // kg/m3, J/kg
  double outer = 0.0;                                       // m, end of the air
  int ball_zones = 100, air_zones = 400;
};

class SphericalBlast {
 public:
  explicit SphericalBlast(const BlastOptions& o) : o_(o) {
    for (int k = 0; k <= o.ball_zones; ++k) r_.push_back(o.radius * k / o.ball_zones);
    // Zones of air grow from the width of a zone of the ball as much as it takes to fill the room.
    const double first = o.radius / o.ball_zones, span = o.outer - o.radius;
    double low = 1.0, high = 1.1;
    for (int k = 0; k < 60; ++k) {
      const double growth = 0.5 * (low + high), sum = first * (std::pow(growth, o.air_zones) - 1) / (growth - 1);
      (sum < span ? low : high) = growth;
    }
    double width = first;
    for (int k = 0; k < o.air_zones; ++k, width *= high) r_.push_back(r_.back() + width);
    u_.assign(r_.size(), 0.0);
    for (std::size_t i = 0; i + 1 < r_.size(); ++i) {
      const bool ball = i < static_cast<std::size_t>(o.ball_zones);
      mass_.push_back((ball ? o.density : o.air_density) * volume(i));
      energy_.push_back(ball ? o.energy : o.air_energy);
      viscosity_.push_back(0.0);
    }
  }

  void advance_to(double time) {
    while (time_ < time) step(std::min(0.2 * courant_, time - time_));
  }

  double contact() const { return r_[static_cast<std::size_t>(o_.ball_zones)]; }
  /// Energy of the ball, of a full sphere, J.
  double ball_energy() const { return energy_between(0, static_cast<std::size_t>(o_.ball_zones)); }
  double total_energy() const { return energy_between(0, mass_.size()); }
  /// Outermost radius where the air moves with half of its largest speed.
  double shock() const {
    const double half = 0.5 * *std::max_element(u_.begin() + o_.ball_zones, u_.end());
    std::size_t i = u_.size() - 1;
    while (u_[i] < half) --i;
    return r_[i] + (r_[i + 1] - r_[i]) * (u_[i] - half) / (u_[i] - u_[i + 1]);
  }
  /// Radial momentum of ball or air, of a full sphere, kg m/s.
  double radial_momentum(bool ball) const {
    const auto edge = static_cast<std::size_t>(o_.ball_zones);
    double sum = 0.0;
    for (std::size_t i = ball ? 0 : edge; i < (ball ? edge : mass_.size()); ++i)
      sum += sphere * mass_[i] * 0.5 * (u_[i] + u_[i + 1]);
    return sum;
  }

 private:
  static constexpr double sphere = 4.0 * 3.141592653589793;
  double volume(std::size_t i) const { return (r_[i + 1] * r_[i + 1] * r_[i + 1] - r_[i] * r_[i] * r_[i]) / 3.0; }
  HardSphereGas gas(std::size_t i) const {
    return {o_.gamma, i < static_cast<std::size_t>(o_.ball_zones) ? o_.covolume : 0.0};
  }
  double pressure(std::size_t i) const {
    const double rho = mass_[i] / volume(i);
    return (o_.gamma - 1) * rho * energy_[i] * gas(i).z(rho);
  }
  double energy_between(std::size_t from, std::size_t to) const {
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i)
      sum += sphere * mass_[i] * (energy_[i] + 0.25 * (u_[i] * u_[i] + u_[i + 1] * u_[i + 1]));
    return sum;
  }

  void step(double dt) {
    const std::size_t zones = mass_.size();
    for (std::size_t j = 1; j < zones; ++j) {
      const double jump = pressure(j) + viscosity_[j] - pressure(j - 1) - viscosity_[j - 1];
      u_[j] -= dt * r_[j] * r_[j] * jump / (0.5 * (mass_[j] + mass_[j - 1]));
    }
    std::vector<double> old(zones), before(zones);
    for (std::size_t i = 0; i < zones; ++i) old[i] = volume(i), before[i] = pressure(i);
    for (std::size_t j = 0; j <= zones; ++j) r_[j] += dt * u_[j];
    courant_ = 1.0;
    for (std::size_t i = 0; i < zones; ++i) {
      const double now = volume(i), rho = mass_[i] / now, change = (now - old[i]) / mass_[i];
      const double closing = std::max(0.0, u_[i] - u_[i + 1]), t = (o_.gamma - 1) * energy_[i];
      const double sound = gas(i).sound(rho, t);
      viscosity_[i] = rho * closing * (2.0 * closing + 0.3 * sound);
      // p at the middle of the step, which contains the new e: solved for it.
      const double per_energy = 0.5 * (o_.gamma - 1) * rho * gas(i).z(rho);
      energy_[i] = (energy_[i] - (0.5 * before[i] + viscosity_[i]) * change) / (1.0 + per_energy * change);
      courant_ = std::min(courant_, (r_[i + 1] - r_[i]) / (sound + 4.0 * closing));
    }
    time_ += dt;
  }

  BlastOptions o_;
  std::vector<double> r_, u_;                      // m, m/s, at the faces
  std::vector<double> mass_, energy_, viscosity_;  // kg per steradian, J/kg, Pa, of the zones
  double time_ = 0.0, courant_ = 1e-9;
};

}  // namespace standoff::particles::test
