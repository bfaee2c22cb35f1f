#include "coupling/case/presets.hpp"

namespace standoff {
namespace {

std::vector<PresetValue> c4(std::string_view name, std::string_view fill) {
  return {{"charge.explosive.name", name},          {"charge.explosive.density", "1601 kg/m3"},
          {"charge.explosive.energy", "8.7 GJ/m3"}, {"charge.explosive.gamma", "1.4"},
          {"charge.explosive.fill", fill},          {"charge.explosive.detonation_speed", "8190 m/s"}};
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      // With exact contact times a fill of 0.35 over-drives a cylinder test; 0.20 delivers the work of the JWL equation
      // of state by a sevenfold expansion.
      {"explosive", "c4", "C-4 with the co-volume calibrated for exact contact times", c4("c4", "0.20")},
      {"explosive", "c4_paper", "C-4 with the literal constants of [Borvik 2011, sec. 3.2]", c4("c4_paper", "0.35")},
      {"material",
       "al6xn",
       "AL-6XN stainless steel, modified Johnson-Cook [Borvik 2011, table 3]",
       {{"plate.material.name", "al6xn"},
        {"plate.material.source", "[Borvik 2011, table 3]"},
        {"plate.material.density", "8060 kg/m3"},
        {"plate.material.youngs_modulus", "195 GPa"},
        {"plate.material.poissons_ratio", "0.3"},
        {"plate.material.A", "410 MPa"},
        {"plate.material.B", "1902 MPa"},
        {"plate.material.n", "0.82"},
        {"plate.material.C", "0.024"},
        {"plate.material.reference_rate", "0.001 1/s"},
        {"plate.material.law", "johnson_cook"},
        {"plate.material.m", "1.03"},
        {"plate.material.room_temperature", "296 K"},
        {"plate.material.melting_temperature", "1700 K"},
        {"plate.material.specific_heat", "500 J/(kg K)"},
        {"plate.material.taylor_quinney", "0.9"},
        {"plate.material.thermal_expansion", "1.5e-5 1/K"}}},
      // What is not in the table of Johnson and Cook says so; no expansion.
      {"material",
       "ofhc_copper",
       "OFHC copper, original Johnson-Cook law [Johnson and Cook 1983, table 1]",
       {{"plate.material.name", "ofhc_copper"},
        {"plate.material.source",
         "Johnson and Cook, 7th Int. Symp. Ballistics, The Hague (1983) 541, table 1; again in Eng. Fract. Mech. 21 "
         "(1985) 31. Elastic constants, room temperature and heat share are not from there"},
        {"plate.material.density", "8960 kg/m3"},
        {"plate.material.youngs_modulus", "124 GPa", "usual value beside these constants; not in that table"},
        {"plate.material.poissons_ratio", "0.34", "usual value beside these constants; not in that table"},
        {"plate.material.law", "johnson_cook_log"},
        {"plate.material.A", "90 MPa"},
        {"plate.material.B", "292 MPa"},
        {"plate.material.n", "0.31"},
        {"plate.material.C", "0.025"},
        {"plate.material.reference_rate", "1 1/s"},
        {"plate.material.m", "1.09"},
        {"plate.material.room_temperature", "293 K", "20 C; assumed"},
        {"plate.material.melting_temperature", "1356 K"},
        {"plate.material.specific_heat", "383 J/(kg K)"},
        {"plate.material.taylor_quinney", "0.9", "usual value for metals; assumed"}}},
      {"soil",
       "dry",
       "dry glass microspheres, equal grains [Borvik 2011, sec. 3.3]",
       {{"soil.packing", "0.60"},
        {"soil.bulk_density", "1620 kg/m3"},
        {"soil.grain_density", "2700 kg/m3"},
        {"soil.stiffness", "0.4 GN/m"},
        {"soil.friction", "0.3"},
        {"soil.damping", "0"},
        {"soil.radius_spread", "0"}}},
      // Water is not modelled by particles: its mass is in the grains, 2020 / 0.64 kg/m3.
      {"soil",
       "wet",
       "saturated glass microspheres, radii +-2.5 % [Borvik 2011, sec. 3.3]",
       {{"soil.packing", "0.64"},
        {"soil.bulk_density", "2020 kg/m3"},
        {"soil.grain_density", "3156.25 kg/m3"},
        {"soil.stiffness", "4 GN/m"},
        {"soil.friction", "0"},
        {"soil.damping", "0.01"},
        {"soil.radius_spread", "0.025"}}}};
  return all;
}

const Preset* find_preset(std::string_view kind, std::string_view name) {
  for (const Preset& preset : presets())
    if (preset.kind == kind && preset.name == name) return &preset;
  return nullptr;
}

}  // namespace standoff
