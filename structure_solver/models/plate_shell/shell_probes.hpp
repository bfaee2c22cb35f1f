#pragma once
// What is read off a shell plate: deflections of the mid-surface, the centre line, extremes of the history, frames for
// ParaView. Deflection is positive away from the charge (against z).
#include "structure_solver/models/plate_shell/shell_plate.hpp"
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

class ShellProbes {
 public:
  explicit ShellProbes(const ShellMesh& mesh);

  double centre_deflection(std::span<const Vec3> u) const;
  double max_deflection(std::span<const Vec3> u) const;
  /// Along y = 0 of the full plate, mirrored from a quarter.
  std::vector<ProfilePoint> profile(std::span<const Vec3> u) const;
  /// Extremes of the committed history; max_strain_rate stays zero.
  StructureExtremes extremes(const ShellForce& forces) const;

 private:
  /// The two node lines on either side of zero along an axis and the weight of the upper one.
  struct Axis {
    int first = 0;
    double upper = 0.0;
  };
  Axis centre_of(int axis) const;
  double on_centre_line(std::span<const Vec3> u, int i) const;

  const ShellMesh& mesh_;
  Axis centre_x_, centre_y_;
};

/// Quads of the mid-surface, means and extremes of each cell.
StructureFrame shell_frame(const ShellPlate& plate);

}  // namespace standoff::structure
