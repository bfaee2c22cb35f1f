#include "particle_solver/search/surface_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace standoff::particles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Angle-weighted normal of a quad at a corner: the sign of offset . (sum over the faces around a node) is the side a
/// position is on (Baerentzen, Aanaes, IEEE TVCG 11 (2005) 243, theorem 1).
Vec3 corner_normal(const std::array<Vec3, 4>& x, std::size_t corner) {
  const Vec3 a = x[(corner + 1) & 3] - x[corner], b = x[(corner + 3) & 3] - x[corner], n = cross(a, b);
  const double size = norm(n);
  return n * (std::atan2(size, dot(a, b)) / std::max(size, 1e-300));
}

std::size_t corner_of(unsigned border) {
  return border & 1u ? (border & 8u ? 0 : 1) : (border & 2u ? 2 : 3);
}

void add_with_images(Vec3& sum, const Vec3& n, bool mirror_x, bool mirror_y) {
  sum += n;
  if (mirror_x) sum += Vec3{-n.x, n.y, n.z};
  if (mirror_y) sum += Vec3{n.x, -n.y, n.z};
  if (mirror_x && mirror_y) sum += Vec3{-n.x, -n.y, n.z};
}

}  // namespace

SurfaceSearch::SurfaceSearch(const SurfaceMesh& mesh, SurfaceTopology topology)
    : quads_(mesh.quads), topology_(std::move(topology)), reference_(mesh.position) {
  double shortest = infinity, area = 0.0;
  Vec3 sum;
  std::size_t counted = 0;
  for (const auto& quad : quads_) {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = reference_[at(quad[i])];
    for (std::size_t i = 0; i < 4; ++i) shortest = std::min(shortest, norm(x[(i + 1) & 3] - x[i]));
    if (std::isinf(mesh.node_mass[at(quad[0])])) continue;  // long ring faces say nothing about a good bin
    const Vec3 facing = 0.5 * cross(x[2] - x[0], x[3] - x[1]);
    area += norm(facing), sum += facing;
    ++counted;
  }
  if (std::abs(sum.z) < std::max(std::abs(sum.x), std::abs(sum.y))) {
    const bool along_x = std::abs(sum.x) >= std::abs(sum.y);
    across_ = along_x ? &Vec3::x : &Vec3::y, first_axis_ = along_x ? &Vec3::y : &Vec3::x, second_axis_ = &Vec3::z;
  }
  smallest_edge_ = shortest;
  bin_size_ = 0.5 * std::sqrt(area / static_cast<double>(counted));
  widen_ = 0.5 * bin_size_;
  box_.resize(quads_.size()), hull_.resize(quads_.size());
  rebuild(mesh.position);
}

void SurfaceSearch::rebuild(std::span<const Vec3> position) {
  reference_.assign(position.begin(), position.end());
  for (std::size_t f = 0; f < quads_.size(); ++f) {
    Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    std::array<Vec3, 4> corner;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& x = corner[i] = reference_[at(quads_[f][i])];
      box.lower = {std::min(box.lower.x, x.x), std::min(box.lower.y, x.y), std::min(box.lower.z, x.z)};
      box.upper = {std::max(box.upper.x, x.x), std::max(box.upper.y, x.y), std::max(box.upper.z, x.z)};
    }
    box_[f] = box, hull_[f] = hull(corner);
  }
  lay_bins();
  fill_bins();
}

SurfaceSearch::Hull SurfaceSearch::hull(const std::array<Vec3, 4>& corner) {
  const BilinearQuad quad = bilinear_quad(corner);
  Hull hull{quad.centre, quad.along_xi / std::max(norm(quad.along_xi), 1e-300), {}, quad.normal(0.0, 0.0), 0, 0, 0};
  hull.axis2 = cross(hull.normal, hull.axis1);
  for (const Vec3& x : corner) {  // the patch lies in the convex hull of its corners
    const Vec3 d = x - hull.centre;
    hull.half1 = std::max(hull.half1, std::abs(dot(d, hull.axis1)));
    hull.half2 = std::max(hull.half2, std::abs(dot(d, hull.axis2)));
    hull.half_normal = std::max(hull.half_normal, std::abs(dot(d, hull.normal)));
  }
  return hull;
}

