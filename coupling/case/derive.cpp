#include "coupling/case/derive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "coupling/case/effects/registry.hpp"
#include "coupling/case/presets.hpp"
#include "coupling/case/structural_models.hpp"

namespace standoff {
namespace {

class Completion {
 public:
  Completion(Settings& settings, Diagnostics& diagnostics) : s_(settings), diagnostics_(diagnostics) {}

  void run_cell() {
    for (const std::string& section : section_names())
      if (section != "case" && section != "soil" && section != "cell" && section != "run" && section != "effects")
        s_.forget_section(section);
    for (const Effect& effect : effect_rules())
      if (!effect.in_a_cell) s_.forget(std::string("effects.") + effect.name);
    cell_only_ = true;
    const std::string soil = s_.word("soil.kind");
    has_soil_ = soil == "dry" || soil == "wet";
    if (!has_soil_ && !s_.is_wrong("soil.kind"))
      diagnostics_.error(s_.section_place("soil"), "there is no sand to test: soil.kind is \"none\"",
                         "kind = \"dry\" or \"wet\" brings the base parameters of the paper");
    if (!has_soil_) return;
    expand("soil", "soil.kind");
    soil_densities();
    defaults();
    require_soil();
  }

  void run() {
    if (describes_a_cell(s_)) {
      diagnostics_.error(s_.section_place("cell"), "this case is a unit cell of sand, not a scene: there is no plate",
                         "`standoff cell` packs and compresses it");
      return;
    }
    has_charge_ = s_.has_section("charge") && (s_.has("charge.mass") || !only_level("charge"));
    const std::string soil = s_.word("soil.kind");
    has_soil_ = soil == "dry" || soil == "wet";
    if (has_charge_ && !explosive_stated()) state_word("charge.explosive.preset", "c4");
    expand("explosive", "charge.explosive.preset");
    expand("material", "plate.material.preset");
    if (has_soil_) expand("soil", "soil.kind");
    soil_densities();
    follow_effects();
    pipe_geometry();
    defaults();
    charge_geometry();
    soil_body();
    domain_box();
    duration();
    surface_friction();
    require_all();
  }

 private:
  bool good(const std::string& path) const { return s_.has(path) && !s_.is_wrong(path); }
  bool good(std::initializer_list<const char*> paths) const {
    return std::all_of(paths.begin(), paths.end(), [this](const char* path) { return good(path); });
  }

  /// True if the only statements about `section` come from the level: it is a count for something that is not there.
  bool only_level(const std::string& section) const {
    for (const auto& [path, setting] : s_.all())
      if (path.starts_with(section + ".") && setting.rank != rank::level) return false;
    return true;
  }
  /// Stated in a file: such a table is complete or names its preset. A --set of one constant changes the default.
  bool explosive_stated() const {
    if (s_.is_wrong("charge.explosive.preset")) return true;
    for (const auto& [path, setting] : s_.all())
      if (path.starts_with("charge.explosive.") && (setting.rank < rank::set || path.ends_with(".preset"))) return true;
    return false;
  }

  void state_word(const std::string& path, const std::string& word) {
    s_.add(path, {word, "default", {}, rank::fallback});
  }
  void derive(const std::string& path, Value value, const std::string& reason) {
    s_.add(path, {std::move(value), "derived: " + reason, {}, rank::derived});
  }

  void expand(const std::string& kind, const std::string& key) {
    const Preset* preset = find_preset(kind, s_.word(key));
    if (!preset) return;
    for (const PresetValue& value : preset->values)
      s_.add(std::string(value.path),
             {known_value(value.text, *find_key(value.path)), "preset " + std::string(preset->name), {}, rank::preset});
  }

