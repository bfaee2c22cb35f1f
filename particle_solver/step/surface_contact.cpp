#include "particle_solver/step/surface_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <omp.h>

namespace standoff::particles {

SurfaceContactOptions surface_contact_options(const CaseSpec& spec, double stiffness, int threads) {
  SurfaceContactOptions options;
  options.spring = spec.contact.surface_law_is_soil;
  options.impact = {spec.contact.surface_restitution, spec.contact.surface_friction};
  options.soil = {stiffness, spec.soil.damping, spec.contact.surface_friction};
  options.threads = threads;
  options.turning = spec.effect("grain_rotation") && spec.contact.surface_friction > 0.0;
  return options;
}

SurfaceContact::SurfaceContact(const SurfaceContactOptions& options)
    : options_(options), found_(static_cast<std::size_t>(std::max(1, options.threads))) {
  if (options.spring)
    resolve_ = options.turning ? &SurfaceContact::resolve<true, true> : &SurfaceContact::resolve<true, false>;
  else
    resolve_ = options.turning ? &SurfaceContact::resolve<false, true> : &SurfaceContact::resolve<false, false>;
}

/// A grain as the sheet meets it.
template <bool Turning>
auto sphere_of(SandState& sand, std::size_t i, double distance) {
  if constexpr (Turning)
    return TurningSphere(sand.mass_of(i), sand.radius_of(i), distance, sand.velocity[i], sand.spin[i]);
  else
    return SmoothSphere{sand.mass_of(i), sand.velocity[i]};
}

template <bool EqualRadii>
void SurfaceContact::find(const SandState& sand, const SurfaceSheet& sheet, double t) {
  const double top = sheet.highest(t);
  const auto grains = static_cast<std::ptrdiff_t>(sand.size());
  const auto parts = static_cast<std::ptrdiff_t>(found_.size());
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(parts)) if (parts > 1)
  for (std::ptrdiff_t part = 0; part < parts; ++part) {
    std::vector<Touch>& found = found_[static_cast<std::size_t>(part)];
    found.clear();
    for (std::ptrdiff_t i = grains * part / parts; i < grains * (part + 1) / parts; ++i) {
      const auto grain = static_cast<std::size_t>(i);
      const double radius = EqualRadii ? sand.radius : sand.grain_radius[grain];
      if (sand.position[grain].z > top + radius) continue;
      const SheetPoint where = sheet.closest(sand.position[grain], radius, t);
      if (where.face >= 0) found.push_back({static_cast<std::uint32_t>(grain), where, 0.0});
    }
  }
}

template <bool Turning>
void SurfaceContact::impact(const Touch& touch, SandState& sand, SurfaceSheet& sheet, double t,
                            SurfaceContactCounts& counts) const {
  const std::size_t i = touch.grain;
  const double mass = sand.mass_of(i), incoming = -mass * sand.velocity[i].z;
  const Impact hit = sheet.collide(touch.where, sphere_of<Turning>(sand, i, touch.where.gap),
                                   options_.impact.restitution, options_.impact.friction, t);
  if (hit.impulse == Vec3{}) return;
  ++counts.hits;
  counts.loss += hit.loss;
  if (touch.where.rigid) return;
  counts.plate_impulse -= hit.impulse.z, counts.plate_work += hit.work;
  if (std::isnan(sand.plate_rebound[i])) counts.plate_incoming += incoming;
  sand.plate_rebound[i] = mass * sand.velocity[i].z;
}

template <bool Turning>
void SurfaceContact::spring(Touch& touch, SandState& sand, SurfaceSheet& sheet, double h, double t,
                            SurfaceContactCounts& counts) const {
  const std::size_t i = touch.grain;
  const double mass = sand.mass_of(i), incoming = -mass * sand.velocity[i].z;
  const double overlap = sand.radius_of(i) - touch.where.gap;
  const Vec3 normal = touch.where.normal, wall = sheet.velocity_at(touch.where);
  auto sphere = sphere_of<Turning>(sand, i, touch.where.gap);
  const Vec3 slip = sphere.surface_velocity(normal) - wall;
  const Vec3 force = surface_spring_force(options_.soil, overlap, slip, normal, mass, sphere.mass_across(), h);
  const double elastic_force = options_.soil.stiffness * overlap;
  touch.stored = 0.5 * elastic_force * overlap;
  counts.elastic_energy += touch.stored;
  if (force == Vec3{}) return;
  const Impact hit = sheet.push(touch.where, force * -h, t);
  sphere.push(force, h, normal);
  const Vec3 mean_slip = (slip + sphere.surface_velocity(normal) - sheet.velocity_at(touch.where)) * 0.5;
  ++counts.hits;
  counts.loss -= dot(force - normal * elastic_force, mean_slip) * h;  // dashpot and friction
  if (touch.where.rigid) return;
  counts.plate_impulse -= hit.impulse.z, counts.plate_work += hit.work;
  if (std::isnan(sand.plate_rebound[i])) counts.plate_incoming += incoming;
  sand.plate_rebound[i] = mass * sand.velocity[i].z;
}

template <bool Spring, bool Turning>
SurfaceContactCounts SurfaceContact::resolve(SandState& sand, SurfaceSheet& sheet, double h, double t) {
  SurfaceContactCounts counts;
  for (std::vector<Touch>& part : found_)
    for (Touch& touch : part) {
      const double radius = sand.radius_of(touch.grain);
      counts.penetration_over_radius = std::max(counts.penetration_over_radius, 1.0 - touch.where.gap / radius);
      if constexpr (Spring)
        spring<Turning>(touch, sand, sheet, h, t, counts);
      else
        impact<Turning>(touch, sand, sheet, t, counts);
    }
  return counts;
}

double SurfaceContact::stored_energy(const SandState& sand, const SurfaceSheet& sheet) {
  if (!options_.spring) return 0.0;
  if (sand.grain_radius.empty())
    find<true>(sand, sheet, 0.0);
  else
    find<false>(sand, sheet, 0.0);
  double sum = 0.0;
  for (const std::vector<Touch>& part : found_)
    for (const Touch& touch : part) {
      const double overlap = sand.radius_of(touch.grain) - touch.where.gap;
      sum += 0.5 * options_.soil.stiffness * overlap * overlap;
    }
  return sum;
}

double SurfaceContact::stored_in(const std::vector<std::uint32_t>& out) const {
  double sum = 0.0;
  if (!out.empty())
    for (const std::vector<Touch>& part : found_)
      for (const Touch& touch : part)
        if (touch.stored > 0.0 && std::binary_search(out.begin(), out.end(), touch.grain)) sum += touch.stored;
  return sum;
}

SurfaceContactCounts SurfaceContact::run(SandState& sand, SurfaceSheet& sheet, double h, double sheet_time) {
  if (sand.grain_radius.empty())
    find<true>(sand, sheet, sheet_time);
  else
    find<false>(sand, sheet, sheet_time);
  const bool any = std::any_of(found_.begin(), found_.end(), [](const auto& part) { return !part.empty(); });
  if (any && sand.plate_rebound.size() != sand.size())
    sand.plate_rebound.resize(sand.size(), std::numeric_limits<double>::quiet_NaN());
  return (this->*resolve_)(sand, sheet, h, sheet_time);
}

}  // namespace standoff::particles
