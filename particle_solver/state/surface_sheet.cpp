#include "particle_solver/state/surface_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "coupling/base/stop.hpp"
#include "particle_solver/kernels/bilinear_quad.hpp"
#include "particle_solver/kernels/surface_impact.hpp"
#include "particle_solver/kernels/surface_sweep.hpp"

namespace standoff::particles {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

SurfaceSheet::SurfaceSheet(SurfaceMesh mesh, const SheetOptions& options)
    : plate_nodes_(mesh.position.size()), plate_faces_(mesh.quads.size()), recedes_(options.recedes) {
  RingedMesh ringed = add_rigid_ring(std::move(mesh), options.quarter, options.surround_half_size);
  mesh_ = std::move(ringed.mesh);
  search_ = SurfaceSearch(mesh_, surface_topology(mesh_, std::move(ringed.weld), options.quarter));
  const std::size_t nodes = mesh_.position.size();
  position_ = mesh_.position;
  velocity_.assign(nodes, {});
  inverse_mass_.resize(nodes);
  const SurfaceTopology& topology = search_.topology();
  for (std::size_t n = 0; n < nodes; ++n) {
    const double inverse = options.recedes ? 1.0 / mesh_.node_mass[n] : 0.0;
    inverse_mass_[n] = {topology.on_mirror_x[n] ? 0.0 : inverse, topology.on_mirror_y[n] ? 0.0 : inverse, inverse};
  }
  window_impulse_.assign(plate_nodes_, {}), pending_.assign(plate_nodes_, {}), node_impulse_.assign(plate_nodes_, {});
  renew_bounds();
}

void SurfaceSheet::begin_window(const SurfaceMotion& motion, bool keep_pending) {
  if (motion.position.size() != plate_nodes_ || motion.velocity.size() != plate_nodes_)
    throw Stop(ExitCode::participant_lost, "surface motion has " + std::to_string(motion.position.size()) +
                                               " positions and " + std::to_string(motion.velocity.size()) +
                                               " velocities, the surface mesh " + std::to_string(plate_nodes_) +
                                               " nodes; the structure process broke the protocol");
  if (!recedes_) return;
  double jump2 = 0.0;
  for (std::size_t n = 0; n < plate_nodes_; ++n)
    jump2 = std::max(jump2, squared_norm(motion.position[n] - position_[n]));
  jump_ = std::sqrt(jump2);
  std::copy(motion.position.begin(), motion.position.end(), position_.begin());
  std::copy(motion.velocity.begin(), motion.velocity.end(), velocity_.begin());
  for (std::size_t n = 0; keep_pending && n < plate_nodes_; ++n) velocity_[n] += scaled(inverse_mass_[n], pending_[n]);
  renew_bounds();
}

void SurfaceSheet::drift(double h) {
  for (std::size_t n = 0; n < plate_nodes_; ++n) position_[n] += velocity_[n] * h;
  renew_bounds();
}

void SurfaceSheet::renew_bounds() {
  const std::span<const Vec3> reference = search_.reference();
  double moved2 = 0.0, speed2 = 0.0;
  top_ = bottom_ = position_[0].z, rise_ = sink_ = 0.0;
  for (std::size_t n = 0; n < position_.size(); ++n) {
    moved2 = std::max(moved2, squared_norm(position_[n] - reference[n]));
    speed2 = std::max(speed2, squared_norm(velocity_[n]));
    top_ = std::max(top_, position_[n].z), rise_ = std::max(rise_, velocity_[n].z);
    bottom_ = std::min(bottom_, position_[n].z), sink_ = std::min(sink_, velocity_[n].z);
  }
  moved_ = std::sqrt(moved2), speed_ = std::sqrt(speed2);
  if (!(moved_ <= search_.margin())) search_.rebuild(position_), moved_ = 0.0;
}

double SurfaceSheet::highest(double t_to) const {
  return top_ + rise_ * t_to;
}
double SurfaceSheet::lowest(double t_to) const {
  return bottom_ + sink_ * t_to;
}
double SurfaceSheet::slack(double t) const {
  return (moved_ + speed_ * t) * (1.0 + 1e-12);
}

SurfaceSheet::Answer SurfaceSheet::answer(std::int32_t face, const std::array<double, 4>& weight) const {
  Answer sum;
  const auto& quad = mesh_.quads[at(face)];
  for (std::size_t i = 0; i < 4; ++i) {
    sum.velocity += velocity_[at(quad[i])] * weight[i];
    sum.inverse_mass += inverse_mass_[at(quad[i])] * (weight[i] * weight[i]);
  }
  return sum;
}

SheetPoint SurfaceSheet::seen(const SheetFoot& foot) const {
  SheetPoint where;
  if (foot.face < 0) return where;
  where.face = foot.face, where.xi = foot.foot.xi, where.eta = foot.foot.eta;
  where.point = foot.point, where.normal = foot.normal, where.gap = foot.gap;
  where.rigid = at(foot.face) >= plate_faces_;
  const Answer wall = answer(foot.face, bilinear_weights(where.xi, where.eta));
  where.velocity = wall.velocity;
  where.inverse_mass = along(where.normal, wall.inverse_mass);
  return where;
}

SheetPoint SurfaceSheet::closest(const Vec3& position, double reach, double t) const {
  if (position.z - reach > highest(t) || position.z + reach < lowest(t)) return {};
  return seen(search_.closest(motion(), position, reach, t, slack(t)));
}

bool SurfaceSheet::first_hit(const Vec3& x, const Vec3& v, double radius, double t_from, double t_to, double& t_hit,
                             SheetPoint& where) const {
  const double top = highest(t_to) + radius, z_from = x.z + v.z * t_from;
  if (std::min(z_from, x.z + v.z * t_to) > top) return false;
  // Nothing happens above the highest point: begin where the path comes down to it.
  if (z_from > top) t_from = std::clamp(t_from + (z_from - top) / -v.z * (1.0 - 1e-12), t_from, t_to);
  SweepLimits limits{radius, norm(v) + speed_, 0.25 * std::min(radius, search_.smallest_edge()), t_from, t_to};
  if (!(limits.speed_bound > 0.0)) limits.speed_bound = 1e-30;
  const double longest = std::max(search_.bin_size(), radius);
  const auto probe = [&](double t) -> Clearance {
    const double view = std::min(limits.speed_bound * (t_to - t) * (1.0 + 1e-9), longest), reach = radius + view;
    where = closest(x + v * t, reach, t);
    if (where.face < 0 || where.gap < -radius) return {view, 0.0};
    return {where.gap - radius, dot(where.normal, v - where.velocity)};
  };
  return sweep_to_contact(limits, probe, t_hit);
}

void SurfaceSheet::give(std::int32_t face, const std::array<double, 4>& weight, const Vec3& impulse, double t,
                        double work) {
  if (at(face) >= plate_faces_) {
    surround_impulse_ += impulse;
    return;
  }
  const std::span<const Vec3> reference = search_.reference();
  const auto& quad = mesh_.quads[at(face)];
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t n = at(quad[i]);
    const Vec3 share = impulse * weight[i], change = scaled(inverse_mass_[n], share);
    window_impulse_[n] += share, node_impulse_[n] += share;
    velocity_[n] += change, position_[n] -= change * t;
    moved_ = std::max(moved_, norm(position_[n] - reference[n])), speed_ = std::max(speed_, norm(velocity_[n]));
    top_ = std::max(top_, position_[n].z), rise_ = std::max(rise_, velocity_[n].z);
    bottom_ = std::min(bottom_, position_[n].z), sink_ = std::min(sink_, velocity_[n].z);
  }
  total_impulse_ += impulse;
  total_work_ += work;
}

