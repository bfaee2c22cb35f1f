// Law: both sides of the interface take the same impulse P_k of window k at a surface node, and book its work at
// different speeds. The load side knows the motion v_k that came last and answers with the mass m of the node; the
// plate books the mean speed w of the window in which it takes P_k:
//   given - received = sum_k P_k . ( v_k + (s P_(k-1) + P_k/2) / m - w ),   s = 1 parallel, 0 serial
// The bracket is how far the surface is from free within the s + 1/2 windows between v_k and w: the metal behind the
// nodes holds them back. It is positive and, for windows H that are short for the nodes of the loaded face, of first
// order: (s + 1/2) H sum of f . (f/m - a), a the acceleration. So half the window halves it, and the parallel scheme
// has three times that of the serial one. Both up to terms of the next order in H w_max, 2/w_max the stable step: 0.09
// here.
#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using namespace testing;

/// given - received, over received, of a pressure that lasts 1.6 us on a plate at rest.
double work_error(double window, bool parallel) {
  CaseSpec spec = plate_case(4, true);
  spec.coupling.window_rule = CouplingSpec::Window::fixed, spec.coupling.window = window;
  PlateHex64 plate(spec, 1);
  const std::vector<Vec3> force = pressure_force(plate.plate().mesh(), 50e6), none(force.size());
  const std::vector<double>& mass = plate.surface().node_mass;
  SurfaceMotion motion;
  plate.surface_motion(motion);
  double given = 0.0;
  const auto windows = std::lround(1.6e-6 / window);
  for (long k = 0; k < windows; ++k) {
    for (std::size_t n = 0; n < force.size(); ++n) {
      const Vec3 impulse = force[n] * window, pending = parallel && k > 0 ? impulse : Vec3{};
      given += dot(impulse, motion.velocity[n] + (pending + impulse * 0.5) * (1.0 / mass[n]));
    }
    plate.set_surface_force(parallel && k == 0 ? none : force);
    plate.step(window);
    plate.surface_motion(motion);
  }
  if (parallel) plate.step(window);
  return given / plate.ledger().external_work - 1.0;
}

TEST(InterfaceWork_OfShortWindows, ErrsByFirstOrderAndThreeTimesAsMuchInTheParallelScheme) {
  const double window = 6.25e-9;
  const double serial = work_error(window, false), half = work_error(0.5 * window, false);
  const double parallel = work_error(window, true), half_parallel = work_error(0.5 * window, true);
  EXPECT_GT(half, 0.0);
  EXPECT_NEAR(serial / half, 2.0, 0.18);
  EXPECT_NEAR(parallel / half_parallel, 2.0, 0.18);
  EXPECT_NEAR(half_parallel / half, 3.0, 0.27);
}

}  // namespace
}  // namespace standoff::structure
