#include "coupling/tape/tape_compare.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace standoff {
namespace {

struct Sum {
  double squares = 0.0;
  std::size_t count = 0;
};

void compare_field(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<Vec3>* rest,
                   std::int64_t window, FieldDifference& field, Sum& sum) {
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
    const double difference = norm(a[n] - b[n]);
    field.scale = std::max(field.scale, norm(rest != nullptr ? a[n] - (*rest)[n] : a[n]));
    field.largest = std::max(field.largest, difference);
    sum.squares += difference * difference, ++sum.count;
  }
  if (a != b && field.first_window < 0) field.first_window = window;
}

std::string structure_difference(const TapeHead& a, const TapeHead& b) {
  if (a.surface.position != b.surface.position || a.surface.quads != b.surface.quads)
    return fmt::format("the surfaces differ: {} and {} nodes", a.surface.position.size(), b.surface.position.size());
  if (a.clock.window != b.clock.window)
    return fmt::format("the windows differ: {} s and {} s", a.clock.window, b.clock.window);
  if (a.clock.parallel != b.clock.parallel) return "one is of the parallel scheme, one of the serial";
  return {};
}

}  // namespace

bool TapeDifference::same() const {
  return structure.empty() && only_first == 0 && only_second == 0 &&
         std::all_of(fields.begin(), fields.end(), [](const FieldDifference& f) { return f.first_window < 0; });
}

TapeDifference compare_tapes(TapeReader& first, TapeReader& second) {
  TapeDifference result;
  result.structure = structure_difference(first.head(), second.head());
  if (!result.structure.empty()) return result;
  FieldDifference force{"force"}, position{"position"}, velocity{"velocity"};
  Sum of_force, of_position, of_velocity;
  std::size_t both = 0;
  for (const TapeEntry& entry : first.entries()) {
    const std::ptrdiff_t other = second.find(entry.role, entry.window);
    if (other < 0) {
      ++result.only_first;
      continue;
    }
    ++both;
    result.windows = std::max(result.windows, entry.window + 1);
    const TapeFrame a = first.frame(entry), b = second.frame(second.entries()[static_cast<std::size_t>(other)]);
    compare_field(a.force, b.force, nullptr, entry.window, force, of_force);
    compare_field(a.position, b.position, &first.head().surface.position, entry.window, position, of_position);
    compare_field(a.velocity, b.velocity, nullptr, entry.window, velocity, of_velocity);
  }
  result.only_second = static_cast<std::int64_t>(second.entries().size() - both);
  const auto close = [&](FieldDifference field, const Sum& sum) {
    field.rms = sum.count > 0 ? std::sqrt(sum.squares / static_cast<double>(sum.count)) : 0.0;
    result.fields.push_back(field);
  };
  close(force, of_force), close(position, of_position), close(velocity, of_velocity);
  return result;
}

std::string tape_csv(TapeReader& tape) {
  std::string text =
      "role,window,time_s,impulse_x_Ns,impulse_y_Ns,impulse_z_Ns,work_J,largest_force_N,largest_way_m,largest_speed_m_"
      "per_s\n";
  const auto largest = [](const std::vector<Vec3>& field, const std::vector<Vec3>* from) {
    double value = 0.0;
    for (std::size_t n = 0; n < field.size(); ++n)
      value = std::max(value, norm(from != nullptr ? field[n] - (*from)[n] : field[n]));
    return value;
  };
  for (const TapeEntry& entry : tape.entries()) {
    const TapeFrame frame = tape.frame(entry);
    const Vec3& j = frame.totals.impulse;
    const double time = static_cast<double>(frame.window + 1) * tape.head().clock.window;
    text += fmt::format("{},{},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},", role_name(frame.role), frame.window, time,
                        j.x, j.y, j.z, frame.totals.work);
    if (frame.role == Role::load)
      text += fmt::format("{:.10g},,\n", largest(frame.force, nullptr));
    else
      text += fmt::format(",{:.10g},{:.10g}\n", largest(frame.position, &tape.head().surface.position),
                          largest(frame.velocity, nullptr));
  }
  return text;
}

}  // namespace standoff
