// Cells on disk: what is read back is what was written, bit for bit; a file that is not whole is never believed; no
// folder is no mistake; writers at the same time leave one whole file. Exact.
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "particle_solver/packing/cell_cache.hpp"

namespace standoff::particles {
namespace {

namespace files = std::filesystem;

class CellCache : public testing::Test {
 protected:
  CellCache() {
    std::string pattern = (files::temp_directory_path() / "cells_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    path_ = folder_ + "/a/b.cell";
    cell_.position = {{0.1, 0.2, 0.3}, {1.0 / 3.0, 0.5, 0.99}};
    cell_.radius = {0.05, 0.06};
    cell_.mean_radius = 0.055, cell_.max_overlap = 1e-7, cell_.coordination = 5.5, cell_.residual_pressure = 0.01;
    cell_.iterations = 17;
  }
  ~CellCache() override { files::remove_all(folder_); }
  void expect_same(const std::optional<PackedCell>& read) const {
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->position, cell_.position);
    EXPECT_EQ(read->radius, cell_.radius);
    EXPECT_EQ(read->mean_radius, cell_.mean_radius);
    EXPECT_EQ(read->max_overlap, cell_.max_overlap);
    EXPECT_EQ(read->coordination, cell_.coordination);
    EXPECT_EQ(read->residual_pressure, cell_.residual_pressure);
    EXPECT_EQ(read->iterations, cell_.iterations);
  }

  std::string folder_, path_;
  PackedCell cell_;
};

TEST_F(CellCache, WhatIsWritten_IsReadBackBitForBit) {
  store_cell(path_, cell_);
  expect_same(load_cell(path_));
}

TEST_F(CellCache, AFileThatIsCutShortOrChanged_IsNotBelieved) {
  EXPECT_FALSE(load_cell(path_)) << "there is none yet";
  store_cell(path_, cell_);
  std::ifstream file(path_, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  for (const std::size_t length : {std::size_t{0}, std::size_t{16}, whole.size() / 2, whole.size() - 8}) {
    std::ofstream(path_, std::ios::binary) << whole.substr(0, length);
    EXPECT_FALSE(load_cell(path_)) << "cut to " << length << " bytes";
  }
  std::string changed = whole;
  changed[whole.size() - 3] ^= 1;
  std::ofstream(path_, std::ios::binary) << changed;
  EXPECT_FALSE(load_cell(path_));
}

TEST_F(CellCache, AFolderThatCannotBeMade_IsNoMistake) {
  std::ofstream(folder_ + "/a") << "a file where the folder should be";
  EXPECT_NO_THROW(store_cell(path_, cell_));
  EXPECT_FALSE(load_cell(path_));
}

TEST_F(CellCache, EveryOptionAndSeed_HasItsOwnFile) {
  const PackedCellOptions base{100, 0.5, 0.01, 1};
  EXPECT_EQ(cell_file_name(base), cell_file_name({100, 0.5, 0.01, 1}));
  for (const PackedCellOptions& other : {PackedCellOptions{101, 0.5, 0.01, 1}, PackedCellOptions{100, 0.51, 0.01, 1},
                                         PackedCellOptions{100, 0.5, 0.02, 1}, PackedCellOptions{100, 0.5, 0.01, 2}})
    EXPECT_NE(cell_file_name(other), cell_file_name(base));
}

TEST_F(CellCache, ReadersBesideAWriter_SeeAWholeFileOrNone) {
  std::thread writer([&] {
    for (int n = 0; n < 50; ++n) store_cell(path_, cell_);
  });
  int seen = 0;
  for (int n = 0; n < 200; ++n)
    if (files::exists(path_)) ++seen, expect_same(load_cell(path_));
  writer.join();
  expect_same(load_cell(path_));
  EXPECT_EQ(std::distance(files::directory_iterator(folder_ + "/a"), files::directory_iterator()), 1);
}

TEST_F(CellCache, InTheUsersFolder_KeepsWhatWasPackedUnlessTurnedOff) {
  setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  const PackedCellOptions options{50, 0.4, 0.0, 77};
  const PackedCell& cell = pack_cell(options);
  const auto kept = load_cell(cell_cache_folder() + "/" + cell_file_name(options));
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->position, cell.position);
  setenv("STANDOFF_CELL_CACHE", "off", 1);
  EXPECT_EQ(cell_cache_folder(), "");
  unsetenv("STANDOFF_CELL_CACHE"), unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace standoff::particles
