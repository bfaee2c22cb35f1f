#pragma once
// Between messages and frames: [envelope, protobuf] [field 0] [field 1] ... What arrives is untrusted: every size is
// checked before it is used, and a message that is not ours throws ProtocolError with the reason.
#include <cstdint>
#include <vector>

#include <zmq.hpp>

#include "coupling/session/messages.hpp"
#include "coupling/transport/field.hpp"

namespace standoff {

constexpr std::uint32_t wire_magic = 0x4F445453u;  // "STDO"
constexpr std::uint32_t wire_version = 1;
constexpr std::size_t most_envelope_bytes = 1u << 20;
constexpr std::int64_t most_frame_bytes = 256ll << 20;

using Frames = std::vector<zmq::message_t>;

struct Parcel {
  Envelope envelope;
  Message body;
  PayloadHandle payload;  // null without fields
};

/// Frames of a message; payload frames are shared with `payload`, not copied.
Frames encode(const Envelope& envelope, const Message& body, const Payload* payload);
Parcel decode(Frames frames);

}  // namespace standoff
