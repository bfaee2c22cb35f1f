#include "structure_solver/models/plate_hex64/plate_probes.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::structure {

PlateProbes::PlateProbes(const PlateMesh& mesh) : mesh_(mesh) {
  const Vec3& size = mesh.options.size;
  centre_x_ = axis_point(0, mesh.bent() ? 0.125 * size.x : 0.0);
  centre_y_ = axis_point(1, mesh.bent() ? 0.5 * size.y : 0.0);
  middle_ = axis_point(2, -0.5 * mesh.options.size.z);
}

PlateProbes::AxisPoint PlateProbes::axis_point(std::size_t axis, double coordinate) const {
  const double lower[3] = {mesh_.lower.x, mesh_.lower.y, mesh_.lower.z};
  const double edge[3] = {mesh_.edge.x, mesh_.edge.y, mesh_.edge.z};
  const double place = (coordinate - lower[axis]) / edge[axis];
  // A point on an element boundary is that boundary's node: round first, so that no rounding error reaches the weights.
  const double nearest = std::round(place);
  const auto last = static_cast<std::size_t>(mesh_.order());
  if (std::fabs(place - nearest) < 1e-9) {
    const int element = std::min(static_cast<int>(nearest), mesh_.elements[axis] - 1);
    return {mesh_.order() * element, mesh_.basis().to_even[static_cast<int>(nearest) == element ? 0 : last]};
  }
  const int element = std::clamp(static_cast<int>(place), 0, mesh_.elements[axis] - 1);
  return {mesh_.order() * element, mesh_.basis().at(2.0 * (place - element) - 1.0)};
}

PlateProbes::AxisPoint PlateProbes::at_node(int j) const {
  AxisPoint y{std::min(j / mesh_.order(), mesh_.elements[1] - 1) * mesh_.order(), {}};
  y.weight[static_cast<std::size_t>(j - y.first)] = 1.0;
  return y;
}

double PlateProbes::mid_surface(std::span<const Vec3> u, int i, const AxisPoint& y) const {
  double sum = 0.0;
  for (int k = 0; k < mesh_.per_edge(); ++k)
    for (int j = 0; j < mesh_.per_edge(); ++j)
      sum += middle_.weight[static_cast<std::size_t>(k)] * y.weight[static_cast<std::size_t>(j)] *
             dot(mesh_.outward(i), u[static_cast<std::size_t>(mesh_.node(i, y.first + j, middle_.first + k))]);
  return sum;
}

double PlateProbes::on_line(std::span<const Vec3> u, const AxisPoint& y) const {
  double sum = 0.0;
  for (int a = 0; a < mesh_.per_edge(); ++a) {
    const double w = centre_x_.weight[static_cast<std::size_t>(a)];
    if (w != 0.0) sum += w * mid_surface(u, centre_x_.first + a, y);
  }
  return sum;
}

double PlateProbes::centre_deflection(std::span<const Vec3> u) const {
  return on_line(u, centre_y_);
}

double PlateProbes::max_deflection(std::span<const Vec3> u) const {
  double largest = -1e300;
  for (int j = 0; j < mesh_.nodes[1]; ++j) {
    const AxisPoint y = at_node(j);
    for (int i = 0; i < mesh_.nodes[0]; ++i) largest = std::max(largest, mid_surface(u, i, y));
  }
  return largest;
}

std::vector<ProfilePoint> PlateProbes::profile(std::span<const Vec3> u) const {
  std::vector<ProfilePoint> points;
  if (mesh_.bent()) {
    for (int j = 0; j < mesh_.nodes[1]; ++j)
      points.push_back({mesh_.position[static_cast<std::size_t>(mesh_.node(0, j, 0))].z, on_line(u, at_node(j))});
    return points;
  }
  for (int i = 0; i < mesh_.nodes[0]; ++i)
    points.push_back({mesh_.position[static_cast<std::size_t>(i)].x, mid_surface(u, i, centre_y_)});
  if (!mesh_.options.quarter) return points;
  std::vector<ProfilePoint> full;
  for (auto p = points.rbegin(); p + 1 != points.rend(); ++p) full.push_back({-p->x, p->deflection});
  full.insert(full.end(), points.begin(), points.end());
  return full;
}

double PlateProbes::to_centre(const Vec3& x) const {
  return mesh_.bent() ? std::fabs(x.z - 0.5 * mesh_.options.size.y) : std::hypot(x.x, x.y);
}

StructureExtremes PlateProbes::extremes(const InternalForce& forces) const {
  StructureExtremes x;
  const double half_x = free_half_width(mesh_, 0), half_y = free_half_width(mesh_, 1);
  const double margin = (mesh_.bent() ? half_y : std::max(half_x, half_y)) / 10.0;  // two elements of a 40 x 40 mesh
  const auto to_edge = [&](const Vec3& at) {
    if (!mesh_.bent()) return std::min(half_x - std::fabs(at.x), half_y - std::fabs(at.y));
    return mesh_.options.edges == "clamped" ? half_y - to_centre(at) : 1e300;  // other ends are no clamp
  };
  double nearest = 1e300;
  for (long e = 0; e < mesh_.element_count(); ++e)
    for (int q = 0; q < forces.points(); ++q) {
      const double strain = forces.plastic_strain(e, q);
      const Vec3 at = mesh_.gauss_position(e, q);
      x.max_plastic_strain = std::max(x.max_plastic_strain, strain);
      x.max_temperature_rise =
          std::max(x.max_temperature_rise, forces.temperature(e, q) - forces.metal().flow.room_temperature);
      if (to_edge(at) > margin)
        x.max_plastic_strain_away_from_clamp = std::max(x.max_plastic_strain_away_from_clamp, strain);
      // The columns of Gauss points next to the axis speak for the centre: their largest value.
      const double distance = to_centre(at);
      if (distance < nearest * (1.0 - 1e-9)) nearest = distance, x.centre_plastic_strain = strain;
      if (distance < nearest * (1.0 + 1e-9)) x.centre_plastic_strain = std::max(x.centre_plastic_strain, strain);
    }
  return x;
}

}  // namespace standoff::structure
