#include <algorithm>
#include <cmath>

#include "structure_solver/elements/hex8.hpp"
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
  const auto elements = static_cast<std::size_t>(mesh.elements[axis]), order = static_cast<std::size_t>(mesh.order());
  for (std::size_t i = 0; i < in.size(); ++i) {
    const std::size_t place = i / stride % count;
    const std::size_t element = std::min(place / order, elements - 1);
    const std::size_t first = i - (place - order * element) * stride;
    const Line4& weight = mesh.basis().to_even[place - order * element];
    for (std::size_t a = 0; a <= order; ++a) out[i] += weight[a] * in[first + a * stride];
  }
  return out;
}

std::vector<Vec3> resample(const PlateMesh& mesh, std::vector<Vec3> values) {
  for (std::size_t axis = 0; axis < 3; ++axis) values = resample_axis(mesh, values, axis);
  return values;
}

/// Volume means over the Gauss points of a cell.
struct CellValues {
  double strain = 0.0, max_strain = 0.0, temperature = 0.0, strain_rate = 0.0, von_mises = 0.0, thickness = 0.0;
  Sym3<double> stress{};
};

template <int N>
using Nodal = double[3][N * N * N];
template <int N>
using PointGradients = std::array<Mat3<double>, N * N * N>;  // du/dX at the Gauss points

/// Angle about z into the frame in which an element of a pipe is computed.
struct Turn {
  double cosine, sine;
  Vec3 in(const Vec3& v) const { return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z}; }
  Sym3<double> back(const Sym3<double>& s) const {
    const double cc = cosine * cosine, ss = sine * sine, cs = cosine * sine;
    return {cc * s.xx + 2.0 * cs * s.xy + ss * s.yy,
            ss * s.xx - 2.0 * cs * s.xy + cc * s.yy,
            s.zz,
            cs * (s.yy - s.xx) + (cc - ss) * s.xy,
            cosine * s.yz - sine * s.zx,
            cosine * s.zx + sine * s.yz};
  }
};

template <int N>
void nodal_values(const PlateMesh& mesh, const std::vector<Vec3>& field, long e, const Turn& turn, Nodal<N>& nodal) {
  for (int a = 0; a < N * N * N; ++a) {
    const Vec3 v = turn.in(field[static_cast<std::size_t>(mesh.element_node(e, a))]);
    nodal[0][a] = v.x, nodal[1][a] = v.y, nodal[2][a] = v.z;
  }
}

template <class Geometry>
PointGradients<Geometry::per_edge> gradients_of(const Geometry& geometry, const Nodal<Geometry::per_edge>& nodal) {
  double parametric[3][3][Geometry::nodes];
  for (int c = 0; c < 3; ++c)
    hex_gradient<Geometry::per_edge>(nodal[c], parametric[c][0], parametric[c][1], parametric[c][2]);
  PointGradients<Geometry::per_edge> h;
  for (int q = 0; q < Geometry::nodes; ++q)
    h[static_cast<std::size_t>(q)] = geometry.reference_gradient(q, load_gradient(parametric, q));
  return h;
}

/// Cauchy stress: (2 G dev eps + K (tr eps - 3 alpha (T - Tr)) I) / J of the elastic logarithmic strain eps.
Sym3<double> cauchy_stress(const InternalForce& forces, long e, int q, const Mat3<double>& h, double j) {
  const HistoryLayout& layout = forces.layout();
  Sym3<double> metric{};
  if (layout.strain >= 0)
    metric = {forces.history(e, q, 0), forces.history(e, q, 1), forces.history(e, q, 2),
              forces.history(e, q, 3), forces.history(e, q, 4), forces.history(e, q, 5)};
  const Sym3<double> twice = log_one_plus(elastic_left_cauchy_green(h, deformation_gradient(h), metric));
  const MetalParameters& metal = forces.metal();
  double volumetric = 0.5 * trace(twice);
  const double mean = trace(twice) / 3.0, shear = metal.shear / j;
  if (layout.expansion) volumetric -= metal.expansion * (forces.temperature(e, q) - metal.flow.room_temperature);
  const double pressure = metal.bulk * volumetric / j;
  return {shear * (twice.xx - mean) + pressure,
          shear * (twice.yy - mean) + pressure,
          shear * (twice.zz - mean) + pressure,
          shear * twice.xy,
          shear * twice.yz,
          shear * twice.zx};
}

