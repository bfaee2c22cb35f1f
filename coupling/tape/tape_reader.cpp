#include "coupling/tape/tape_reader.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "coupling/base/state_archive.hpp"
#include "coupling/transport/checksum.hpp"

namespace standoff {
namespace {

constexpr std::uint64_t head_size = 12, frame_size = head_size + 4;  // kind and size; and the checksum
constexpr std::uint64_t tail_size = 16;

template <class T>
T value_at(const std::string& text, std::size_t offset) {
  T value;
  std::memcpy(&value, text.data() + offset, sizeof value);
  return value;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Stop(ExitCode::bad_case, fmt::format("tape {}: {}", path, why));
}

}  // namespace

TapeReader::TapeReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::ate) {
  if (!file_) refuse(path_, "the file cannot be opened");
  bytes_ = static_cast<std::uint64_t>(file_.tellg());
  std::string magic(tape_magic.size(), '\0');
  file_.seekg(0).read(magic.data(), static_cast<std::streamsize>(magic.size()));
  Record head;
  if (!file_ || magic != tape_magic) refuse(path_, "it is not a tape of this version");
  if (!read_record(tape_magic.size(), head) || head.kind != TapeKind::head) refuse(path_, "its head is damaged");
  StateReader reader(head.body);
  reader(head_);
  first_frame_ = tape_magic.size() + head.size;
  has_index_ = read_index();
  if (!has_index_) scan();
}

bool TapeReader::read_record(std::uint64_t offset, Record& record) {
  file_.clear();
  std::string head(head_size, '\0');
  if (offset + frame_size > bytes_) return false;
  file_.seekg(static_cast<std::streamoff>(offset)).read(head.data(), head_size);
  const auto size = value_at<std::uint64_t>(head, 4);
  if (!file_ || size > bytes_ - offset - frame_size) return false;
  std::string rest(size + 4, '\0');
  file_.read(rest.data(), static_cast<std::streamsize>(rest.size()));
  if (!file_) return false;
  record.kind = static_cast<TapeKind>(value_at<std::uint32_t>(head, 0));
  record.body = rest.substr(0, size);
  record.size = size + frame_size;
  const std::string all = head + record.body;
  return crc32c(all.data(), all.size()) == value_at<std::uint32_t>(rest, size);
}

bool TapeReader::read_index() {
  if (bytes_ < first_frame_ + tail_size) return false;
  std::string tail(tail_size, '\0');
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(bytes_ - tail_size)).read(tail.data(), tail_size);
  Record record;
  if (!file_ || tail.substr(8) != tape_end) return false;
  if (!read_record(value_at<std::uint64_t>(tail, 0), record) || record.kind != TapeKind::index) return false;
  StateReader reader(record.body);
  reader(entries_);
  readable_ = bytes_;
  return true;
}

void TapeReader::scan() {
  Record record;
  readable_ = first_frame_;
  while (read_record(readable_, record) && record.kind == TapeKind::frame) {
    TapeFrame frame;
    StateReader reader(record.body);
    reader(frame);
    entries_.push_back({readable_, record.size, frame.role, 0, frame.window});
    readable_ += record.size;
  }
}

TapeFrame TapeReader::frame(const TapeEntry& entry) {
  Record record;
  if (!read_record(entry.offset, record) || record.kind != TapeKind::frame)
    throw Stop(ExitCode::checkpoint_incompatible, fmt::format("tape {}: the record of window {} at byte {} is damaged",
                                                              path_, entry.window, entry.offset));
  TapeFrame frame;
  StateReader reader(record.body);
  reader(frame);
  return frame;
}

std::ptrdiff_t TapeReader::find(Role role, std::int64_t window) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const TapeEntry& e) { return e.role == role && e.window == window; });
  return found == entries_.end() ? -1 : found - entries_.begin();
}

std::int64_t TapeReader::windows(Role role) const {
  std::int64_t last = -1;
  for (const TapeEntry& entry : entries_)
    if (entry.role == role) last = std::max(last, entry.window);
  return last + 1;
}

}  // namespace standoff
