#pragma once
// The particles of a scene as arrays, one struct a medium. No physics. Order in the arrays may change (sorting,
// removal); `id` stays with its particle and is what random numbers and ties are keyed by. `archive` lists everything.
//
// Inside a gas sub-step of length h a collision at time t in [0, h] changes a velocity and shifts the *starting point*
// back, x -= (v_new - v_old) t, so that x + v h is where the particle ends; gas_drift then does x += v h for
// everything.
#include <cstdint>
#include <map>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

/// What was given to particles that wait. Few have any at a time, those next to the front: kept by id.
class LatentImpulses {
 public:
  bool empty() const { return impulse_.empty(); }
  Vec3 of(std::uint32_t id) const {
    const auto found = impulse_.find(id);
    return found == impulse_.end() ? Vec3{} : found->second;
  }
  void add(std::uint32_t id, const Vec3& impulse) { impulse_[id] += impulse; }
  void forget(std::uint32_t id) { impulse_.erase(id); }
  template <class Archive>
  void archive(Archive& a) {
    std::vector<Entry> entries;
    for (const auto& [id, impulse] : impulse_) entries.push_back({impulse, id});
    a(entries);
    if constexpr (Archive::reading) {
      impulse_.clear();
      for (const Entry& entry : entries) impulse_[static_cast<std::uint32_t>(entry.id)] = entry.impulse;
    }
  }

 private:
  struct Entry {
    Vec3 impulse;
    std::uint64_t id = 0;
  };
  std::map<std::uint32_t, Vec3> impulse_;  // N s
};

/// Detonation products: equal hard spheres with a reservoir of internal energy. Air: points with one, see air.hpp.
struct GasState {
  double mass = 0.0;    // kg, one particle
  double radius = 0.0;  // m
  double gamma = 1.4;   // dilute ratio of specific heats; zeta = 2/(gamma-1) - 3 internal degrees of freedom
  std::vector<Vec3> position,
      velocity;                         // m, m/s; an unreleased particle stands still but keeps its velocity-to-be here
  std::vector<double> internal_energy;  // J per particle, >= 0
  std::vector<double> release_time;     // s; empty once all are released
  std::vector<std::uint8_t> released;   // 0/1; empty once all are released
  LatentImpulses latent_impulse;        // N s taken by unreleased particles, given back at release
  std::vector<double> plate_rebound;    // kg m/s towards the charge after the last contact with the plate; NaN before a
                                        // particle's first, empty before the first of all
  std::vector<std::uint8_t> disturbed;  // air: 1 once anything but still air has touched it; empty for products
  std::vector<std::uint32_t> id;
  std::size_t size() const { return position.size(); }
  bool all_released() const { return released.empty(); }
  template <class Archive>
  void archive(Archive& a) {
    a(mass, radius, gamma, position, velocity, internal_energy, release_time, released, latent_impulse, plate_rebound,
      disturbed, id);
  }
};

/// Grains: rigid spheres, which turn only where the effect grain_rotation is on. Velocity Verlet: half kick, drift
/// (with gas hits), forces, half kick.
struct SandState {
  double radius = 0.0, mass = 0.0;       // of every grain, or the mean when radii differ
  std::vector<double> grain_radius;      // m; empty when all are equal
  std::vector<double> grain_mass;        // kg; empty when all are equal
  std::vector<Vec3> position, velocity;  // m, m/s
  std::vector<Vec3> force;               // N, contact forces at `position`
  std::vector<Vec3> spin, torque;        // rad/s, N m of those forces about the centre; empty where grains do not turn
  std::vector<double> plate_rebound;     // as in GasState
  std::vector<std::uint32_t> id;
  std::size_t size() const { return position.size(); }
  double radius_of(std::size_t i) const { return grain_radius.empty() ? radius : grain_radius[i]; }
  double mass_of(std::size_t i) const { return grain_mass.empty() ? mass : grain_mass[i]; }
  template <class Archive>
  void archive(Archive& a) {
    a(radius, mass, grain_radius, grain_mass, position, velocity, force, plate_rebound, id, spin, torque);
  }
};

/// Mirror planes of a quarter model, x = 0 and y = 0: a grain touches its own image when its centre is one radius away;
/// the centres of gas particles reach the plane.
struct MirrorPlanes {
  bool on = false;
};

/// Impulse and energy booked outside the particles, simulated part only; see ledger/.
struct BoundaryBooks {
  Vec3 mirror_impulse;          // N s given to mirror planes and to walls of a closed box
  Vec3 surround_impulse;        // N s given to the rigid cover around the plate
  Vec3 escaped_momentum;        // kg m/s carried away
  double escaped_energy = 0.0;  // J, kinetic + internal
  Vec3 inflow_momentum;         // kg m/s brought in by ambient air, and N s of its pressure on the rear of the plate
  double inflow_energy = 0.0;   // J, likewise: energy of the air that came in plus the work of the rear pressure
};

}  // namespace standoff::particles