double von_mises(const Sym3<double>& s) {
  const double mean = trace(s) / 3.0;
  const Sym3<double> dev{s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.yz, s.zx};
  return std::sqrt(1.5 * contract(dev, dev));
}

/// sqrt(2/3 dev D : dev D) of the rate of deformation D, the symmetric part of dH/dt F^-1.
double equivalent_rate(const Mat3<double>& h_rate, const Mat3<double>& cofactor_of_f, double j) {
  double l[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      l[i][k] = 0.0;
      for (int d = 0; d < 3; ++d) l[i][k] += h_rate.m[i][d] * cofactor_of_f.m[k][d] / j;
    }
  const Sym3<double> rate{
      l[0][0], l[1][1], l[2][2], 0.5 * (l[0][1] + l[1][0]), 0.5 * (l[1][2] + l[2][1]), 0.5 * (l[2][0] + l[0][2])};
  return von_mises(rate) / 1.5;
}

/// Enhanced strain of an element with 8 nodes, and its rate in the step that follows.
struct Enhanced {
  double now = 0.0, rate = 0.0, interval = 0.0;  // -, 1/s, s
};

/// One an element; all zero with more nodes.
std::vector<Enhanced> enhanced_strains(const PlateSolid& plate) {
  const auto count = static_cast<std::size_t>(plate.mesh().element_count());
  std::vector<Enhanced> strains(count);
  if (plate.mesh().order() != 1) return strains;
  const double dt = plate.stable_step();
  std::vector<Vec3> ahead = plate.state().u;
  for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += dt * plate.state().v[i];
  const auto now = plate.forces().enhanced_strains_at(plate.state().u, 0.0);
  const auto then = plate.forces().enhanced_strains_at(ahead, dt);
  for (std::size_t e = 0; e < count; ++e)
    strains[e] = {plate.forces().enhanced_strain(static_cast<long>(e)), (then[e] - now[e]) / dt, dt};
  return strains;
}

/// Gradients of displacement and velocity at the Gauss points of an element, as the metal feels them.
template <int N>
struct Felt {
  PointGradients<N> h, rate;
};

template <class Geometry>
Felt<Geometry::per_edge> felt(const Geometry& geometry, const Nodal<Geometry::per_edge>& u,
                              const Nodal<Geometry::per_edge>& velocity, const Enhanced&) {
  return {gradients_of(geometry, u), gradients_of(geometry, velocity)};
}

/// With 8 nodes strains are assumed and enhanced, not linear in the displacements: rates by central differences.
Felt<2> felt(const BoxGeometryOf<2>& box, const Nodal<2>& u, const Nodal<2>& velocity, const Enhanced& alpha) {
  const auto moved_by = [&](double time) {
    Nodal<2> moved;
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < 8; ++a) moved[c][a] = u[c][a] + time * velocity[c][a];
    return hex8_gradients(moved, box.scale, alpha.now + time * alpha.rate);
  };
  Felt<2> result{moved_by(0.0), moved_by(0.5 * alpha.interval)};
  const PointGradients<2> before = moved_by(-0.5 * alpha.interval);
  for (std::size_t q = 0; q < 8; ++q)
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d)
        result.rate[q].m[i][d] = (result.rate[q].m[i][d] - before[q].m[i][d]) / alpha.interval;
  return result;
}

