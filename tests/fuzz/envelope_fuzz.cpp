// The first frame of a message: any bytes are either refused with ProtocolError, or a message that is the same after it
// has been written and read again.
#include "coupling/transport/codec.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace standoff;

namespace {

Parcel read(const std::string& bytes) {
  Frames frames;
  frames.emplace_back(bytes.data(), bytes.size());
  return decode(std::move(frames));
}

std::string text_of(const Parcel& parcel) {
  return encode(parcel.envelope, parcel.body, nullptr)[0].to_string();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string once = text_of(read({reinterpret_cast<const char*>(data), size}));
    fuzz::require(text_of(read(once)) == once, "a message changes when it is read again");
  } catch (const ProtocolError&) {
    // refused
  }
  return 0;
}
