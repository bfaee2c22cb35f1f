#pragma once
// Stage internal_force of the shells: the resisting force of all elements and their committed history.
//
//   element forces, 4 nodes x (displacement, slip) -> every node sums its contributions in element order
//
// Each element writes its own part of the buffer and each node is summed by one thread in a fixed order: the result has
// the same bits for any number of threads.
//
// DATA LAYOUT  history: Pack4[element][5 layers][fields + 1], lane = Gauss point in the plane
#include <array>
#include <span>
#include <vector>

#include "coupling/base/state_hash.hpp"
#include "structure_solver/models/plate_shell/shell_kernels.hpp"
#include "structure_solver/models/plate_shell/shell_mesh.hpp"
#include "structure_solver/step/internal_force.hpp"

namespace standoff::structure {

inline constexpr int shell_material_points = 4 * shell_layers;

class ShellForce {
 public:
  ShellForce(const ShellMesh& mesh, const MetalParameters& metal, const MetalEffects& effects, int threads);

  /// Element forces at displacement u and slip w into the buffer; the history is written only if `commit`.
  ForceSums evaluate(std::span<const Vec3> u, std::span<const Vec3> slip, const PointStep& step, bool commit);
  /// Sums of the buffered element forces at node i: on its displacement and on its slip.
  Vec3 on_displacement(std::size_t i) const { return at_node(i, 0); }
  Vec3 on_slip(std::size_t i) const { return at_node(i, 4); }

  /// Committed history of point q = 4 layer + Gauss point.
  double plastic_strain(std::size_t element, int q) const {
    return kernel_.layout.strain < 0 ? 0.0 : history(element, q, kernel_.layout.strain);
  }
  double temperature(std::size_t element, int q) const {
    return kernel_.layout.temperature < 0 ? metal_.flow.room_temperature
                                          : history(element, q, kernel_.layout.temperature);
  }
  /// Thickness now over thickness at rest, less one.
  double stretch(std::size_t element, int q) const { return history(element, q, kernel_.layout.fields); }
  /// Von Mises stress of every point [Pa], [layer] with lane = Gauss point.
  std::array<Pack4, shell_layers> stress(std::size_t element, std::span<const Vec3> u,
                                         std::span<const Vec3> slip) const;
  /// Position at rest of Gauss point 0 .. 3 of an element.
  Vec3 gauss_position(std::size_t element, int point) const;

  using ElementMatrix = std::array<double, 400>;  // [20][20], node by node: u_x u_y u_z slip_x slip_y; symmetric
  /// Elastic tangent of an element, plastic flow frozen, by central differences of the force.
  ElementMatrix element_stiffness(std::size_t element, std::span<const Vec3> u, std::span<const Vec3> slip);
  /// Least of (stable step now / stable step at rest) over all points: squeezed laminae and thinned metal shorten it.
  double shape_factor(std::span<const Vec3> u, std::span<const Vec3> slip) const;

  const HistoryLayout& layout() const { return kernel_.layout; }
  const MetalParameters& metal() const { return metal_; }
  std::size_t history_bytes() const { return history_.size() * sizeof(Pack4); }
  void add_to(StateHash& hash) const;
  template <class Archive>
  void archive(Archive& a) {
    a(history_);
  }

 private:
  struct Corners {
    std::array<Vec3, 4> u, slip;
  };
  Corners corners(std::size_t element, std::span<const Vec3> u, std::span<const Vec3> slip) const;
  ShellMotion motion_of(const Corners& at) const;
  /// Forces on displacements (0 .. 3) and slips (4 .. 7) of the four nodes.
  ShellSums element_force(std::size_t element, const Corners& at, const PointStep& step, bool commit, Vec3* out);
  std::size_t element_fields() const { return shell_layers * (static_cast<std::size_t>(kernel_.layout.fields) + 1); }
  double history(std::size_t element, int q, int field) const {
    const auto row = static_cast<std::size_t>(q / 4 * (kernel_.layout.fields + 1) + field);
    return lane(history_[element * element_fields() + row], q % 4);
  }
  Vec3 at_node(std::size_t i, std::size_t kind) const {
    Vec3 sum;
    for (std::int32_t e = node_begin_[i]; e < node_begin_[i + 1]; ++e)
      sum += buffer_[static_cast<std::size_t>(node_entry_[static_cast<std::size_t>(e)]) + kind];
    return sum;
  }

  const ShellMesh& mesh_;
  MetalParameters metal_;
  ShellKernel kernel_;
  int threads_;
  std::vector<ShellGeometry> geometry_;
  std::vector<Pack4> history_;
  std::vector<Vec3> buffer_;                           // [element][displacement 4, slip 4]
  std::vector<ShellSums> sums_;                        // per element
  std::vector<std::int32_t> node_begin_, node_entry_;  // contributions of each node, in element order
};

}  // namespace standoff::structure