void SurfaceSearch::lay_bins() {
  double x1 = -infinity, y1 = -infinity;
  x0_ = y0_ = infinity;
  for (const Box& box : box_) {
    x0_ = std::min(x0_, box.lower.*first_axis_), y0_ = std::min(y0_, box.lower.*second_axis_);
    x1 = std::max(x1, box.upper.*first_axis_), y1 = std::max(y1, box.upper.*second_axis_);
  }
  x0_ -= widen_, y0_ -= widen_, x1 += widen_, y1 += widen_;
  while ((x1 - x0_) * (y1 - y0_) > 4e6 * bin_size_ * bin_size_) bin_size_ *= 2.0;
  inverse_bin_ = 1.0 / bin_size_;
  nx_ = static_cast<int>((x1 - x0_) / bin_size_) + 1, ny_ = static_cast<int>((y1 - y0_) / bin_size_) + 1;
}

void SurfaceSearch::fill_bins() {
  const std::size_t bins = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
  first_.assign(bins + 1, 0);
  bin_low_.assign(bins, infinity), bin_high_.assign(bins, -infinity);
  const auto each_bin = [&](const Box& box, auto&& visit) {
    const auto column = [&](double x) { return std::clamp(static_cast<int>((x - x0_) / bin_size_), 0, nx_ - 1); };
    const auto row = [&](double y) { return std::clamp(static_cast<int>((y - y0_) / bin_size_), 0, ny_ - 1); };
    const int i0 = column(box.lower.*first_axis_ - widen_), i1 = column(box.upper.*first_axis_ + widen_);
    const int j0 = row(box.lower.*second_axis_ - widen_), j1 = row(box.upper.*second_axis_ + widen_);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i)
        visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i));
  };
  for (const Box& box : box_)
    each_bin(box, [&](std::size_t b) {
      ++first_[b + 1];
      bin_low_[b] = std::min(bin_low_[b], box.lower.*across_);
      bin_high_[b] = std::max(bin_high_[b], box.upper.*across_);
    });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  faces_.resize(at(first_.back()));
  std::vector<std::int32_t> fill(first_.begin(), first_.end() - 1);
  for (std::size_t f = 0; f < box_.size(); ++f)
    each_bin(box_[f], [&](std::size_t b) { faces_[at(fill[b]++)] = static_cast<std::int32_t>(f); });
}

std::array<Vec3, 4> SurfaceSearch::corners(const SheetMotion& motion, std::int32_t face, double t) const {
  const auto& quad = quads_[at(face)];
  std::array<Vec3, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = motion.position[at(quad[i])] + motion.velocity[at(quad[i])] * t;
  return x;
}

SurfaceSearch::Range SurfaceSearch::bins_within(const Vec3& p, double widen) const {
  const double x = p.*first_axis_, y = p.*second_axis_, inverse = inverse_bin_;
  const double ax = (x - widen - x0_) * inverse, bx = (x + widen - x0_) * inverse;
  const double ay = (y - widen - y0_) * inverse, by = (y + widen - y0_) * inverse;
  if (!(bx >= 0.0 && by >= 0.0 && ax < nx_ && ay < ny_)) return {0, 0, 0, 0, true};
  return {static_cast<int>(std::max(ax, 0.0)), static_cast<int>(std::min(bx, nx_ - 1.0)),
          static_cast<int>(std::max(ay, 0.0)), static_cast<int>(std::min(by, ny_ - 1.0)), false};
}

void SurfaceSearch::search_bin(std::size_t bin, const SheetMotion& motion, const Vec3& position, double t, double slack,
                               SheetFoot& best, double& distance) const {
  const std::int32_t *begin = faces_.data() + first_[bin], *end = faces_.data() + first_[bin + 1];
  const auto try_face = [&](std::int32_t face) {
    const QuadFoot foot = quad_foot(corners(motion, face, t), position);
    // A tie, two faces at their common edge, goes to the lower face.
    const double limit = best.foot.squared_distance, tie = 1e-12 * limit;
    if (foot.squared_distance > limit + tie ||
        (foot.squared_distance >= limit - tie && best.face >= 0 && face > best.face))
      return;
    best.face = face, best.foot = foot;
    distance = std::sqrt(foot.squared_distance);
  };
  std::array<double, 16> kept;  // hull distances; the few bins with more faces look twice
  const auto hull_distance = [&](const std::int32_t* f) { return hull_[at(*f)].squared_distance(position); };
  const std::int32_t* nearest = begin;  // the face below the position first: it usually rules the others out
  double nearest_hull = infinity;
  for (const std::int32_t* f = begin; f != end; ++f) {
    const double d2 = hull_distance(f);
    if (const auto k = static_cast<std::size_t>(f - begin); k < kept.size()) kept[k] = d2;
    if (d2 < nearest_hull) nearest = f, nearest_hull = d2;
  }
  if (nearest_hull > (distance + slack) * (distance + slack)) return;
  if (*nearest != best.face) try_face(*nearest);
  for (const std::int32_t* f = begin; f != end; ++f) {
    if (f == nearest || *f == best.face) continue;
    const auto k = static_cast<std::size_t>(f - begin);
    const double open = (distance + slack) * (1.0 + 1e-9);
    if ((k < kept.size() ? kept[k] : hull_distance(f)) <= open * open) try_face(*f);
  }
}

