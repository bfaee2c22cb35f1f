#include "particle_solver/packing/cell_cache.hpp"

#include <array>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "coupling/base/state_hash.hpp"
#include "coupling/base/stop.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff::particles {

namespace {

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Of the running program: it stands for every line of code that a cell depends on, and for the compiler.
const std::string& program_hash() {
  static const std::string hash = [] {
    StateHash sum;
    sum.add(std::string_view(read_file("/proc/self/exe")));
    return sum.hex();
  }();
  return hash;
}

std::string checksum(std::string_view bytes) {
  StateHash sum;
  sum.add(bytes);
  return sum.hex();
}

/// Numbers as eight bytes each, in a fixed order.
class Words {
 public:
  void put(double value) { bytes_.append(std::bit_cast<std::array<char, 8>>(value).data(), 8); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace

std::string cell_cache_folder() {
  const auto variable = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
  if (variable("STANDOFF_CELL_CACHE") == "off") return "";
  const std::string cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (cache.starts_with("/")) return cache + "/standoff/cells";
  return home.starts_with("/") ? home + "/.cache/standoff/cells" : "";
}

std::string cell_file_name(const PackedCellOptions& options) {
  StateHash key;
  key.add(std::string_view(program_hash()));
  key.add(static_cast<std::uint64_t>(options.count));
  key.add(options.fill), key.add(options.radius_spread), key.add(options.seed);
  return key.hex() + ".cell";
}

std::optional<PackedCell> load_cell(const std::string& path) {
  const std::string text = read_file(path);
  constexpr std::size_t head = 16, numbers = 7;
  if (text.size() < head + 8 * numbers || text.size() % 8 != 0) return std::nullopt;
  if (checksum(std::string_view(text).substr(head)) != text.substr(0, head)) return std::nullopt;
  std::size_t at = head;
  const auto next = [&] {
    std::array<char, 8> word;
    text.copy(word.data(), 8, at);
    at += 8;
    return std::bit_cast<double>(word);
  };
  PackedCell cell;
  const auto grains = static_cast<std::size_t>(next()), radii = static_cast<std::size_t>(next());
  if (text.size() != head + 8 * (numbers + 3 * grains + radii)) return std::nullopt;
  cell.mean_radius = next(), cell.max_overlap = next(), cell.coordination = next(), cell.residual_pressure = next();
  cell.iterations = static_cast<int>(next());
  cell.position.resize(grains), cell.radius.resize(radii);
  for (Vec3& p : cell.position) p.x = next(), p.y = next(), p.z = next();
  for (double& r : cell.radius) r = next();
  return cell;
}

void store_cell(const std::string& path, const PackedCell& cell) {
  Words words;
  words.put(static_cast<double>(cell.position.size())), words.put(static_cast<double>(cell.radius.size()));
  words.put(cell.mean_radius), words.put(cell.max_overlap), words.put(cell.coordination);
  words.put(cell.residual_pressure), words.put(cell.iterations);
  for (const Vec3& p : cell.position) words.put(p.x), words.put(p.y), words.put(p.z);
  for (const double r : cell.radius) words.put(r);
  std::error_code trouble;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), trouble);
  if (trouble) return;
  try {
    write_atomically(path, checksum(words.bytes()) + words.bytes());
  } catch (const Stop&) {  // a cache that cannot be written is no cache
  }
}

}  // namespace standoff::particles
