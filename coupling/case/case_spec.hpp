#pragma once
// A validated case in SI. Everything a solver may know about its scene is here; nothing in it is a string to be parsed
// again. Built by read_case (case_reader.hpp); the tables of keys, quantities and defaults are in schema.cpp.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff {

/// Detonation products as a gas of spheres [Borvik 2011, sec. 3.2].
struct Explosive {
  std::string name;
  double density = 0.0;           // kg/m3, before detonation
  double energy = 0.0;            // J/m3 of explosive
  double gamma = 0.0;             // ratio of specific heats of the dilute products, 1 < gamma <= 5/3
  double fill = 0.0;              // volume of the spheres over volume of the explosive: the co-volume
  double detonation_speed = 0.0;  // m/s
  friend bool operator==(const Explosive&, const Explosive&) = default;
};

struct ChargeSpec {
  bool present = false;
  Explosive explosive;
  double mass = 0.0;    // kg, full charge
  double radius = 0.0;  // m; mass and radius are independent inputs
  double length = 0.0;  // m; > 0: a cylinder about the z axis of this length, else a ball
  Vec3 detonator;       // m, point of ignition in the global frame
  long particles = 0;   // full charge
  friend bool operator==(const ChargeSpec&, const ChargeSpec&) = default;
};

enum class SoilKind { none, dry, wet };

enum class SoilShape { shell, sphere, cylinder, box };

/// Sand as a packed cell of spheres repeated and cut to a body [Borvik 2011, sec. 3.3]; its geometry is soil_body.hpp.
struct SoilSpec {
  SoilKind kind = SoilKind::none;
  SoilShape shape = SoilShape::shell;
  double inner_radius = 0.0, outer_radius = 0.0;  // m: cavity about the charge centre; shell, sphere or cylinder
  double height = 0.0;                            // m, cylinder
  Vec3 size;                                      // m, box
  Vec3 centre;                                    // m, of all but the shell, which lies about the charge centre
  double packing = 0.0;                           // solid fraction of the cell
  double grain_density = 0.0;                     // kg/m3
  double bulk_density = 0.0;                      // kg/m3; = packing * grain_density
  double stiffness = 0.0;                         // k0, N/m for a cell of 1 m; k = (L/L0) k0
  double friction = 0.0;                          // Coulomb coefficient; 0 stores no tangential history
  double damping = 0.0;                           // fraction of critical, c = 2 xi sqrt(k m)
  double radius_spread = 0.0;                     // relative half width of the radius distribution
  long particles = 0;                             // full body
  friend bool operator==(const SoilSpec&, const SoilSpec&) = default;
};

/// The unit cell of the soil as a material test; see `standoff cell`.
struct CellSpec {
  long grains = 1000;     // of one cell [Borvik 2011, sec. 3.3]
  long cells = 5;         // samples, seeds run.seed, run.seed + 1, ...
  double strain = 0.135;  // engineering strain along one axis at the end; lateral lengths stay, so it is that of volume
  long points = 27;       // rows after the one at zero strain
  long steps = 20000;     // of the compression
  friend bool operator==(const CellSpec&, const CellSpec&) = default;
};

/// Box that air.particles counts for [Borvik 2011, sec. 3.2], m3.
inline constexpr double nominal_air_volume = 0.9;
/// Particles in a cell of still air. Two are the fewest that collide; a shock brings six times as many. More would blur
/// the front over larger cells: a cell is the resolution.
inline constexpr double particles_an_air_cell = 2.0;

struct AirSpec {
  bool on = false;
  double pressure = 101300.0, density = 1.3, gamma = 1.4;
  long particles = 0;  // in the nominal 0.9 m3
  friend bool operator==(const AirSpec&, const AirSpec&) = default;
};

struct DomainSpec {
  Vec3 lower, upper;  // m; particles that leave are removed and booked
  std::string boundaries = "open";
  bool closed() const { return boundaries == "reflecting"; }
  bool repeats() const { return boundaries == "periodic"; }
  /// Lengths after which the scene repeats, 0 along an axis: it does not.
  Vec3 period() const { return repeats() ? Vec3{upper.x - lower.x, upper.y - lower.y, 0.0} : Vec3{}; }
  friend bool operator==(const DomainSpec&, const DomainSpec&) = default;
};

/// Sand on the plate: a restitution in 0..1, or the soil's own spring law.
struct ContactSpec {
  bool surface_law_is_soil = false;
  double surface_restitution = 0.0;
  double surface_friction = 0.0;
  friend bool operator==(const ContactSpec&, const ContactSpec&) = default;
};

enum class MaterialLaw {
  johnson_cook,      // (A + B p^n)(1 + rate)^C (1 - T*^m)
  johnson_cook_log,  // the original rate term 1 + C ln(rate)
  j2_table,          // straight lines between points instead of A + B p^n
  elastic,           // no yield
};

