#include "structure_solver/models/plate_shell/shell_probes.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::structure {

ShellProbes::ShellProbes(const ShellMesh& mesh) : mesh_(mesh), centre_x_(centre_of(0)), centre_y_(centre_of(1)) {}

/// A quarter begins at zero; a whole plate has a node line there if its elements are even in number.
ShellProbes::Axis ShellProbes::centre_of(int axis) const {
  if (mesh_.options.quarter) return {};
  const int n = mesh_.elements[static_cast<std::size_t>(axis)];
  return {n / 2, n % 2 == 0 ? 0.0 : 0.5};
}

double ShellProbes::on_centre_line(std::span<const Vec3> u, int i) const {
  const double lower = u[static_cast<std::size_t>(mesh_.node(i, centre_y_.first))].z;
  if (centre_y_.upper == 0.0) return -lower;
  return -0.5 * (lower + u[static_cast<std::size_t>(mesh_.node(i, centre_y_.first + 1))].z);
}

double ShellProbes::centre_deflection(std::span<const Vec3> u) const {
  const double lower = on_centre_line(u, centre_x_.first);
  return centre_x_.upper == 0.0 ? lower : 0.5 * (lower + on_centre_line(u, centre_x_.first + 1));
}

double ShellProbes::max_deflection(std::span<const Vec3> u) const {
  double largest = -1e300;
  for (const Vec3& each : u) largest = std::max(largest, -each.z);
  return largest;
}

std::vector<ProfilePoint> ShellProbes::profile(std::span<const Vec3> u) const {
  std::vector<ProfilePoint> points;
  if (mesh_.options.quarter)
    for (int i = mesh_.nodes[0] - 1; i > 0; --i)
      points.push_back({-mesh_.position[static_cast<std::size_t>(i)].x, on_centre_line(u, i)});
  for (int i = 0; i < mesh_.nodes[0]; ++i)
    points.push_back({mesh_.position[static_cast<std::size_t>(i)].x, on_centre_line(u, i)});
  return points;
}

StructureExtremes ShellProbes::extremes(const ShellForce& forces) const {
  StructureExtremes x;
  const double half_x = 0.5 * mesh_.options.size.x, half_y = 0.5 * mesh_.options.size.y;
  const double margin = std::max(half_x, half_y) / 10.0;  // two elements of a 40 x 40 mesh
  double nearest = 1e300;
  for (std::size_t e = 0; e < mesh_.quads.size(); ++e)
    for (int q = 0; q < shell_material_points; ++q) {
      const double strain = forces.plastic_strain(e, q);
      const Vec3 at = forces.gauss_position(e, q % 4);
      x.max_plastic_strain = std::max(x.max_plastic_strain, strain);
      x.max_temperature_rise =
          std::max(x.max_temperature_rise, forces.temperature(e, q) - forces.metal().flow.room_temperature);
      if (std::min(half_x - std::fabs(at.x), half_y - std::fabs(at.y)) > margin)
        x.max_plastic_strain_away_from_clamp = std::max(x.max_plastic_strain_away_from_clamp, strain);
      // The columns of points next to the axis speak for the centre: their largest value.
      const double distance = std::hypot(at.x, at.y);
      if (distance < nearest * (1.0 - 1e-9)) nearest = distance, x.centre_plastic_strain = strain;
      if (distance < nearest * (1.0 + 1e-9)) x.centre_plastic_strain = std::max(x.centre_plastic_strain, strain);
    }
  return x;
}

StructureFrame shell_frame(const ShellPlate& plate) {
  const ShellMesh& mesh = plate.mesh();
  const ShellForce& forces = plate.forces();
  StructureFrame frame;
  frame.vtk_cell_type = 9;
  frame.displacement = plate.translation().u;
  frame.velocity = plate.translation().v;
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    frame.position.push_back(mesh.position[i] + frame.displacement[i]);
  const std::size_t count = mesh.quads.size();
  std::vector<double> mean(count), max(count), mises(count), thickness(count), temperature(count);
  for (std::size_t e = 0; e < count; ++e) {
    const auto& quad = mesh.quads[e];
    frame.cells.push_back({quad[0], quad[1], quad[2], quad[3]});
    const auto stress = forces.stress(e, plate.translation().u, plate.slip().u);
    for (int q = 0; q < shell_material_points; ++q) {
      const double share = 0.125 * layer_weight[q / 4];
      mean[e] += share * forces.plastic_strain(e, q), max[e] = std::max(max[e], forces.plastic_strain(e, q));
      mises[e] += share * lane(stress[static_cast<std::size_t>(q / 4)], q % 4);
      thickness[e] += share * mesh.options.size.z * (1.0 + forces.stretch(e, q));
      temperature[e] += share * forces.temperature(e, q);
    }
  }
  frame.cell_data = {
      {"plastic_strain", mean}, {"plastic_strain_max", max}, {"von_mises_Pa", mises}, {"thickness_m", thickness}};
  if (forces.layout().temperature >= 0) frame.cell_data.emplace_back("temperature_K", temperature);
  return frame;
}

}  // namespace standoff::structure
