#include "coupling/contract/kept_file.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "coupling/base/state_archive.hpp"
#include "coupling/output/atomic_file.hpp"
#include "coupling/transport/checksum.hpp"

namespace standoff {
namespace {

constexpr std::uint64_t magic = 0x3145544154534453ull;  // "SDSTATE1" in memory order

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw Stop(ExitCode::checkpoint_incompatible, fmt::format("checkpoint {}: {}", path, reason));
}

std::string path_of(const std::string& folder, const std::string& name) {
  return folder + "/" + name + ".state";
}

}  // namespace

std::pair<std::int64_t, std::uint32_t> KeptFile::write(const std::string& folder, const std::string& state) const {
  StateWriter head;
  head(magic, case_hash, name, windows, state);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Stop(ExitCode::out_of_resources, fmt::format("cannot create {}: {}", folder, error.message()));
  write_atomically(path_of(folder, name), head.bytes());
  return {static_cast<std::int64_t>(head.bytes().size()), crc32c(head.bytes().data(), head.bytes().size())};
}

std::string KeptFile::read(const std::string& folder, std::uint32_t checksum) const {
  const std::string path = path_of(folder, name), text = file_text(path);
  if (crc32c(text.data(), text.size()) != checksum) refuse(path, "it is damaged, or belongs to another checkpoint");
  std::uint64_t found_magic = 0;
  KeptFile found;
  std::string state;
  StateReader reader(text);
  reader(found_magic);
  if (found_magic != magic) refuse(path, "it is not a state of this version");
  reader(found.case_hash, found.name, found.windows, state);
  if (found.case_hash != case_hash)
    refuse(path, fmt::format("it was written for case hash {}, this case has {}", found.case_hash, case_hash));
  if (found.name != name || found.windows != windows)
    refuse(path, fmt::format("it holds {} after {} windows, wanted is {} after {}", found.name, found.windows, name,
                             windows));
  return state;
}

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "the file cannot be opened");
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

std::uint32_t file_checksum(const std::string& path) {
  const std::string text = file_text(path);
  return crc32c(text.data(), text.size());
}

}  // namespace standoff
