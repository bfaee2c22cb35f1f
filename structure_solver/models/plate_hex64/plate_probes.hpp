#pragma once
// What is read off a plate: deflections of the mid-surface, the centre line, extremes of the history, frames for
// ParaView. Deflection is positive away from the charge (against z). Of a pipe: outwards; its centre is half its length
// along, half way round the quarter, its line runs along the axis there.
#include "structure_solver/models/plate_hex64/plate_solid.hpp"
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

class PlateProbes {
 public:
  explicit PlateProbes(const PlateMesh& mesh);

  double centre_deflection(std::span<const Vec3> u) const;
  /// Largest mid-surface deflection over the node columns.
  double max_deflection(std::span<const Vec3> u) const;
  /// Along y = 0 of the full plate, mirrored from a quarter.
  std::vector<ProfilePoint> profile(std::span<const Vec3> u) const;
  /// Extremes of the committed history; max_strain_rate stays zero.
  StructureExtremes extremes(const InternalForce& forces) const;

 private:
  /// The nodes of an element on an axis and the weights that interpolate between them.
  struct AxisPoint {
    int first = 0;
    Line4 weight{};
  };
  AxisPoint axis_point(std::size_t axis, double coordinate) const;
  AxisPoint at_node(int j) const;
  double mid_surface(std::span<const Vec3> u, int i, const AxisPoint& y) const;
  double on_line(std::span<const Vec3> u, const AxisPoint& y) const;
  double to_centre(const Vec3& x) const;

  const PlateMesh& mesh_;
  AxisPoint centre_x_, centre_y_, middle_;
};

/// True cubic cells with evenly spaced points, as ParaView expects them, and means and extremes of each cell.
StructureFrame plate_frame(const PlateSolid& plate);

}  // namespace standoff::structure
