// standoff tape info | verify | diff | export
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/command_line_verbs.hpp"
#include "coupling/launcher/text_format.hpp"
#include "coupling/output/atomic_file.hpp"
#include "coupling/output/vtk_file.hpp"
#include "coupling/tape/tape_compare.hpp"

namespace standoff::launch {
namespace {

struct TapeOptions {
  std::string first, second, out;
  double tolerance = 0.0;
  bool json = false;
};

nlohmann::ordered_json facts_of(const TapeReader& tape) {
  const TapeHead& head = tape.head();
  return {{"tape", tape.path()},
          {"case_hash", head.case_hash},
          {"scheme", head.clock.parallel ? "parallel" : "serial"},
          {"window_s", head.clock.window},
          {"of_windows", head.clock.windows},
          {"first_window", head.clock.first},
          {"windows_load", tape.windows(Role::load)},
          {"windows_structure", tape.windows(Role::structure)},
          {"surface_nodes", head.surface.position.size()},
          {"surface_quads", head.surface.quads.size()},
          {"bytes", tape.bytes()},
          {"complete", tape.has_index()},
          {"readable_bytes", tape.readable()}};
}

void print(const nlohmann::ordered_json& facts, bool json) {
  if (json) {
    std::printf("%s\n", facts.dump(2).c_str());
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& [key, value] : facts.items())
    rows.push_back({key, value.is_string() ? value.get<std::string>() : value.dump()});
  std::fputs(table_text(rows, {false, false}).c_str(), stdout);
}

int info(const TapeOptions& options) {
  print(facts_of(TapeReader(options.first)), options.json);
  return 0;
}

/// Every record, its checksum and its place in the index.
int verify(const TapeOptions& options) {
  TapeReader tape(options.first);
  nlohmann::ordered_json facts = facts_of(tape);
  std::string trouble =
      tape.has_index() ? "" : fmt::format("cut off after {} of {} bytes", tape.readable(), tape.bytes());
  for (const TapeEntry& entry : tape.entries()) try {
      const TapeFrame frame = tape.frame(entry);
      if (frame.role != entry.role || frame.window != entry.window) trouble = "the index does not fit the records";
    } catch (const Stop& stop) {
      if (trouble.empty()) trouble = stop.what();
    }
  facts["verdict"] = trouble.empty() ? "whole" : trouble;
  print(facts, options.json);
  return static_cast<int>(trouble.empty() ? ExitCode::done : ExitCode::check_failed);
}

int diff(const TapeOptions& options) {
  TapeReader first(options.first), second(options.second);
  const TapeDifference found = compare_tapes(first, second);
  nlohmann::ordered_json j{{"same_bits", found.same()}, {"windows", found.windows}};
  if (!found.structure.empty()) j["cannot_be_compared"] = found.structure;
  if (found.only_first > 0) j["frames_only_in_first"] = found.only_first;
  if (found.only_second > 0) j["frames_only_in_second"] = found.only_second;
  double worst = 0.0;
  for (const FieldDifference& field : found.fields) {
    worst = std::max(worst, field.relative());
    j[field.name + "_largest"] = field.largest, j[field.name + "_rms"] = field.rms;
    j[field.name + "_relative"] = field.relative();
    if (field.first_window >= 0) j[field.name + "_first_differs_in_window"] = field.first_window;
  }
  print(j, options.json);
  const bool comparable = found.structure.empty() && found.only_first == 0 && found.only_second == 0;
  const bool agree = found.same() || (comparable && options.tolerance > 0.0 && worst <= options.tolerance);
  return static_cast<int>(agree ? ExitCode::done : ExitCode::check_failed);
}

/// tape.csv, and the surface as frames for ParaView, at most a hundred.
int write_out(const TapeOptions& options) {
  TapeReader tape(options.first);
  PvdSeries series(options.out, "surface", "vtu");
  write_atomically(options.out + "/tape.csv", tape_csv(tape));
  const TapeHead& head = tape.head();
  const std::int64_t windows = tape.windows(Role::structure), stride = windows / 100 + 1;
  VtkGrid grid;
  grid.cell_type = 9;
  for (const auto& q : head.surface.quads) grid.cells.push_back({q[0], q[1], q[2], q[3]});
  for (std::int64_t k = 0; k < windows; k += stride) {
    const std::ptrdiff_t motion = tape.find(Role::structure, k), load = tape.find(Role::load, k);
    if (motion < 0) continue;
    const TapeFrame moved = tape.frame(tape.entries()[static_cast<std::size_t>(motion)]);
    std::vector<Vec3> force(moved.position.size());
    if (load >= 0) force = tape.frame(tape.entries()[static_cast<std::size_t>(load)]).force;
    grid.points = moved.position;
    grid.point_data = {vtk_array("velocity_m_per_s", moved.velocity), vtk_array("force_N", force)};
    series.add(static_cast<double>(k + 1) * head.clock.window, vtu_text(grid));
  }
  std::printf("%s/tape.csv and surface.pvd written\n", options.out.c_str());
  return 0;
}

}  // namespace

void add_tape_verb(CLI::App& app, Actions& actions) {
  CLI::App& verb = *app.add_subcommand("tape", "recorded exchanges: info, verify, diff, export");
  auto options = std::make_shared<TapeOptions>();
  auto action = std::make_shared<std::function<int(const TapeOptions&)>>();
  verb.require_subcommand(1);
  const auto add = [&](const char* name, const char* help, int (*call)(const TapeOptions&)) -> CLI::App& {
    CLI::App& sub = *verb.add_subcommand(name, help);
    sub.add_option("TAPE", options->first, "a file written by standoff run --tape")->required()->type_name("");
    sub.callback([action, call] { *action = call; });
    return sub;
  };
  add("info", "what a tape holds", info).add_flag("--json", options->json, "the same as JSON");
  add("verify", "reads every record; exit 1 if one is damaged or the end is missing", verify)
      .add_flag("--json", options->json, "the same as JSON");
  CLI::App& compare = add("diff", "largest and rms difference of each field; exit 1 if they differ", diff);
  compare.add_option("OTHER", options->second, "another tape")->required()->type_name("");
  compare.add_option("--tolerance", options->tolerance, "relative difference that is still the same")
      ->type_name("X")
      ->check(CLI::NonNegativeNumber);
  compare.add_flag("--json", options->json, "the same as JSON");
  add("export", "a CSV table and frames for ParaView", write_out)
      .add_option("--out", options->out, "folder to write into")
      ->required()
      ->type_name("DIR");
  actions["tape"] = [options, action] { return (*action)(*options); };
}

}  // namespace standoff::launch
