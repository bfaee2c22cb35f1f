#pragma once
// Sorts points into cells, so that neighbours in space are neighbours in memory, and finds the points of a cell.
//
//   brick = 4 x 4 x 4 cells, bricks in Morton order      only occupied bricks hold cells; the map of bricks is dense
//   sub-brick = 2 x 2 x 2 cells, contiguous in a brick   the unit of the displacement check (grain_drift.hpp)
//   cell edge >= cutoff: all neighbours within the cutoff lie in the 27 cells around a point
//
// A cloud that spreads out would need ever more bricks: once they exceed eight per point the cell edge doubles.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

struct CellIndex {
  int x = 0, y = 0, z = 0;
};

class GrainCells {
 public:
  struct Brick {
    CellIndex at;  // in bricks
    std::uint64_t morton = 0;
  };

  /// Sorts `points`; `periodic_box` (lengths, 0: not along z) or null. The cutoff must be > 0.
  void build(std::span<const Vec3> points, double cutoff, const Vec3* periodic_box);

  /// Sorted index -> index in the span given to build.
  const std::vector<std::uint32_t>& order() const { return order_; }
  const std::vector<Brick>& bricks() const { return bricks_; }
  double edge() const { return edge_; }  // m, shortest edge of a cell
  /// True if periodic and too small for cells: everyone is everyone's neighbour.
  bool too_small() const { return periodic_ && (cells_.x < 3 || cells_.y < 3 || (cells_.z < 3 && box_.z > 0.0)); }
  bool periodic() const { return periodic_; }
  /// False in a periodic box with bricks that are cut by its end, or fewer than three of them: a brick is then no
  /// neighbour that means anything.
  bool bricks_are_whole() const { return !periodic_ || whole_; }

  /// First sorted index of code `c` (0..64) of brick b; the points of a cell are [first(b,c), first(b,c+1)).
  std::uint32_t first(std::size_t brick, unsigned code) const { return first_[brick * 64 + code]; }
  /// Brick that holds a cell after wrapping, -1 if there is none; `code` is the cell's place in it.
  int find(CellIndex cell, unsigned& code) const;
  /// One bit per code: the cells of a brick that hold points.
  std::uint64_t occupied(std::size_t brick) const { return occupied_[brick]; }
  /// The 27 bricks around one and itself, -1 where there is none; place 13 is the brick. For whole bricks.
  std::array<std::int32_t, 27> bricks_around(std::size_t brick) const;
  /// The same for brick coordinates, after wrapping where bricks are whole.
  int find_brick(CellIndex brick) const;

  /// Place of a cell in its brick: three bits for the sub-brick, three for the cell in it.
  static constexpr unsigned code_of(int x, int y, int z) {
    return static_cast<unsigned>((x >> 1 & 1) << 3 | (y >> 1 & 1) << 4 | (z >> 1 & 1) << 5 | (x & 1) | (y & 1) << 1 |
                                 (z & 1) << 2);
  }
  static constexpr CellIndex cell_of(unsigned code) {
    const int c = static_cast<int>(code);
    return {(c >> 3 & 1) << 1 | (c & 1), (c >> 4 & 1) << 1 | (c >> 1 & 1), (c >> 5 & 1) << 1 | (c >> 2 & 1)};
  }

 private:
  void choose_grid(std::span<const Vec3> points, double cutoff, const Vec3* periodic_box);
  void sort(std::span<const Vec3> points);
  CellIndex cell_at(const Vec3& p) const;
  std::size_t slot(CellIndex brick) const {
    return (static_cast<std::size_t>(brick.z) * static_cast<std::size_t>(grid_.y) + static_cast<std::size_t>(brick.y)) *
               static_cast<std::size_t>(grid_.x) +
           static_cast<std::size_t>(brick.x);
  }

  bool periodic_ = false, whole_ = false;
  Vec3 lower_, per_edge_, box_;  // m, 1/m, m
  double edge_ = 0.0;
  CellIndex cells_, grid_;  // number of cells and of bricks along each axis
  std::vector<std::int32_t> brick_at_;
  std::vector<Brick> bricks_;
  std::vector<std::uint64_t> occupied_;
  std::vector<std::uint32_t> first_, order_;
};

/// Which cells of which brick (a place in GrainCells::bricks_around) are among the 27 around a cell.
struct CellsAround {
  struct Part {
    unsigned place = 0;
    std::uint64_t cells = 0;  // a bit per code
  };
  std::array<Part, 8> parts{};  // a block of 3 x 3 x 3 cells reaches into at most eight bricks
  std::size_t count = 0;
};

/// For the cell with a given code.
const CellsAround& cells_around(unsigned code);

}  // namespace standoff::particles
