#include <algorithm>
#include <cmath>

#include "structure_solver/mesh/vtk_hexahedron.hpp"
#include "structure_solver/models/plate_hex64/plate_probes.hpp"

namespace standoff::structure {
namespace {

/// Nodal values carried to evenly spaced points along one axis of the grid.
std::vector<Vec3> resample_axis(const PlateMesh& mesh, const std::vector<Vec3>& in, std::size_t axis) {
  std::vector<Vec3> out(in.size());
  const std::size_t strides[3] = {1, static_cast<std::size_t>(mesh.nodes[0]),
                                  static_cast<std::size_t>(mesh.nodes[0]) * static_cast<std::size_t>(mesh.nodes[1])};
  const std::size_t stride = strides[axis], count = static_cast<std::size_t>(mesh.nodes[axis]);
  const auto elements = static_cast<std::size_t>(mesh.elements[axis]);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const std::size_t place = i / stride % count;
    const std::size_t element = std::min(place / 3, elements - 1), first = i - (place - 3 * element) * stride;
    const Line4& weight = to_even[place - 3 * element];
    for (std::size_t a = 0; a < 4; ++a) out[i] += weight[a] * in[first + a * stride];
  }
  return out;
}

std::vector<Vec3> resample(const PlateMesh& mesh, std::vector<Vec3> values) {
  for (std::size_t axis = 0; axis < 3; ++axis) values = resample_axis(mesh, values, axis);
  return values;
}

struct CellValues {
  double mean_strain = 0.0, max_strain = 0.0, temperature = 0.0, von_mises = 0.0, thickness = 0.0;
};

/// Volume means over the Gauss points; von Mises from the Cauchy stress, thickness as deformed volume over mid-plane
/// area.
CellValues cell_values(const PlateSolid& plate, long e) {
  const PlateMesh& mesh = plate.mesh();
  const InternalForce& forces = plate.forces();
  const BoxGeometry box = mesh.geometry();
  double nodal[3][hex_nodes], gradient[3][3][hex_points];
  for (int a = 0; a < hex_nodes; ++a) {
    const Vec3& u = plate.state().u[static_cast<std::size_t>(mesh.element_node(e, a))];
    nodal[0][a] = u.x, nodal[1][a] = u.y, nodal[2][a] = u.z;
  }
  for (int c = 0; c < 3; ++c) hex64_gradient(nodal[c], gradient[c][0], gradient[c][1], gradient[c][2]);
  CellValues v;
  for (int q = 0; q < hex_points; ++q) {
    const double share = box.weight(q) / box.volume;
    const Mat3<double> h = box.reference_gradient(q, load_gradient(gradient, q));
    const Mat3<double> f = deformation_gradient(h);
    const Mat3<double> c = cofactor(f);
    Sym3<double> metric{};
    if (forces.layout().strain >= 0)
      metric = {forces.history(e, q, 0), forces.history(e, q, 1), forces.history(e, q, 2),
                forces.history(e, q, 3), forces.history(e, q, 4), forces.history(e, q, 5)};
    Sym3<double> log = log_one_plus(elastic_left_cauchy_green(h, f, metric));  // twice the elastic strain
    const double mean = trace(log) / 3.0, j = rows(f, 0, c, 0);
    log.xx -= mean, log.yy -= mean, log.zz -= mean;
    const double strain = forces.plastic_strain(e, q);
    v.mean_strain += share * strain, v.max_strain = std::max(v.max_strain, strain);
    v.temperature += share * forces.temperature(e, q);
    v.von_mises += share * forces.metal().shear * std::sqrt(1.5 * contract(log, log)) / j;
    // Height of the deformed element over its reference mid-plane: 1 / |F^-T e_z|.
    v.thickness +=
        share * mesh.edge.z * j / std::sqrt(c.m[0][2] * c.m[0][2] + c.m[1][2] * c.m[1][2] + c.m[2][2] * c.m[2][2]);
  }
  return v;
}

}  // namespace

StructureFrame plate_frame(const PlateSolid& plate) {
  const PlateMesh& mesh = plate.mesh();
  StructureFrame frame;
  frame.displacement = resample(mesh, plate.state().u);
  frame.velocity = resample(mesh, plate.state().v);
  frame.position = resample(mesh, mesh.position);
  for (std::size_t i = 0; i < frame.position.size(); ++i) frame.position[i] += frame.displacement[i];
  std::vector<double> mean, max, temperature, mises, thickness;
  for (long e = 0; e < mesh.element_count(); ++e) {
    auto& cell = frame.cells.emplace_back();
    for (const int local : vtk_cubic_order) cell.push_back(mesh.element_node(e, local));
    const CellValues v = cell_values(plate, e);
    mean.push_back(v.mean_strain), max.push_back(v.max_strain), temperature.push_back(v.temperature);
    mises.push_back(v.von_mises), thickness.push_back(v.thickness);
  }
  frame.cell_data = {
      {"plastic_strain", mean}, {"plastic_strain_max", max}, {"von_mises_Pa", mises}, {"thickness_m", thickness}};
  if (plate.forces().layout().temperature >= 0) frame.cell_data.emplace_back("temperature_K", temperature);
  return frame;
}

}  // namespace standoff::structure
