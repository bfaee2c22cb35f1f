#pragma once
// The verbs of `standoff`, one function each. They return the exit code; a Stop they throw carries it.
#include <string>
#include <vector>

#include "coupling/case/case_reader.hpp"

namespace standoff::launch {

struct ThreadOptions {
  int both = 0, particles = 0, structure = 0;  // 0 = chosen by the launcher
  int particle_count() const { return particles > 0 ? particles : both; }
  int structure_count() const { return structure > 0 ? structure : both; }
};

struct CheckpointOptions {
  bool on = true;
  double every = 60.0;  // s of wall clock, 0 = not by time
  long windows = 0;     // 0 = not by count
};
/// "off", "90 s", "5 min" or "200 windows"; throws Stop(bad_case) for anything else.
CheckpointOptions checkpoint_options(const std::string& text);

struct RunOptions {
  std::string case_path;
  CaseOverrides overrides;
  std::string structure_command;  // --structure exec:COMMAND: a program that takes the place of standoff-structure
  std::string out;
  ThreadOptions threads;
  double max_time = 0.0;  // s of wall clock, 0 = none
  bool quiet = false, json = false;
  CheckpointOptions checkpoint;
  std::string trace;                          // one track per process, for Chrome's and Perfetto's viewers
  std::string tape;                           // every exchange is recorded in it
  std::string structure_tape, particle_tape;  // recorded sides in place of the programs
};
int run_verb(const RunOptions& options);
/// Goes on with the run in `folder`; of the options those count that do not change the case.
int resume_verb(const RunOptions& options, const std::string& folder);

struct CheckOptions {
  std::string case_path;
  CaseOverrides overrides;
  bool json = false;
};
int check_verb(const CheckOptions& options);

struct PlanOptions {
  std::string case_path;
  CaseOverrides overrides;
  ThreadOptions threads;
  bool json = false;
};
int plan_verb(const PlanOptions& options);

struct CostOptions {
  std::string case_path;
  CaseOverrides overrides;
  std::vector<std::string> levels;  // empty: all that fit the budget
  int seeds = 3;
  double budget = 1800.0;  // s of predicted wall clock for all runs together
  std::string out;
  ThreadOptions threads;
  double max_time = 0.0;
  bool quiet = false;
  bool effects = false;  // price the effects instead of the levels
};
int cost_verb(const CostOptions& options);

struct CellOptions {
  std::string case_path;
  CaseOverrides overrides;
  std::string out;
  int threads = 0;  // 0 = all cores
  bool json = false;
};
/// Packs and compresses the unit cell of the case's sand.
int cell_verb(const CellOptions& options);

struct DocOptions {
  std::string key;  // "" = list everything
  bool json = false;
};
int doc_verb(const DocOptions& options);
int effects_verb(bool json);
int presets_verb(bool json);
int models_verb(bool json);
/// Writes a template case into `folder`, or prints it if there is none.
int new_verb(const std::string& folder);

struct FolderOptions {
  std::string folder;
  bool json = false;
};
int status_verb(const FolderOptions& options);
/// Returns the exit code of the run that it followed.
int watch_verb(const FolderOptions& options);

struct CompareOptions {
  std::string first, second;
  bool json = false;
};
int compare_verb(const CompareOptions& options);

struct ReportOptions {
  std::vector<std::string> folders;
  std::string out;  // "" = report.html in the first folder
};
int report_verb(const ReportOptions& options);

/// Becomes standoff-conform, which has the wire in it; returns only by exception.
int conform_verb(char** arguments);

/// Prints every error and warning on standard error; true if the case is good.
bool print_diagnostics(const CaseRead& read);

}  // namespace standoff::launch
