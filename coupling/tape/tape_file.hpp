#pragma once
// A tape: everything that crossed the interface of a run, in a file of our own framing.
//
//   "SDTAPE1\n"  record  record  ...  [index record]  [offset of the index, "SDTAPEND"]
//   record = kind u32 | size of the body u64 | body (base/state_archive.hpp) | CRC-32C of all before u32
//
// Records: one head (what was coupled and how), one frame for each ADVANCE in the order in which the broker took them.
// A tape that was cut off has no index: it is read record by record up to the first that is not whole. A field whose
// values are all zero is stored without them: a load before the blast arrives costs nothing.
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/contract/surface.hpp"
#include "coupling/session/messages.hpp"

namespace standoff {

/// What was coupled.
struct TapeHead {
  std::string case_hash;
  CouplingClock clock;
  WindowNeeds load_needs, structure_needs;
  SurfaceMesh surface;
  template <class Archive>
  void archive(Archive& a) {
    a(case_hash, clock.window, clock.windows, clock.parallel, clock.first, load_needs, structure_needs);
    a(surface.position, surface.quads, surface.node_mass);
  }
};

/// One ADVANCE. Of the load side `force` is filled, of the structure `position` and `velocity`.
struct TapeFrame {
  Role role = Role::load;
  std::int64_t window = 0;
  InterfaceTotals totals;
  double wall = 0.0;  // s since the head
  std::vector<Vec3> force, position, velocity;
  template <class Archive>
  void archive(Archive& a) {
    a(role, window, totals, wall);
    for (auto* field : {&force, &position, &velocity}) archive_field(a, *field);
  }

 private:
  template <class Archive>
  static void archive_field(Archive& a, std::vector<Vec3>& field) {
    std::uint64_t count = field.size();
    std::uint8_t zero = all_zero(field);
    a(count, zero);
    if (zero == 0) a(field);
    if constexpr (Archive::reading)
      if (zero != 0) field.assign(bounded(count), Vec3{});
  }
  static bool all_zero(const std::vector<Vec3>& field);
  /// Throws for a count no surface has: a damaged tape must not ask for all memory.
  static std::size_t bounded(std::uint64_t count);
};

enum class TapeKind : std::uint32_t { head = 1, frame = 2, index = 3 };

/// Where the frames are in the file, and which they are.
struct TapeEntry {
  std::uint64_t offset = 0, size = 0;  // of the record
  Role role = Role::load;
  std::int32_t spare = 0;
  std::int64_t window = 0;
};

/// Record of `kind` around `body`.
std::string tape_record(TapeKind kind, const std::string& body);
constexpr std::string_view tape_magic = "SDTAPE1\n", tape_end = "SDTAPEND";

}  // namespace standoff
