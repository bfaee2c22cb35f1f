#pragma once
// The structural models: the choices of plate.model and what `standoff models` tells of each. One row a model;
// structure_solver/models/make_structural_model.cpp builds them by the same names, which a test compares.
#include <array>
#include <cstddef>
#include <string_view>

namespace standoff {

/// What a model resolves and what it leaves out: the choice of a user, so both sides are told.
struct StructuralModelEntry {
  std::string_view name;
  std::string_view doc, resolves, leaves_out;  // one sentence each
  /// Processor time of its windows over that of plate_hex64, and the steps of plate_hex64 over its own: medians of
  /// tests/validation/model_costs.py, on dry_150mm at level coarse. 0.01: no more than can be told from nothing. 0:
  /// there are no windows to cost anything.
  double relative_cost, relative_step;
  int points;                                                      // that keep a history, in an element of the case
  std::string_view edges = "clamped|pinned|free|symmetry|bolted";  // of plate.edges it knows
};

inline constexpr StructuralModelEntry structural_models[] = {
    {"plate_hex64", "Solid plate of cubic hexahedra with 64 nodes, explicit central differences.",
     "large deflection, membrane and bending waves, stress through the thickness; Johnson-Cook hardening, rate, "
     "heating and thermal expansion; the way to rest",
     "fracture, slip under the clamp", 1.0, 1.0, 64},
    {"plate_hex27", "Solid plate of quadratic hexahedra with 27 nodes, explicit central differences.",
     "what plate_hex64 resolves, with a longer step; stress through the thickness by three points",
     "hinges as narrow as those of plate_hex64 on the same elements; fracture, slip under the clamp", 0.24, 1.79, 27},
    {"plate_hex8",
     "Solid plate of 8-node hexahedra with assumed and enhanced strains, 3 x 3 to an element of the case.",
     "what plate_hex64 resolves, by low order: a longer step, a mesh of as many nodes on the face",
     "stress across the plate beyond its mean; fracture, slip under the clamp", 0.95, 3.57, 72},
    {"plate_shell", "Plate of 4-node shells (MITC4) with five layers, plane stress, explicit central differences.",
     "large deflection, membrane and bending waves, transverse shear; Johnson-Cook hardening, rate, heating and "
     "thermal "
     "expansion, thinning; the way to rest",
     "stress normal to the plate, waves through the thickness, the thickness under the load, fracture", 0.21, 4.05, 20,
     "clamped|pinned|free|symmetry"},
    {"rigid_plate", "The plate as one rigid body: held, or with free edges pushed along z by the load.",
     "the load: impulse and where it lands", "all deformation; held, the load is that on a plate that does not recede",
     0.01, 5.36, 0},
    {"single_dof", "The plate as one spring, mass and yield: hinges and a stretched sheet, closed form (Biggs, Jones).",
     "what an impulse does to a square plate, to a factor, in no time; hardening, rate and heating of the mean strain; "
     "the way to rest",
     "the shape of deflection and load, waves, local strain", 0.01, 5.36, 0, "clamped|pinned"},
    {"pipe_hex64", "Pipe of cubic hexahedra with 64 nodes, loaded from inside: the cylinder test.",
     "expansion of the wall at large strain, waves in it; Johnson-Cook hardening, rate, heating and thermal expansion",
     "fracture of the wall, which ends a test; gas leaves at the ends", 7.3, 0.174, 64, "free|clamped|symmetry"},
    {"material_point", "One point of the plate's material, without load: `standoff run` draws its flow curves.",
     "hardening, rate and temperature as the plate's elements compute them",
     "the plate, the charge and everything else", 0.0, 0.0, 0}};

/// The one entry that is no surface before a charge: `standoff run` draws curves for it instead.
inline constexpr std::string_view material_point_model = "material_point";
/// The one whose shape is plate.pipe instead of plate.size.
inline constexpr std::string_view pipe_model = "pipe_hex64";

namespace detail {
constexpr std::size_t joined_size() {
  std::size_t size = 0;
  for (const StructuralModelEntry& model : structural_models) size += model.name.size() + 1;
  return size - 1;
}
inline constexpr auto joined_names = [] {
  std::array<char, joined_size()> text{};
  std::size_t at = 0;
  for (const StructuralModelEntry& model : structural_models) {
    if (at > 0) text[at++] = '|';
    for (const char letter : model.name) text[at++] = letter;
  }
  return text;
}();
}  // namespace detail

/// The entry of a name; of the default where the name is none.
constexpr const StructuralModelEntry& structural_model(std::string_view name) {
  for (const StructuralModelEntry& model : structural_models)
    if (model.name == name) return model;
  return structural_models[0];
}

/// Whether `word` is one of `words`, which | separates.
constexpr bool is_one_of(std::string_view word, std::string_view words) {
  for (;;) {
    const std::size_t end = words.find('|');
    if (words.substr(0, end) == word) return true;
    if (end == std::string_view::npos) return false;
    words.remove_prefix(end + 1);
  }
}

/// "plate_hex64|rigid_plate|…", as the schema writes choices.
inline constexpr std::string_view structural_model_words{detail::joined_names.data(), detail::joined_names.size()};

}  // namespace standoff
