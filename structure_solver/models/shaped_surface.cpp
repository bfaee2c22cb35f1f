#include "structure_solver/models/shaped_surface.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/base/stop.hpp"
#include "structure_solver/mesh/surface_map.hpp"

namespace standoff::structure {
namespace {

constexpr double fixed_factor = 1e6;  // as in mesh/surface_inertia.hpp: a node that does not answer
/// sum_b C_ab / C_aa of the bilinear quads, 3/2 along each axis: how a hit spread over nodes that answer together is
/// felt beside one on a single node (mesh/surface_inertia.hpp with A_ab = phi_a phi_b / M, phi nearly constant in a
/// quad).
constexpr double spread = 2.25;

double answering_mass(double mass, double weight, double tributary) {
  const double inverse = spread * weight * weight / mass;
  return inverse * fixed_factor * tributary > 1.0 ? 1.0 / inverse : fixed_factor * tributary;
}

}  // namespace

ShapedSurface::ShapedSurface(const PlateMeshOptions& options, Shape shape, double mass) : shape_(std::move(shape)) {
  const PlateMesh mesh = make_plate_mesh(options);
  surface_ = plate_surface(mesh);
  for (std::size_t i = 0; i < surface_.position.size(); ++i) {
    weight_.push_back(shape_(surface_.position[i]));
    surface_.node_mass[i] = answering_mass(mass, weight_[i], surface_.node_mass[i]);
  }
  const auto count = static_cast<std::size_t>(mesh.nodes[0]);
  for (std::size_t i = options.quarter ? count - 1 : 0; options.quarter && i > 0; --i)
    line_.push_back(-surface_.position[i].x);
  for (std::size_t i = 0; i < count; ++i) line_.push_back(surface_.position[i].x);
}

void ShapedSurface::motion(double deflection, double velocity, SurfaceMotion& motion) const {
  motion.position = surface_.position;
  motion.velocity.assign(surface_.position.size(), Vec3{});
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    motion.position[i].z -= weight_[i] * deflection;
    motion.velocity[i].z -= weight_[i] * velocity;
  }
}

double ShapedSurface::force_along(std::span<const Vec3> force) const {
  if (force.size() != weight_.size())
    throw Stop(ExitCode::participant_lost, "structure: the load has " + std::to_string(force.size()) +
                                               " forces, the plate surface has " + std::to_string(weight_.size()) +
                                               " nodes\n  both sides must use the surface of the handshake");
  double sum = 0.0;
  for (std::size_t i = 0; i < weight_.size(); ++i) sum -= weight_[i] * force[i].z;
  return sum;
}

std::vector<ProfilePoint> ShapedSurface::profile(double deflection) const {
  std::vector<ProfilePoint> points;
  for (const double x : line_) points.push_back({x, shape_({x, 0.0, 0.0}) * deflection});
  return points;
}

StructureFrame ShapedSurface::frame(double deflection, double velocity) const {
  StructureFrame frame;
  SurfaceMotion now;
  motion(deflection, velocity, now);
  frame.position = now.position, frame.velocity = now.velocity;
  for (const double weight : weight_) frame.displacement.push_back({0.0, 0.0, -weight * deflection});
  frame.vtk_cell_type = 9;
  for (const auto& q : surface_.quads) frame.cells.push_back({q[0], q[1], q[2], q[3]});
  return frame;
}

}  // namespace standoff::structure
