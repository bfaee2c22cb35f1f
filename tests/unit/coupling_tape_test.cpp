// Law: what is recorded is read back bit for bit; a tape that was cut off anywhere gives every record before the cut; a
// changed byte is never read as data. A replay with other windows keeps the impulse up to any common time and follows a
// motion that is cubic in time exactly (cubic Hermite reproduces cubics). Tolerance there: a few hundred roundings.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "coupling/contract/surface_fields.hpp"
#include "coupling/replay/replay.hpp"
#include "coupling/tape/tape_compare.hpp"
#include "coupling/tape/tape_writer.hpp"

namespace standoff::test {
namespace {

constexpr double length = 0.25;  // s, of a window
constexpr std::int64_t windows = 8;

SurfaceMesh square() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {1, 1, 1, 1}};
}
double height(double t) {
  return 0.3 * t - 0.2 * t * t + 0.7 * t * t * t;
}
double speed(double t) {
  return 0.3 - 0.4 * t + 2.1 * t * t;
}
Vec3 force_in(std::int64_t k, std::size_t node) {
  return k == 0 ? Vec3{} : Vec3{0.1 * static_cast<double>(k), -0.0, 1.0 + static_cast<double>(node)};
}

struct Tape {
  Tape() : path((std::filesystem::temp_directory_path() / ("tape_" + std::to_string(getpid()))).string()) {}
  ~Tape() { std::filesystem::remove(path); }
  void record() const {
    TapeWriter writer(path);
    TapeHead head;
    head.case_hash = "case";
    head.clock = {length, windows, true, 0};
    head.surface = square();
    writer.head(head);
    InterfaceTotals totals;
    for (std::int64_t k = 0; k < windows; ++k) {
      SurfaceLoad load;
      SurfaceMotion motion = {square().position, std::vector<Vec3>(4)};
      for (std::size_t n = 0; n < 4; ++n) {
        load.force.push_back(force_in(k, n));
        totals.impulse += load.force[n] * length;
        motion.position[n].z = height(static_cast<double>(k + 1) * length);
        motion.velocity[n].z = speed(static_cast<double>(k + 1) * length);
      }
      writer.frame(Role::load, k, totals, 0.0, std::make_shared<Payload>(to_fields(load)));
      writer.frame(Role::structure, k, {}, 0.0, std::make_shared<Payload>(to_fields(motion)));
    }
  }
  std::string text() const {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return all.str();
  }
  void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
  std::string path;
};

TEST(Tape, Recorded_IsReadBackBitForBit) {
  const Tape tape;
  tape.record();
  TapeReader reader(tape.path);
  EXPECT_TRUE(reader.has_index());
  ASSERT_EQ(reader.entries().size(), 2u * windows);
  EXPECT_EQ(reader.head().surface.quads, square().quads);
  for (std::int64_t k = 0; k < windows; ++k) {
    const TapeFrame frame = reader.frame(reader.entries()[static_cast<std::size_t>(reader.find(Role::load, k))]);
    ASSERT_EQ(frame.force.size(), 4u);
    for (std::size_t n = 0; n < 4; ++n) {
      EXPECT_EQ(frame.force[n], force_in(k, n));
      EXPECT_EQ(std::signbit(frame.force[n].y), k > 0) << "a negative zero is kept";
    }
  }
  const TapeEntry &empty = reader.entries()[0], &full = reader.entries()[2];
  EXPECT_EQ(full.size - empty.size, 4 * sizeof(Vec3) + 8) << "an array of zeros costs nothing";
}

TEST(Tape, CutOffAnywhere_GivesEveryRecordBeforeTheCut) {
  const Tape tape;
  tape.record();
  const std::string whole = tape.text();
  const std::vector<TapeEntry> entries = TapeReader(tape.path).entries();
  for (std::size_t size = entries[0].offset; size < whole.size(); size += 7) {
    tape.write(whole.substr(0, size));
    TapeReader reader(tape.path);
    std::size_t expected = 0;
    while (expected < entries.size() && entries[expected].offset + entries[expected].size <= size) ++expected;
    EXPECT_EQ(reader.entries().size(), expected) << "cut to " << size << " bytes";
    EXPECT_FALSE(reader.has_index());
  }
}

