#pragma once
// When does a moving sphere first touch a moving surface? The clearance c(t) = gap - radius along its straight path is
// known only through probes that return c and its rate. Facts used:
//   * |dc/dt| <= L, the sum of the speed bounds: from c > 0 the time c / L is free of contact (conservative
//   advancement:
//     Mirtich, PhD thesis, Berkeley 1996, sec. 2.3);
//   * where the surface is plane Newton's step -c / rate lands on the contact.
// A step is the safe one, or Newton's if that is no more than `resolution` of travel longer. So whatever a step passes
// over is a touch less than resolution / 2 deep that the sphere has left again by itself; nothing can be passed
// through. A sign change is closed in by Newton inside the bracket.
//
// L m/s > 0, lengths m, times s. Cost: one probe if c > L (t_to - t_from), about three for a hit, plus one for each
// `resolution` of travel along the surface. Touching means c <= 1e-9 radius; approaching means rate < -1e-12 L, so that
// a perfectly inelastic hit, which leaves a rate of rounding size, is not found again.
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

/// First touch in [t_from, t_to]; `probe(t)` is last called at the time returned. False if there is none.
template <class Probe>
bool sweep_to_contact(const SweepLimits& limits, Probe&& probe, double& t_hit) {
  const double touch = 1e-9 * limits.radius, calm = 1e-12 * limits.speed_bound;
  const double grain = limits.resolution / limits.speed_bound;
  double t = limits.t_from;
  Clearance now = probe(t);
  while (true) {
    if (now.value <= touch && now.rate < -calm) return t_hit = t, true;
    const double left = limits.t_to - t, safe = std::max(now.value, 0.0) / limits.speed_bound;
    if (!(left > 0.0) || safe > left) return false;
    double step = safe + grain;
    if (now.value > touch && now.rate < -calm) step = std::min(step, std::max(safe, -now.value / now.rate));
    double next_t = std::min(t + step, limits.t_to);
    if (!(next_t > t)) next_t = std::nextafter(t, limits.t_to);
    Clearance next = probe(next_t);
    if (now.value > touch && next.value < -touch) {  // passed the touch: close in on it
      double low = t, high = next_t;
      for (int i = 0; i < 100 && std::abs(next.value) > touch; ++i) {
        (next.value > 0.0 ? low : high) = next_t;
        const double newton = next_t - next.value / next.rate;
        const bool inside = newton > low && newton < high && i < 50;
        const double guess = inside ? newton : 0.5 * (low + high);
        if (!(guess > low && guess < high)) break;  // neighbouring numbers: the clearance jumps here
        next_t = guess;
        next = probe(next_t);
      }
      if (next.value > touch) next_t = high, next = probe(high);
    }
    t = next_t, now = next;
  }
}

}  // namespace standoff::particles
