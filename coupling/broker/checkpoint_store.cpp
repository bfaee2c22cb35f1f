#include "coupling/broker/checkpoint_store.hpp"

#include <algorithm>
#include <filesystem>

#include <errno.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string.h>
#include <unistd.h>

#include "coupling/base/state_archive.hpp"
#include "coupling/contract/kept_file.hpp"
#include "coupling/output/atomic_file.hpp"
#include "coupling/transport/field.hpp"

namespace standoff {
namespace {

namespace files = std::filesystem;
constexpr const char* name_of_ours = "interface";
constexpr std::size_t kept = 2;

/// A payload as plain data.
struct StoredField {
  std::string name, bytes;
  DataType type = DataType::f64;
  std::int64_t components = 1, count = 0;
  std::uint32_t checksum = 0;
  template <class Archive>
  void archive(Archive& a) {
    a(name, bytes, type, components, count, checksum);
  }
};

std::vector<StoredField> stored(const PayloadHandle& payload) {
  std::vector<StoredField> fields;
  for (std::size_t i = 0; payload && i < payload->fields.size(); ++i) {
    const FieldShape& shape = payload->fields[i].shape;
    fields.push_back({shape.name, payload->frames[i].to_string(), shape.type, shape.components, shape.count,
                      payload->fields[i].checksum});
  }
  return fields;
}

PayloadHandle payload_of(const std::vector<StoredField>& fields) {
  if (fields.empty()) return nullptr;
  auto payload = std::make_shared<Payload>();
  for (const StoredField& field : fields) {
    payload->fields.push_back({{field.name, field.type, field.components, field.count}, field.checksum});
    payload->frames.emplace_back(field.bytes.data(), field.bytes.size());
  }
  return payload;
}

/// One list for writing and reading, arrays apart.
template <class Archive>
void archive_interface(Archive& a, InterfaceState& state, std::vector<StoredField>& motion,
                       std::vector<StoredField>& load) {
  a(state.clock.window, state.clock.windows, state.clock.parallel, state.clock.first, state.case_hash);
  a(state.surface_digest, state.given, state.received, state.bytes, motion, load);
}

nlohmann::ordered_json description(const InterfaceState& state, const std::string& build) {
  nlohmann::ordered_json j{{"form", 1},
                           {"windows", state.clock.first},
                           {"of_windows", state.clock.windows},
                           {"time_s", static_cast<double>(state.clock.first) * state.clock.window},
                           {"window_s", state.clock.window},
                           {"case_hash", state.case_hash},
                           {"build", build}};
  for (const SavedSide& side : state.sides)
    j["sides"].push_back({{"name", side.name}, {"bytes", side.bytes}, {"checksum", side.checksum}});
  return j;
}

[[noreturn]] void give_up(const std::string& doing, const std::string& why) {
  throw Stop(ExitCode::out_of_resources, fmt::format("cannot {}: {}", doing, why));
}

/// The names in a folder are on disk too.
void flush_folder(const std::string& folder) {
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0 || fsync(fd) != 0) {
    const std::string why = strerror(errno);
    if (fd >= 0) close(fd);
    give_up("flush " + folder, why);
  }
  close(fd);
}

std::string folder_of(const std::string& base, std::int64_t windows) {
  return fmt::format("{}/window-{:09}", base, windows);
}

}  // namespace

CheckpointStore::CheckpointStore(std::string folder, std::string build)
    : folder_(std::move(folder)), build_(std::move(build)) {
  sweep();
}

void CheckpointStore::sweep() const {
  std::error_code ignored;
  for (const auto& entry : files::directory_iterator(folder_, ignored))
    if (entry.path().extension() == ".part") files::remove_all(entry.path(), ignored);
}

void CheckpointStore::commit(const InterfaceState& state) const {
  const std::string place = folder_of(folder_, state.clock.first), part = place + ".part";
  InterfaceState copy = state;
  std::vector<StoredField> motion = stored(state.motion), load = stored(state.load);
  StateWriter writer;
  archive_interface(writer, copy, motion, load);
  const auto [bytes, checksum] = KeptFile{state.case_hash, name_of_ours, state.clock.first}.write(part, writer.bytes());
  copy.sides.push_back({name_of_ours, bytes, checksum});
  write_atomically(part + "/checkpoint.json", description(copy, build_).dump(2) + "\n");
  flush_folder(part);
  std::error_code error;
  files::remove_all(place, error);  // one of an earlier attempt at the same window
  files::rename(part, place, error);
  if (error) give_up("rename " + part, error.message());
  flush_folder(folder_);
  const std::vector<std::string> all = checkpoints_in(folder_);
  for (std::size_t i = kept; i < all.size(); ++i) files::remove_all(all[i], error);
}

std::vector<std::string> checkpoints_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : files::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("window-") && !name.ends_with(".part")) found.push_back(entry.path());
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

ResumePoint read_checkpoint(const std::string& folder) {
  const auto refuse = [&](const std::string& why) {
    throw Stop(ExitCode::checkpoint_incompatible, fmt::format("checkpoint {}: {}", folder, why));
  };
  const std::string text = file_text(folder + "/checkpoint.json");
  const auto j = nlohmann::json::parse(text, nullptr, false);
  if (!j.is_object() || j.value("form", 0) != 1 || !j.contains("sides")) refuse("checkpoint.json cannot be read");
  ResumePoint point;
  point.folder = folder;
  try {
    for (const auto& side : j.at("sides"))
      point.state.sides.push_back({side.at("name"), side.at("bytes"), side.at("checksum")});
    const SavedSide ours = point.state.sides.back();
    for (const SavedSide& side : point.state.sides)
      if (file_checksum(folder + "/" + side.name + ".state") != side.checksum) refuse(side.name + ".state is damaged");
    const std::string state = KeptFile{j.at("case_hash"), name_of_ours, j.at("windows")}.read(folder, ours.checksum);
    std::vector<StoredField> motion, load;
    StateReader reader(state);
    archive_interface(reader, point.state, motion, load);
    point.state.motion = payload_of(motion), point.state.load = payload_of(load);
  } catch (const nlohmann::json::exception& error) {
    refuse(error.what());
  }
  return point;
}

}  // namespace standoff
