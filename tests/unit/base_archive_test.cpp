// Law: what is written is read back bit for bit, and a state that is cut short is refused, whatever the place of the
// cut.
#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/base/state_archive.hpp"
#include "coupling/base/vec3.hpp"

namespace standoff {
namespace {

struct Part {
  std::vector<Vec3> position;
  std::string name;
  template <class Archive>
  void archive(Archive& a) {
    a(position, name);
  }
};

struct Whole {
  std::vector<Part> parts;
  std::optional<double> time;
  long steps = 0;
  template <class Archive>
  void archive(Archive& a) {
    a(parts, time, steps);
  }
};

Whole example() {
  const double odd = std::bit_cast<double>(0x7FF8000000000123ull);  // a NaN with a payload
  return {{{{{1.0, -0.0, odd}, {2.0, 3.0, 4.0}}, "first"}, {{}, ""}}, 0.25, 17};
}

TEST(StateArchive, AnyState_IsReadBackBitForBit) {
  StateWriter writer;
  writer(example());
  Whole copy;
  StateReader reader(writer.bytes());
  reader(copy);
  EXPECT_TRUE(reader.at_end());
  ASSERT_EQ(copy.parts.size(), 2u);
  EXPECT_EQ(copy.parts[0].name, "first");
  EXPECT_EQ(std::bit_cast<std::uint64_t>(copy.parts[0].position[0].z), 0x7FF8000000000123ull);
  EXPECT_TRUE(std::signbit(copy.parts[0].position[0].y));
  EXPECT_EQ(copy.time, 0.25);
  EXPECT_EQ(copy.steps, 17);
  StateWriter again;
  again(copy);
  EXPECT_EQ(again.bytes(), writer.bytes());
}

TEST(StateArchive, CutAnywhere_IsRefused) {
  StateWriter writer;
  writer(example());
  for (std::size_t size = 0; size < writer.bytes().size(); ++size) {
    Whole copy;
    StateReader reader(std::span(writer.bytes()).first(size));
    EXPECT_THROW(reader(copy), Stop) << "cut to " << size << " bytes";
  }
}

}  // namespace
}  // namespace standoff
