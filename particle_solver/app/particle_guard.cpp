#include "particle_solver/app/particle_guard.hpp"

#include <fmt/format.h>

#include "coupling/base/stop.hpp"

namespace standoff::particles {

void guard_particle_energy(const CaseSpec& spec, const ParticleEnergy& now, double open_share, double time) {
  if (open_share <= largest_open_share) return;
  const double full = spec.copies();
  throw Stop(
      ExitCode::guard,
      fmt::format(
          "particles: the energy books are open by {:.3g} % at t = {:.4g} us; limit {:.0f} %\n"
          "  gas {:.4g} J, sand in motion {:.4g} J, in springs {:.4g} J, given to the plate {:.4g} J (full scene)\n"
          "  contacts of the sand are too short for its step, or overlaps beyond what its springs can mean: use\n"
          "  smaller soil.damping and soil.friction, or more soil.particles",
          100.0 * open_share, 1e6 * time, 100.0 * largest_open_share, full * (now.gas_kinetic + now.gas_internal),
          full * now.sand_kinetic, full * now.sand_elastic, full * now.work_to_structure));
}

void guard_surface(const BoundaryTotals& totals, const CarriedGas& carried, long particles, double window,
                   double time) {
  const long behind = totals.slipped + carried.particles;
  if (static_cast<double>(behind) <= largest_passed_share * static_cast<double>(particles)) return;
  const Vec3& at = totals.slipped > 0 ? totals.last_slip : carried.last;
  throw Stop(
      ExitCode::guard,
      fmt::format("particles: {} of {} particles have passed through the plate at t = {:.4g} us; {} of them were "
                  "set back on it\n"
                  "  one of them at ({:.1f}, {:.1f}, {:.1f}) mm\n"
                  "  the plate moves by more than a particle between two exchanges: use a shorter "
                  "coupling.window than {:.4g} us; \"auto\" chooses one",
                  behind, particles, 1e6 * time, carried.particles, 1e3 * at.x, 1e3 * at.y, 1e3 * at.z, 1e6 * window));
}

}  // namespace standoff::particles
