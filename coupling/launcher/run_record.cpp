#include "coupling/launcher/run_record.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/base/state_hash.hpp"
#include "coupling/case/effects/registry.hpp"

namespace standoff::launch {
namespace {

using nlohmann::json;

// Keys of the contract that an effect or a medium may take away; those missing from a finished run are listed in
// absent[].
constexpr const char* contract_keys[] = {"results.permanent_centre_deflection_m",
                                         "results.permanent_max_deflection_m",
                                         "results.peak_centre_deflection_m",
                                         "results.impulse_Ns",
                                         "results.impulse_gas_Ns",
                                         "results.impulse_sand_Ns",
                                         "results.impulse_air_Ns",
                                         "results.incoming_momentum_Ns",
                                         "results.rebound_momentum_Ns",
                                         "results.max_plastic_strain",
                                         "results.centre_plastic_strain",
                                         "results.max_plastic_strain_away_from_clamp",
                                         "results.max_strain_rate_per_s",
                                         "results.max_temperature_rise_K",
                                         "results.max_overlap_over_radius",
                                         "results.shock_arrival_at_sand_surface_s",
                                         "relaxation.at_rest",
                                         "relaxation.kinetic_ratio",
                                         "relaxation.residual_N",
                                         "relaxation.drift_m_per_period",
                                         "relaxation.polish_difference_m",
                                         "relaxation.wall_s",
                                         "conservation.energy_error_particles",
                                         "conservation.energy_error_structure",
                                         "conservation.interface_work_error",
                                         "conservation.momentum_error",
                                         "counts.charge_particles",
                                         "counts.sand_particles",
                                         "counts.air_particles",
                                         "counts.elements",
                                         "counts.surface_nodes",
                                         "counts.particle_steps",
                                         "counts.structure_steps",
                                         "counts.windows"};

json::json_pointer pointer_to(const std::string& dotted) {
  std::string path = "/" + dotted;
  std::replace(path.begin(), path.end(), '.', '/');
  return json::json_pointer(path);
}

/// Objects are merged member by member; anything else is replaced.
void merge_into(json& target, const json& addition) {
  if (!target.is_object() || !addition.is_object()) {
    target = addition;
    return;
  }
  for (const auto& [key, value] : addition.items()) merge_into(target[key], value);
}

const json* member(const json& report, const std::string& dotted) {
  const auto pointer = pointer_to(dotted);
  return report.contains(pointer) ? &report.at(pointer) : nullptr;
}

std::optional<double> momentum_error(const std::map<std::string, json>& reports, const InterfaceEvent& ledger) {
  std::array<double, 3> sum{};
  double scale = 0.0;
  int books = 0;
  for (const auto& [name, report] : reports) {
    const json* residual = member(report, "conservation.momentum_residual_Ns");
    const json* impulses = member(report, "conservation.impulse_scale_Ns");
    if (residual == nullptr || impulses == nullptr) continue;
    for (std::size_t i = 0; i < 3; ++i) sum[i] += residual->at(i).get<double>();
    scale += impulses->get<double>();
    ++books;
  }
  if (books < 2 || scale <= 0.0) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) sum[i] += ledger.impulse_received_Ns[i] - ledger.impulse_given_Ns[i];
  return std::hypot(sum[0], sum[1], sum[2]) / scale;
}

/// Absent where particles meet the surface at rest: they do no work on it.
std::optional<double> work_error(const CaseSpec& spec, const RunFacts& facts) {
  const auto recedes = std::ranges::find(spec.effects, "surface_recession", &EffectDecision::name);
  if (recedes != spec.effects.end() && !recedes->on) return std::nullopt;
  double error = facts.largest_work_error, work = facts.largest_external_work;
  if (facts.interface_ledger) {
    const double copies = spec.copies();
    error = std::max(error,
                     copies * std::abs(facts.interface_ledger->work_given_J - facts.interface_ledger->work_received_J));
    work = std::max(work, copies * facts.interface_ledger->work_received_J);
  }
  if (work <= 0.0) return std::nullopt;
  return error / work;
}

/// One fingerprint of both final states; absent unless every participant reported one.
std::optional<std::string> combined_hash(const std::map<std::string, json>& reports) {
  StateHash hash;
  for (const auto& [name, report] : reports) {
    const json* own = member(report, "provenance.state_hash");
    if (own == nullptr) return std::nullopt;
    hash.add(std::string_view(name));
    hash.add(std::string_view(own->get_ref<const std::string&>()));
  }
  return reports.empty() ? std::nullopt : std::optional(hash.hex());
}

void add_conservation(json& merged, const CaseSpec& spec, const RunFacts& facts,
                      const std::map<std::string, json>& reports) {
  json& books = merged["conservation"];
  if (books.is_object()) books.erase("momentum_residual_Ns"), books.erase("impulse_scale_Ns");
  for (const auto& [name, report] : reports)
    if (const json* residual = member(report, "conservation.momentum_residual_Ns"))
      books["momentum_residual_" + name + "_Ns"] = *residual;
  if (const auto error = work_error(spec, facts)) books["interface_work_error"] = *error;
  if (facts.interface_ledger) {
    books["impulse_given_Ns"] = facts.interface_ledger->impulse_given_Ns;
    books["impulse_received_Ns"] = facts.interface_ledger->impulse_received_Ns;
    if (const auto error = momentum_error(reports, *facts.interface_ledger)) books["momentum_error"] = *error;
  }
}

/// Stages that exist for one effect alone: their seconds are its measured price.
std::optional<double> stage_seconds(const std::string& name, const json& merged) {
  const auto effect = std::ranges::find(effect_rules(), name, &Effect::name);
  if (effect == effect_rules().end()) return std::nullopt;
  std::optional<double> sum;
  for (const std::string& stage : effect->stages)
    for (const char* side : {"timing.particle.stages.", "timing.structure.stages."})
      if (const json* seconds = member(merged, side + stage)) sum = sum.value_or(0.0) + seconds->get<double>();
  return sum;
}

OrderedJson effects(const CaseSpec& spec, const RunFacts& facts, const json& merged) {
  const json reported = merged.value("effects", json());
  OrderedJson list = OrderedJson::array();
  for (const EffectDecision& effect : spec.effects) {
    OrderedJson row{{"name", effect.name}, {"on", effect.on}, {"reason", effect.reason}};
    const auto bytes = facts.effect_bytes.find(effect.name);
    row["bytes"] = effect.on && bytes != facts.effect_bytes.end() ? bytes->second : 0.0;
    row["seconds"] = effect.on ? OrderedJson(nullptr) : OrderedJson(0.0);  // null: not measured apart from its stage
    if (const auto seconds = stage_seconds(effect.name, merged); effect.on && seconds) row["seconds"] = *seconds;
    if (effect.on && reported.is_object() && reported.contains(effect.name))
      for (const auto& [key, value] : reported.at(effect.name).items()) row[key] = value;
    list.push_back(row);
  }
  return list;
}

OrderedJson coupling(const CaseSpec& spec, const RunFacts& facts) {
  OrderedJson j;
  j["scheme"] = spec.coupling.scheme == Scheme::parallel ? "parallel" : "serial";
  if (facts.clock) {
    if (!facts.clock->scheme.empty()) j["scheme"] = facts.clock->scheme;
    j["window_s"] = facts.clock->window_s;
  }
  if (facts.interface_ledger) j["bytes"] = facts.interface_ledger->bytes;
  return j;
}

OrderedJson provenance(const RunFacts& facts, const std::map<std::string, json>& reports, const json& merged) {
  OrderedJson j = merged.is_object() ? OrderedJson(merged) : OrderedJson::object();
  j.erase("state_hash");
  j["version"] = facts.build.version;
  j["git"] = facts.build.git;
  j["compiler"] = facts.build.compiler;
  j["flags"] = facts.build.flags;
  for (const auto& [name, version] : facts.build.libraries) j["libraries"][name] = version;
  j["cpu"] = facts.cpu;
  j["threads"] = {{"particles", facts.particle_threads}, {"structure", facts.structure_threads}};
  j["case_hash"] = facts.case_hash;
  if (const auto hash = combined_hash(reports)) {
    j["state_hash"] = *hash;
    for (const auto& [name, report] : reports) j["state_hash_" + name] = *member(report, "provenance.state_hash");
  }
  return j;
}

/// Members the contract names first and in its order, then the others by name.
OrderedJson in_contract_order(const std::string& section, const json& content) {
  OrderedJson ordered = OrderedJson::object();
  for (const std::string key : contract_keys)
    if (key.starts_with(section + ".") && content.contains(key.substr(section.size() + 1)))
      ordered[key.substr(section.size() + 1)] = content.at(key.substr(section.size() + 1));
  for (const auto& [key, value] : content.items())
    if (!ordered.contains(key)) ordered[key] = value;
  return ordered;
}

OrderedJson absent_keys(const OrderedJson& record) {
  OrderedJson absent = OrderedJson::array();
  for (const char* key : contract_keys) {
    std::string path = std::string("/") + key;
    std::replace(path.begin(), path.end(), '.', '/');
    if (!record.contains(OrderedJson::json_pointer(path))) absent.push_back(key);
  }
  return absent;
}

}  // namespace

