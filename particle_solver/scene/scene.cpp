#include "particle_solver/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "particle_solver/packing/charge.hpp"
#include "particle_solver/packing/sand_body.hpp"
#include "particle_solver/scene/ambient_air.hpp"
#include "particle_solver/step/detonate.hpp"
#include "particle_solver/step/grain_rotation.hpp"

namespace standoff::particles {
namespace {

SheetOptions sheet_options(const CaseSpec& spec) {
  SheetOptions options;
  options.quarter = spec.run.quarter_symmetry;
  options.recedes = spec.effect("surface_recession");
  if (spec.plate.surround == "rigid") options.surround_half_size = 0.5 * spec.plate.surround_size;
  return options;
}

}  // namespace

Scene build_scene(const CaseSpec& spec, const SurfaceMesh& mesh, int threads) {
  Scene scene(SurfaceSheet(mesh, sheet_options(spec)));
  scene.centre = {0.0, 0.0, spec.run.stand_off};
  const bool quarter = spec.run.quarter_symmetry;
  scene.has_gas = spec.charge.present;
  scene.has_sand = spec.soil.kind != SoilKind::none;
  if (scene.has_gas) {
    scene.gas = build_charge(spec.charge, scene.centre, spec.copies(), spec.run.seed);
    if (!spec.effect("detonation_timing")) detonate(scene.gas, std::numeric_limits<double>::infinity());
  }
  scene.has_air = spec.effect("air");
  if (scene.has_air) scene.air = build_air(spec);
  if (scene.has_sand) {
    const DomainSpec& domain = spec.domain;
    SandBody body = fill_body(spec.soil, {.centre = scene.centre,
                                          .quarter = quarter,
                                          .seed = spec.run.seed,
                                          .threads = threads,
                                          .sides = periodic_sides(domain.repeats(), domain.lower, domain.upper)});
    scene.sand = std::move(body.grains);
    scene.sand_cell_size = body.cell_size;
    scene.sand_residual_overlap = body.residual_overlap;
    SandPairsOptions law;
    law.law = body.law;
    law.mirrors.on = quarter;
    if (domain.repeats()) law.periodic_box = domain.period();
    law.threads = threads;
    law.turning = spec.effect("grain_rotation");
    if (law.turning) let_grains_turn(scene.sand);
    scene.sand_law = law;
  }
  scene.charge_particles = static_cast<long>(scene.gas.size());
  scene.sand_particles = static_cast<long>(scene.sand.size());
  return scene;
}

double window_limit(const CaseSpec& spec, const Scene& scene) {
  double radius = std::numeric_limits<double>::infinity();
  if (scene.has_gas) radius = std::min(radius, scene.gas.radius);
  if (scene.has_sand) radius = std::min(radius, scene.sand.radius);
  if (!std::isfinite(radius)) return spec.run.until;
  // Gurney's estimate of the outward momentum: all energy kinetic, the gas with a linear velocity profile
  // [Gurney 1943, BRL 405]: v = sqrt(2 E / (M + 3/5 C)), momentum M v + 3/4 C v.
  const double charge = spec.charge.present ? spec.charge.mass : 0.0;
  const double energy =
      spec.charge.present ? charge * spec.charge.explosive.energy / spec.charge.explosive.density : 0.0;
  const double sand = scene.has_sand ? scene.sand.mass * static_cast<double>(scene.sand.size()) * spec.copies() : 0.0;
  const double speed = std::sqrt(2.0 * energy / std::max(sand + 0.6 * charge, 1e-12));
  const double momentum = (sand + 0.75 * charge) * speed;
  double area = spec.charge.length > 0.0  // a cylinder pushes on its casing
                    ? 2.0 * std::numbers::pi * spec.charge.radius * spec.charge.length
                    : 4.0 * std::numbers::pi * spec.run.stand_off * spec.run.stand_off;
  if (const Vec3 period = spec.domain.period(); period.x > 0.0)  // a layer of charges sends half to either side
    area = std::min(area, 2.0 * period.x * period.y);
  const double specific = momentum / area;
  const double wall_speed = specific / (spec.plate.material.density * spec.plate.size.z);
  return wall_speed > 0.0 ? radius / wall_speed : spec.run.until;
}

}  // namespace standoff::particles
