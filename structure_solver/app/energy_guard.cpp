#include "structure_solver/app/energy_guard.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"

namespace standoff::structure {
namespace {

bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Where the surface moves fastest: an instability starts there.
std::string fastest_place(const StructuralModel& model) {
  SurfaceMotion motion;
  model.surface_motion(motion);
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < motion.velocity.size(); ++i) {
    if (!is_finite(motion.velocity[i])) {
      fastest = i;
      break;
    }
    if (norm(motion.velocity[i]) > norm(motion.velocity[fastest])) fastest = i;
  }
  const Vec3& at = model.surface().position[fastest];
  return fmt::format("surface node {} at ({:.1f}, {:.1f}) mm moves fastest, with {:.3g} m/s", fastest, 1e3 * at.x,
                     1e3 * at.y, norm(motion.velocity[fastest]));
}

}  // namespace

void guard_energy(const CaseSpec& spec, const StructuralModel& model, const StructureLedger& books, double peak_work) {
  const Vec3& size = spec.plate.size;
  const double volume = size.x * size.y * size.z / spec.copies();
  const double strained = 0.5 * spec.plate.material.youngs_modulus * 1e-6 * volume;
  const double balance = books.balance();
  const double share = balance < 0.0 ? largest_made_share : largest_lost_share;
  if (std::abs(balance) <= share * std::max(peak_work, strained)) return;
  const double full = spec.copies();
  throw Stop(
      ExitCode::guard,
      fmt::format(
          "structure: the energy books are open: {:.4g} J {} at t = {:.4g} us\n"
          "  external work {:.4g} J, kinetic {:.4g} J, elastic {:.4g} J, plastic {:.4g} J (full plate); limit "
          "{:.0f} %\n"
          "  {}\n"
          "  the step is too long for the plate as it is, or a hit yields within one step: use more particles or\n"
          "  fewer elements so that a hit loads more of the plate at once, or another coupling.window, \"auto\" best",
          full * std::abs(balance), balance < 0.0 ? "came from nowhere" : "are missing", 1e6 * model.time(),
          full * books.external_work, full * books.kinetic, full * books.elastic, full * books.plastic, 100.0 * share,
          fastest_place(model)));
}

bool can_be_shown(const StructureFrame& frame) {
  return std::ranges::all_of(frame.position, is_finite);
}

}  // namespace standoff::structure
