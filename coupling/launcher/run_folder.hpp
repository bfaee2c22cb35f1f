#pragma once
// Where a run writes. A folder that holds a run, finished or not, is never written again.
#include <string>

namespace standoff::launch {

/// runs/CASE/LEVEL-NUMBER (LEVEL is "run" for a case without levels) below `base`, created with the first free number.
/// Throws Stop(bad_case) if it cannot be created, Stop(out_of_resources) if the disk is full.
std::string new_run_folder(const std::string& base, const std::string& case_name, const std::string& level);

/// The folder a user named: created, or taken as it is if it holds no run; else Stop(bad_case) that says what it holds.
std::string named_run_folder(const std::string& path);

/// "done", "failed", ... from run.json in `folder`; "" without a readable one.
std::string run_status(const std::string& folder);

/// `name` with everything but letters, digits, dot, dash and underscore replaced.
std::string file_name_of(const std::string& name);

/// First number n >= 1 for which `base`/`stem`-n can be created; creates it and returns its path.
std::string numbered_folder(const std::string& base, const std::string& stem);

}  // namespace standoff::launch
