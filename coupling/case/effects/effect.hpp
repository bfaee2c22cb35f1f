#pragma once
// One effect of the physics, in a file of its own: what it is, the criterion by which a scene calls for it, its price,
// what a result misses without it, and how it is left out. registry.hpp lists them; [effects] of a case overrides.
//
// A criterion is physics with figures that can be evaluated before a run, never a list of cases.
#include <string>
#include <vector>

#include "coupling/case/case_spec.hpp"

namespace standoff {

/// What a rule finds in a scene.
struct EffectFinding {
  bool possible = true;  // false: the scene holds nothing this effect could act on; it cannot be switched on
  bool wanted = false;   // what the criterion says
  std::string reason;
};

/// What a run of the scene consists of, simulated part, one core: what prices are made of.
struct SceneWork {
  double gas = 0.0, grains = 0.0, air = 0.0, points = 0.0;  // particles; air awake at the end; Gauss points
  double sand_steps = 0.0;
  double gas_s = 0.0, air_s = 0.0, sand_s = 0.0, structure_s = 0.0, relaxation_s = 0.0, all_s = 0.0;  // s
  double copies = 1.0;  // full domain = copies x simulated part
};

/// Whose memory an effect adds to; `counted`: it is in the bytes of a particle or a Gauss point already.
enum class MemoryOf { counted, particles, structure };

struct EffectCost {
  double bytes = 0.0, seconds = 0.0;  // of one core; what the effect takes while it is on
  MemoryOf memory = MemoryOf::counted;
  bool more_seconds = false;  // the sand's seconds grow by these; else they, or the other rows of the price, hold them
};

struct Effect {
  const char* name;
  const char* doc;      // what it is
  const char* rule;     // when a scene calls for it, and by which figure
  const char* without;  // what a result misses when it is left out
  EffectFinding (*find)(const CaseSpec&);
  EffectCost (*cost)(const CaseSpec&, const SceneWork&) = nullptr;  // of the scene with it; null: free
  void (*leave_out)(CaseSpec&) = nullptr;  // takes it out of the specification, where solvers do not ask for it
  const char* needs = nullptr;             // the effect without which this one has nothing to act on
  bool inherent = false;                   // cannot be left out of a scene that calls for it
  bool in_a_cell = false;                  // acts between grains at rest, too: a unit cell of sand has it
  const char* switched_by = nullptr;       // the key that turns it on where [effects] alone cannot
  // What exists for this effect alone and is absent without it: stages of the time loops, columns of histories.csv,
  // keys of run.json's results.
  std::vector<std::string> stages{}, columns{}, results{};
};

namespace effects {

inline EffectFinding nothing(const char* why) {
  return {false, false, why};
}
inline bool has_sand(const CaseSpec& spec) {
  return spec.soil.kind != SoilKind::none;
}
inline bool yields(const CaseSpec& spec) {
  return spec.plate.material.law != MaterialLaw::elastic;
}

/// Rough figures of a scene for the criteria; factors of two do not matter.
struct Estimate {
  double mass = 0.0;        // kg, charge and sand
  double speed = 0.0;       // m/s, all energy as motion of all mass: sqrt(2 E / M)
  double arriving = 0.0;    // kg/m2, mass spread over the sphere of radius stand_off
  double plate = 0.0;       // kg/m2
  double wall_speed = 0.0;  // m/s, of the plate after a plastic impact of what arrives at its centre
  double rate = 0.0;        // 1/s, wall speed over the half width
  double heating = 0.0;     // K, if the plate's kinetic energy becomes plastic work: chi v^2 / (2 cp)
};
Estimate estimate(const CaseSpec& spec);
double soil_mass(const SoilSpec& soil);  // kg

}  // namespace effects
}  // namespace standoff