template <class Sphere>
Impact SurfaceSheet::meet(const SheetPoint& where, Sphere& sphere, double restitution, double friction, double t) {
  const std::array<double, 4> weight = bilinear_weights(where.xi, where.eta);
  const Answer wall = answer(where.face, weight);
  const Vec3 before = sphere.surface_velocity(where.normal) - wall.velocity;
  const Vec3 impulse = -surface_impulse({restitution, friction}, before, where.normal, sphere.inverse_mass(),
                                        sphere.across(), wall.inverse_mass);
  if (impulse == Vec3{}) return {};
  const Vec3 wall_change = scaled(wall.inverse_mass, impulse), change = sphere.change(-impulse, where.normal);
  const Impact impact{impulse, dot(impulse, wall.velocity + wall_change * 0.5),
                      dot(impulse, before + (change - wall_change) * 0.5)};
  sphere.push(-impulse, 1.0, where.normal);
  give(where.face, weight, impulse, t, impact.work);
  return impact;
}

Impact SurfaceSheet::collide(const SheetPoint& where, double mass, double restitution, double friction, double t,
                             Vec3& velocity) {
  return collide(where, SmoothSphere{mass, velocity}, restitution, friction, t);
}

Impact SurfaceSheet::collide(const SheetPoint& where, SmoothSphere sphere, double restitution, double friction,
                             double t) {
  return meet(where, sphere, restitution, friction, t);
}

Impact SurfaceSheet::collide(const SheetPoint& where, TurningSphere sphere, double restitution, double friction,
                             double t) {
  return meet(where, sphere, restitution, friction, t);
}

Impact SurfaceSheet::push(const SheetPoint& where, const Vec3& impulse, double t) {
  const std::array<double, 4> weight = bilinear_weights(where.xi, where.eta);
  const Answer wall = answer(where.face, weight);
  const Impact impact{impulse, dot(impulse, wall.velocity + scaled(wall.inverse_mass, impulse) * 0.5), 0.0};
  give(where.face, weight, impulse, t, impact.work);
  return impact;
}

Vec3 SurfaceSheet::velocity_at(const SheetPoint& where) const {
  return answer(where.face, bilinear_weights(where.xi, where.eta)).velocity;
}

void SurfaceSheet::collect_load(double window, SurfaceLoad& load) {
  load.force.resize(plate_nodes_);
  for (std::size_t n = 0; n < plate_nodes_; ++n) load.force[n] = window_impulse_[n] / window;
  pending_.swap(window_impulse_);
  std::fill(window_impulse_.begin(), window_impulse_.end(), Vec3{});
}

void SurfaceSheet::throw_unless_sized(std::size_t reference_nodes) const {
  const std::size_t nodes = mesh_.position.size();
  const bool fits = reference_nodes == nodes && position_.size() == nodes && velocity_.size() == nodes &&
                    window_impulse_.size() == plate_nodes_ && pending_.size() == plate_nodes_ &&
                    node_impulse_.size() == plate_nodes_;
  if (!fits)
    throw Stop(ExitCode::checkpoint_incompatible, "the saved surface has " + std::to_string(position_.size()) +
                                                      " nodes, this case " + std::to_string(nodes) +
                                                      ": it was saved with another mesh");
}

std::size_t SurfaceSheet::plate_nodes() const {
  return plate_nodes_;
}
Vec3 SurfaceSheet::total_impulse() const {
  return total_impulse_;
}
Vec3 SurfaceSheet::surround_impulse() const {
  return surround_impulse_;
}
double SurfaceSheet::total_work() const {
  return total_work_;
}
std::span<const Vec3> SurfaceSheet::node_impulse() const {
  return node_impulse_;
}
const SurfaceMesh& SurfaceSheet::mesh() const {
  return mesh_;
}

}  // namespace standoff::particles
