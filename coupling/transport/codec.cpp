#include "coupling/transport/codec.hpp"

#include <fmt/format.h>

#include "coupling/transport/codec_body.hpp"

namespace standoff {
namespace {

void put_field(const FieldDescriptor& field, wire::Field& into) {
  into.set_name(field.shape.name);
  into.set_data_type(field.shape.type == DataType::f64 ? wire::F64 : wire::I32);
  into.set_components(static_cast<std::uint32_t>(field.shape.components));
  into.set_count(static_cast<std::uint64_t>(field.shape.count));
  into.set_byte_length(static_cast<std::uint64_t>(byte_length(field.shape)));
  into.set_checksum(field.checksum);
}

FieldDescriptor get_field(const wire::Field& from, const zmq::message_t& frame) {
  if (from.data_type() != wire::F64 && from.data_type() != wire::I32)
    throw ProtocolError(
        fmt::format("field \"{}\" has data type {}; known: F64, I32", from.name(), static_cast<int>(from.data_type())));
  FieldDescriptor field;
  field.shape = {from.name(), from.data_type() == wire::F64 ? DataType::f64 : DataType::i32, from.components(),
                 static_cast<std::int64_t>(from.count())};
  field.checksum = from.checksum();
  const auto length = static_cast<std::uint64_t>(byte_length(field.shape));
  if (from.byte_length() != length)
    throw ProtocolError(fmt::format("field \"{}\" announces {} bytes for {} x {} values, that is {}", from.name(),
                                    from.byte_length(), from.count(), from.components(), length));
  if (frame.size() != length)
    throw ProtocolError(fmt::format("field \"{}\" announces {} bytes, its frame holds {}: truncated or padded",
                                    from.name(), length, frame.size()));
  return field;
}

/// Valid until the next call on this thread: the memory of an envelope is used again.
const wire::Envelope& parse_envelope(const zmq::message_t& frame) {
  if (frame.size() > most_envelope_bytes)
    throw ProtocolError(fmt::format("an envelope of {} bytes; at most {}", frame.size(), most_envelope_bytes));
  // The reason reaches the user through ProtocolError; protobuf's own lines on stderr would only hide it.
  [[maybe_unused]] static const auto quiet = google::protobuf::SetLogHandler(nullptr);
  static thread_local wire::Envelope envelope;
  if (!envelope.ParseFromArray(frame.data(), static_cast<int>(frame.size())) || envelope.magic() != wire_magic)
    throw ProtocolError("the first frame is not an envelope of this protocol");
  if (envelope.wire_version() != wire_version)
    throw ProtocolError(fmt::format("wire version {} where this program speaks {}: use programs of the same release",
                                    envelope.wire_version(), wire_version));
  return envelope;
}

}  // namespace

Frames encode(const Envelope& envelope, const Message& body, const Payload* payload) {
  static thread_local wire::Envelope out;  // its memory is used again
  out.Clear();
  out.set_magic(wire_magic);
  out.set_wire_version(wire_version);
  out.set_token(envelope.token);
  out.set_epoch(envelope.epoch);
  out.set_sequence(envelope.sequence);
  out.set_sender(envelope.sender);
  out.set_window(envelope.window);
  put_body(body, out);
  if (payload != nullptr)
    for (const FieldDescriptor& field : payload->fields) put_field(field, *out.add_fields());
  Frames frames;
  frames.reserve(1 + (payload != nullptr ? payload->frames.size() : 0));
  frames.emplace_back(out.ByteSizeLong());
  out.SerializeWithCachedSizesToArray(frames[0].data<std::uint8_t>());  // the sizes are those just found
  if (payload == nullptr) return frames;
  for (const zmq::message_t& frame : payload->frames) {
    zmq::message_t shared;
    shared.copy(const_cast<zmq::message_t&>(frame));  // counts a reference, the bytes stay where they are
    frames.push_back(std::move(shared));
  }
  return frames;
}

Parcel decode(Frames frames) {
  if (frames.empty()) throw ProtocolError("an empty message");
  const wire::Envelope& in = parse_envelope(frames[0]);
  if (static_cast<std::size_t>(in.fields_size()) != frames.size() - 1)
    throw ProtocolError(
        fmt::format("{} fields announced, {} frames behind the envelope", in.fields_size(), frames.size() - 1));
  Parcel parcel;
  parcel.envelope = {in.token(), in.epoch(), in.sequence(), in.sender(), in.window()};
  parcel.body = get_body(in);
  if (frames.size() == 1) return parcel;
  auto payload = std::make_shared<Payload>();
  payload->fields.reserve(frames.size() - 1);
  payload->frames.reserve(frames.size() - 1);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    payload->fields.push_back(get_field(in.fields(static_cast<int>(i) - 1), frames[i]));
    payload->frames.push_back(std::move(frames[i]));
  }
  parcel.payload = std::move(payload);
  return parcel;
}

}  // namespace standoff
