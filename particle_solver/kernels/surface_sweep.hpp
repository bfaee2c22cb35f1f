#pragma once
// When does a moving sphere first touch a moving surface? The clearance c(t) = gap - radius along its straight path is
// known only through probes that return c and its rate. Facts used:
//   * |dc/dt| <= L, the sum of the speed bounds: from c > 0 the time c / L is free of contact (conservative
//     advancement: Mirtich, PhD thesis, Berkeley 1996, sec. 2.3);
//   * where the surface is plane Newton's step -c / rate lands on the contact.
// A cautious step is the safe one, or up to `resolution` of travel more. First a bold step, to Newton's contact or the
// end, is tried if it is at most four resolutions of travel; it counts only if the clearance there is what the rate
// here foretells, within a fifth of the resolution, as on any smooth surface. A sign change is closed in by Newton.
//
// Nothing can be passed through: a sphere that is inside at a probe is caught. What can be missed is a touch that the
// sphere leaves by itself between two probes. With resolution = radius / 4 the worst, a sharp point under the path of a
// bold step, is 1 - sqrt(1 - 1/4) = 0.13 radius deep, of a cautious step 0.008 radius. After a rebound the next touch
// in a sharp corner may be found one resolution late.
//
// L m/s > 0, lengths m, times s. Cost: one probe if c > L (t_to - t_from), two or three for a hit or a near miss, plus
// one for each `resolution` of travel along the surface beyond that. Touching means c <= 1e-9 radius; approaching means
// rate < -1e-12 L, so that a perfectly inelastic hit, which leaves a rate of rounding size, is not found again.
#include <algorithm>
#include <cmath>

namespace standoff::particles {

struct SweepLimits {
  double radius = 0.0;       // m, of the sphere
  double speed_bound = 0.0;  // m/s, L
  double resolution = 0.0;   // m of relative travel
  double t_from = 0.0, t_to = 0.0;
};

/// What a probe at time t returns: clearance [m] (a lower bound with rate 0 if nothing is in reach) and its rate [m/s].
struct Clearance {
  double value = 0.0, rate = 0.0;
};

/// A probe's time and what it saw.
struct SweepProbe {
  double t = 0.0;
  Clearance seen;
};

/// The next probe after `now`: a bold step if it proves right, else a cautious one.
template <class Probe>
SweepProbe sweep_step(const SweepLimits& limits, Probe&& probe, const SweepProbe& now, double touch, double calm) {
  const double left = limits.t_to - now.t, safe = std::max(now.seen.value, 0.0) / limits.speed_bound;
  const double grain = limits.resolution / limits.speed_bound;
  const bool closing = now.seen.value > touch && now.seen.rate < -calm;
  const double newton = closing ? std::max(safe, -now.seen.value / now.seen.rate) : left;
  const double bold = std::min(newton, left), cautious = std::min(bold, safe + grain);
  const auto look = [&](double step) {
    const double t = step == left ? limits.t_to : std::max(now.t + step, std::nextafter(now.t, limits.t_to));
    return SweepProbe{t, probe(t)};
  };
  if (bold > cautious && bold <= 4.0 * grain) {
    const SweepProbe next = look(bold);
    if (std::abs(next.seen.value - now.seen.value - now.seen.rate * bold) <= 0.2 * limits.resolution) return next;
  }
  return look(cautious);
}

/// The touch between a probe in front, at `low`, and one inside, `next`; ends inside if the clearance jumps.
template <class Probe>
SweepProbe sweep_close_in(Probe&& probe, double low, SweepProbe next, double touch) {
  double high = next.t;
  for (int i = 0; i < 100 && std::abs(next.seen.value) > touch; ++i) {
    (next.seen.value > 0.0 ? low : high) = next.t;
    const double newton = next.t - next.seen.value / next.seen.rate;
    const double guess = newton > low && newton < high && i < 50 ? newton : 0.5 * (low + high);
    if (!(guess > low && guess < high)) break;  // neighbouring numbers
    next = {guess, probe(guess)};
  }
  return next.seen.value > touch ? SweepProbe{high, probe(high)} : next;
}

/// First touch in [t_from, t_to]; `probe(t)` is last called at the time returned. False if there is none.
template <class Probe>
bool sweep_to_contact(const SweepLimits& limits, Probe&& probe, double& t_hit) {
  const double touch = 1e-9 * limits.radius, calm = 1e-12 * limits.speed_bound;
  SweepProbe now{limits.t_from, probe(limits.t_from)};
  while (true) {
    if (now.seen.value <= touch && now.seen.rate < -calm) return t_hit = now.t, true;
    const double left = limits.t_to - now.t;
    if (!(left > 0.0) || now.seen.value > limits.speed_bound * left) return false;
    SweepProbe next = sweep_step(limits, probe, now, touch, calm);
    if (now.seen.value > touch && next.seen.value < -touch) next = sweep_close_in(probe, now.t, next, touch);
    now = next;
  }
}

}  // namespace standoff::particles
