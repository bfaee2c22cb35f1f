#include "coupling/case/periodic_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "coupling/case/scene_findings.hpp"
#include "coupling/case/soil_body.hpp"

namespace standoff {
namespace {

// A particle meets the nearest image of a partner alone. Grains are searched in cells of a diameter and a skin, up to
// 1.8 diameters, three to a period at least; in air nothing flies farther than a cell a step, and half a period must be
// more than that from either side.
constexpr double diameters_a_period = 6.0, air_cells_a_period = 4.0;

double diameter_of_spheres(double volume, double count) {
  return count > 0.0 ? std::cbrt(6.0 * volume / (std::numbers::pi * count)) : 0.0;
}

class PeriodicCheck : private SceneFindings {
 public:
  using SceneFindings::SceneFindings;

  void run() {
    if (spec_.plate.is_pipe())
      return finding(true, {"domain.boundaries", "plate.model"}, "a pipe stands free: a scene with one does not repeat",
                     "boundaries = \"open\"");
    finding(spec_.run.quarter_symmetry, {"domain.boundaries", "run.symmetry"},
            "a scene that repeats has no mirror planes, but symmetry = \"quarter\"",
            "symmetry = \"none\" in [run] computes a whole period; boundaries = \"reflecting\" mirrors at every face");
    for (const char* path : {"domain.size", "domain.lower", "domain.upper"})
      if (settings_.is_wrong(path)) return;
    if (settings_.has("domain.lower") && settings_.find("domain.lower")->rank == rank::derived)
      return finding(true, {"domain.boundaries"}, "the scene is to repeat, but after which width is not stated",
                     "state size in [domain]: its x and y are the distances from image to image");
    room_between_images();
    images_of_the_plate();
  }

 private:
  static Paths with_domain(Paths paths) {
    paths.insert(paths.end(), {"domain.size", "domain.lower", "domain.upper"});
    return paths;
  }

  double gas_sphere() const {
    if (!spec_.charge.present || !usable({"charge.mass", "charge.particles", "charge.explosive.density"})) return 0.0;
    const ChargeSpec& c = spec_.charge;
    return diameter_of_spheres(c.explosive.fill * c.mass / c.explosive.density, static_cast<double>(c.particles));
  }
  double grain() const {
    if (spec_.soil.kind == SoilKind::none || !usable({"soil.particles", "soil.packing"})) return 0.0;
    const SoilBody body(spec_.soil, {0.0, 0.0, spec_.run.stand_off});
    return (1.0 + spec_.soil.radius_spread) *
           diameter_of_spheres(spec_.soil.packing * body.volume(), static_cast<double>(spec_.soil.particles));
  }
  double air_cell() const {
    if (!spec_.air.on || !usable({"air.particles"})) return 0.0;
    return std::cbrt(particles_an_air_cell * nominal_air_volume / static_cast<double>(spec_.air.particles));
  }

  void room_between_images() {
    const Vec3 period = spec_.domain.period();
    const double width = std::min(period.x, period.y);
    const auto room = [&](double needed, const char* what, double size, const char* more) {
      finding(width < needed, with_domain({more}),
              fmt::format("the scene repeats after {}, too soon for {} of {}: at least {} are needed", mm(width), what,
                          mm(size), mm(needed)),
              fmt::format("make the domain wider, or raise {}", more));
    };
    room(diameters_a_period * gas_sphere(), "gas spheres", gas_sphere(), "charge.particles");
    room(diameters_a_period * grain(), "grains", grain(), "soil.particles");
    room(air_cells_a_period * air_cell(), "cells of air", air_cell(), "air.particles");
  }

  /// A particle at a face does not see the rim of the image behind it: there must be none, or nothing within reach.
  void images_of_the_plate() {
    if (!usable({"plate.size", "plate.surround_size"})) return;
    const Vec3 &low = spec_.domain.lower, &high = spec_.domain.upper;
    if (!near_its_image(spec_.plate.size.x, low.x, high.x, "x")) near_its_image(spec_.plate.size.y, low.y, high.y, "y");
  }
  bool near_its_image(double size, double low, double high, const char* axis) {
    const bool cover = spec_.plate.surround == "rigid";
    const double reach = std::max(gas_sphere(), grain()), half = 0.5 * (cover ? spec_.plate.surround_size : size);
    const double room = std::min(high, -low) - half, widest = std::max(high, -low) - half;
    const bool endless = widest <= 1e-9 * half, wrong = !endless && room < reach;
    finding(wrong, with_domain({cover ? "plate.surround_size" : "plate.size"}),
            fmt::format("{} ends {} from a face of the domain in {}, nearer to its own image than a particle of {} can "
                        "tell",
                        cover ? "the wall around the plate" : "the plate", mm(std::max(room, 0.0)), axis, mm(reach)),
            "let it reach the faces on both sides, or leave room at both");
    return wrong;
  }
};

}  // namespace

void check_periodic_scene(const CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics) {
  if (spec.domain.repeats()) PeriodicCheck(spec, settings, diagnostics).run();
}

}  // namespace standoff
