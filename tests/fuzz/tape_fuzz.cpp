// A tape: any file is refused with Stop, or read as far as it is whole; a damaged record is refused, never believed.
#include "coupling/base/stop.hpp"
#include "coupling/tape/tape_reader.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    standoff::TapeReader tape(fuzz::file_with(data, size, ".tape"));
    fuzz::require(tape.readable() <= tape.bytes(), "more can be read than there is");
    for (const standoff::TapeEntry& entry : tape.entries()) tape.frame(entry);
  } catch (const standoff::Stop&) {
    // refused
  }
  return 0;
}
