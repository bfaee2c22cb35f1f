#include "coupling/launcher/stage_costs.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

constexpr double smallest_shown = 0.01;             // of a process, at the finest level
using Place = std::pair<std::string, std::string>;  // process, stage

void take_process(const OrderedJson& timing, const std::string& key, std::vector<StageTime>& times) {
  const auto process = timing.find(key);
  if (process == timing.end() || !process->is_object()) return;
  if (const auto stages = process->find("stages"); stages != process->end())
    for (const auto& [stage, seconds] : stages->items())
      if (seconds.is_number()) times.push_back({key, stage, seconds.get<double>()});
  for (const char* other : {"exchange", "wait"})
    if (const auto seconds = process->find(std::string(other) + "_s");
        seconds != process->end() && seconds->is_number())
      times.push_back({key, other, seconds->get<double>()});
}

/// Mean seconds of every stage over the successful runs of a level.
std::map<Place, double> means_of(const std::vector<CostRun>& runs, const std::string& level) {
  std::map<Place, double> sums;
  double count = 0.0;
  for (const CostRun& run : runs) {
    if (run.level != level || run.exit_code != 0 || run.stages.empty()) continue;
    count += 1.0;
    for (const StageTime& time : run.stages) sums[{time.process, time.stage}] += time.seconds;
  }
  for (auto& [place, seconds] : sums) seconds /= count;
  return sums;
}

double whole_of(const std::map<Place, double>& means, const std::string& process) {
  double sum = 0.0;
  for (const auto& [place, seconds] : means)
    if (place.first == process) sum += seconds;
  return sum;
}

std::string cell(const std::map<Place, double>& means, const Place& place) {
  const auto found = means.find(place);
  if (found == means.end()) return "";
  return fmt::format("{:.1f} s {:4.1f} %", found->second, 100.0 * found->second / whole_of(means, place.first));
}

/// The places that matter at `finest`, particles before structure, the dearest first.
std::vector<Place> places_of(const std::map<Place, double>& finest) {
  std::vector<Place> places;
  for (const auto& [place, seconds] : finest)
    if (seconds >= smallest_shown * whole_of(finest, place.first)) places.push_back(place);
  std::sort(places.begin(), places.end(), [&](const Place& a, const Place& b) {
    return a.first != b.first ? a.first < b.first : finest.at(a) > finest.at(b);
  });
  return places;
}

}  // namespace

std::vector<StageTime> stage_times_of(const OrderedJson& record) {
  std::vector<StageTime> times;
  const auto timing = record.find("timing");
  if (timing == record.end() || !timing->is_object()) return times;
  for (const char* process : {"particle", "structure"}) take_process(*timing, process, times);
  return times;
}

std::string stage_table(const std::vector<CostRun>& runs, const std::vector<std::string>& levels) {
  std::vector<std::string> header{"process", "stage"};
  std::vector<std::map<Place, double>> means;
  for (const std::string& level : levels) {
    if (auto of_level = means_of(runs, level); !of_level.empty()) {
      header.push_back(level.empty() ? "case" : level);
      means.push_back(std::move(of_level));
    }
  }
  if (means.empty()) return "";
  std::vector<std::vector<std::string>> rows{header};
  for (const Place& place : places_of(means.back())) {
    rows.push_back({place.first, place.second});
    for (const auto& of_level : means) rows.back().push_back(cell(of_level, place));
  }
  std::vector<bool> right(header.size(), true);
  right[0] = right[1] = false;
  return table_text(rows, right) +
         "\n  mean seconds of a run and share of its process; the processes work side by side; below 1 % not shown\n";
}

std::string stage_csv(const std::vector<CostRun>& runs) {
  std::string text = "level,seed,process,stage,seconds\n";
  for (const CostRun& run : runs)
    for (const StageTime& time : run.stages)
      if (run.exit_code == 0)
        text += fmt::format("{},{},{},{},{}\n", run.level, run.seed, time.process, time.stage, time.seconds);
  return text;
}

}  // namespace standoff::launch
