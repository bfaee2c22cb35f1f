#include "particle_solver/app/particle_files.hpp"

#include <cmath>

#include "coupling/output/atomic_file.hpp"
#include "coupling/output/csv_table.hpp"

namespace standoff::particles {
namespace {

/// Area that belongs to each node of a mesh at rest, m2: a quarter of each of its quads.
std::vector<double> nodal_area(const SurfaceMesh& mesh, std::size_t nodes) {
  std::vector<double> area(nodes, 0.0);
  for (const auto& quad : mesh.quads) {
    auto corner = [&](std::size_t a) { return static_cast<std::size_t>(quad[a]); };
    if (corner(0) >= nodes) continue;  // the surround
    const Vec3 diagonal = mesh.position[corner(2)] - mesh.position[corner(0)];
    const Vec3 other = mesh.position[corner(3)] - mesh.position[corner(1)];
    for (std::size_t a = 0; a < 4; ++a) area[corner(a)] += 0.125 * norm(cross(diagonal, other));
  }
  return area;
}

}  // namespace

ParticleFiles::ParticleFiles(const std::string& folder) : folder_(folder) {
  if (!folder.empty()) series_.emplace(folder + "/particles", "particles", "vtp");
}

void ParticleFiles::frame(double time, const GasState& gas, const SandState& sand, const GasState* air) {
  if (!series_) return;
  std::vector<Vec3> position(gas.position), velocity(gas.velocity);
  position.insert(position.end(), sand.position.begin(), sand.position.end());
  velocity.insert(velocity.end(), sand.velocity.begin(), sand.velocity.end());
  for (std::size_t i = 0; i < gas.size(); ++i)
    if (!gas.all_released() && gas.released[i] == 0) velocity[i] = {};
  std::vector<double> radius(gas.size(), gas.radius), medium(gas.size(), 0.0);
  for (std::size_t i = 0; i < sand.size(); ++i) radius.push_back(sand.radius_of(i));
  medium.resize(position.size(), 1.0);
  if (air != nullptr) {
    position.insert(position.end(), air->position.begin(), air->position.end());
    velocity.insert(velocity.end(), air->velocity.begin(), air->velocity.end());
    radius.resize(position.size(), air->radius), medium.resize(position.size(), 2.0);
  }
  series_->add(time, vtp_text(position, {vtk_array("velocity_m_per_s", velocity), vtk_array("radius_m", radius),
                                         vtk_array("medium", medium)}));
}

void ParticleFiles::impulse_map(const SurfaceSheet& sheet, bool quarter) const {
  if (folder_.empty() || !sheet.is_level()) return;  // a map over x, y is one of a plate
  const std::size_t nodes = sheet.plate_nodes();
  const std::vector<double> area = nodal_area(sheet.mesh(), nodes);
  std::vector<std::vector<double>> rows;
  for (std::size_t a = 0; a < nodes; ++a) {
    const Vec3& x = sheet.mesh().position[a];
    const double specific = -sheet.node_impulse()[a].z / area[a];
    for (const double sx : {1.0, -1.0})
      for (const double sy : {1.0, -1.0}) {
        const bool twice = (sx < 0.0 && (!quarter || x.x == 0.0)) || (sy < 0.0 && (!quarter || x.y == 0.0));
        if (!twice) rows.push_back({sx * x.x, sy * x.y, specific});
      }
  }
  write_atomically(folder_ + "/impulse_map.csv", csv_text({"x_m", "y_m", "impulse_Pa_s"}, rows));
}

}  // namespace standoff::particles
