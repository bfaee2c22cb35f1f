#include <cmath>

#include "coupling/case/derive.hpp"
#include "coupling/case/structural_models.hpp"

namespace standoff {
namespace {

/// Reads settings into fields; what is absent or wrong leaves the field as it is.
class Fields {
 public:
  explicit Fields(const Settings& settings) : s_(settings) {}

  void get(const char* path, double& field) const { read<double>(path, field); }
  void get(const char* path, std::string& field) const { read<std::string>(path, field); }
  void get(const char* path, bool& field) const { read<bool>(path, field); }
  void get(const char* path, long& field) const { read<long long>(path, field); }
  void get(const char* path, std::uint64_t& field) const { read<long long>(path, field); }
  void get(const char* path, std::vector<double>& field) const { read<std::vector<double>>(path, field); }
  void get(const char* path, Vec3& field) const {
    Triple three{field.x, field.y, field.z};
    read<Triple>(path, three);
    field = {three[0], three[1], three[2]};
  }
  void get(const char* path, std::array<int, 3>& field) const {
    CountTriple three{field[0], field[1], field[2]};
    read<CountTriple>(path, three);
    for (std::size_t i = 0; i < 3; ++i) field[i] = static_cast<int>(three[i]);
  }
  std::string word(const char* path) const { return s_.word(path); }
  bool has(const char* path) const { return s_.has(path); }

