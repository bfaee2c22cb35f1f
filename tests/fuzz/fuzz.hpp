#pragma once
// What the targets share. A target is the function LLVMFuzzerTestOneInput; libFuzzer calls it with what it invents
// (preset fuzz), replay.cpp with the files of corpus/ (every build).
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

inline void require(bool truth, const char* what) {
  if (truth) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

/// A file in memory with these bytes, the same name for every input of a process.
inline std::string file_with(const std::uint8_t* data, std::size_t size, const std::string& ending) {
  static const std::string path = "/dev/shm/standoff-fuzz-" + std::to_string(getpid()) + ending;
  static const bool registered = std::atexit([] { unlink(path.c_str()); }) == 0;
  require(registered, "atexit");
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

}  // namespace fuzz
