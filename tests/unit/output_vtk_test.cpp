// Law: what is written can be read back bit for bit: decompressing the appended blocks of a piece gives the arrays that
// went in. Layout: VTK file format guide, "appended raw data, compressed": UInt64 [blocks][block size][last
// size][sizes].
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>
#include <zlib.h>

#include "coupling/base/stop.hpp"
#include "coupling/output/atomic_file.hpp"
#include "coupling/output/vtk_file.hpp"

namespace standoff {
namespace {

std::string inflate_array(const std::string& text, const std::string& name) {
  std::smatch match;
  const std::regex element("Name=\"" + name + "\"[^>]*offset=\"(\\d+)\"");
  if (!std::regex_search(text, match, element)) return "no array " + name;
  const char* at = text.data() + text.find("\n_") + 2 + std::stoul(match[1]);
  std::uint64_t head[3];
  std::memcpy(head, at, sizeof head);
  std::string result;
  const char* block = at + (3 + head[0]) * 8;
  for (std::uint64_t b = 0; b < head[0]; ++b) {
    std::uint64_t packed = 0;
    std::memcpy(&packed, at + (3 + b) * 8, 8);
    uLongf size = b + 1 == head[0] && head[2] ? head[2] : head[1];
    std::string piece(size, '\0');
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(piece.data()), &size, reinterpret_cast<const Bytef*>(block), packed),
              Z_OK);
    result += piece;
    block += packed;
  }
  return result;
}

TEST(VtkPiece, ManyParticles_ReadBackAsWritten) {
  std::vector<Vec3> points;  // more than one compression block
  for (int i = 0; i < 200000; ++i) points.push_back({0.5 * i, -1.0 * i, 0.25});
  const std::string text = vtp_text(points, {vtk_array("speed_m_per_s", std::vector<double>(points.size(), 3.0))});
  const std::string bytes = inflate_array(text, "Points");
  ASSERT_EQ(bytes.size(), points.size() * 12);
  float last[3];
  std::memcpy(last, bytes.data() + bytes.size() - 12, 12);
  EXPECT_EQ(last[0], 0.5f * 199999);
  EXPECT_EQ(last[1], -199999.0f);
}

TEST(VtkPiece, OneHexahedron_KeepsItsConnectivity) {
  VtkGrid grid;
  grid.points.resize(8);
  grid.cells = {{0, 1, 2, 3, 4, 5, 6, 7}};
  const std::string bytes = inflate_array(vtu_text(grid), "connectivity");
  ASSERT_EQ(bytes.size(), 64u);
  std::int64_t node = 0;
  std::memcpy(&node, bytes.data() + 7 * 8, 8);
  EXPECT_EQ(node, 7);
}

TEST(PvdSeries, TwoFrames_NamesBothPiecesWithTheirTimes) {
  const auto folder = std::filesystem::temp_directory_path() / "standoff_pvd_test";
  PvdSeries series(folder.string(), "plate", "vtu");
  series.add(0.0, "a");
  series.add(1e-3, "b");
  std::stringstream text;
  text << std::ifstream(folder / "plate.pvd").rdbuf();
  EXPECT_NE(text.str().find("timestep=\"0.001\" part=\"0\" file=\"plate_0001.vtu\""), std::string::npos) << text.str();
  std::filesystem::remove_all(folder);
}

TEST(AtomicFile, FolderDoesNotExist_SaysWhichPathAndWhyWithExitFive) {
  try {
    write_atomically("/nonexistent-folder/run.json", "{}");
    FAIL() << "no error";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::out_of_resources);
    EXPECT_NE(std::string(stop.what()).find("/nonexistent-folder/run.json"), std::string::npos) << stop.what();
  }
}

}  // namespace
}  // namespace standoff