/// Constants of a plate material; see structure_solver/materials for the laws.
struct MaterialSpec {
  MaterialLaw law = MaterialLaw::johnson_cook;
  std::string name, source;
  double density = 0.0, youngs_modulus = 0.0, poissons_ratio = 0.0;
  double A = 0.0, B = 0.0, n = 1.0;                                           // Pa, Pa, -: (A + B p^n)
  double C = 0.0, reference_rate = 1.0;                                       // -, 1/s
  double m = 1.0, room_temperature = 293.0, melting_temperature = 1e4;        // -, K, K
  std::vector<double> plastic_strain, flow_stress;                            // -, Pa: the points of a table
  double specific_heat = 0.0, taylor_quinney = 0.0, thermal_expansion = 0.0;  // J/kgK, -, 1/K
  friend bool operator==(const MaterialSpec&, const MaterialSpec&) = default;
};

/// A pipe about the z axis from z = 0 to its length, loaded from inside; see model pipe_hex64.
struct PipeSpec {
  double inner_diameter = 0.0, wall = 0.0, length = 0.0;  // m
  friend bool operator==(const PipeSpec&, const PipeSpec&) = default;
};

struct PlateSpec {
  std::string model = "plate_hex64";
  MaterialSpec material;
  PipeSpec pipe;
  Vec3 size;                               // m: width x, width y, thickness; of a pipe: its wall unrolled
  std::array<int, 3> elements{10, 10, 1};  // full plate; of a pipe: round, along, through the wall
  std::string edges = "clamped";           // "clamped" | "pinned" | "free" | "symmetry" | "bolted"
  double opening = 0.0;                    // m, side of the square opening of a frame; with "bolted"
  std::string surround = "rigid";          // "rigid" | "open"
  double surround_size = 0.613;            // m, side of the square cover plate
  bool is_pipe() const { return pipe.inner_diameter > 0.0; }
  friend bool operator==(const PlateSpec&, const PlateSpec&) = default;
};

struct RunSpec {
  double stand_off = 0.0;  // m, charge centre to loaded face
  double until = 0.0;      // s, end of the particle phase
  bool settle = true;      // damped relaxation to rest afterwards
  std::uint64_t seed = 1;
  bool quarter_symmetry = true;
  friend bool operator==(const RunSpec&, const RunSpec&) = default;
};

enum class Scheme { parallel, serial };
struct CouplingSpec {
  Scheme scheme = Scheme::parallel;
  enum class Window { structure_step, fixed, automatic } window_rule = Window::automatic;
  double window = 0.0;  // s, with Window::fixed
  friend bool operator==(const CouplingSpec&, const CouplingSpec&) = default;
};

struct ObserveSpec {
  double interval = 5e-6;      // s between rows of histories.csv
  long snapshots = 20;         // frames of the PVD series over the particle phase
  std::vector<double> probes;  // m along a pipe: where the speed of its wall is recorded
  friend bool operator==(const ObserveSpec&, const ObserveSpec&) = default;
};

/// One decision of the scene: an effect that is off costs no memory, no time and no timer row.
struct EffectDecision {
  std::string name;  // "friction", "damping", "heating", ...
  bool on = false;
  std::string reason;  // a sentence with its numbers, printed by `standoff plan`
  bool overridden = false;
  friend bool operator==(const EffectDecision&, const EffectDecision&) = default;
};

/// Published and measured figures shown beside ours; from reference.toml of the case.
struct ReferenceValue {
  std::string quantity;  // key below "results." of run.json
  std::string source;    // "paper, 10k/50k", "test", ...
  double value = 0.0;    // SI
  friend bool operator==(const ReferenceValue&, const ReferenceValue&) = default;
};

struct CaseSpec {
  std::string name, title, question, source;
  std::string folder;               // where case.toml lies
  std::string level;                // chosen level, "" when the case has none
  std::vector<std::string> levels;  // all names, in order
  ChargeSpec charge;
  SoilSpec soil;
  CellSpec cell;
  AirSpec air;
  DomainSpec domain;
  ContactSpec contact;
  PlateSpec plate;
  RunSpec run;
  CouplingSpec coupling;
  ObserveSpec observe;
  std::vector<EffectDecision> effects;  // every effect that exists, decided
  std::vector<ReferenceValue> references;

  /// True if the scene calls for effect `name`; throws std::out_of_range for a name that does not exist.
  bool effect(const std::string& effect_name) const;
  /// Number of copies of the simulated part in the full domain: 4 or 1.
  int copies() const { return run.quarter_symmetry ? 4 : 1; }
  friend bool operator==(const CaseSpec&, const CaseSpec&) = default;
};

}  // namespace standoff
