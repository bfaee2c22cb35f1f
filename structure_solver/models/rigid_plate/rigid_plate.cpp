#include "structure_solver/models/rigid_plate/rigid_plate.hpp"

#include <cmath>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {

RigidPlate::RigidPlate(const CaseSpec& spec) : mirrored_(spec.run.quarter_symmetry) {
  const PlateMesh mesh = make_plate_mesh(mesh_options(spec));
  surface_ = plate_surface(mesh);
  line_nodes_ = mesh.nodes[0];
  const MaterialSpec& m = spec.plate.material;
  mass_ = m.density * spec.plate.size.x * spec.plate.size.y * spec.plate.size.z / spec.copies();
  stable_step_ = spec.plate.size.z / std::sqrt(m.youngs_modulus / m.density);  // one thickness transit
}

void RigidPlate::set_surface_force(std::span<const Vec3> force) {
  force_ = {};
  for (const Vec3& f : force) force_ += f;
}

void RigidPlate::step(double dt) {
  impulse_ += dt * force_;
  time_ += dt;
}

StructureLedger RigidPlate::ledger() const {
  StructureLedger ledger;
  ledger.impulse_received = impulse_;
  ledger.impulse_of_supports = -impulse_;
  return ledger;
}

std::vector<ProfilePoint> RigidPlate::profile() const {
  std::vector<ProfilePoint> points;
  for (int i = mirrored_ ? line_nodes_ - 1 : 0; mirrored_ && i > 0; --i)
    points.push_back({-surface_.position[static_cast<std::size_t>(i)].x, 0.0});
  for (int i = 0; i < line_nodes_; ++i) points.push_back({surface_.position[static_cast<std::size_t>(i)].x, 0.0});
  return points;
}

StructureFrame RigidPlate::frame() const {
  StructureFrame frame;
  frame.position = surface_.position;
  frame.displacement.resize(frame.position.size());
  frame.velocity.resize(frame.position.size());
  frame.vtk_cell_type = 9;
  for (const auto& q : surface_.quads) frame.cells.push_back({q[0], q[1], q[2], q[3]});
  return frame;
}

}  // namespace standoff::structure
