#pragma once
// Files that are complete or absent: written beside their place, flushed to disk, then renamed.
#include <string>
#include <string_view>

namespace standoff {

/// Replaces `path` by `content`. Throws Stop(out_of_resources) naming the path and the system's reason (full disk,
/// ...).
void write_atomically(const std::string& path, std::string_view content);

}  // namespace standoff
