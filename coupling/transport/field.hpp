#pragma once
// Arrays on the wire: raw little-endian frames with a descriptor each. A sender's array is copied once into a message;
// handing libzmq the solver's own memory delivered the next step's numbers in trials. A receiver trusts no size.
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <zmq.hpp>

#include "coupling/session/messages.hpp"
#include "coupling/session/session.hpp"

namespace standoff {

/// The other side sent something that is not this protocol; the text says what and where.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct FieldDescriptor {
  FieldShape shape;
  std::uint32_t checksum = 0;
  bool finite = true;  // of an array of doubles that was added here
};

/// The arrays of one message; frames[i] belongs to fields[i].
struct Payload {
  std::vector<FieldDescriptor> fields;
  std::vector<zmq::message_t> frames;

  std::int64_t bytes() const;
  std::vector<FieldShape> shapes() const;
  /// True unless a double that was added is an infinity or not a number; it may not be sent then.
  bool finite() const;

  /// Copies `values` (count x components of them) in as one field.
  void add(const std::string& name, std::int64_t components, std::span<const double> values);
  void add(const std::string& name, std::int64_t components, std::span<const std::int32_t> values);

  /// Copies field `name` out, after checking shape, checksum and (f64) that every value is finite. Throws
  /// ProtocolError.
  void take(const std::string& name, std::int64_t components, std::span<double> values) const;
  void take(const std::string& name, std::int64_t components, std::span<std::int32_t> values) const;
};

std::int64_t size_of(DataType type);
/// Bytes a field of this shape takes. Throws ProtocolError for a shape beyond the limits of the wire.
std::int64_t byte_length(const FieldShape& shape);

}  // namespace standoff
