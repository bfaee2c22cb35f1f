#include "coupling/case/checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "coupling/case/scene_findings.hpp"
#include "coupling/case/soil_body.hpp"

namespace standoff {
namespace {

std::string seconds(double time) {
  return readable_text(time, quantity::time);
}

class SceneCheck : private SceneFindings {
 public:
  using SceneFindings::SceneFindings;

  void run() {
    if (spec_.charge.present) charge(), detonator();
    if (spec_.soil.kind != SoilKind::none) sand(), sand_and_charge();
    stand_off();
    domain();
    times();
  }

 private:
  void charge() {
    const ChargeSpec& c = spec_.charge;
    const Paths size{"charge.radius", "charge.mass", "charge.explosive.density", "charge.explosive.fill"};
    if (!usable(size)) return;
    if (c.length > 0.0) return cylinder();
    const double sphere = 4.0 / 3.0 * std::numbers::pi * std::pow(c.radius, 3);
    const double fill = c.explosive.fill * c.mass / c.explosive.density / sphere;
    finding(fill > 0.74, {"charge.radius", "charge.mass", "charge.explosive.fill"},
            fmt::format("the gas spheres do not fit into the charge: they would fill {:.2f} of radius = {}", fill,
                        mm(c.radius)),
            fmt::format("spheres fill at most 0.74; {} kg at {} kg/m3 is a sphere of {}", c.mass, c.explosive.density,
                        mm(std::cbrt(0.75 * c.mass / c.explosive.density / std::numbers::pi))));
    const double mean = c.mass / sphere;
    if (fill <= 0.74 && mean > 1.01 * c.explosive.density)
      diagnostics_.warning(settings_.blame(size),
                           fmt::format("mass in radius gives {:.0f} kg/m3, denser than the explosive ({:.0f} kg/m3)",
                                       mean, c.explosive.density));
  }

  /// Keys that give the body of sand its size and place.
  Paths sand_paths() const {
    if (spec_.soil.shape == SoilShape::shell) return {"run.stand_off", "soil.outer_radius"};
    Paths paths{"soil.centre"};
    paths.emplace_back(spec_.soil.shape == SoilShape::box ? "soil.size" : "soil.outer_radius");
    if (spec_.soil.shape == SoilShape::cylinder) paths.emplace_back("soil.height");
    return paths;
  }
  SoilBody body() const { return {spec_.soil, {0.0, 0.0, spec_.run.stand_off}}; }

  /// The charge lies in its cavity, and the cavity in the sand; or the charge is outside of the sand.
  void sand_and_charge() {
    const bool shell = spec_.soil.shape == SoilShape::shell;  // about the charge, wherever that is
    Paths paths = shell ? Paths{} : sand_paths();
    if (!shell) paths.emplace_back("run.stand_off");
    paths.emplace_back("soil.inner_radius");
    if (!usable(paths)) return;
    const double cavity = spec_.soil.inner_radius, size = spec_.charge.radius;
    const double depth = -body().beyond_outside({0.0, 0.0, spec_.run.stand_off});  // of the charge centre in the sand
    finding(!shell && cavity > 0.0 && depth < cavity * (1.0 - touching), paths,
            fmt::format("the cavity reaches out of the sand: its centre is {} deep, inner_radius {}", mm(depth),
                        mm(cavity)),
            "a charge outside of the sand needs no cavity: inner_radius = \"0 mm\"");
    if (!spec_.charge.present || !usable({"charge.radius", "charge.mass"}) ||
        (!shell && cavity == 0.0 && depth <= -size))
      return;
    finding(
        size > cavity * (1.0 + touching), {"charge.radius", "charge.mass", "soil.inner_radius"},
        fmt::format("the charge is larger than its cavity: radius {} against inner_radius {}", mm(size), mm(cavity)),
        "make the cavity larger or the charge smaller");
  }

