#pragma once
// A throw-away folder of case files for the tests of the reader.
#include <filesystem>
#include <fstream>
#include <string>

#include <stdlib.h>

#include "coupling/case/case_reader.hpp"

namespace standoff::test {

class CaseFolder {
 public:
  CaseFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "case_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~CaseFolder() { std::filesystem::remove_all(path_); }
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;

  CaseFolder& write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name) << text;
    return *this;
  }
  std::string path() const { return path_.string(); }
  CaseRead read(const std::string& name = "case.toml", const CaseOverrides& overrides = {}) const {
    CaseRead result = read_case((path_ / name).string(), overrides);
    const std::string prefix = path_.string() + "/";
    for (std::string& error : result.errors)
      for (std::size_t at; (at = error.find(prefix)) != std::string::npos;) error.erase(at, prefix.size());
    return result;
  }

 private:
  std::filesystem::path path_;
};

/// A complete small case without mistakes; `more` is appended.
inline std::string sound_case(const std::string& more = "") {
  return "[charge]\nmass = \"150 g\"\n[plate]\nmaterial = \"al6xn\"\nsize = [\"406 mm\", \"406 mm\", \"3.4 mm\"]\n"
         "[run]\nstand_off = \"150 mm\"\n" +
         more;
}

inline CaseOverrides with_set(std::vector<std::pair<std::string, std::string>> set) {
  CaseOverrides overrides;
  overrides.set = std::move(set);
  return overrides;
}

inline std::string all_errors(const CaseRead& result) {
  std::string text;
  for (const std::string& error : result.errors) text += error + "\n";
  return text;
}

}  // namespace standoff::test
