#include "particle_solver/step/air_drift.hpp"

#include <algorithm>
#include <cmath>

#include "particle_solver/kernels/gas_impact_time.hpp"
#include "particle_solver/kernels/gas_pair_impulse.hpp"
#include "particle_solver/step/wrap.hpp"

namespace standoff::particles {
namespace {

// A particle caught between a grain and the plate may bounce many times; what is left of its step is then dropped, and
// it flies on from where it is in the next one.
constexpr int most_bounces = 200;

/// What planes make of a finished flight; returns what they take of the velocity.
Vec3 fold(const ReflectingPlanes& planes, Vec3& position, Vec3& velocity) {
  const Vec3 before = velocity;
  const auto axis = [](double& x, double& v, double low, double high) {
    if (x < low)
      x = 2.0 * low - x, v = -v;
    else if (x > high)
      x = 2.0 * high - x, v = -v;
  };
  axis(position.x, velocity.x, planes.lower.x, planes.upper.x);
  axis(position.y, velocity.y, planes.lower.y, planes.upper.y);
  axis(position.z, velocity.z, planes.lower.z, planes.upper.z);
  return before - velocity;
}

}  // namespace

struct AirDrift::Hit {
  double time = no_impact;
  enum { none, plane, grain, sheet } what = none;
  unsigned axis = 0;
  std::uint32_t grain_index = 0;
  SheetPoint where;
};

void AirDrift::sort_grains(const SandState& sand, double radius, double dt) {
  double fastest = 0.0, largest = 0.0;
  middle_.resize(sand.size());
  for (std::size_t k = 0; k < sand.size(); ++k) {
    middle_[k] = sand.position[k] + sand.velocity[k] * (0.5 * dt);
    fastest = std::max(fastest, squared_norm(sand.velocity[k]));
    largest = std::max(largest, sand.radius_of(k));
  }
  // Room for grains that air pushes aside within the step: a grain outweighs many of them.
  grain_reach_ = radius + largest + 0.55 * dt * std::sqrt(fastest);
  grains_.shape(sand.size(), grain_reach_, sides_.period);
  grains_.sort(middle_);
}

template <bool Periodic>
void AirDrift::list_those_near(const Air& air, const SandState* sand, const SurfaceSheet* sheet, double dt) {
  const GasState& gas = air.particles;
  if (sand != nullptr) {
    double fastest = 0.0;
    for (const Vec3& v : gas.velocity) fastest = std::max(fastest, squared_norm(v));
    near_grains_.mark(middle_, grain_reach_ + 0.5 * dt * std::sqrt(fastest), sides_.period);
  }
  const double top = sheet != nullptr ? sheet->highest(dt) + gas.radius : 0.0;
  near_.resize(gas.size());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::size_t i = 0; i < gas.size(); ++i) {
    const Vec3 &x = gas.position[i], &v = gas.velocity[i];
    bool near = sheet != nullptr && x.z + std::min(0.0, v.z * dt) <= top;
    if (!near && sand != nullptr) near = near_grains_.near<Periodic>(x + v * (0.5 * dt));
    near_[i] = near ? 1 : 0;
  }
}

template <bool Periodic>
AirDrift::Hit AirDrift::earliest(const GasState& gas, std::size_t i, double from, double dt, const SandState* sand,
                                 const SurfaceSheet* sheet) const {
  Hit hit;
  const Vec3 &x = gas.position[i], &v = gas.velocity[i];
  double until = dt;
  if (sand != nullptr && sand->size() > 0) {
    const double half = 0.5 * (dt - from) * norm(v);
    const Vec3 middle = x + v * (0.5 * (from + dt));
    grains_.visit<Periodic>(middle, grain_reach_ + half, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t q = begin; q < end; ++q) {
        const std::uint32_t k = grains_.order()[q];
        const Vec3 gap = nearest_image<Periodic>(sand->position[k] - x, sides_.period);
        const double time = impact_time(gap, sand->velocity[k] - v, gas.radius + sand->radius_of(k), from, until);
        if (!(time < hit.time)) continue;
        hit.time = until = time, hit.what = Hit::grain, hit.grain_index = k;
      }
    });
  }
  if (planes_.on)
    if (const PlaneHit plane = first_plane(planes_, x, v, from, until); plane.time < hit.time)
      hit.time = until = plane.time, hit.what = Hit::plane, hit.axis = plane.axis;
  SheetPoint where;
  double time = no_impact;
  const auto first_hit = [&] {
    if constexpr (Periodic) return first_hit_on_the_way(sides_, *sheet, x, v, gas.radius, from, until, time, where);
    return sheet->first_hit(x, v, gas.radius, from, until, time, where);
  };
  if (sheet != nullptr && first_hit() && time < hit.time) hit = {time, Hit::sheet, 0, 0, where};
  return hit;
}

