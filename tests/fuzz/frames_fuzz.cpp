// A whole message, envelope and arrays: refused with ProtocolError, or taken by the session and by both sides' readers
// of arrays, which in turn refuse what does not fit.
// Input: for each frame two bytes of length, little-endian, and the frame.
#include "coupling/contract/surface_fields.hpp"
#include "coupling/session/session.hpp"
#include "coupling/transport/codec.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace standoff;

namespace {

constexpr std::size_t most_nodes = 1000;

Frames cut(const std::uint8_t* data, std::size_t size) {
  Frames frames;
  while (size >= 2) {
    const std::size_t length = std::min<std::size_t>(data[0] + 256u * data[1], size - 2);
    frames.emplace_back(data + 2, length);
    data += 2 + length, size -= 2 + length;
  }
  return frames;
}

template <class Reading>
void try_to(const Reading& reading) {
  try {
    reading();
  } catch (const ProtocolError&) {
    // refused
  }
}

void read_arrays(const Payload& payload) {
  for (const FieldDescriptor& field : payload.fields) {
    if (field.shape.count > static_cast<std::int64_t>(most_nodes)) continue;
    const auto nodes = static_cast<std::size_t>(field.shape.count);
    SurfaceMotion motion;
    SurfaceLoad load;
    try_to([&] { take_motion(payload, nodes, motion); });
    try_to([&] { take_load(payload, nodes, load); });
  }
}

void take(const Parcel& parcel) {
  SessionRules rules;
  rules.until = 1.0;
  Received received{"address", parcel.envelope, parcel.body, {}, parcel.payload, 0};
  if (parcel.payload) received.fields = parcel.payload->shapes();
  SessionStep step = step_session(open_session(rules, 0.0), received, 0.0);
  if (const auto* surface = std::get_if<message::Surface>(&parcel.body); surface && parcel.payload)
    try_to([&] { mesh_from(*parcel.payload, surface->nodes, surface->quads); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_to([&] {
    const Parcel parcel = decode(cut(data, size));
    take(parcel);
    if (parcel.payload) read_arrays(*parcel.payload);
  });
  return 0;
}
