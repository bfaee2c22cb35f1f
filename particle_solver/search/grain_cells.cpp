#include "particle_solver/search/grain_cells.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "coupling/base/stop.hpp"

namespace standoff::particles {

namespace {

/// Spreads the lowest 21 bits three places apart.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1FFFFF;
  v = (v | v << 32) & 0x1F00000000FFFFull;
  v = (v | v << 16) & 0x1F0000FF0000FFull;
  v = (v | v << 8) & 0x100F00F00F00F00Full;
  v = (v | v << 4) & 0x10C30C30C30C30C3ull;
  return (v | v << 2) & 0x1249249249249249ull;
}

std::uint64_t morton(CellIndex c) {
  return spread(static_cast<std::uint64_t>(c.x)) | spread(static_cast<std::uint64_t>(c.y)) << 1 |
         spread(static_cast<std::uint64_t>(c.z)) << 2;
}

void bounds(std::span<const Vec3> points, Vec3& lower, Vec3& upper) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  lower = {infinity, infinity, infinity}, upper = -lower;
  double check = 0.0;  // NaN and infinity survive a sum, not a minimum
  for (const Vec3& p : points) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    check += 0.0 * (p.x + p.y + p.z);
  }
  if (check != 0.0)
    throw Stop(ExitCode::guard,
               "sand: the position of a grain is not a finite number. The step was too large or a force is wrong; "
               "look at the first time the energy balance breaks.");
}

int whole_cells(double length, double edge) {
  return static_cast<int>(std::min(length / edge, 1e9));
}

CellsAround make_cells_around(unsigned code) {
  CellsAround around;
  const CellIndex at = GrainCells::cell_of(code);
  for (int z = at.z - 1; z <= at.z + 1; ++z)
    for (int y = at.y - 1; y <= at.y + 1; ++y)
      for (int x = at.x - 1; x <= at.x + 1; ++x) {
        const auto place = static_cast<unsigned>(((z + 4) / 4 * 3 + (y + 4) / 4) * 3 + (x + 4) / 4);
        std::size_t p = 0;
        while (p < around.count && around.parts[p].place != place) ++p;
        if (p == around.count) around.parts[around.count++].place = place;
        around.parts[p].cells |= 1ull << GrainCells::code_of(x & 3, y & 3, z & 3);
      }
  return around;
}

}  // namespace

const CellsAround& cells_around(unsigned code) {
  static const std::array<CellsAround, 64> table = [] {
    std::array<CellsAround, 64> all;
    for (unsigned c = 0; c < 64; ++c) all[c] = make_cells_around(c);
    return all;
  }();
  return table[code];
}

void GrainCells::build(std::span<const Vec3> points, double cutoff, const Vec3* periodic_box) {
  choose_grid(points, cutoff, periodic_box);
  sort(points);
}

void GrainCells::choose_grid(std::span<const Vec3> points, double cutoff, const Vec3* periodic_box) {
  periodic_ = periodic_box != nullptr, whole_ = false;
  Vec3 upper;
  bounds(points, lower_, upper);
  if (periodic_) {
    box_ = *periodic_box, lower_ = {0.0, 0.0, box_.z > 0.0 ? 0.0 : lower_.z};
    const double most = 64.0 * (8.0 * static_cast<double>(points.size()) + 65536.0);  // a scene may be nearly empty
    const auto along = [&](double length) { return std::min(std::max(1, whole_cells(length, cutoff)), 1 << 20); };
    const double height = points.empty() ? 0.0 : upper.z - lower_.z;
    for (;; cutoff *= 2.0) {
      cells_ = {along(box_.x), along(box_.y), box_.z > 0.0 ? along(box_.z) : along(height) + 1};
      whole_ = box_.z == 0.0 && std::min(cells_.x, cells_.y) >= 12;  // a scene; a packed cell has too few
      if (whole_) cells_ = {cells_.x / 4 * 4, cells_.y / 4 * 4, (cells_.z + 3) / 4 * 4};
      if (1.0 * cells_.x * cells_.y * cells_.z <= most) break;
    }
    per_edge_ = {cells_.x / box_.x, cells_.y / box_.y, box_.z > 0.0 ? cells_.z / box_.z : 1.0 / cutoff};
    edge_ = 1.0 / std::max({per_edge_.x, per_edge_.y, per_edge_.z});
  } else {
    const double most = 8.0 * static_cast<double>(points.size()) + 65536.0;
    const Vec3 extent = points.empty() ? Vec3{} : upper - lower_;
    const auto bricks_along = [](double length, double edge) { return std::floor(length / (4.0 * edge)) + 1.0; };
    edge_ = cutoff;
    while (bricks_along(extent.x, edge_) * bricks_along(extent.y, edge_) * bricks_along(extent.z, edge_) > most)
      edge_ *= 2.0;
    const auto along = [&](double length) { return 4 * static_cast<int>(bricks_along(length, edge_)); };
    cells_ = {along(extent.x), along(extent.y), along(extent.z)};
    per_edge_ = {1.0 / edge_, 1.0 / edge_, 1.0 / edge_};
  }
  grid_ = {(cells_.x + 3) / 4, (cells_.y + 3) / 4, (cells_.z + 3) / 4};
}