SheetFoot SurfaceSearch::closest(const SheetMotion& motion, const Vec3& position, double reach, double t,
                                 double slack) const {
  SheetFoot best;
  best.foot.squared_distance = reach * reach;
  double distance = reach;
  const Range range = bins_within(position, std::max(0.0, reach + slack - widen_));
  if (range.empty) return best;
  for (int j = range.y0; j <= range.y1; ++j)
    for (int i = range.x0; i <= range.x1; ++i) {
      const std::size_t b = static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i);
      const double height = position.*across_;
      if (height - distance - slack > bin_high_[b] || height + distance + slack < bin_low_[b]) continue;
      search_bin(b, motion, position, t, slack, best, distance);
    }
  if (best.face < 0) return best;
  const std::array<Vec3, 4> x = corners(motion, best.face, t);
  const BilinearQuad quad = bilinear_quad(x);
  best.point = quad.point(best.foot.xi, best.foot.eta);
  best.normal = quad.normal(best.foot.xi, best.foot.eta);
  const Vec3 offset = position - best.point;
  best.gap = dot(offset, best.normal);
  if (best.foot.border == 0) return best;
  const Vec3 crease = crease_normal(motion, best, t);
  if (dot(offset, crease) > 0.0) {
    // Very near a seam the direction of the offset is mostly rounding; the normal of the face is as good there.
    best.gap = distance;
    if (distance > 1e-6 * smallest_edge_) best.normal = offset / distance;
    return best;
  }
  // Beside an open rim and behind it: past the sheet, not in contact with it.
  const double beside = distance * distance - best.gap * best.gap;
  if (on_open_rim(best) && beside > 1e-12 * smallest_edge_ * smallest_edge_) return {};
  best.gap = -distance;
  best.normal = crease / norm(crease);
  return best;
}

bool SurfaceSearch::on_open_rim(const SheetFoot& best) const {
  const auto& quad = quads_[at(best.face)];
  const unsigned border = best.foot.border;
  if ((border & 5u) && (border & 10u))
    return topology_.on_open_rim[at(topology_.weld[at(quad[corner_of(border)])])] != 0;
  std::size_t edge = 0;
  while (!(border >> edge & 1u)) ++edge;
  return topology_.neighbour[at(best.face)][edge] == open_rim;
}

Vec3 SurfaceSearch::crease_normal(const SheetMotion& motion, const SheetFoot& best, double t) const {
  const auto& quad = quads_[at(best.face)];
  const unsigned border = best.foot.border;
  const bool corner = (border & 5u) && (border & 10u);
  Vec3 sum;
  if (corner) {
    const std::int32_t node = topology_.weld[at(quad[corner_of(border)])];
    for (const std::int32_t face : topology_.faces_around(node))
      for (std::size_t k = 0; k < 4; ++k)
        if (topology_.weld[at(quads_[at(face)][k])] == node)
          add_with_images(sum, corner_normal(corners(motion, face, t), k), topology_.on_mirror_x[at(node)],
                          topology_.on_mirror_y[at(node)]);
    return sum;
  }
  std::size_t edge = 0;
  while (!(border >> edge & 1u)) ++edge;
  const std::int32_t across = topology_.neighbour[at(best.face)][edge];
  add_with_images(sum, best.normal, across == mirror_rim_x, across == mirror_rim_y);
  if (across < 0) return sum;
  const std::int32_t a = topology_.weld[at(quad[edge])], b = topology_.weld[at(quad[(edge + 1) & 3])];
  const auto& other = quads_[at(across)];
  const double along = edge == 0   ? best.foot.xi
                       : edge == 1 ? best.foot.eta
                       : edge == 2 ? -best.foot.xi
                                   : -best.foot.eta;
  for (std::size_t e = 0; e < 4; ++e) {
    const std::int32_t c = topology_.weld[at(other[e])], d = topology_.weld[at(other[(e + 1) & 3])];
    if (!((c == a && d == b) || (c == b && d == a))) continue;
    const double u = c == a ? along : -along;
    const double xi = e == 0   ? u
                      : e == 1 ? 1.0
                      : e == 2 ? -u
                               : -1.0,
                 eta = e == 0   ? -1.0
                       : e == 1 ? u
                       : e == 2 ? 1.0
                                : -u;
    return sum + bilinear_quad(corners(motion, across, t)).normal(xi, eta);
  }
  return sum;
}

}  // namespace standoff::particles