TEST(Tape, AnyByteChanged_IsNeverReadAsData) {
  const Tape tape;
  tape.record();
  const std::string whole = tape.text();
  for (std::size_t at = 0; at < whole.size(); at += 11) {
    std::string spoilt = whole;
    spoilt[at] = static_cast<char>(spoilt[at] ^ 0x20);
    tape.write(spoilt);
    bool noticed = false;
    try {
      TapeReader reader(tape.path);
      noticed = !reader.has_index();
      for (const TapeEntry& entry : reader.entries()) reader.frame(entry);
    } catch (const Stop&) {
      noticed = true;
    }
    EXPECT_TRUE(noticed) << "byte " << at;
  }
}

TEST(Replay, SameWindows_SendsTheRecordedBits) {
  const Tape tape;
  tape.record();
  TapeReader reader(tape.path);
  ReplayedSide load(reader, Role::load);
  for (std::int64_t k = 0; k < windows; ++k) EXPECT_EQ(load.at(reader.head().clock, k).force[3], force_in(k, 3));
  EXPECT_THROW(load.at(reader.head().clock, windows), Stop);
}

TEST(Replay, OtherWindows_KeepImpulseAndPath) {
  const Tape tape;
  tape.record();
  TapeReader reader(tape.path);
  for (const std::int64_t count : {5, 16, 23}) {
    const CouplingClock clock{windows * length / static_cast<double>(count), count, true, 0};
    ReplayedSide load(reader, Role::load), motion(reader, Role::structure);
    Vec3 impulse, recorded;
    for (std::int64_t k = 0; k < count; ++k) {
      const double end = static_cast<double>(k + 1) * clock.window;
      const TapeFrame frame = load.at(clock, k);
      for (const Vec3& f : frame.force) impulse += f * clock.window;
      EXPECT_NEAR(frame.totals.impulse.z, impulse.z, 1e-12) << "N s at " << end << " s";
      const TapeFrame moved = motion.at(clock, k);
      if (end < length) continue;  // before the first frame the recorded path begins at rest, this cubic does not
      EXPECT_NEAR(moved.position[0].z, height(end), 1e-12) << "m at " << end << " s";
      EXPECT_NEAR(moved.velocity[0].z, speed(end), 1e-11) << "m/s at " << end << " s";
    }
    for (std::int64_t k = 0; k < windows; ++k)
      for (std::size_t n = 0; n < 4; ++n) recorded += force_in(k, n) * length;
    EXPECT_NEAR(impulse.z, recorded.z, 1e-12);
  }
}

TEST(TapeDiff, OneSidesTwoTapes_AreToldApartByFieldAndWindow) {
  const Tape tape;
  tape.record();
  const std::string copy = tape.path + "_other";
  {
    TapeReader from(tape.path);
    TapeWriter to(copy);
    to.head(from.head());
    for (const TapeEntry& entry : from.entries()) {
      const TapeFrame frame = from.frame(entry);
      SurfaceLoad load{frame.force};
      if (entry.role == Role::load && entry.window == 5) load.force[2].z += 0.5;
      const SurfaceMotion motion{frame.position, frame.velocity};
      to.frame(entry.role, entry.window, frame.totals, 0.0,
               std::make_shared<Payload>(entry.role == Role::load ? to_fields(load) : to_fields(motion)));
    }
  }
  TapeReader a(tape.path), b(tape.path), c(copy);
  EXPECT_TRUE(compare_tapes(a, b).same());
  const TapeDifference found = compare_tapes(a, c);
  EXPECT_FALSE(found.same());
  EXPECT_EQ(found.fields[0].first_window, 5);
  EXPECT_EQ(found.fields[0].largest, 0.5);
  EXPECT_EQ(found.fields[1].first_window, -1);
  std::filesystem::remove(copy);
}

}  // namespace
}  // namespace standoff::test
