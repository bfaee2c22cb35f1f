#include "structure_solver/relaxation/rest_monitor.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace standoff::structure {

void RestMonitor::observe(double time, double deflection, double kinetic_energy, double plastic_work) {
  peak_kinetic_ = std::max(peak_kinetic_, kinetic_energy);
  const auto index = static_cast<long>(std::floor(time / period_ * bins_per_period));
  if (bins_.empty() || bins_.back().index != index) {
    bins_.push_back({index, time, deflection, deflection, kinetic_energy, plastic_work});
    while (bins_.size() > 1 && bins_[1].first_time <= time - period_) bins_.pop_front();
  }
  Bin& bin = bins_.back();
  bin.lowest = std::min(bin.lowest, deflection);
  bin.highest = std::max(bin.highest, deflection);
  bin.kinetic = std::max(bin.kinetic, kinetic_energy);
  time_ = time;
  plastic_ = plastic_work;
}

bool RestMonitor::covers_a_period() const {
  return !bins_.empty() && time_ - bins_.front().first_time >= period_ * (1.0 - 1e-12);
}

double RestMonitor::kinetic_ratio() const {
  if (!(peak_kinetic_ > 0.0)) return 0.0;
  double largest = 0.0;
  for (const Bin& bin : bins_)
    if (&bin == &bins_.back() || bin.first_time >= time_ - 0.25 * period_) largest = std::max(largest, bin.kinetic);
  return largest / peak_kinetic_;
}

double RestMonitor::drift() const {
  if (bins_.empty()) return 0.0;
  double lowest = bins_.front().lowest, highest = bins_.front().highest;
  for (const Bin& bin : bins_) lowest = std::min(lowest, bin.lowest), highest = std::max(highest, bin.highest);
  return highest - lowest;
}

double RestMonitor::plastic_work_gained() const {
  return bins_.empty() ? 0.0 : plastic_ - bins_.front().plastic_at_first;
}

double RestMonitor::plastic_ratio() const {
  return plastic_ > 0.0 ? plastic_work_gained() / plastic_ : 0.0;
}

bool RestMonitor::still() const {
  return covers_a_period() && kinetic_ratio() < limits_.kinetic_ratio && drift() < limits_.drift;
}

std::string RestMonitor::shortcomings(double residual) const {
  std::string text;
  const auto add = [&](const std::string& item) { text += (text.empty() ? "" : ", ") + item; };
  if (!covers_a_period()) add(fmt::format("less than one period of {:.3g} ms was watched", period_ * 1e3));
  if (!(kinetic_ratio() < limits_.kinetic_ratio))
    add(fmt::format("kinetic energy is {:.2g} of its peak (limit {:.2g})", kinetic_ratio(), limits_.kinetic_ratio));
  if (!(residual < limits_.residual))
    add(fmt::format("largest unbalanced force is {:.3g} N (limit {:.3g} N)", residual, limits_.residual));
  if (!(drift() < limits_.drift))
    add(fmt::format("the centre moved {:.3g} um within one period (limit {:.3g} um)", drift() * 1e6,
                    limits_.drift * 1e6));
  if (!(plastic_ratio() < limits_.plastic_ratio))
    add(fmt::format("plastic work still grows, by {:.2g} of the total per period (limit {:.2g})", plastic_ratio(),
                    limits_.plastic_ratio));
  return text;
}

}  // namespace standoff::structure
