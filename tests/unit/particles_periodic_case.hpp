#pragma once
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::particles::test {

/// A charge, bare or in a shell of sand, over a wall without end.
inline CaseSpec periodic_case(const std::string& soil, const std::string& more = "",
                              std::vector<std::pair<std::string, std::string>> set = {}) {
  standoff::test::CaseFolder folder;
  folder.write("case.toml", R"([charge]
explosive = "c4"
mass = "150 g"
radius = "28.2 mm"
particles = 600
[plate]
material = "al6xn"
size = ["100 mm", "100 mm", "3.4 mm"]
surround = "rigid"
surround_size = "300 mm"
[domain]
size = ["0.25 m", "0.25 m", "1.25 m"]
boundaries = "periodic"
[run]
stand_off = "100 mm"
until = "0.2 ms"
symmetry = "none"
[soil]
inner_radius = "30 mm"
outer_radius = "76.2 mm"
particles = 1500
kind = ")" + soil + "\"\n" + more);
  const CaseRead read = folder.read("case.toml", standoff::test::with_set(std::move(set)));
  EXPECT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  return read.spec;
}

}  // namespace standoff::particles::test
