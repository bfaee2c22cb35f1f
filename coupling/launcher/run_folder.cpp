#include "coupling/launcher/run_folder.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "coupling/base/stop.hpp"

namespace standoff::launch {
namespace {

namespace files = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::error_code& why) {
  const bool full = why == std::errc::no_space_on_device;
  throw Stop(full ? ExitCode::out_of_resources : ExitCode::bad_case,
             fmt::format("cannot create the run folder {}: {}; choose another with --out", path, why.message()));
}

void create(const std::string& path) {
  std::error_code error;
  files::create_directories(path, error);
  if (error || !files::is_directory(path, error)) refuse(path, error);
}

/// Number of `name` if it reads STEM-number, else 0.
long number_of(const std::string& name, const std::string& stem) {
  const std::string tail = name.starts_with(stem + "-") ? name.substr(stem.size() + 1) : "";
  const bool digits = !tail.empty() && tail.size() < 10 && std::all_of(tail.begin(), tail.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c));
  });
  return digits ? std::stol(tail) : 0;
}

}  // namespace

std::string file_name_of(const std::string& name) {
  std::string clean = name;
  for (char& c : clean)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '_') c = '_';
  return clean.empty() || clean[0] == '.' ? "case" + clean : clean;
}

std::string numbered_folder(const std::string& base, const std::string& stem) {
  create(base);
  long last = 0;
  for (const auto& entry : files::directory_iterator(base))
    last = std::max(last, number_of(entry.path().filename(), stem));
  for (long number = last + 1;; ++number) {
    const std::string path = fmt::format("{}/{}-{}", base, stem, number);
    if (mkdir(path.c_str(), 0777) == 0) return path;
    if (errno != EEXIST) refuse(path, std::error_code(errno, std::generic_category()));
  }
}

std::string new_run_folder(const std::string& base, const std::string& case_name, const std::string& level) {
  return numbered_folder(base + "/" + file_name_of(case_name), level.empty() ? "run" : file_name_of(level));
}

std::string named_run_folder(const std::string& path) {
  const std::string status = run_status(path);
  if (!status.empty())
    throw Stop(ExitCode::bad_case,
               fmt::format("{} already holds a run (status {}); a run is never overwritten: choose another folder with "
                           "--out, or leave --out away for the next free number",
                           path, status));
  create(path);
  return path;
}

std::string run_status(const std::string& folder) {
  std::ifstream file(folder + "/run.json");
  if (!file) return "";
  const auto record = nlohmann::json::parse(file, nullptr, false);
  if (!record.is_object() || !record.contains("status") || !record["status"].is_string()) return "unreadable";
  return record["status"];
}

}  // namespace standoff::launch
