#pragma once
// Stage boundaries: takes out particles that can no longer matter and books what they carry; in a closed box turns
// grains round at its walls (gas and air meet the walls in flight, reflecting_planes.hpp).
//
// Out is a particle that (1) left the domain's box; with a quarter model x = 0 and y = 0 are mirrors, not exits, and
// in a scene that repeats only the ends in z are; (2)
// passed the plane of the plate's edge by one radius outside the sheet's outline, which is how gas gets behind an open
// plate; or (3) is deeper than one radius below the lowest point of the sheet: it slipped through, which is counted
// apart because it should not happen. Of a pipe only (1) holds. The others keep their order. Momentum and energy of
// what left go to BoundaryBooks, its last rebound from the plate to the totals here, so that sums over all particles
// stay complete.
#include <cstdint>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

struct BoundaryOptions {
  Vec3 lower, upper;  // m, domain box
  bool quarter = false;
  int threads = 1;
  bool closed = false;   // the box has walls that reflect
  bool repeats = false;  // the scene repeats across x and y: no way out there
};

/// What one call took out: indices before the removal, ascending; for lists that others keep by index.
struct BoundaryChanges {
  std::vector<std::uint32_t> gas, sand;
  bool any() const { return !gas.empty() || !sand.empty(); }
};

/// Since the start.
struct BoundaryTotals {
  long gas = 0, sand = 0;                        // particles taken out
  long slipped = 0;                              // of these, below the sheet inside its outline
  Vec3 last_slip;                                // m, where one of these was
  double sand_mass = 0.0;                        // kg; they are beyond every front radius
  double gas_rebound = 0.0, sand_rebound = 0.0;  // kg m/s, last plate rebound of particles taken out
  double gas_energy = 0.0,
         sand_energy = 0.0;  // J that products and sand carried out; the rest of what escaped is air's
};

class Boundaries {
 public:
  explicit Boundaries(const BoundaryOptions& options);
  /// `gas`, `sand`, `sheet` may be null. Call when nobody holds indices into the arrays.
  const BoundaryChanges& run(GasState* gas, SandState* sand, const SurfaceSheet* sheet, BoundaryBooks& books);
  /// Takes the gas particles named by `out` (ascending) out and books them.
  void take_out(GasState& gas, const std::vector<std::uint32_t>& out, BoundaryBooks& books);
  void take_out(SandState& sand, const std::vector<std::uint32_t>& out, BoundaryBooks& books);
  const BoundaryTotals& totals() const { return totals_; }
  template <class Archive>
  void archive(Archive& a) {
    a(totals_);
  }

 private:
  struct Limits {
    Vec3 lower, upper;            // box, mirrors opened
    double outline_x, outline_y;  // half widths of the sheet with its surround
    double edge_height, lowest;   // m
  };
  Limits limits(const SurfaceSheet* sheet) const;
  template <class State>
  void find(const State& state, const Limits& limits, std::vector<std::uint32_t>& out);
  Vec3 turn_round(SandState& sand) const;

  BoundaryOptions options_;
  BoundaryTotals totals_;
  BoundaryChanges changes_;
  std::vector<std::vector<std::uint32_t>> found_;  // by thread
  std::vector<std::vector<std::uint32_t>> slips_;  // by thread, of these
};

}  // namespace standoff::particles
