#pragma once
// A round bar thrown end-on against a rigid, frictionless wall: a quarter between mirror planes x = 0, y = 0, of cubic
// elements, explicit, with the element force of the plate.
//
//      y ^            cross-section: a square core and two patches out to the rim, one element each;
//        |\ 2 \       along z: elements that grow by a constant factor away from the foot
//        | --  |
//        |0  |1 |     foot z = 0 on the wall: a node that would pass it is stopped there and free to leave
//        +---+--+> x
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "structure_solver/step/hex_force.hpp"

namespace standoff::structure::testing {

struct BarOptions {
  double length = 32.4e-3, radius = 3.2e-3;  // m
  double speed = 0.0, until = 80e-6;         // m/s, s
  double density = 0.0, dt = 0.0;            // kg/m3, s
  int layers = 12;
  double growth = 1.12;  // of the layers' height
};

struct BarResult {
  double length = 0.0, foot_diameter = 0.0;                // m
  double max_plastic_strain = 0.0, max_temperature = 0.0;  // at Gauss points, K
  double energy_error = 0.0;                               // of the kinetic energy at the start
  bool sound = true;
};

template <class Law>
class TaylorBar {
 public:
  TaylorBar(const MetalParameters& metal, const BarOptions& options) : metal_(metal), o_(options) {
    double height = o_.length * (o_.growth - 1.0) / (std::pow(o_.growth, o_.layers) - 1.0), z = 0.0;
    for (int layer = 0; layer < o_.layers; ++layer, z += height, height *= o_.growth)
      for (int patch = 0; patch < 3; ++patch) add_element(patch, z, height);
    v_.assign(x_.size(), Vec3{0.0, 0.0, -o_.speed});
    u_.assign(x_.size(), Vec3{});
    for (std::size_t i = 0; i < x_.size(); ++i) hold(i);
  }

  BarResult run() {
    BarResult r;
    const double start = kinetic();
    double lost = 0.0, dissipated = 0.0;
    std::vector<Vec3> f(x_.size());
    ElementSums<double> sums = forces(0.0, f);
    for (double t = 0.0; t < o_.until && r.sound; t += o_.dt) {
      kick(f, 0.5 * o_.dt);
      for (std::size_t i = 0; i < u_.size(); ++i) u_[i] += o_.dt * v_[i];
      lost += stop_at_wall();
      sums = forces(o_.dt, f);
      dissipated += sums.inelastic;
      kick(f, 0.5 * o_.dt);
      lost += stop_at_wall();
      r.sound = sums.sound;
      r.energy_error =
          std::max(r.energy_error, std::fabs(start - lost - kinetic() - sums.elastic - dissipated) / start);
    }
    measure(r);
    return r;
  }

 private:
  using Nodal = double[3][hex_nodes];

  /// Point of a patch of the cross-section at parametric (p, q) in [0, 1]^2.
  Vec3 section(int patch, double p, double q) const {
    const double core = 0.55 * o_.radius, bulge = 0.92;  // the core's outer corner is drawn in: no flat angle at 45 deg
    const auto on_core = [&](double s) {                 // from (core, 0) to the corner
      return Vec3{core * (1.0 - s * s * (1.0 - bulge)), core * bulge * s, 0.0};
    };
    if (patch == 0) {
      const Vec3 right = on_core(q), top{on_core(p).y, on_core(p).x, 0.0}, corner = on_core(1.0);
      return {p * right.x + q * top.x - p * q * corner.x, p * right.y + q * top.y - p * q * corner.y, 0.0};
    }
    const double angle = 0.25 * M_PI * q;
    const Vec3 inner = on_core(q), outer{o_.radius * std::cos(angle), o_.radius * std::sin(angle), 0.0};
    const Vec3 at = (1.0 - p) * inner + p * outer;
    return patch == 1 ? at : Vec3{at.y, at.x, 0.0};
  }