  void cylinder() {
    const ChargeSpec& c = spec_.charge;
    const double volume = std::numbers::pi * c.radius * c.radius * c.length;
    const double fill = c.explosive.fill * c.mass / c.explosive.density / volume;
    finding(fill > 0.74, {"charge.length", "charge.radius", "charge.mass", "charge.explosive.fill"},
            fmt::format("the gas spheres do not fit into the charge: they would fill {:.2f} of the cylinder", fill),
            "spheres fill at most 0.74; leave charge.mass out to have it from the density");
    const Paths bore{"charge.radius", "charge.length", "plate.pipe.inner_diameter", "plate.pipe.length"};
    if (!spec_.plate.is_pipe() || !usable(bore)) return;
    const PipeSpec& pipe = spec_.plate.pipe;
    finding(2.0 * c.radius > pipe.inner_diameter * (1.0 + touching), bore,
            fmt::format("the charge does not fit into the pipe: radius {} against inner_diameter {}", mm(c.radius),
                        mm(pipe.inner_diameter)),
            "the charge fills the pipe with half its inner diameter as radius");
    const double middle = spec_.run.stand_off, half = 0.5 * c.length;
    finding(middle - half < -touching || middle + half > pipe.length * (1.0 + touching),
            {"charge.length", "run.stand_off", "plate.pipe.length"},
            fmt::format("the charge reaches out of the pipe: from z = {} to {}, the pipe from 0 mm to {}",
                        mm(middle - half), mm(middle + half), mm(pipe.length)),
            "leave run.stand_off out to have the charge in the middle of the pipe");
  }

  void detonator() {
    const ChargeSpec& c = spec_.charge;
    const Paths paths{"charge.detonator", "charge.radius", "run.stand_off"};
    if (!usable(paths) || !settings_.word("charge.detonator").empty()) return;
    const Vec3 centre{0.0, 0.0, spec_.run.stand_off};
    const double distance = norm(c.detonator - centre), reach = c.length > 0.0 ? 0.5 * c.length : c.radius;
    finding(distance > reach * (1.0 + touching), paths,
            fmt::format("the detonator is outside the charge: {} from its centre, radius {}", mm(distance), mm(reach)),
            "the charge centre is at (0, 0, stand_off); \"far pole\" and \"centre\" are always right");
    finding(spec_.run.quarter_symmetry && (c.detonator.x != 0.0 || c.detonator.y != 0.0),
            {"charge.detonator", "run.symmetry"}, "quarter symmetry needs the detonator on the z axis",
            "run.symmetry = \"none\" computes everything");
  }

  void sand() {
    const SoilSpec& s = spec_.soil;
    const Paths radii{"soil.inner_radius", "soil.outer_radius"};
    if (s.shape == SoilShape::shell && usable(radii))
      finding(
          s.inner_radius >= s.outer_radius, radii,
          fmt::format("inner_radius {} is not smaller than outer_radius {}", mm(s.inner_radius), mm(s.outer_radius)),
          "the sand is a shell between the two");
    const Paths place{"soil.centre", "run.symmetry"};
    if (s.shape != SoilShape::shell && usable(place))
      finding(spec_.run.quarter_symmetry && (s.centre.x != 0.0 || s.centre.y != 0.0), place,
              "quarter symmetry needs the centre of the sand on the z axis",
              "run.symmetry = \"none\" computes everything");
    const Paths densities{"soil.packing", "soil.grain_density", "soil.bulk_density"};
    if (usable(densities))
      finding(std::abs(s.packing * s.grain_density / s.bulk_density - 1.0) > 1e-3, densities,
              fmt::format("packing * grain_density = {:.6g} kg/m3, but bulk_density = {:.6g} kg/m3",
                          s.packing * s.grain_density, s.bulk_density),
              "state two of the three; the third follows");
  }

  void stand_off() {
    if (spec_.plate.is_pipe()) return;  // the charge stands in it
    const bool sand = spec_.soil.kind != SoilKind::none;
    const ChargeSpec& c = spec_.charge;
    if (sand && usable(sand_paths())) {
      const SoilBody soil = body();
      const double lowest = soil.centre().z - soil.half_size().z;
      const bool shell = spec_.soil.shape == SoilShape::shell;
      finding(lowest < -touching * soil.half_size().z, sand_paths(),
              shell ? fmt::format("the sand overlaps the plate: stand_off {} is smaller than its radius {}",
                                  mm(spec_.run.stand_off), mm(spec_.soil.outer_radius))
                    : fmt::format("the sand overlaps the plate: its lower end is at z = {}", mm(lowest)),
              shell ? "stand_off is from the charge centre to the loaded face; equal to the radius means just touching"
                    : "the loaded face of the plate is at z = 0; equal to it means just touching");
      if (lowest < 0.0 && shell) return;
    }
    const Paths paths{"run.stand_off", "charge.radius"};
    if (!c.present || !usable(paths)) return;
    finding(spec_.run.stand_off < c.radius * (1.0 - touching), paths,
            fmt::format("the charge overlaps the plate: stand_off {} is smaller than its radius {}",
                        mm(spec_.run.stand_off), mm(c.radius)),
            "stand_off is from the charge centre to the loaded face; equal to the radius means just touching");
  }

