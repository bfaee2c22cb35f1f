#include "coupling/case/references.hpp"

#include <array>

#include "coupling/case/near_word.hpp"
#include "coupling/case/value.hpp"

namespace standoff {
namespace {

// Results of a run that a figure can be compared with; the unit is the end of the name.
const std::vector<std::string>& result_names() {
  static const std::vector<std::string> names{"permanent_centre_deflection_m",
                                              "permanent_max_deflection_m",
                                              "peak_centre_deflection_m",
                                              "impulse_Ns",
                                              "impulse_gas_Ns",
                                              "impulse_sand_Ns",
                                              "impulse_air_Ns",
                                              "incoming_momentum_Ns",
                                              "rebound_momentum_Ns",
                                              "max_plastic_strain",
                                              "centre_plastic_strain",
                                              "max_plastic_strain_away_from_clamp",
                                              "max_strain_rate_per_s",
                                              "max_temperature_rise_K",
                                              "max_overlap_over_radius",
                                              "shock_arrival_at_sand_surface_s"};
  return names;
}

KeyEntry value_entry(std::string_view name) {
  using namespace quantity;
  KeyEntry entry{"references.value", KeyKind::quantity, none, {}, "", "", ""};
  if (name.ends_with("_per_s"))
    entry.quantity = rate;
  else if (name.ends_with("_Ns"))
    entry.quantity = impulse;
  else if (name.ends_with("_m"))
    entry.quantity = length;
  else if (name.ends_with("_K"))
    entry.quantity = temperature;
  else if (name.ends_with("_s"))
    entry.quantity = quantity::time;
  else
    entry.kind = KeyKind::number;
  return entry;
}

void read_one(const Node& node, std::vector<ReferenceValue>& references, Diagnostics& diagnostics) {
  static const std::vector<std::string> keys{"quantity", "source", "value"};
  if (!node.table()) return diagnostics.error(node.place, "references hold tables: [[references]]");
  for (const Node::Member& member : *node.table())
    if (member.name != "quantity" && member.name != "source" && member.name != "value")
      diagnostics.error(member.place, "unknown key " + in_quotes(member.name) + " in [[references]]",
                        did_you_mean(member.name, keys, "keys here"));
  ReferenceValue reference;
  for (const std::string& key : keys)
    if (!node.find(key)) return diagnostics.error(node.place, key + " is missing in [[references]]");
  const KeyEntry text{"references.quantity", KeyKind::text, quantity::none, {}, "", "", ""};
  const KeyEntry source{"references.source", KeyKind::text, quantity::none, {}, "", "", ""};
  const auto name = check_value(*node.find("quantity"), text, diagnostics);
  const auto from = check_value(*node.find("source"), source, diagnostics);
  if (!name || !from) return;
  reference.quantity = std::get<std::string>(*name);
  reference.source = std::get<std::string>(*from);
  bool known = false;
  for (const std::string& result : result_names()) known = known || result == reference.quantity;
  if (!known)
    return diagnostics.error(node.find("quantity")->place, "unknown result " + in_quotes(reference.quantity),
                             did_you_mean(reference.quantity, result_names(), "results"));
  const auto value = check_value(*node.find("value"), value_entry(reference.quantity), diagnostics);
  if (!value) return;
  reference.value = std::get<double>(*value);
  references.push_back(std::move(reference));
}

}  // namespace

void read_references(const Node& list, std::vector<ReferenceValue>& references, Diagnostics& diagnostics) {
  if (!list.array()) return diagnostics.error(list.place, "references is a list of tables: [[references]]");
  for (const Node& node : *list.array()) read_one(node, references, diagnostics);
}

std::string reference_text(const std::vector<ReferenceValue>& references) {
  std::string text;
  for (const ReferenceValue& reference : references)
    text += "\n[[references]]\nquantity = " + in_quotes(reference.quantity) +
            "\nsource = " + in_quotes(reference.source) +
            "\nvalue = " + toml_text(reference.value, value_entry(reference.quantity)) + "\n";
  return text;
}

}  // namespace standoff
