#pragma once
// The part of a program that callgrind counts, by the name of this function, and what the programs share.
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

#include "coupling/case/case_reader.hpp"

extern "C" [[gnu::noinline]] inline void measured(const std::function<void()>& work) {
  work();
  asm volatile("" ::: "memory");  // no tail call: collecting ends where this function returns
}

namespace standoff::test {

struct Order {
  std::string effect;    // the one that is off, or on where the test looks whether it is seen
  bool by_hand = false;  // else composed by the scene
  CaseSpec spec;
};

/// PROGRAM EFFECT composed|by_hand CASE
inline Order order_of(int argc, char** argv) {
  if (argc != 4) throw std::runtime_error("EFFECT composed|by_hand CASE");
  const CaseRead read = read_case(argv[3], {});
  if (!read.errors.empty()) throw std::runtime_error(read.errors.front());
  return {argv[1], std::string(argv[2]) == "by_hand", read.spec};
}

}  // namespace standoff::test
