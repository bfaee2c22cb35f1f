// The contact law of two grains [Borvik 2011, sec. 3.3], asked directly. Where a tolerance is given it is rounding: an
// expression of at most 30 operations on numbers of size 1 is good to 30 eps = 7e-15; 1e-13 leaves room for
// cancellation.
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "particle_solver/kernels/grain_contact.hpp"

namespace standoff::particles {
namespace {

constexpr double rounding = 1e-13;
using Input = GrainPairInput<double>;

/// A pair in contact or nearly so, moving in any direction, with a spring across the old normal.
Input random_pair(std::uint32_t number) {
  CounterRandom random(11, RandomUse::test, number);
  const auto about = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  Input in{{about(1.2), about(1.2), about(1.2)}, 2.0 * (0.7 + 0.3 * random.uniform()), {}, {}, 0.0};
  in.slip = {about(0.05), about(0.05), about(0.05)};
  in.spring = {about(0.1), about(0.1), about(0.1)};
  in.dashpot_per_step = 3.0 * random.uniform();
  return in;
}

TEST(GrainContact, WithDashpotAtAnySpeed_NeverPulls) {
  const GrainLaw law{1.0, 0.0, 0.5};
  int cut = 0;
  for (std::uint32_t n = 0; n < 2000; ++n) {
    const Input in = random_pair(n);
    const auto contact = grain_contact<false, true>(law, in);
    const double along = dot(contact.force, in.separation);
    EXPECT_GE(along, 0.0) << "pair " << n << ": " << along << " N m along the line of centres";
    EXPECT_GE(contact.damping_loss, -rounding) << "a dashpot may not give energy";
    if (contact.overlap > 0.0 && along == 0.0) ++cut;
  }
  EXPECT_GT(cut, 10) << "the sample must hold pairs that part fast enough to need the cut";
}

TEST(GrainContact, PushedSideways_SticksThenSlidesAtCoulombLimit) {
  // Overlap held at 0.01, slip 1e-4 a step, mu 0.3: the spring grows by 1e-4 to 0.3 * 0.01 = 3e-3 in 30 steps, then
  // stays.
  const GrainLaw law{2.0, 0.3, 0.0};
  Input in{{1.99, 0.0, 0.0}, 2.0, {0.0, 1e-4, 0.0}, {}, 0.0};
  for (int step = 1; step <= 60; ++step) {
    const auto contact = grain_contact<true, false>(law, in);
    const double expected = 2.0 * std::min(1e-4 * step, 3e-3);
    EXPECT_NEAR(contact.force.y, -expected, rounding) << "step " << step;
    EXPECT_NEAR(contact.friction_loss, step > 30 ? 2.0 * 3e-3 * 1e-4 : 0.0, rounding) << "step " << step;
    in.spring = contact.spring;
  }
}

TEST(GrainContact, PairTurnedInSpace_CarriesSpringAcrossNewNormalAtOldLength) {
  // The pair turns by 0.2 about z without slip across the contact: only the direction of the spring may change.
  const GrainLaw law{1.0, 10.0, 0.0};
  const double angle = 0.2;
  const Input in{{1.5 * std::cos(angle), 1.5 * std::sin(angle), 0.0}, 2.0, {}, {0.0, 0.02, 0.01}, 0.0};
  const auto contact = grain_contact<true, false>(law, in);
  EXPECT_NEAR(dot(contact.spring, in.separation), 0.0, rounding);
  EXPECT_NEAR(std::sqrt(dot(contact.spring, contact.spring)), std::sqrt(dot(in.spring, in.spring)), rounding);
  EXPECT_NEAR(contact.friction_loss, 0.0, rounding);
}

TEST(GrainContact, SlidingInAnyState_FrictionLossClosesTheWork) {
  // Trapezoidal work on the spring = change of stored energy + loss, for every state; see the header of the law.
  const GrainLaw law{3.0, 0.4, 0.0};
  for (std::uint32_t n = 0; n < 500; ++n) {
    Input in = random_pair(n);
    in.spring =
        add_scaled(in.spring, -dot(in.spring, in.separation) / dot(in.separation, in.separation), in.separation);
    const auto c = grain_contact<true, false>(law, in);
    const double before = 0.5 * law.stiffness * dot(in.spring, in.spring);
    const double stored = 0.5 * law.stiffness * dot(c.spring, c.spring);
    const double along = dot(in.slip, in.separation) / dot(in.separation, in.separation);
    const Triple<double> across = add_scaled(in.slip, -along, in.separation);
    const Triple<double> mean = {in.spring.x + c.spring.x, in.spring.y + c.spring.y, in.spring.z + c.spring.z};
    const double work = 0.5 * law.stiffness * dot(mean, across);
    EXPECT_NEAR(work, stored - before + c.friction_loss, rounding) << "pair " << n;
  }
}

TEST(GrainContact, FourPairsAtOnce_GiveTheBitsOfOneByOne) {
  const GrainLaw law{2.5, 0.3, 0.1};
  for (std::uint32_t n = 0; n < 400; n += 4) {
    GrainPairInput<Lanes> four{};
    std::array<GrainContact<double>, 4> single;
    for (std::uint32_t lane = 0; lane < 4; ++lane) {
      const Input in = random_pair(n + lane);
      four.separation.x[lane] = in.separation.x, four.separation.y[lane] = in.separation.y;
      four.separation.z[lane] = in.separation.z, four.reach[lane] = in.reach;
      four.slip.x[lane] = in.slip.x, four.slip.y[lane] = in.slip.y, four.slip.z[lane] = in.slip.z;
      four.spring.x[lane] = in.spring.x, four.spring.y[lane] = in.spring.y, four.spring.z[lane] = in.spring.z;
      four.dashpot_per_step[lane] = in.dashpot_per_step;
      single[lane] = grain_contact<true, true>(law, in);
    }
    const auto all = grain_contact<true, true>(law, four);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(all.force.x[lane], single[lane].force.x);
      EXPECT_EQ(all.spring.z[lane], single[lane].spring.z);
      EXPECT_EQ(all.elastic[lane], single[lane].elastic);
      EXPECT_EQ(all.friction_loss[lane], single[lane].friction_loss);
      EXPECT_EQ(all.damping_loss[lane], single[lane].damping_loss);
    }
  }
}

TEST(MirrorContact, GrainPressedIntoThePlane_ForceIsTheSlopeOfItsEnergy) {
  // Half of the image pair's energy is ours: E = k (r - h)^2, so the force away from the plane must be -dE/dh = 2k(r -
  // h). A central difference of a parabola is exact; its rounding is eps E / step = 2e-16 * 0.02 / 1e-3 = 4e-15.
  const GrainLaw law{2.0, 0.0, 0.0};
  const double step = 1e-3, height = 0.9;
  const double up = mirror_contact(law, height + step, 1.0, 0.0, 0.0).elastic;
  const double down = mirror_contact(law, height - step, 1.0, 0.0, 0.0).elastic;
  EXPECT_NEAR(mirror_contact(law, height, 1.0, 0.0, 0.0).force, -(up - down) / (2.0 * step), rounding);
  EXPECT_EQ(mirror_contact(law, 1.0 + step, 1.0, 0.0, 0.0).force, 0.0);
}

}  // namespace
}  // namespace standoff::particles
