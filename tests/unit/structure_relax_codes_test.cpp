// Every return code that SUNDIALS 6.4.1 can name is in our tables under that name, with a meaning and an action. The
// names come from the library itself, so the tables cannot drift from it. Exact comparison: strings.
#include <cstdlib>
#include <string>

#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <kinsol/kinsol.h>

#include "structure_solver/relaxation/solver_codes.hpp"

namespace standoff::structure {
namespace {

std::string taken(char* text) {
  const std::string copy = text;
  std::free(text);
  return copy;
}

TEST(SolverCodes, CvodeAsked_EveryCodeItNamesIsKnownByThatName) {
  int known = 0;
  for (int code = -100; code <= 100; ++code) {
    const std::string name = taken(CVodeGetReturnFlagName(code));
    if (name == "NONE") continue;
    // The library misspells one of its own names (CV_NLS_SETUPT_FAIL for -14); the header does not.
    EXPECT_EQ(cvode_code(code).name, code == CV_NLS_SETUP_FAIL ? "CV_NLS_SETUP_FAIL" : name) << "code " << code;
    EXPECT_FALSE(cvode_code(code).meaning.empty()) << name;
    ++known;
  }
  EXPECT_GT(known, 25);
}

TEST(SolverCodes, KinsolAsked_EveryCodeItNamesIsKnownByThatName) {
  int known = 0;
  for (int code = -100; code <= 100; ++code) {
    const std::string name = taken(KINGetReturnFlagName(code));
    if (name == "NONE") continue;
    EXPECT_EQ(kinsol_code(code).name, name) << "code " << code;
    EXPECT_FALSE(kinsol_code(code).meaning.empty()) << name;
    ++known;
  }
  EXPECT_GT(known, 15);
}

TEST(SolverCodes, Failures_AreNeverTakenForSuccess) {
  for (const SolverCode& entry : cvode_codes())
    EXPECT_EQ(entry.action == SolverAction::proceed, entry.code >= 0) << entry.name;
  for (const SolverCode& entry : kinsol_codes()) {
    EXPECT_NE(entry.action, SolverAction::proceed) << entry.name << ": a KINSOL flag alone is never believed";
    EXPECT_FALSE(words_for(entry.action).empty()) << entry.name;
  }
}

TEST(SolverCodes, UnknownCode_StopsTheProgram) {
  EXPECT_EQ(cvode_code(-12345).action, SolverAction::stop);
  EXPECT_EQ(kinsol_code(-12345).action, SolverAction::stop);
}

}  // namespace
}  // namespace standoff::structure
