#pragma once
// One side's half of a checkpoint: FOLDER/NAME.state, complete or absent.
//
//   magic | case hash | name | windows done | state (base/state_archive.hpp)
#include <cstdint>
#include <string>
#include <utility>

namespace standoff {

struct KeptFile {
  std::string case_hash, name;
  std::int64_t windows = 0;

  /// Writes and flushes to disk; returns size and CRC-32C of the file. Throws Stop(out_of_resources).
  std::pair<std::int64_t, std::uint32_t> write(const std::string& folder, const std::string& state) const;
  /// The state as it was written. Throws Stop(checkpoint_incompatible) that says what does not fit.
  std::string read(const std::string& folder, std::uint32_t checksum) const;
};

/// A whole file of a checkpoint, and its CRC-32C; throw Stop(checkpoint_incompatible) if it cannot be read.
std::string file_text(const std::string& path);
std::uint32_t file_checksum(const std::string& path);

}  // namespace standoff
