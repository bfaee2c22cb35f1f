// A case file: any text gives a case or a list of mistakes, never an exception. A case that is accepted is the same
// after its resolved form has been read.
#include "coupling/case/case_reader.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const standoff::CaseRead read = standoff::read_case(fuzz::file_with(data, size, ".toml"));
  if (!read.errors.empty()) return 0;
  const auto* text = reinterpret_cast<const std::uint8_t*>(read.resolved.data());
  const standoff::CaseRead again = standoff::read_case(fuzz::file_with(text, read.resolved.size(), ".toml"));
  fuzz::require(again.errors.empty(), "the resolved case is refused");
  fuzz::require(again.hash == read.hash, "the resolved case is another one");
  return 0;
}