  /// bulk density = packing * grain density: of the two densities the one stated with the higher rank is kept.
  void soil_densities() {
    const Setting* bulk = s_.find("soil.bulk_density");
    const Setting* grain = s_.find("soil.grain_density");
    if (!has_soil_ || !good("soil.packing") || s_.is_wrong("soil.bulk_density") || s_.is_wrong("soil.grain_density"))
      return;
    const double packing = s_.number("soil.packing");
    const int bulk_rank = bulk ? bulk->rank : -1, grain_rank = grain ? grain->rank : -1;
    if (bulk_rank < 0 && grain_rank < 0) return;
    if (bulk && grain &&
        std::abs(packing * s_.number("soil.grain_density") / s_.number("soil.bulk_density") - 1.0) < 1e-9)
      return;
    const bool wet = s_.word("soil.kind") == "wet";
    // Both from the preset, with a packing stated above it: dry sand keeps its grains, wet sand its bulk with the
    // water.
    const bool from_grain = grain_rank > bulk_rank || (grain_rank == bulk_rank && grain_rank == rank::preset && !wet);
    const bool both_stated = grain_rank == bulk_rank && grain_rank != rank::preset;
    if (both_stated) return;  // checked for agreement later
    if (from_grain)
      replace("soil.bulk_density", packing * s_.number("soil.grain_density"), grain_rank, "packing * grain_density");
    else
      replace("soil.grain_density", s_.number("soil.bulk_density") / packing, bulk_rank, "bulk_density / packing");
  }
  void replace(const std::string& path, double value, int rank, const std::string& reason) {
    s_.add(path, {value, "derived: " + reason, {}, rank});
  }

  /// Two effects are also keys of [run]; an override of the effect is an override of the key.
  void follow_effects() {
    const std::string symmetry = s_.word("effects.symmetry"), relaxation = s_.word("effects.relaxation");
    if (!symmetry.empty())
      s_.add("run.symmetry", {symmetry == "on" ? "quarter" : "none", s_.find("effects.symmetry")->origin + ", effects",
                              s_.find("effects.symmetry")->place, rank::option});
    if (!relaxation.empty())
      s_.add("run.settle", {relaxation == "on", s_.find("effects.relaxation")->origin + ", effects",
                            s_.find("effects.relaxation")->place, rank::option});
  }

  void defaults() {
    for (const KeyEntry& entry : schema()) {
      const std::string path(entry.path);
      const bool absent = (path.starts_with("charge.") && !has_charge_) ||
                          (path.starts_with("soil.") && !has_soil_ && path != "soil.kind") ||
                          (cell_only_ ? !belongs_to_a_cell(path) : path.starts_with("cell."));
      if (entry.fallback.empty() || absent || s_.has(path)) continue;
      s_.add(path, {known_value(entry.fallback, entry), "default", {}, rank::fallback});
    }
  }

  static bool belongs_to_a_cell(const std::string& path) {
    return path.starts_with("soil.") || path.starts_with("cell.") || path == "run.seed";
  }

  /// The wall of a pipe unrolled is its plate; nothing surrounds it, and its middle is where a charge stands.
  void pipe_geometry() {
    is_pipe_ = s_.word("plate.model") == pipe_model;
    if (!is_pipe_) return;
    derive("plate.surround", std::string("open"), "a pipe stands free");
    derive("plate.edges", std::string("free"), "a pipe stands free");
    derive("run.settle", false, "a pipe stands free");
    if (good("plate.pipe.length"))
      derive("run.stand_off", 0.5 * s_.number("plate.pipe.length"), "half the length of the pipe");
    if (!good({"plate.pipe.inner_diameter", "plate.pipe.wall", "plate.pipe.length"})) return;
    const double wall = s_.number("plate.pipe.wall"), length = s_.number("plate.pipe.length");
    s_.forget("plate.size");
    derive("plate.size", Triple{std::numbers::pi * (s_.number("plate.pipe.inner_diameter") + wall), length, wall},
           "the wall unrolled");
  }

