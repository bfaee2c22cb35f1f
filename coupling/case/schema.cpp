#include "coupling/case/schema.hpp"

#include <algorithm>

#include "coupling/case/structural_models.hpp"

namespace standoff {
namespace {

using enum KeyKind;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range any{};
constexpr Range positive{0.0, infinity, true, false};
constexpr Range not_negative{0.0, infinity, false, false};
constexpr Range fraction{0.0, 1.0, false, false};
constexpr Range packing_limit{0.0, 0.74, true, false};
constexpr Range count_of_particles{1.0, 2e9, false, false};

constexpr KeyEntry entries[] = {
    // ---- what the case is ----
    {"case.name", text, quantity::none, any, "", "",
     "Name used in tables and run folders; the folder's name if not given."},
    {"case.title", text, quantity::none, any, "", "", "One line that says what is computed."},
    {"case.question", text, quantity::none, any, "", "", "What the case is meant to answer."},
    {"case.source", text, quantity::none, any, "", "", "Where scene and figures come from."},
    {"case.level", text, quantity::none, any, "", "",
     "Level taken when the command line names none; otherwise \"coarse\" if there is one, else the first."},

    // ---- explosive ----
    {"charge.mass", KeyKind::quantity, quantity::mass, positive, "", "", "Mass of the full charge.",
     "[Borvik 2011, sec. 2]: 150 g"},
    {"charge.radius", KeyKind::quantity, quantity::length, positive, "", "",
     "Radius of the charge sphere; from mass and density if not given. Mass and radius are independent inputs."},
    {"charge.length", KeyKind::quantity, quantity::length, positive, "", "",
     "Length of a charge that is a cylinder about the z axis, its centre at the stand-off; a ball if not given. Its "
     "gas "
     "spheres lie inside the radius, as in a casing."},
    {"charge.detonator", quantities, quantity::length, any, "far pole|centre", "far pole",
     "Point of ignition: \"far pole\" (the pole of the charge farthest from the plate), \"centre\", or [x, y, z].",
     "[Borvik 2011, sec. 2]"},
    {"charge.particles", count, quantity::none, count_of_particles, "", "10000",
     "Gas particles of the full charge; usually set by the level."},
    {"charge.explosive.preset", choice, quantity::none, any, "c4|c4_paper", "",
     "Named set of constants that the other keys of the table may change. explosive = \"c4\" is short for it."},
    {"charge.explosive.name", text, quantity::none, any, "", "custom", "Name shown in reports."},
    {"charge.explosive.density", KeyKind::quantity, quantity::density, positive, "", "", "Density before detonation.",
     "[Borvik 2011, sec. 3.2]"},
    {"charge.explosive.energy", KeyKind::quantity, quantity::energy_density, positive, "", "",
     "Internal energy set free per volume of explosive.", "[Borvik 2011, sec. 3.2]"},
    {"charge.explosive.gamma",
     number,
     quantity::none,
     {1.0, 5.0 / 3.0, true, false},
     "",
     "",
     "Ratio of specific heats of the dilute products; 5/3 is a gas without internal energy.",
     "[Borvik 2011, sec. 3.2]"},
    {"charge.explosive.fill",
     number,
     quantity::none,
     {0.0, 0.74, false, false},
     "",
     "",
     "Volume of the gas spheres over the volume of explosive: the co-volume. Spheres cannot fill more than 0.74.",
     "[Borvik 2011, sec. 3.2]: 0.35; 0.20 with exact contact times"},
    {"charge.explosive.detonation_speed", KeyKind::quantity, quantity::speed, positive, "", "",
     "Speed of the front that releases the gas particles.", "[Borvik 2011, sec. 3.2]"},

    // ---- sand ----
    {"soil.kind", choice, quantity::none, any, "none|dry|wet", "none",
     "Sand about the charge. dry and wet bring the base parameters of the paper.", "[Borvik 2011, sec. 3.3]"},
    {"soil.body", choice, quantity::none, any, "shell|sphere|cylinder|box", "shell",
     "Shape that is filled with sand: a shell about the charge centre; a ball, a cylinder with its axis along z or a "
     "box, "
     "each about soil.centre."},
    {"soil.inner_radius", KeyKind::quantity, quantity::length, not_negative, "", "",
     "Radius of the cavity for the charge, about the charge centre. A shell states it; other bodies have none if it is "
     "not "
     "given."},
    {"soil.outer_radius", KeyKind::quantity, quantity::length, positive, "", "",
     "Outer radius of the shell, sphere or cylinder of sand."},
    {"soil.height", KeyKind::quantity, quantity::length, positive, "", "", "Height of a cylinder of sand, along z."},
    {"soil.size", quantities, quantity::length, positive, "", "", "Edges of a box of sand along x, y and z."},
    {"soil.centre", quantities, quantity::length, any, "", "",
     "Centre of a sphere, cylinder or box of sand; that of the charge, [0, 0, stand_off], if not given."},
    {"soil.packing", number, quantity::none, packing_limit, "", "",
     "Solid fraction of the cell; no packing of equal spheres exceeds 0.74.", "[Borvik 2011, sec. 3.3]"},
    {"soil.grain_density", KeyKind::quantity, quantity::density, positive, "", "",
     "Density of a grain; bulk_density / packing if only that is given."},
    {"soil.bulk_density", KeyKind::quantity, quantity::density, positive, "", "",
     "Density of the sand as a body; packing * grain_density if only that is given.", "[Borvik 2011, sec. 3.3]"},
    {"soil.stiffness", KeyKind::quantity, quantity::stiffness, positive, "", "",
     "Contact stiffness k0 for a cell of 1 m; k = (L/L0) k0 for a cell of side L.", "[Borvik 2011, sec. 3.3]"},
    {"soil.friction",
     number,
     quantity::none,
     {0.0, 10.0, false, false},
     "",
     "",
     "Coulomb coefficient between grains; 0 stores no tangential history.",
     "[Borvik 2011, sec. 3.3]"},
    {"soil.damping", number, quantity::none, fraction, "", "",
     "Normal dashpot as a fraction of critical, c = 2 xi sqrt(k m).", "[Borvik 2011, sec. 3.3]"},
    {"soil.radius_spread",
     number,
     quantity::none,
     {0.0, 0.5, false, false},
     "",
     "",
     "Relative half width of the distribution of grain radii.",
     "[Borvik 2011, sec. 3.3]"},
    {"soil.particles", count, quantity::none, count_of_particles, "", "50000",
     "Grains of the full body; usually set by the level."},

    // ---- the unit cell of the sand as a material test ----
    {"cell.grains",
     count,
     quantity::none,
     {10.0, 1e6, false, false},
     "",
     "1000",
     "Grains of one periodic cell.",
     "[Borvik 2011, sec. 3.3]"},
    {"cell.cells",
     count,
     quantity::none,
     {1.0, 1000.0, false, false},
     "",
     "5",
     "Cells that are packed and compressed, with seeds run.seed, run.seed + 1, ...; their mean is reported."},
    {"cell.strain",
     number,
     quantity::none,
     {0.0, 0.5, true, false},
     "",
     "0.135",
     "Engineering strain at the end; lateral lengths stay, so that it is the change of volume.",
     "[Borvik 2011, figs. 11 and 13]"},
    {"cell.points",
     count,
     quantity::none,
     {1.0, 10000.0, false, false},
     "",
     "27",
     "Rows of the stress-strain table after the one at zero strain."},
    {"cell.steps",
     count,
     quantity::none,
     {100.0, 1e8, false, false},
     "",
     "20000",
     "Steps of the compression; it must stay quasi-static, so fewer only for a quick look."},

    // ---- air ----
    {"air.mode", choice, quantity::none, any, "off|on", "off", "Ambient air around charge and plate."},
    {"air.pressure", KeyKind::quantity, quantity::pressure, positive, "", "101300 Pa", "Ambient pressure.",
     "[Borvik 2011, sec. 3.2]: 0.25325 MJ/m3 with gamma 1.4"},
    {"air.density", KeyKind::quantity, quantity::density, positive, "", "1.3 kg/m3", "Ambient density.",
     "[Borvik 2011, sec. 3.2]"},
    {"air.gamma",
     number,
     quantity::none,
     {1.0, 5.0 / 3.0, true, false},
     "",
     "1.4",
     "Ratio of specific heats of air.",
     "[Borvik 2011, sec. 3.2]"},
    {"air.particles", count, quantity::none, count_of_particles, "", "500000",
     "Air particles in a box of 0.9 m3; another box keeps the number density. Air that stands still costs nothing."},

    // ---- where particles live ----
    {"domain.size", quantities, quantity::length, positive, "", "",
     "Box in x, y and z: centred on the axis, its lower end 0.2 m behind the loaded face."},
    {"domain.lower", quantities, quantity::length, any, "", "",
     "Lower corner of the box. If nothing is given the box reaches 0.6 m to each side, 0.2 m behind the loaded face "
     "and 0.8 m beyond the charge."},
    {"domain.upper", quantities, quantity::length, any, "", "", "Upper corner of the box; see domain.lower."},
    {"domain.boundaries", choice, quantity::none, any, "open|reflecting|periodic", "open",
     "What happens at the box: open removes and books what leaves (and lets ambient air in), reflecting turns it "
     "round, periodic repeats the scene across x and y (its ends in z stay open)."},
    {"contact.surface_restitution", number, quantity::none, fraction, "soil", "0",
     "Grain against plate: 0 stops the normal motion, 1 reflects it, \"soil\" uses the soil's own spring law.",
     "Holloman et al. 2015: wet glass sand on a rigid block transmits 1.0 to 1.1 times its momentum"},
    {"contact.surface_friction", number, quantity::none, fraction, "soil", "0",
     "Coulomb coefficient of a grain on the plate, 0 to 1; \"soil\" takes soil.friction."},

    // ---- plate ----
    {"plate.model", choice, quantity::none, any, structural_model_words, "plate_hex64",
     "Structural model by name; see `standoff models`.", "[Borvik 2011, sec. 3.4]"},
    {"plate.size", quantities, quantity::length, positive, "", "", "Exposed width in x, width in y, thickness.",
     "[Borvik 2011, sec. 2]: 406 mm, 406 mm, 3.4 mm"},
    {"plate.elements",
     counts,
     quantity::none,
     {1.0, 10000.0, false, false},
     "",
     "[10, 10, 1]",
     "Elements of the full plate along x, y and through the thickness; usually set by the level."},
    {"plate.edges", choice, quantity::none, any, "clamped|pinned|free|symmetry|bolted", "clamped",
     "How the edges are held: not moving at all, free to turn but not to slide, free, mirror planes along which they "
     "slide, or bolted in a frame on both faces. The ends of a pipe: free (its default), clamped, or symmetry, which "
     "keeps its length (plane strain).",
     "[Borvik 2011, sec. 2]"},
    {"plate.opening", KeyKind::quantity, quantity::length, positive, "", "",
     "Side of the square opening of the frame, with edges = \"bolted\": beyond it both faces of the plate are held."},
    {"plate.surround", choice, quantity::none, any, "rigid|open", "rigid",
     "What surrounds the exposed plate: a rigid wall (the cover plate) or nothing."},
    {"plate.surround_size", KeyKind::quantity, quantity::length, positive, "", "613 mm",
     "Side of the square wall around the plate; what passes behind it is removed and booked.", "[Borvik 2011, sec. 2]"},
    {"plate.pipe.inner_diameter", KeyKind::quantity, quantity::length, positive, "", "",
     "Of model pipe_hex64: a pipe about the z axis from z = 0.", "[Borvik 2011, sec. 3.2]: 25.43 mm"},
    {"plate.pipe.wall", KeyKind::quantity, quantity::length, positive, "", "", "Thickness of the wall of the pipe.",
     "[Borvik 2011, sec. 3.2]: 2.593 mm"},
    {"plate.pipe.length", KeyKind::quantity, quantity::length, positive, "", "", "Length of the pipe.",
     "[Borvik 2011, sec. 3.2]: 300 mm"},
    {"plate.material.preset", choice, quantity::none, any, "al6xn|ofhc_copper", "",
     "Named set of constants that the other keys of the table may change. material = \"al6xn\" is short for it."},
    {"plate.material.name", text, quantity::none, any, "", "custom", "Name shown in reports."},
    {"plate.material.source", text, quantity::none, any, "", "", "Where the constants come from."},
    {"plate.material.density", KeyKind::quantity, quantity::density, positive, "", "", "Density."},
    {"plate.material.youngs_modulus", KeyKind::quantity, quantity::pressure, positive, "", "", "Young's modulus E."},
    {"plate.material.poissons_ratio",
     number,
     quantity::none,
     {0.0, 0.5, false, true},
     "",
     "",
     "Poisson's ratio; at 0.5 the volume cannot change and explicit steps become zero."},
    {"plate.material.law", choice, quantity::none, any, "johnson_cook|johnson_cook_log|j2_table|elastic",
     "johnson_cook",
     "Flow stress: (A + B p^n)(1 + rate)^C (1 - T*^m); the original rate term 1 + C ln(rate); a table of "
     "plastic_strain "
     "and flow_stress in place of A + B p^n; or no yield at all.",
     "[Borvik 2011, sec. 3.4]; Johnson and Cook 1985"},
    {"plate.material.plastic_strain", list, quantity::none, not_negative, "", "",
     "Points of a j2_table: plastic strains, rising from 0, at most 32."},
    {"plate.material.flow_stress", list, quantity::pressure, positive, "", "",
     "Points of a j2_table: flow stress at each plastic strain, nowhere falling; level after the last."},
    {"plate.material.A", KeyKind::quantity, quantity::pressure, positive, "", "",
     "Initial yield stress, A of A + B p^n."},
    {"plate.material.B", KeyKind::quantity, quantity::pressure, not_negative, "", "0 Pa", "Hardening, B of A + B p^n."},
    {"plate.material.n", number, quantity::none, positive, "", "1", "Hardening exponent, n of A + B p^n."},
    {"plate.material.C", number, quantity::none, not_negative, "", "0", "Strain-rate sensitivity; 0 is none."},
    {"plate.material.reference_rate", KeyKind::quantity, quantity::rate, positive, "", "1 1/s",
     "Plastic strain rate that the rate term is relative to."},
    {"plate.material.m", number, quantity::none, positive, "", "1", "Exponent of thermal softening, 1 - T*^m."},
    {"plate.material.room_temperature", KeyKind::quantity, quantity::temperature, positive, "", "293 K",
     "Temperature at rest, where softening begins."},
    {"plate.material.melting_temperature", KeyKind::quantity, quantity::temperature, positive, "", "10000 K",
     "Temperature at which no strength is left."},
    {"plate.material.specific_heat", KeyKind::quantity, quantity::specific_heat, positive, "", "500 J/(kg K)",
     "Specific heat."},
    {"plate.material.taylor_quinney", number, quantity::none, fraction, "", "0",
     "Share of plastic work that becomes heat; 0 is none."},
    {"plate.material.thermal_expansion", KeyKind::quantity, quantity::expansion, not_negative, "", "0 1/K",
     "Linear thermal expansion; 0 is none."},

    // ---- run ----
    {"run.stand_off", KeyKind::quantity, quantity::length, positive, "", "", "Charge centre to the loaded face.",
     "[Borvik 2011, sec. 2]: 150, 200, 250 mm"},
    {"run.until", KeyKind::quantity, quantity::time, positive, "", "",
     "End of the particle phase; 1 ms without sand, 2 ms with it, if not given.", "[Borvik 2011, sec. 3.4]"},
    {"run.settle", flag, quantity::none, any, "", "true", "Bring the plate to rest afterwards."},
    {"run.seed",
     count,
     quantity::none,
     {0.0, 9.2e18, false, false},
     "",
     "1",
     "Everything random follows from it; another seed is another sample of the same scene."},
    {"run.symmetry", choice, quantity::none, any, "quarter|none", "quarter",
     "Compute one quarter between mirror planes x = 0 and y = 0, or everything."},

    // ---- coupling and output ----
    {"coupling.scheme", choice, quantity::none, any, "parallel|serial", "parallel",
     "Both sides compute a window at once, or one after the other (the reference)."},
    {"coupling.window", KeyKind::quantity, quantity::time, positive, "auto|step", "auto",
     "Time between exchanges: \"auto\", \"step\" (one structure step, the paper's exchange), or a time."},
    {"observe.interval", KeyKind::quantity, quantity::time, positive, "", "5 us",
     "Time between rows of histories.csv."},
    {"observe.snapshots",
     count,
     quantity::none,
     {0.0, 100000.0, false, false},
     "",
     "20",
     "Frames of the ParaView series over the particle phase; 0 writes none."},
    {"observe.probes", list, quantity::length, not_negative, "", "",
     "Places along a pipe where radius and radial velocity of the outer wall are written to wall_velocity.csv.",
     "[Borvik 2011, figs. 8 and 9]"},
};

constexpr LevelKey keys_of_a_level[] = {{"charge", "charge.particles"},
                                        {"soil", "soil.particles"},
                                        {"air", "air.particles"},
                                        {"elements", "plate.elements"}};

}  // namespace

std::vector<std::string> KeyEntry::word_list() const {
  std::vector<std::string> list;
  for (std::string_view rest = words; !rest.empty();) {
    const std::size_t bar = rest.find('|');
    list.emplace_back(rest.substr(0, bar));
    rest = bar == std::string_view::npos ? "" : rest.substr(bar + 1);
  }
  return list;
}

std::span<const KeyEntry> schema() {
  return entries;
}
std::span<const LevelKey> level_keys() {
  return keys_of_a_level;
}

const KeyEntry* find_key(std::string_view path) {
  for (const KeyEntry& entry : entries)
    if (entry.path == path) return &entry;
  return nullptr;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const KeyEntry& entry : entries) {
    const std::string name(entry.section());
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  for (const char* name : {"effects", "levels", "references"}) names.emplace_back(name);
  return names;
}

std::vector<std::string> keys_of(std::string_view section) {
  std::vector<std::string> keys;
  if (section == "case") keys.emplace_back("use");
  if (section == "charge") keys.emplace_back("explosive");
  for (const KeyEntry& entry : entries)
    if (entry.section() == section) keys.emplace_back(entry.key());
  if (section == "plate") keys.emplace_back("material");
  if (section == "levels.NAME")
    for (const LevelKey& level : keys_of_a_level) keys.emplace_back(level.key);
  return keys;
}

std::string range_text(const KeyEntry& entry) {
  const Range& range = entry.range;
  const bool low = range.low > -infinity, high = range.high < infinity;
  const std::string key(entry.key());
  const auto end = [&](double value) { return readable_text(value, entry.quantity); };
  if (low && high)
    return end(range.low) + (range.low_open ? " < " : " <= ") + key + (range.high_open ? " < " : " <= ") +
           end(range.high);
  if (low) return key + (range.low_open ? " > " : " >= ") + end(range.low);
  if (high) return key + (range.high_open ? " < " : " <= ") + end(range.high);
  return "";
}

std::string describe_key(std::string_view key) {
  static constexpr std::string_view kinds[] = {"",
                                               "number",
                                               "count",
                                               "true or false",
                                               "text",
                                               "one of",
                                               "three values, each ",
                                               "three counts",
                                               "a list of values, each "};
  std::string text;
  for (const KeyEntry& entry : entries) {
    if (entry.path != key && entry.key() != key) continue;
    const bool dimensional = !entry.quantity.units.empty();
    text += std::string(entry.path) + "\n  " + std::string(entry.doc) + "\n  takes    " +
            std::string(kinds[static_cast<std::size_t>(entry.kind)]);
    if (dimensional) text += with_article(entry.quantity.name) + " (" + std::string(entry.quantity.units) + ")";
    for (const std::string& word : entry.word_list()) text += (entry.kind == choice ? " \"" : ", or \"") + word + "\"";
    if (const std::string range = range_text(entry); !range.empty()) text += "\n  range    " + range;
    if (!entry.fallback.empty()) text += "\n  default  " + std::string(entry.fallback);
    if (!entry.source.empty()) text += "\n  source   " + std::string(entry.source);
    text += "\n";
  }
  return text;
}

}  // namespace standoff
