#pragma once
// Closest point of the moving sheet. Broad phase: bins of half a face over x, y (of a sheet that looks along x or y:
// over the two other axes) list the faces whose bounding box, widened by a quarter face, touches the bin; one bin
// answers a short query, O(1). Narrow phase: feet on the listed faces, nearest hull first, so that folds are seen from
// all their faces and the answer is the globally closest point.
//
//   bins        +--+--+--+      boxes and hulls are those of the last rebuild; `slack`, a bound on how far any node has
//   moved since,
//               |  |##|##|      widens every test, so an answer is exact at any time and a rebuild only restores speed
//               +--+--+--+
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/contract/surface.hpp"
#include "particle_solver/kernels/bilinear_quad.hpp"
#include "particle_solver/search/surface_topology.hpp"

namespace standoff::particles {

/// Where the nodes are and how they move: x + v t.
struct SheetMotion {
  std::span<const Vec3> position, velocity;
};

struct SheetFoot {
  std::int32_t face = -1;  // -1: nothing in reach, or the position is beside an open rim and behind it
  QuadFoot foot;
  Vec3 point, normal;  // normal: direction point to position on a crease seen from the front, else of the face
  double gap = 0.0;    // m, signed
};

class SurfaceSearch {
 public:
  SurfaceSearch() = default;
  SurfaceSearch(const SurfaceMesh& mesh, SurfaceTopology topology);

  /// Bins and boxes for nodes at `position`.
  void rebuild(std::span<const Vec3> position);
  /// Node motion above which a rebuild pays.
  double margin() const { return 0.1 * smallest_edge_; }
  double smallest_edge() const { return smallest_edge_; }
  /// The axis across the bins is the one that most of the sheet looks along.
  bool looks_along_z() const { return across_ == &Vec3::z; }
  double bin_size() const { return bin_size_; }
  /// Node positions of the last rebuild.
  std::span<const Vec3> reference() const { return reference_; }
  const SurfaceTopology& topology() const { return topology_; }

  SheetFoot closest(const SheetMotion& motion, const Vec3& position, double reach, double t, double slack) const;

 private:
  struct Box {
    Vec3 lower, upper;
  };
  /// A face's bounding box along its own axes: as tight on a tilted face as on a level one.
  struct Hull {
    Vec3 centre, axis1, axis2, normal;
    double half1, half2, half_normal;
    double squared_distance(const Vec3& p) const {
      const Vec3 d = p - centre;
      const double a = std::max(std::abs(dot(d, axis1)) - half1, 0.0);
      const double b = std::max(std::abs(dot(d, axis2)) - half2, 0.0);
      const double c = std::max(std::abs(dot(d, normal)) - half_normal, 0.0);
      return a * a + b * b + c * c;
    }
  };
  static Hull hull(const std::array<Vec3, 4>& corner);
  struct Range {
    int x0, x1, y0, y1;
    bool empty;
  };
  std::array<Vec3, 4> corners(const SheetMotion& motion, std::int32_t face, double t) const;
  Range bins_within(const Vec3& position, double widen) const;
  void search_bin(std::size_t bin, const SheetMotion& motion, const Vec3& position, double t, double slack,
                  SheetFoot& best, double& distance) const;
  bool on_open_rim(const SheetFoot& best) const;
  Vec3 crease_normal(const SheetMotion& motion, const SheetFoot& best, double t) const;
  void lay_bins();
  void fill_bins();

  std::vector<std::array<std::int32_t, 4>> quads_;
  SurfaceTopology topology_;
  std::vector<Vec3> reference_;
  std::vector<Box> box_;                     // by face
  std::vector<Hull> hull_;                   // by face
  std::vector<double> bin_low_, bin_high_;   // range across of a bin's faces
  std::vector<std::int32_t> first_, faces_;  // CSR: faces of bin b in ascending order
  double Vec3::*first_axis_ = &Vec3::x;
  double Vec3::*second_axis_ = &Vec3::y;
  double Vec3::*across_ = &Vec3::z;
  double smallest_edge_ = 0.0, bin_size_ = 0.0, inverse_bin_ = 0.0, widen_ = 0.0, x0_ = 0.0, y0_ = 0.0;
  int nx_ = 0, ny_ = 0;
};

}  // namespace standoff::particles