  void domain() {
    const Vec3 &low = spec_.domain.lower, &high = spec_.domain.upper;
    const Paths corners{"domain.lower", "domain.upper"};
    if (!usable(corners)) return;
    if (const Setting* size = settings_.find("domain.size"))
      for (const std::string& corner : corners)
        if (const Setting* stated = settings_.find(corner); stated->rank == size->rank && stated->place != size->place)
          return finding(true, {"domain.size"}, "domain is stated twice", "give size, or lower and upper");
    const bool pipe = spec_.plate.is_pipe();
    const double half_x = pipe ? spec_.plate.pipe.inner_diameter : 0.5 * spec_.plate.size.x;  // room to expand
    const double half_y = pipe ? spec_.plate.pipe.inner_diameter : 0.5 * spec_.plate.size.y;
    check_side(half_x, low.x, high.x, "plate", "x", {"domain.lower", "domain.upper", "plate.size"});
    check_side(half_y, low.y, high.y, "plate", "y", {"domain.lower", "domain.upper", "plate.size"});
    const Paths behind{"domain.lower", "plate.size"};
    if (usable(behind))
      finding(low.z > -spec_.plate.size.z, behind,
              fmt::format("the domain is smaller than the scene: it begins at z = {}, the plate reaches z = {}",
                          mm(low.z), mm(-spec_.plate.size.z)),
              "particles that leave the domain are removed");
    if (spec_.soil.kind != SoilKind::none && usable(sand_paths())) {
      const SoilBody soil = body();
      inside("sand", soil.centre(), soil.half_size(), sand_paths());
    }
    const bool in_sand =
        spec_.soil.kind != SoilKind::none && body().beyond_outside({0.0, 0.0, spec_.run.stand_off}) < 0.0;
    if (spec_.charge.present && !in_sand && usable({"charge.radius", "charge.length", "run.stand_off"})) {
      const double radius = spec_.charge.radius, length = spec_.charge.length;
      inside("charge", {0.0, 0.0, spec_.run.stand_off}, {radius, radius, length > 0.0 ? 0.5 * length : radius},
             {"charge.radius", "run.stand_off"});
    }
  }
  /// A body with its centre and half extents lies in the domain.
  void inside(const char* what, const Vec3& centre, const Vec3& half, const Paths& body) {
    const auto with = [&](Paths paths) { return paths.insert(paths.end(), body.begin(), body.end()), paths; };
    const Paths sides = with({"domain.lower", "domain.upper"}), above = with({"domain.upper"});
    check_side(std::abs(centre.x) + half.x, spec_.domain.lower.x, spec_.domain.upper.x, what, "x", sides);
    check_side(std::abs(centre.y) + half.y, spec_.domain.lower.y, spec_.domain.upper.y, what, "y", sides);
    const double top = centre.z + half.z;
    if (usable(above))
      finding(spec_.domain.upper.z < top, above,
              fmt::format("the domain is smaller than the scene: it ends at z = {}, the {} at z = {}",
                          mm(spec_.domain.upper.z), what, mm(top)),
              "particles that leave the domain are removed");
  }
  void check_side(double half, double low, double high, const char* what, const char* axis, const Paths& paths) {
    if (usable(paths))
      finding(low > -half || high < half, paths,
              fmt::format("the domain is smaller than the scene: {} from {} to {}, the {} reaches {} to each side",
                          axis, mm(low), mm(high), what, mm(half)),
              "particles that leave the domain are removed");
  }

  void times() {
    const Paths window{"coupling.window", "run.until"};
    if (usable(window))
      finding(spec_.coupling.window_rule == CouplingSpec::Window::fixed && spec_.coupling.window > spec_.run.until,
              window,
              fmt::format("window {} is longer than the run, until = {}", seconds(spec_.coupling.window),
                          seconds(spec_.run.until)),
              "the two sides exchange once a window; \"auto\" chooses it");
    const Paths rows{"observe.interval", "run.until"};
    if (usable(rows))
      finding(spec_.observe.interval > spec_.run.until, rows,
              fmt::format("interval {} is longer than the run, until = {}", seconds(spec_.observe.interval),
                          seconds(spec_.run.until)),
              "histories.csv has a row every interval");
  }
};

}  // namespace

void check_scene(const CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics) {
  SceneCheck(spec, settings, diagnostics).run();
}

}  // namespace standoff
