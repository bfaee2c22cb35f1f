#pragma once
// Reads a tape, whole or cut off; a record whose checksum is wrong ends it.
#include <fstream>

#include "coupling/tape/tape_file.hpp"

namespace standoff {

class TapeReader {
 public:
  /// Throws Stop(bad_case) if `path` is not a tape.
  explicit TapeReader(std::string path);

  const std::string& path() const { return path_; }
  const TapeHead& head() const { return head_; }
  const std::vector<TapeEntry>& entries() const { return entries_; }
  /// Throws Stop(checkpoint_incompatible) if the record is damaged.
  TapeFrame frame(const TapeEntry& entry);
  /// Index of the entry of a window of one side, -1 if it is not on the tape.
  std::ptrdiff_t find(Role role, std::int64_t window) const;
  std::int64_t windows(Role role) const;  // one more than the last on the tape

  bool has_index() const { return has_index_; }
  std::uint64_t bytes() const { return bytes_; }        // of the file
  std::uint64_t readable() const { return readable_; }  // up to the last whole record

 private:
  struct Record {
    TapeKind kind;
    std::string body;
    std::uint64_t size = 0;
  };
  bool read_record(std::uint64_t offset, Record& record);
  bool read_index();
  void scan();

  std::string path_;
  std::ifstream file_;
  TapeHead head_;
  std::vector<TapeEntry> entries_;
  bool has_index_ = false;
  std::uint64_t bytes_ = 0, readable_ = 0, first_frame_ = 0;
};

}  // namespace standoff
