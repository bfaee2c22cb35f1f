#pragma once
// Measures whether a moving structure has come to rest: kinetic energy, drift of the centre and plastic work over one
// period of the softest mode. One number alone is fooled: kinetic energy vanishes at every turning point, and a soft or
// overdamped mode creeps with next to no kinetic energy.
//
//   |<------------- one period -------------->|        bins of period/64, each keeps the extremes of what fell into it
//   [bin][bin][bin] ...            [bin][bin][bin] now
//                                  |<- period/4 ->|    kinetic energy oscillates twice per period: its largest value
//                                  within a
//                                                      quarter period is at least half of its envelope
#include <deque>
#include <string>

namespace standoff::structure {

struct RestLimits {
  double kinetic_ratio = 1e-9;
  double drift = 2e-6;          // m per period
  double plastic_ratio = 1e-6;  // plastic work gained per period over the total
  double residual = 1.0;        // N
};

class RestMonitor {
 public:
  RestMonitor(const RestLimits& limits, double period, double peak_kinetic_energy)
      : limits_(limits), period_(period), peak_kinetic_(peak_kinetic_energy) {}

  void observe(double time, double deflection, double kinetic_energy, double plastic_work);
  /// Forgets the window, not the peak of the kinetic energy: rest must be shown again, over one `period`.
  void restart(double period) {
    bins_.clear();
    period_ = period;
  }

  /// The observations cover at least one period.
  bool covers_a_period() const;
  /// Kinetic energy and drift hold.
  bool still() const;
  /// All but the residual hold.
  bool quiet() const { return still() && plastic_ratio() < limits_.plastic_ratio; }
  double kinetic_ratio() const;        // largest of the last quarter period over the peak
  double drift() const;                // m, largest minus smallest centre deflection within the last period
  double plastic_work_gained() const;  // J, within the last period
  double plastic_ratio() const;        // the same over all plastic work
  /// What is missing for rest, with the measured figures; empty if nothing is.
  std::string shortcomings(double residual) const;

 private:
  struct Bin {
    long index;
    double first_time, lowest, highest, kinetic, plastic_at_first;
  };
  static constexpr long bins_per_period = 64;

  RestLimits limits_;
  double period_, peak_kinetic_;
  double time_ = 0.0, plastic_ = 0.0;
  std::deque<Bin> bins_;
};

}  // namespace standoff::structure