template <class Geometry>
CellValues cell_values(const PlateSolid& plate, long e, const Geometry& geometry, double volume,
                       const Enhanced& alpha) {
  const PlateMesh& mesh = plate.mesh();
  const InternalForce& forces = plate.forces();
  const Turn turn{std::cos(mesh.angle_to_first(e)), std::sin(mesh.angle_to_first(e))};
  constexpr int N = Geometry::per_edge;
  Nodal<N> u, velocity;
  nodal_values<N>(mesh, plate.state().u, e, turn, u);
  nodal_values<N>(mesh, plate.state().v, e, turn, velocity);
  const Felt<N> gradients = felt(geometry, u, velocity, alpha);
  CellValues v;
  for (int q = 0; q < Geometry::nodes; ++q) {
    const double share = geometry.weight(q) / volume;
    const auto i = static_cast<std::size_t>(q);
    const Mat3<double>& h = gradients.h[i];
    const Mat3<double> f = deformation_gradient(h), c = cofactor(f);
    const double j = rows(f, 0, c, 0), strain = forces.plastic_strain(e, q);
    const Sym3<double> s = cauchy_stress(forces, e, q, h, j);
    v.strain += share * strain, v.max_strain = std::max(v.max_strain, strain);
    v.temperature += share * forces.temperature(e, q);
    v.strain_rate += share * equivalent_rate(gradients.rate[i], c, j);
    v.von_mises += share * von_mises(s);
    v.stress.xx += share * s.xx, v.stress.yy += share * s.yy, v.stress.zz += share * s.zz;
    v.stress.xy += share * s.xy, v.stress.yz += share * s.yz, v.stress.zx += share * s.zx;
    // Height of the deformed element over its reference mid-plane: 2 / |F^-T g|, g = dxi_2 / dX.
    const Vec3 g = geometry.direction(q, 2);
    const auto along = [&](int k) { return c.m[k][0] * g.x + c.m[k][1] * g.y + c.m[k][2] * g.z; };
    v.thickness += share * 2.0 * j / norm(Vec3{along(0), along(1), along(2)});
  }
  v.stress = turn.back(v.stress);
  return v;
}

struct Column {
  const char* name;
  double (*of)(const CellValues&);
};

/// What the scene's effects leave to be shown.
std::vector<Column> columns(const HistoryLayout& layout) {
  std::vector<Column> list;
  if (layout.strain >= 0) {
    list.push_back({"plastic_strain", [](const CellValues& v) { return v.strain; }});
    list.push_back({"plastic_strain_max", [](const CellValues& v) { return v.max_strain; }});
  }
  list.push_back({"strain_rate_per_s", [](const CellValues& v) { return v.strain_rate; }});
  list.push_back({"von_mises_Pa", [](const CellValues& v) { return v.von_mises; }});
  list.push_back({"stress_xx_Pa", [](const CellValues& v) { return v.stress.xx; }});
  list.push_back({"stress_yy_Pa", [](const CellValues& v) { return v.stress.yy; }});
  list.push_back({"stress_zz_Pa", [](const CellValues& v) { return v.stress.zz; }});
  list.push_back({"stress_xy_Pa", [](const CellValues& v) { return v.stress.xy; }});
  list.push_back({"stress_yz_Pa", [](const CellValues& v) { return v.stress.yz; }});
  list.push_back({"stress_zx_Pa", [](const CellValues& v) { return v.stress.zx; }});
  list.push_back({"thickness_m", [](const CellValues& v) { return v.thickness; }});
  if (layout.temperature >= 0) list.push_back({"temperature_K", [](const CellValues& v) { return v.temperature; }});
  return list;
}

}  // namespace

StructureFrame plate_frame(const PlateSolid& plate) {
  const PlateMesh& mesh = plate.mesh();
  StructureFrame frame;
  if (mesh.order() == 1) frame.vtk_cell_type = 12;
  frame.displacement = resample(mesh, plate.state().u);
  frame.velocity = resample(mesh, plate.state().v);
  frame.position = resample(mesh, mesh.position);
  for (std::size_t i = 0; i < frame.position.size(); ++i) frame.position[i] += frame.displacement[i];
  const std::vector<Enhanced> enhanced = enhanced_strains(plate);
  std::vector<CellValues> values;
  for (long e = 0; e < mesh.element_count(); ++e) {
    auto& cell = frame.cells.emplace_back();
    const BatchShape& shape = plate.forces().shape(e);
    const Enhanced& alpha = enhanced[static_cast<std::size_t>(e)];
    with_nodes_per_edge(mesh.per_edge(), [&](auto n) {
      for (const int local : vtk_order<n()>) cell.push_back(mesh.element_node(e, local));
      if (shape.curved != nullptr)
        values.push_back(cell_values(plate, e, *shape.curved, shape.curved->volume(), alpha));
      else
        values.push_back(cell_values(plate, e, BoxGeometryOf<n()>::of_box(shape.box), shape.box.volume, alpha));
    });
  }
  for (const Column& column : columns(plate.forces().layout())) {
    auto& [name, data] = frame.cell_data.emplace_back(column.name, std::vector<double>{});
    for (const CellValues& v : values) data.push_back(column.of(v));
  }
  return frame;
}

}  // namespace standoff::structure