template <bool Periodic>
void AirDrift::fly(Air& air, std::size_t i, SandState* sand, SurfaceSheet* sheet, double dt, AirDriftCounts& counts) {
  GasState& gas = air.particles;
  Vec3 &x = gas.position[i], &v = gas.velocity[i];
  double from = 0.0;
  for (int bounce = 0; bounce < most_bounces; ++bounce) {
    const Hit hit = earliest<Periodic>(gas, i, from, dt, sand, sheet);
    if (hit.what == Hit::none) break;
    from = hit.time;
    const Vec3 old = v;
    double speed_of_other = 0.0;
    if (hit.what == Hit::plane) {
      const Vec3 change = change_at_plane(v, hit.axis);
      change_velocity(x, v, change, from);
      counts.mirror_impulse -= change * gas.mass;
      continue;
    }
    if (hit.what == Hit::grain) {
      const std::uint32_t k = hit.grain_index;
      const double inverse = 1.0 / gas.mass, inverse_grain = 1.0 / sand->mass_of(k);
      const Vec3 closing = sand->velocity[k] - v;
      const Vec3 gap = nearest_image<Periodic>(sand->position[k] - x, sides_.period);
      const Vec3 n = line_of_centres(gap + closing * from, closing);
      const double before = dot(closing, n);
      const double impulse = pair_impulse(reduced_mass(inverse, inverse_grain), before, -before);
      speed_of_other = norm(sand->velocity[k]);
      change_velocity(x, v, n * (-impulse * inverse), from);
      sand->velocity[k] += n * (impulse * inverse_grain);
      ++counts.sand_hits;
    } else {
      speed_of_other = norm(hit.where.velocity);
      const Impact impact = sheet->collide(hit.where, gas.mass, 1.0, 0.0, from, v);
      x -= (v - old) * from;
      ++counts.sheet_hits;
      if (!hit.where.rigid) {
        if (std::isnan(gas.plate_rebound[i])) counts.plate_incoming -= gas.mass * old.z;
        gas.plate_rebound[i] = gas.mass * v.z;
        counts.plate_impulse -= impact.impulse.z;
      }
    }
    if (speed_of_other > air.still_speed) gas.disturbed[i] = 1;
  }
  x += v * dt;
}

template <bool Periodic>
AirDriftCounts AirDrift::run_images(Air& air, SandState* sand, SurfaceSheet* sheet, double dt) {
  AirDriftCounts counts;
  GasState& gas = air.particles;
  if (gas.size() == 0) return counts;
  if (sand != nullptr) sort_grains(*sand, gas.radius, dt);
  list_those_near<Periodic>(air, sand, sheet, dt);
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::size_t i = 0; i < gas.size(); ++i)
    if (near_[i] == 0) gas.position[i] += gas.velocity[i] * dt;
  for (std::size_t i = 0; i < gas.size(); ++i)
    if (near_[i] != 0) fly<Periodic>(air, i, sand, sheet, dt, counts);
  if constexpr (Periodic) {
    for (Vec3& x : gas.position) x = image_inside(sides_, x);
  } else if (planes_.on) {
    for (std::size_t i = 0; i < gas.size(); ++i)
      counts.mirror_impulse += fold(planes_, gas.position[i], gas.velocity[i]) * gas.mass;
  }
  return counts;
}

AirDriftCounts AirDrift::run(Air& air, SandState* sand, SurfaceSheet* sheet, double dt) {
  return sides_.on() ? run_images<true>(air, sand, sheet, dt) : run_images<false>(air, sand, sheet, dt);
}

}  // namespace standoff::particles