  void add_element(int patch, double z, double height) {
    Nodal x;
    std::array<std::size_t, hex_nodes> nodes;
    for (std::size_t a = 0; a < hex_nodes; ++a) {
      const double s[3] = {0.5 + 0.5 * lobatto_node[a & 3], 0.5 + 0.5 * lobatto_node[a >> 2 & 3],
                           0.5 + 0.5 * lobatto_node[a >> 4]};
      Vec3 at = patch == 2 ? section(2, s[1], s[0]) : section(patch, s[0], s[1]);  // keeps the axes right-handed
      at.z = z + height * s[2];
      x[0][a] = at.x, x[1][a] = at.y, x[2][a] = at.z;
      nodes[a] = node_at(at);
    }
    geometry_.push_back(CurvedGeometry::of_nodes(x));
    element_.push_back(nodes);
    double weight[hex_points], b[hex_points], c[hex_points], lumped[hex_nodes];
    for (int q = 0; q < hex_points; ++q) weight[q] = o_.density * geometry_.back().weight(q);
    contract_axis<4, 1, true, false>(line_basis<4>.to_gauss, weight, b);
    contract_axis<4, 4, true, false>(line_basis<4>.to_gauss, b, c);
    contract_axis<4, 16, true, false>(line_basis<4>.to_gauss, c, lumped);
    for (std::size_t a = 0; a < hex_nodes; ++a) mass_[nodes[a]] += lumped[a];
    std::vector<double> history(hex_points * Law::fields, 0.0);
    for (std::size_t q = 0; q < hex_points; ++q) {
      double* fields = &history[q * Law::fields];
      if (Law::temperature_field >= 0) fields[Law::temperature_field] = metal_.flow.room_temperature;
      if (Law::static_stress_field >= 0) fields[Law::static_stress_field] = metal_.flow.A;
    }
    history_.push_back(history);
  }

  std::size_t node_at(const Vec3& at) {
    const auto grid = [](double v) { return std::lround(1e9 * v); };
    const auto [entry, fresh] = index_.try_emplace({grid(at.x), grid(at.y), grid(at.z)}, x_.size());
    if (fresh) x_.push_back(at), mass_.push_back(0.0);
    return entry->second;
  }

  void hold(std::size_t i) {
    if (x_[i].x < 1e-9) v_[i].x = 0.0, u_[i].x = 0.0;
    if (x_[i].y < 1e-9) v_[i].y = 0.0, u_[i].y = 0.0;
  }
  void kick(const std::vector<Vec3>& f, double dt) {
    for (std::size_t i = 0; i < v_.size(); ++i) {
      const bool pressed = x_[i].z + u_[i].z <= 0.0 && v_[i].z <= 0.0 && f[i].z > 0.0;
      v_[i] += -dt / mass_[i] * Vec3{f[i].x, f[i].y, pressed ? 0.0 : f[i].z};
      hold(i);
    }
  }
  /// Energy that stopped nodes lose, J.
  double stop_at_wall() {
    double lost = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (x_[i].z + u_[i].z > 0.0 || v_[i].z > 0.0) continue;
      lost += 0.5 * mass_[i] * v_[i].z * v_[i].z;
      v_[i].z = 0.0, u_[i].z = -x_[i].z;
    }
    return lost;
  }
  double kinetic() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < v_.size(); ++i) sum += 0.5 * mass_[i] * squared_norm(v_[i]);
    return sum;
  }

  ElementSums<double> forces(double dt, std::vector<Vec3>& f) {
    f.assign(x_.size(), Vec3{});
    ElementSums<double> all{0.0, 0.0, true};
    for (std::size_t e = 0; e < element_.size(); ++e) {
      Nodal u, force;
      for (std::size_t a = 0; a < hex_nodes; ++a) {
        const Vec3& at = u_[element_[e][a]];
        u[0][a] = at.x, u[1][a] = at.y, u[2][a] = at.z;
      }
      const auto sums = hex_force<Law>(metal_, geometry_[e], {dt, true}, true, u, history_[e].data(), force);
      all.elastic += sums.elastic, all.inelastic += sums.inelastic, all.sound = all.sound && sums.sound;
      for (std::size_t a = 0; a < hex_nodes; ++a) f[element_[e][a]] += Vec3{force[0][a], force[1][a], force[2][a]};
    }
    return all;
  }

  void measure(BarResult& r) const {
    double top = 0.0, foot = 1.0;  // of the axis; the bar may have left the wall
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const Vec3 at = x_[i] + u_[i];
      if (std::hypot(x_[i].x, x_[i].y) < 1e-9) top = std::max(top, at.z), foot = std::min(foot, at.z);
      r.foot_diameter = std::max(r.foot_diameter, 2.0 * std::hypot(at.x, at.y));
    }
    r.length = top - foot;
    for (const auto& history : history_)
      for (std::size_t q = 0; q < hex_points; ++q) {
        r.max_plastic_strain = std::max(r.max_plastic_strain, history[q * Law::fields + Law::strain_field]);
        if (Law::temperature_field >= 0)
          r.max_temperature = std::max(r.max_temperature, history[q * Law::fields + Law::temperature_field]);
      }
  }

  MetalParameters metal_;
  BarOptions o_;
  std::vector<Vec3> x_, u_, v_;
  std::vector<double> mass_;
  std::vector<CurvedGeometry> geometry_;
  std::vector<std::array<std::size_t, hex_nodes>> element_;
  std::vector<std::vector<double>> history_;
  std::map<std::array<long, 3>, std::size_t> index_;
};

}  // namespace standoff::structure::testing
