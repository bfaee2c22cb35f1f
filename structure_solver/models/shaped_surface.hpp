#pragma once
// The loaded face of a plate that can move in one way only: along z, by one deflection W times a shape phi(x, y).
//   x_s = X_s - phi_s W e_z,   F = -sum_s phi_s f_s.z     (adjoint: the work of f is F dW)
// phi = 1 is a rigid plate, a pyramid the yielding plate of single_dof.
#include <functional>

#include "structure_solver/mesh/plate_mesh.hpp"
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

class ShapedSurface {
 public:
  using Shape = std::function<double(const Vec3&)>;
  /// `mass`: what resists W [kg], of the simulated part; infinity if nothing moves.
  ShapedSurface(const PlateMeshOptions& options, Shape shape, double mass);

  const SurfaceMesh& surface() const { return surface_; }
  void motion(double deflection, double velocity, SurfaceMotion& motion) const;
  double force_along(std::span<const Vec3> force) const;
  /// Along y = 0 of the full plate.
  std::vector<ProfilePoint> profile(double deflection) const;
  StructureFrame frame(double deflection, double velocity) const;

 private:
  SurfaceMesh surface_;
  Shape shape_;
  std::vector<double> weight_;  // phi of each surface node
  std::vector<double> line_;    // x of the points of the centre line, full plate
};

}  // namespace standoff::structure