CellIndex GrainCells::cell_at(const Vec3& p) const {
  if (periodic_) {
    const auto along = [](double x, double length, double per_edge, int n) {
      const double inside = length > 0.0 ? x - length * std::floor(x / length) : x;
      return std::clamp(static_cast<int>(inside * per_edge), 0, n - 1);
    };
    return {along(p.x, box_.x, per_edge_.x, cells_.x), along(p.y, box_.y, per_edge_.y, cells_.y),
            along(p.z - lower_.z, box_.z, per_edge_.z, cells_.z)};
  }
  const auto along = [](double x, double per_edge, int n) {
    return std::clamp(static_cast<int>(x * per_edge), 0, n - 1);
  };
  return {along(p.x - lower_.x, per_edge_.x, cells_.x), along(p.y - lower_.y, per_edge_.y, cells_.y),
          along(p.z - lower_.z, per_edge_.z, cells_.z)};
}

void GrainCells::sort(std::span<const Vec3> points) {
  const std::size_t count = points.size();
  const std::size_t slots =
      static_cast<std::size_t>(grid_.x) * static_cast<std::size_t>(grid_.y) * static_cast<std::size_t>(grid_.z);
  brick_at_.assign(slots, -1);
  bricks_.clear();
  order_.resize(count);
  std::vector<std::uint32_t> point_slot(count);
  std::vector<std::uint8_t> point_code(count);
  for (std::size_t i = 0; i < count; ++i) {
    const CellIndex c = cell_at(points[i]);
    const CellIndex b = {c.x >> 2, c.y >> 2, c.z >> 2};
    point_code[i] = static_cast<std::uint8_t>(code_of(c.x, c.y, c.z));
    point_slot[i] = static_cast<std::uint32_t>(slot(b));
    if (brick_at_[point_slot[i]] < 0) {
      brick_at_[point_slot[i]] = 0;
      bricks_.push_back({b, morton(b)});
    }
  }
  std::sort(bricks_.begin(), bricks_.end(), [](const Brick& a, const Brick& b) { return a.morton < b.morton; });
  for (std::size_t b = 0; b < bricks_.size(); ++b) brick_at_[slot(bricks_[b].at)] = static_cast<std::int32_t>(b);

  // Counting sort by (brick, code); first_ counts, becomes the ends of the cells, and walking backwards turns ends into
  // starts: stable, so points of one cell keep the order they came in.
  first_.assign(bricks_.size() * 64 + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    point_slot[i] = static_cast<std::uint32_t>(brick_at_[point_slot[i]]) * 64 + point_code[i];
    ++first_[point_slot[i]];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  for (std::size_t i = count; i-- > 0;) order_[--first_[point_slot[i]]] = static_cast<std::uint32_t>(i);
  occupied_.assign(bricks_.size(), 0);
  for (std::size_t b = 0; b < bricks_.size(); ++b)
    for (unsigned code = 0; code < 64; ++code)
      if (first(b, code) != first(b, code + 1)) occupied_[b] |= 1ull << code;
}

int GrainCells::find_brick(CellIndex b) const {
  if (whole_) b.x = (b.x + grid_.x) % grid_.x, b.y = (b.y + grid_.y) % grid_.y;
  if (b.x < 0 || b.y < 0 || b.z < 0 || b.x >= grid_.x || b.y >= grid_.y || b.z >= grid_.z) return -1;
  return brick_at_[slot(b)];
}

std::array<std::int32_t, 27> GrainCells::bricks_around(std::size_t brick) const {
  std::array<std::int32_t, 27> around{};
  const CellIndex at = bricks_[brick].at;
  for (int place = 0; place < 27; ++place)
    around[static_cast<std::size_t>(place)] =
        find_brick({at.x + place % 3 - 1, at.y + place / 3 % 3 - 1, at.z + place / 9 - 1});
  return around;
}

int GrainCells::find(CellIndex c, unsigned& code) const {
  if (periodic_) {
    const auto wrap = [](int i, int n) { return i < 0 ? i + n : i >= n ? i - n : i; };
    c = {wrap(c.x, cells_.x), wrap(c.y, cells_.y), box_.z > 0.0 ? wrap(c.z, cells_.z) : c.z};
  }
  code = code_of(c.x, c.y, c.z);
  // An arithmetic shift keeps -1 at -1, which find_brick refuses.
  return find_brick({c.x >> 2, c.y >> 2, c.z >> 2});
}

}  // namespace standoff::particles