 private:
  template <class Stored, class Field>
  void read(const char* path, Field& field) const {
    const Setting* setting = s_.find(path);
    const Stored* value = setting ? std::get_if<Stored>(&setting->value) : nullptr;
    if (value) field = static_cast<Field>(*value);
  }
  const Settings& s_;
};

void charge(const Fields& from, ChargeSpec& to) {
  to.present = from.has("charge.mass");
  if (!to.present) return;
  from.get("charge.mass", to.mass);
  from.get("charge.radius", to.radius);
  from.get("charge.length", to.length);
  from.get("charge.detonator", to.detonator);
  from.get("charge.particles", to.particles);
  from.get("charge.explosive.name", to.explosive.name);
  from.get("charge.explosive.density", to.explosive.density);
  from.get("charge.explosive.energy", to.explosive.energy);
  from.get("charge.explosive.gamma", to.explosive.gamma);
  from.get("charge.explosive.fill", to.explosive.fill);
  from.get("charge.explosive.detonation_speed", to.explosive.detonation_speed);
}

SoilShape shape_named(const std::string& word) {
  if (word == "sphere") return SoilShape::sphere;
  if (word == "cylinder") return SoilShape::cylinder;
  return word == "box" ? SoilShape::box : SoilShape::shell;
}

void soil(const Fields& from, SoilSpec& to) {
  const std::string kind = from.word("soil.kind");
  to.kind = kind == "dry" ? SoilKind::dry : kind == "wet" ? SoilKind::wet : SoilKind::none;
  if (to.kind == SoilKind::none) return;
  to.shape = shape_named(from.word("soil.body"));
  from.get("soil.inner_radius", to.inner_radius);
  from.get("soil.outer_radius", to.outer_radius);
  from.get("soil.height", to.height);
  from.get("soil.size", to.size);
  from.get("soil.centre", to.centre);
  from.get("soil.packing", to.packing);
  from.get("soil.grain_density", to.grain_density);
  from.get("soil.bulk_density", to.bulk_density);
  from.get("soil.stiffness", to.stiffness);
  from.get("soil.friction", to.friction);
  from.get("soil.damping", to.damping);
  from.get("soil.radius_spread", to.radius_spread);
  from.get("soil.particles", to.particles);
}

MaterialLaw law_named(const std::string& word) {
  if (word == "johnson_cook_log") return MaterialLaw::johnson_cook_log;
  if (word == "j2_table") return MaterialLaw::j2_table;
  return word == "elastic" ? MaterialLaw::elastic : MaterialLaw::johnson_cook;
}

void cell(const Fields& from, CellSpec& to) {
  from.get("cell.grains", to.grains);
  from.get("cell.cells", to.cells);
  from.get("cell.strain", to.strain);
  from.get("cell.points", to.points);
  from.get("cell.steps", to.steps);
}

void material(const Fields& from, MaterialSpec& to) {
  to.law = law_named(from.word("plate.material.law"));
  from.get("plate.material.name", to.name);
  from.get("plate.material.source", to.source);
  from.get("plate.material.density", to.density);
  from.get("plate.material.youngs_modulus", to.youngs_modulus);
  from.get("plate.material.poissons_ratio", to.poissons_ratio);
  from.get("plate.material.A", to.A);
  from.get("plate.material.B", to.B);
  from.get("plate.material.n", to.n);
  from.get("plate.material.C", to.C);
  from.get("plate.material.reference_rate", to.reference_rate);
  from.get("plate.material.plastic_strain", to.plastic_strain);
  from.get("plate.material.flow_stress", to.flow_stress);
  if (to.law == MaterialLaw::j2_table && !to.flow_stress.empty()) to.A = to.flow_stress.front();
  from.get("plate.material.m", to.m);
  from.get("plate.material.room_temperature", to.room_temperature);
  from.get("plate.material.melting_temperature", to.melting_temperature);
  from.get("plate.material.specific_heat", to.specific_heat);
  from.get("plate.material.taylor_quinney", to.taylor_quinney);
  from.get("plate.material.thermal_expansion", to.thermal_expansion);
}

void surroundings(const Fields& from, CaseSpec& to) {
  to.air.on = from.word("air.mode") == "on";
  from.get("air.pressure", to.air.pressure);
  from.get("air.density", to.air.density);
  from.get("air.gamma", to.air.gamma);
  from.get("air.particles", to.air.particles);
  from.get("domain.lower", to.domain.lower);
  from.get("domain.upper", to.domain.upper);
  from.get("domain.boundaries", to.domain.boundaries);
  to.contact.surface_law_is_soil = from.word("contact.surface_restitution") == "soil";
  from.get("contact.surface_restitution", to.contact.surface_restitution);
  from.get("contact.surface_friction", to.contact.surface_friction);
}

void plate(const Fields& from, PlateSpec& to) {
  from.get("plate.model", to.model);
  if (to.model == pipe_model) {
    from.get("plate.pipe.inner_diameter", to.pipe.inner_diameter);
    from.get("plate.pipe.wall", to.pipe.wall);
    from.get("plate.pipe.length", to.pipe.length);
  }
  from.get("plate.size", to.size);
  from.get("plate.elements", to.elements);
  from.get("plate.edges", to.edges);
  from.get("plate.opening", to.opening);
  from.get("plate.surround", to.surround);
  from.get("plate.surround_size", to.surround_size);
  material(from, to.material);
}

void procedure(const Fields& from, CaseSpec& to) {
  from.get("run.stand_off", to.run.stand_off);
  from.get("run.until", to.run.until);
  from.get("run.settle", to.run.settle);
  from.get("run.seed", to.run.seed);
  to.run.quarter_symmetry = from.word("run.symmetry") != "none";
  to.coupling.scheme = from.word("coupling.scheme") == "serial" ? Scheme::serial : Scheme::parallel;
  const std::string window = from.word("coupling.window");
  to.coupling.window_rule = window == "auto"   ? CouplingSpec::Window::automatic
                            : window == "step" ? CouplingSpec::Window::structure_step
                                               : CouplingSpec::Window::fixed;
  from.get("coupling.window", to.coupling.window);
  from.get("observe.interval", to.observe.interval);
  from.get("observe.snapshots", to.observe.snapshots);
  from.get("observe.probes", to.observe.probes);
}

}  // namespace

CaseSpec build_spec(const Settings& settings) {
  const Fields from(settings);
  CaseSpec spec;
  from.get("case.name", spec.name);
  from.get("case.title", spec.title);
  from.get("case.question", spec.question);
  from.get("case.source", spec.source);
  from.get("case.level", spec.level);
  spec.levels = settings.levels;
  charge(from, spec.charge);
  soil(from, spec.soil);
  cell(from, spec.cell);
  plate(from, spec.plate);
  surroundings(from, spec);
  procedure(from, spec);
  return spec;
}

}  // namespace standoff