  void charge_geometry() {
    if (!has_charge_) return;
    const bool cylinder = good({"charge.length", "charge.radius", "charge.explosive.density"});
    if (cylinder && !s_.has("charge.mass"))
      derive("charge.mass",
             std::numbers::pi * std::pow(s_.number("charge.radius"), 2) * s_.number("charge.length") *
                 s_.number("charge.explosive.density"),
             "cylinder of radius, length and density");
    if (!s_.has("charge.radius") && good({"charge.mass", "charge.explosive.density"})) {
      const double volume = s_.number("charge.mass") / s_.number("charge.explosive.density");
      derive("charge.radius", std::cbrt(0.75 * volume / std::numbers::pi), "sphere of mass and density");
    }
    const std::string word = s_.word("charge.detonator");
    if (word.empty() || !good({"charge.radius", "run.stand_off"})) return;
    const double stand_off = s_.number("run.stand_off");
    const double half = good("charge.length") ? 0.5 * s_.number("charge.length") : s_.number("charge.radius");
    const double z = word == "centre" ? stand_off : stand_off + half;
    Setting at = *s_.find("charge.detonator");
    at.value = Triple{0.0, 0.0, z};
    at.origin += ", \"" + word + "\"";
    s_.add("charge.detonator", at);
  }

  void soil_body() {
    if (!has_soil_ || s_.is_wrong("soil.body") || s_.word("soil.body") == "shell") return;
    if (!s_.has("soil.inner_radius")) derive("soil.inner_radius", 0.0, "no cavity stated");
    if (!s_.has("soil.centre") && good("run.stand_off"))
      derive("soil.centre", Triple{0.0, 0.0, s_.number("run.stand_off")}, "the charge centre");
  }

  /// Half the extent of the sand in x and y, and the upper end of what is not about the charge; 0 where not known.
  std::pair<double, double> extent_of_sand() const {
    const std::string body = s_.word("soil.body");
    const bool box = body == "box", cylinder = body == "cylinder";
    if (!has_soil_ || !good(box ? "soil.size" : "soil.outer_radius") || (cylinder && !good("soil.height"))) return {};
    const Triple size = box ? s_.triple("soil.size") : Triple{};
    const double across = box ? 0.5 * std::max(size[0], size[1]) : s_.number("soil.outer_radius");
    if (body == "shell") return {across, 0.0};
    const double up = box ? 0.5 * size[2] : cylinder ? 0.5 * s_.number("soil.height") : across;
    const double centre = good("soil.centre")     ? s_.triple("soil.centre")[2]
                          : good("run.stand_off") ? s_.number("run.stand_off")
                                                  : 0.0;
    return {across, centre + up};
  }

  /// The corners follow from `size` if that was stated above them; else from the scene.
  void domain_box() {
    const Setting* size = s_.find("domain.size");
    const bool stated = size && !s_.is_wrong("domain.size");
    if (stated) {
      const Triple box = s_.triple("domain.size");
      corner("domain.lower", {-0.5 * box[0], -0.5 * box[1], -behind}, *size);
      corner("domain.upper", {0.5 * box[0], 0.5 * box[1], box[2] - behind}, *size);
    }
    double half = 0.6;
    if (good("plate.size")) half = std::max({half, s_.triple("plate.size")[0], s_.triple("plate.size")[1]});
    if (good("plate.surround_size")) half = std::max(half, 0.75 * s_.number("plate.surround_size"));
    const auto [sand, top] = extent_of_sand();
    double outer = sand;
    if (good("charge.radius")) outer = std::max(outer, s_.number("charge.radius"));
    if (good("charge.length")) outer = std::max(outer, 0.5 * s_.number("charge.length"));
    half = std::max(half, 4.0 * outer);
    const double stand_off = good("run.stand_off") ? s_.number("run.stand_off") : 0.0;
    const double beyond = std::max(0.8, 4.0 * outer);
    derive("domain.lower", Triple{-half, -half, -behind}, "the scene with room to spread");
    derive("domain.upper", Triple{half, half, std::max(stand_off, top) + beyond}, "the scene with room to spread");
  }
  void corner(const std::string& path, const Triple& value, const Setting& size) {
    s_.add(path, {value, size.origin + ", domain.size", size.place, size.rank});
  }

  void duration() {
    if (s_.has("run.until")) return;
    derive("run.until", has_soil_ ? 2e-3 : 1e-3, has_soil_ ? "2 ms with sand" : "1 ms without sand");
  }

