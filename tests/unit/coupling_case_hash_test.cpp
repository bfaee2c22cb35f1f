// Law: two programs that read a case must have read the same one; a program that reads none says nothing about it and
// is welcome, whoever comes first.
#include <gtest/gtest.h>

#include "tests/unit/coupling_virtual_session.hpp"

namespace standoff::test {
namespace {

const std::string structure = "structure", particles = "particles", none, one = "one", other = "other";

message::Hello hello(const std::string& name, Role role, const std::string& hash) {
  message::Hello body;
  body.name = name;
  body.role = role;
  body.case_hash = hash;
  return body;
}

TEST(CaseHash, ProgramThatReadsNoCase_IsWelcomeInEitherOrder) {
  for (const bool silent_first : {true, false}) {
    VirtualSession run;
    run.say("structure", hello(structure, Role::structure, silent_first ? none : one));
    run.say("particles", hello(particles, Role::load, silent_first ? one : none));
    EXPECT_EQ(run.sent<message::Welcome>("particles").size(), 1u);
    EXPECT_EQ(run.sent<message::Welcome>("structure").size(), 1u);
  }
}

TEST(CaseHash, TwoDifferentCases_TheSecondIsRejected) {
  VirtualSession run;
  run.say("structure", hello(structure, Role::structure, one));
  run.say("particles", hello(particles, Role::load, other));
  EXPECT_EQ(run.sent<message::Reject>("particles").size(), 1u);
}

}  // namespace
}  // namespace standoff::test
