#include "coupling/tape/tape_file.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/transport/checksum.hpp"

namespace standoff {

bool TapeFrame::all_zero(const std::vector<Vec3>& field) {
  // A negative zero is not nothing: bits are kept.
  return std::all_of(field.begin(), field.end(), [](const Vec3& v) {
    return v == Vec3{} && !std::signbit(v.x) && !std::signbit(v.y) && !std::signbit(v.z);
  });
}

std::size_t TapeFrame::bounded(std::uint64_t count) {
  if (count > (1u << 28)) throw Stop(ExitCode::checkpoint_incompatible, "tape: a field with too many nodes");
  return static_cast<std::size_t>(count);
}

std::string tape_record(TapeKind kind, const std::string& body) {
  const auto number = static_cast<std::uint32_t>(kind);
  const std::uint64_t size = body.size();
  std::string record;
  record.reserve(size + 16);
  record.append(reinterpret_cast<const char*>(&number), sizeof number);
  record.append(reinterpret_cast<const char*>(&size), sizeof size);
  record += body;
  const std::uint32_t checksum = crc32c(record.data(), record.size());
  record.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  return record;
}

}  // namespace standoff
