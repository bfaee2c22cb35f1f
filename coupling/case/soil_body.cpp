#include "coupling/case/soil_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standoff {
namespace {

constexpr double unit_ball = 4.0 / 3.0 * std::numbers::pi;

double cube(double a) {
  return a * a * a;
}

Vec3 half_size_of(const SoilSpec& soil) {
  switch (soil.shape) {
    case SoilShape::box:
      return soil.size * 0.5;
    case SoilShape::cylinder:
      return {soil.outer_radius, soil.outer_radius, 0.5 * soil.height};
    default:
      return {soil.outer_radius, soil.outer_radius, soil.outer_radius};
  }
}

/// Scales the components x and y to a length of at most `most`.
void shorten(double& x, double& y, double most) {
  if (const double length = std::hypot(x, y); length > most) x *= most / length, y *= most / length;
}

}  // namespace

SoilSpec without_cut_sides(SoilSpec soil, const Vec3& period) {
  if (soil.shape != SoilShape::box) return soil;
  const auto spans = [](double size, double length) { return length > 0.0 && size >= length * (1.0 - 1e-9); };
  if (spans(soil.size.x, period.x)) soil.size.x = 4.0 * period.x;  // the sides are out of reach
  if (spans(soil.size.y, period.y)) soil.size.y = 4.0 * period.y;
  return soil;
}

SoilBody::SoilBody(const SoilSpec& soil, const Vec3& charge_centre)
    : shape_(soil.shape),
      centre_(soil.shape == SoilShape::shell ? charge_centre : soil.centre),
      cavity_(charge_centre),
      half_(half_size_of(soil)),
      cavity_radius_(soil.inner_radius) {}

double SoilBody::volume() const {
  const double cavity = unit_ball * cube(cavity_radius_);
  if (shape_ == SoilShape::box) return 8.0 * half_.x * half_.y * half_.z - cavity;
  if (shape_ == SoilShape::cylinder) return 2.0 * std::numbers::pi * half_.x * half_.x * half_.z - cavity;
  return unit_ball * (cube(half_.x) - cube(cavity_radius_));
}

double SoilBody::beyond_outside(const Vec3& place) const {
  const Vec3 p = place - centre_;
  if (shape_ == SoilShape::box)
    return std::max({std::abs(p.x) - half_.x, std::abs(p.y) - half_.y, std::abs(p.z) - half_.z});
  if (shape_ == SoilShape::cylinder) return std::max(std::hypot(p.x, p.y) - half_.x, std::abs(p.z) - half_.z);
  return norm(p) - half_.x;
}

double SoilBody::beyond(const Vec3& place) const {
  const double outside = beyond_outside(place);
  return cavity_radius_ > 0.0 ? std::max(cavity_radius_ - norm(place - cavity_), outside) : outside;
}

Vec3 SoilBody::held(const Vec3& place, double play) const {
  Vec3 p = place - centre_;
  if (beyond_outside(place) > play) {
    const Vec3 most = half_ + Vec3{play, play, play};
    if (shape_ == SoilShape::box) {
      p.x = std::clamp(p.x, -most.x, most.x), p.y = std::clamp(p.y, -most.y, most.y);
      p.z = std::clamp(p.z, -most.z, most.z);
    } else if (shape_ == SoilShape::cylinder) {
      shorten(p.x, p.y, most.x);
      p.z = std::clamp(p.z, -most.z, most.z);
    } else {
      p *= most.x / norm(p);
    }
  }
  const Vec3 held = beyond_outside(place) > play ? centre_ + p : place, from = held - cavity_;
  const double r = norm(from), least = cavity_radius_ - play;
  return r < least && r > 0.0 ? cavity_ + (least / r) * from : held;
}

}  // namespace standoff
