#pragma once
// log.txt for people, log.jsonl for programs: the same facts, each line with seconds since the start and who said it.
#include <chrono>
#include <string>

#include <nlohmann/json.hpp>

namespace standoff::launch {

/// A file that grows line by line; a full disk is Stop(out_of_resources), never a silently shorter file.
class GrowingFile {
 public:
  /// `append`: goes on behind what is there; otherwise the file begins empty.
  explicit GrowingFile(const std::string& path, bool append = false);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  void append(const std::string& text);

 private:
  std::string path_;
  int fd_ = -1;
};

class RunLog {
 public:
  /// `earlier` > 0: the run goes on after so many seconds in earlier sessions.
  explicit RunLog(const std::string& folder, double earlier = 0.0);
  /// A line somebody said: "launcher", "broker", "particles", "structure".
  void line(const std::string& who, const std::string& text);
  /// An event; its text goes to log.txt, the object with time and origin to log.jsonl.
  void event(const std::string& who, const std::string& text, nlohmann::json object);

 private:
  double seconds() const;
  std::chrono::steady_clock::time_point begin_;
  double earlier_;
  GrowingFile text_, json_;
};

}  // namespace standoff::launch
