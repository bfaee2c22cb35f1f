#pragma once
// Stage sand_pairs: contact forces between grains, and of grains with their images in the mirror planes.
//
// Velocity Verlet around it:   half_kick -> drift (one or several sub-steps, with gas hits) -> forces(dt) -> half_kick
// with dt the time since the last call. Forces are functions of where grains are and of the way they came: dashpot and
// tangential spring use displacements since the last call, not velocities, so gas hits on the way are seen as they
// happened.
//
//   sand arrays --copy in--> sorted records --pair lists by block--> forces --copy out--> SandState::force
//
// The order of the arrays in SandState is free and may change between calls; grains may be removed or added: springs
// follow the ids. What a removed grain's normal springs hold goes with it (escaped_elastic), its tangential springs are
// friction loss. Overlaps at the first call are springs like any other and part of the first reading of the ledger: see
// packing/relaxation.hpp for why they are small. Pair lists are made anew when grains moved more than a skin against
// their neighbours (search/grain_drift.hpp). The same bits for any number of threads.
#include <memory>
#include <optional>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/kernels/grain_contact.hpp"
#include "particle_solver/search/grain_history.hpp"
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

/// The law of a soil in a packed cell of edge `cell_size` [m]: k = (L/L0) k0 [Borvik 2011, sec. 3.3].
GrainLaw grain_law(const SoilSpec& soil, double cell_size);

/// 0.05 * 2 sqrt(m/k): a 22nd of the time that two grains touch; energy then holds to a few tenths of a percent.
double recommended_step(const GrainLaw& law, double mass);

struct SandPairsOptions {
  GrainLaw law;  // friction = 0: no tangential springs exist; damping = 0: no dashpot
  MirrorPlanes mirrors;
  std::optional<Vec3> periodic_box;  // m, lengths of a unit cell, or of a scene that repeats (z: 0)
  double skin = 0.0;                 // in mean diameters; 0: adapted to how often lists are made
  int threads = 1;
  bool turning = false;  // SandState::spin slides surfaces, SandState::torque is set; nothing without friction
};

/// Energies [J] and more, of the simulated part.
struct SandBooks {
  double elastic_energy = 0.0;           // stored now, normal and tangential springs
  double friction_loss = 0.0;            // since the start
  double damping_loss = 0.0;             // since the start
  double escaped_elastic = 0.0;          // since the start, in normal springs of grains that were taken out
  double max_overlap_over_radius = 0.0;  // since the start; over the mean radius
  double overlap_over_radius = 0.0;      // largest now
  Vec3 mirror_impulse;                   // N s given to the mirror planes since the start
  double coordination = 0.0;             // mean contacts of a grain now
  int most_contacts = 0;                 // on one grain now
  Vec3 virial;                           // J, periodic cells only: stress along an axis = virial / volume
  long list_builds = 0;
  template <class Archive>
  void archive(Archive& a) {
    a(elastic_energy, friction_loss, damping_loss, escaped_elastic, max_overlap_over_radius, overlap_over_radius,
      mirror_impulse);
    a(coordination, most_contacts, virial, list_builds);
  }
};

/// What a restart needs beside SandState to go on with the same bits; arrays in the order of SandState.
struct SandPairsMemory {
  std::vector<Vec3> list_position;  // m, where grains were when the present list was made
  std::vector<GrainSpring> springs;
  SandBooks books;
  double skin = 0.0;  // m
  long calls_since_list = 0;
  Vec3 mirror_force;  // N on the planes at the last call
  template <class Archive>
  void archive(Archive& a) {
    a(list_position, springs, books, skin, calls_since_list, mirror_force);
  }
};

/// A contact deeper than asked for, by indices of SandState: two grains, or a grain and its image in a mirror plane.
struct DeepContact {
  enum class With : std::uint8_t { grain, image_x, image_y };
  std::uint32_t i = 0, j = 0;  // j = i for an image
  With with = With::grain;
  Vec3 apart;  // m, two grains: from j to i, or to its nearest image
};

class SandPairs {
 public:
  explicit SandPairs(const SandPairsOptions& options);
  ~SandPairs();
  SandPairs(SandPairs&&) noexcept;

  /// Sets sand.force at sand.position; dt [s] is the time since the last call. The first call, forces(sand, 0), only
  /// sees overlaps: no displacement is known yet.
  void forces(SandState& sand, double dt);
  const SandBooks& books() const;
  const GrainLaw& law() const;
  /// Step for the present coordination [s]: recommended_step, and at most a quarter of the bound sqrt(2 m / (z k)) for
  /// the grain with most contacts (it binds above z = 12). Call after forces().
  double stable_step() const;
  /// Contacts at the positions of the last call of forces() whose centres are nearer than `share` of their reach, in an
  /// order that does not depend on threads. Looks only where that call met one.
  void deep_contacts(double share, std::vector<DeepContact>& contacts) const;
  /// Changes the lengths of the periodic box; grains keep their positions.
  void set_box(const Vec3& box);

  SandPairsMemory memory(const SandState& sand) const;
  /// Continues a run: `sand` and `memory` as they were after a call of forces().
  void restore(const SandState& sand, const SandPairsMemory& memory);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace standoff::particles
