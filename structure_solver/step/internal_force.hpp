#pragma once
// Stage internal_force: the resisting force of all elements of a plate and their committed history.
//
//   batches of four elements -> element force buffer -> every node sums its contributions in element order
//
// Each batch writes its own part of the buffer and each node is summed by one thread in a fixed order: the result has
// the same bits for any number of threads. Idle lanes of the last batch repeat the last element and are not counted.
//
// DATA LAYOUT  count = nodes = Gauss points of an element; lane = element 4 batch + lane
//   history: Pack4[batch][count][fields]     buffer: Pack4[batch][3][count]     nodes: [batch][count][lane]
#include <array>
#include <span>
#include <vector>

#include "coupling/base/state_hash.hpp"
#include "structure_solver/mesh/plate_mesh.hpp"
#include "structure_solver/step/element_kernels.hpp"

namespace standoff::structure {

struct ForceSums {
  double elastic = 0.0, inelastic = 0.0;  // J; see ElementSums
  long broken_element = -1;               // first element with det F <= 0 or a number that is not finite
};

class InternalForce {
 public:
  InternalForce(const PlateMesh& mesh, const MetalParameters& metal, const MetalEffects& effects, int threads);

  /// Element forces at u into the buffer; the history is written only if `commit`.
  ForceSums evaluate(std::span<const Vec3> u, const PointStep& step, bool commit);
  /// Sum of the buffered element forces at node i.
  Vec3 at_node(std::size_t i) const {
    Vec3 sum;
    for (std::int32_t e = node_begin_[i]; e < node_begin_[i + 1]; ++e) {
      const double* f = reinterpret_cast<const double*>(buffer_.data()) + node_entry_[static_cast<std::size_t>(e)];
      sum += Vec3{f[0], f[component_stride_], f[2 * component_stride_]};
    }
    return sum;
  }

  /// One number of the committed history.
  double history(long element, int point, int field) const {
    const auto row = (element / 4 * points() + point) * law_.layout.fields + field;
    return lane(history_[static_cast<std::size_t>(row)], static_cast<int>(element % 4));
  }
  double plastic_strain(long element, int point) const {
    return law_.layout.strain < 0 ? 0.0 : history(element, point, law_.layout.strain);
  }
  double temperature(long element, int point) const {
    return law_.layout.temperature < 0 ? metal_.flow.room_temperature
                                       : history(element, point, law_.layout.temperature);
  }
  /// The shape at rest of element e.
  const BatchShape& shape(long e) const { return shapes_[static_cast<std::size_t>(e / 4)]; }
  /// Committed enhanced strain of an element with 8 nodes.
  double enhanced_strain(long e) const {
    return lane(enhanced_[static_cast<std::size_t>(e / 4)], static_cast<int>(e % 4));
  }
  /// Of every element with 8 nodes: the enhanced strain it would have at u after a step dt. Writes nothing.
  std::vector<double> enhanced_strains_at(std::span<const Vec3> u, double dt) const;
  /// Gauss points of an element; as many as nodes.
  int points() const { return static_cast<int>(count_); }
  const HistoryLayout& layout() const { return law_.layout; }
  const MetalParameters& metal() const { return metal_; }
  std::size_t history_bytes() const { return (history_.size() + enhanced_.size()) * sizeof(Pack4); }
  void add_to(StateHash& hash) const;
  template <class Archive>
  void archive(Archive& a) {
    a(history_, enhanced_);  // forces of the elements are made anew each step
  }

  /// [3 a + i][3 b + j], symmetric, rows of 3 points() numbers: room for the largest element.
  using ElementMatrix = std::array<double, 192 * 192>;
  /// Elastic tangent of up to four elements of a batch at u, plastic flow frozen, by central differences of the force.
  void element_stiffness(std::span<const Vec3> u, long batch, std::array<ElementMatrix, 4>& out);
  long batches() const { return static_cast<long>(sums_.size()); }
  /// Least of (stable step now / stable step at rest) over all Gauss points, from the deformed shape alone.
  double shape_factor(std::span<const Vec3> u) const;

 private:
  void shape_batches();
  Pack4* alpha_of(std::size_t batch) { return enhanced_.empty() ? nullptr : &enhanced_[batch]; }
  template <class Geometry>
  double worst_shape(const Geometry& geometry, std::size_t batch, std::span<const Vec3> u) const;

  const PlateMesh& mesh_;
  MetalParameters metal_;
  std::vector<CurvedGeometry> curved_;  // of a pipe, one a layer of its wall
  std::vector<BatchShape> shapes_;      // per batch
  PointLaw law_;
  ElementKernel kernel_;
  int threads_;
  std::size_t count_;                // nodes, and Gauss points, of an element
  std::ptrdiff_t component_stride_;  // in the buffer, counted in numbers
  std::vector<std::int32_t> nodes_;  // [batch][4 local + lane]
  std::vector<Pack4> history_, buffer_;
  std::vector<Pack4> enhanced_;                        // [batch] alpha of elements with 8 nodes, empty otherwise
  std::vector<BatchSums> sums_;                        // per batch
  std::vector<std::int32_t> node_begin_, node_entry_;  // contributions of each node, in element order
};

}  // namespace standoff::structure