OrderedJson run_record(const CaseSpec& spec, const RunFacts& facts, const std::map<std::string, json>& reports) {
  json merged = json::object();
  for (const auto& [name, report] : reports) merge_into(merged, report);
  add_conservation(merged, spec, facts, reports);
  if (facts.clock) merged["counts"]["windows"] = facts.clock->windows;

  OrderedJson record;
  record["status"] = facts.status;
  record["exit_code"] = facts.exit_code ? OrderedJson(*facts.exit_code) : OrderedJson(nullptr);
  record["reason"] = facts.reason;
  record["case"] = spec.name;
  record["level"] = spec.level;
  record["seed"] = spec.run.seed;
  record["structure_model"] = facts.structure_model.empty() ? spec.plate.model : facts.structure_model;
  record["absent"] = OrderedJson::array();
  for (const char* section : {"results", "relaxation", "conservation", "counts"})
    if (merged.contains(section) && !merged[section].is_null())
      record[section] = in_contract_order(section, merged[section]);
  record["coupling"] = coupling(spec, facts);
  record["effects"] = effects(spec, facts, merged);
  record["timing"] = OrderedJson{{"wall_s", facts.wall_s}};
  if (merged.contains("timing"))
    for (const auto& [key, value] : merged["timing"].items()) record["timing"][key] = value;
  for (const auto& [name, seconds] : facts.cpu_s) record["timing"]["cpu_s"][name] = seconds;
  for (const auto& [name, bytes] : facts.peak_bytes) record["memory"][name + "_peak_bytes"] = bytes;
  record["provenance"] = provenance(facts, reports, merged.value("provenance", json()));
  for (const auto& [key, value] : merged.items())
    if (!record.contains(key) && !value.is_null()) record[key] = value;
  if (facts.status == "done") record["absent"] = absent_keys(record);
  return record;
}

std::optional<double> number_at(const OrderedJson& record, const std::string& dotted) {
  std::string path = "/" + dotted;
  std::replace(path.begin(), path.end(), '.', '/');
  const OrderedJson::json_pointer pointer(path);
  if (!record.contains(pointer) || !record.at(pointer).is_number()) return std::nullopt;
  return record.at(pointer).get<double>();
}

}  // namespace standoff::launch