  void surface_friction() {
    if (s_.word("contact.surface_friction") != "soil") return;
    Setting own = *s_.find("contact.surface_friction");
    own.value = good("soil.friction") ? s_.number("soil.friction") : 0.0;
    own.origin += ", \"soil\"";
    s_.add("contact.surface_friction", own);
  }

  void require(const std::string& path, const std::string& why = "") {
    if (s_.has(path) || s_.is_wrong(path)) return;
    s_.mark_wrong(path);
    const KeyEntry& entry = *find_key(path);
    const std::string section(entry.section()), key(entry.key());
    diagnostics_.error(s_.section_place(path),
                       key + " is missing in [" + section + "]" + (why.empty() ? "" : "; " + why),
                       key + ": " + std::string(entry.doc));
  }
  void require_soil() {
    for (const char* key :
         {"packing", "grain_density", "bulk_density", "stiffness", "friction", "damping", "radius_spread"})
      if (!s_.is_wrong("soil.packing")) require(std::string("soil.") + key);
  }
  void require_body() {
    const std::string body = s_.word("soil.body");
    if (s_.is_wrong("soil.body")) return;
    require("soil.inner_radius");  // only a shell can lack it
    require(body == "box" ? "soil.size" : "soil.outer_radius", "the body is a " + body);
    if (body == "cylinder") require("soil.height", "the body is a cylinder");
  }
  void require_all() {
    if (has_charge_) {
      require("charge.mass");
      if (!s_.is_wrong("charge.explosive.preset"))
        for (const char* key : {"density", "energy", "gamma", "fill", "detonation_speed"})
          require(std::string("charge.explosive.") + key, "a table without preset states everything");
    }
    if (has_soil_) {
      require_body();
      require_soil();
    }
    if (is_pipe_)
      for (const char* path : {"plate.size", "run.stand_off"})  // they follow from the shape of the pipe
        if (!s_.has(path)) s_.mark_wrong(path);
    if (has_charge_ || has_soil_) require("run.stand_off");
    if (is_pipe_)
      for (const char* key : {"inner_diameter", "wall", "length"})
        require(std::string("plate.pipe.") + key, "model = \"pipe_hex64\" is a pipe");
    require("plate.size");
    if (s_.word("plate.edges") == "bolted") require("plate.opening", "a frame on both faces has an opening");
    if (s_.is_wrong("plate.material.preset")) return;
    if (!s_.has_section("plate.material") || only_defaults("plate.material")) {
      s_.mark_wrong("plate.material.preset");
      diagnostics_.error(s_.section_place("plate.size"), "material is missing in [plate]",
                         "write material = \"al6xn\", or a table with density, youngs_modulus, poissons_ratio, A ...");
      return;
    }
    const std::string law = s_.word("plate.material.law"), whole = "a table without preset states everything";
    for (const char* key : {"density", "youngs_modulus", "poissons_ratio"})
      require(std::string("plate.material.") + key, whole);
    if (law == "j2_table")
      for (const char* key : {"plastic_strain", "flow_stress"})
        require(std::string("plate.material.") + key, "law = \"j2_table\" needs the points of its curve");
    else if (law != "elastic")
      require("plate.material.A", whole);
  }
  bool only_defaults(const std::string& section) const {
    for (const auto& [path, setting] : s_.all())
      if (path.starts_with(section + ".") && setting.rank != rank::fallback) return false;
    return true;
  }

  static constexpr double behind = 0.2;  // m, how far the box reaches behind the loaded face

  Settings& s_;
  Diagnostics& diagnostics_;
  bool has_charge_ = false, has_soil_ = false, cell_only_ = false, is_pipe_ = false;
};

}  // namespace

void complete(Settings& settings, Diagnostics& diagnostics) {
  Completion(settings, diagnostics).run();
}

void complete_cell(Settings& settings, Diagnostics& diagnostics) {
  Completion(settings, diagnostics).run_cell();
}

bool describes_a_cell(const Settings& settings) {
  return settings.has_section("cell") && !settings.has_section("plate");
}

}  // namespace standoff
