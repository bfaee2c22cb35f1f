// Run folders: numbers only go up, and what holds a run is never written again (contract, sec. 2).
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/run_folder.hpp"

namespace standoff::launch {
namespace {

namespace files = std::filesystem;

class RunFolder : public ::testing::Test {
 protected:
  RunFolder() : base_(files::temp_directory_path() / ("launch_folder_" + std::to_string(getpid()))) {
    files::remove_all(base_);
    files::create_directories(base_);
  }
  ~RunFolder() override { files::remove_all(base_); }
  void put_run(const std::string& folder, const std::string& content) const {
    files::create_directories(folder);
    std::ofstream(folder + "/run.json") << content;
  }
  std::string base() const { return base_.string(); }

 private:
  files::path base_;
};

ExitCode code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Stop& stop) {
    return stop.code();
  }
  return ExitCode::done;
}

TEST_F(RunFolder, FirstRuns_AreNumberedFromOne) {
  EXPECT_EQ(new_run_folder(base(), "dry", "coarse"), base() + "/dry/coarse-1");
  EXPECT_EQ(new_run_folder(base(), "dry", "coarse"), base() + "/dry/coarse-2");
  EXPECT_EQ(new_run_folder(base(), "dry", "paper"), base() + "/dry/paper-1");
  EXPECT_EQ(new_run_folder(base(), "dry", ""), base() + "/dry/run-1");
}

TEST_F(RunFolder, GapInTheNumbers_IsNotFilled) {
  files::create_directories(base() + "/dry/coarse-7");
  files::create_directories(base() + "/dry/coarse-x");
  files::create_directories(base() + "/dry/coarse-99-old");
  EXPECT_EQ(new_run_folder(base(), "dry", "coarse"), base() + "/dry/coarse-8");
}

TEST_F(RunFolder, NameWithSlashes_StaysInsideTheBase) {
  EXPECT_EQ(new_run_folder(base(), "../a/b", "c/d"), base() + "/case.._a_b/c_d-1");
}

TEST_F(RunFolder, NamedFolderThatHoldsARun_IsRefusedWhateverItsStatus) {
  for (const char* status : {"done", "failed", "running"}) {
    const std::string folder = base() + "/" + status;
    put_run(folder, std::string(R"({"status": ")") + status + "\"}");
    EXPECT_EQ(code_of([&] { named_run_folder(folder); }), ExitCode::bad_case) << status;
  }
  put_run(base() + "/half", "{\"sta");
  EXPECT_EQ(code_of([&] { named_run_folder(base() + "/half"); }), ExitCode::bad_case);
}

TEST_F(RunFolder, NamedFolderWithoutARun_IsTaken) {
  EXPECT_EQ(named_run_folder(base() + "/a/b"), base() + "/a/b");
  EXPECT_TRUE(files::is_directory(base() + "/a/b"));
  EXPECT_EQ(named_run_folder(base() + "/a/b"), base() + "/a/b");
}

TEST_F(RunFolder, PlaceThatCannotBeAFolder_IsAWrongCommandLine) {
  std::ofstream(base() + "/file") << "x";
  EXPECT_EQ(code_of([&] { named_run_folder(base() + "/file/run"); }), ExitCode::bad_case);
  EXPECT_EQ(code_of([&] { named_run_folder(base() + "/file"); }), ExitCode::bad_case);
}

}  // namespace
}  // namespace standoff::launch
