#include "coupling/transport/field.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "coupling/transport/checksum.hpp"

namespace standoff {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are little-endian and copied as they are");
constexpr std::int64_t most_components = 16, most_items = 1ll << 31;

void add_frame(Payload& payload, FieldShape shape, const void* data, std::size_t size) {
  payload.frames.emplace_back(size);
  const Copied copied = copy_checked(payload.frames.back().data(), data, size);
  const bool finite = shape.type != DataType::f64 || copied.finite;
  payload.fields.push_back({std::move(shape), copied.checksum, finite});
}

/// True if all doubles are finite.
bool take_frame(const Payload& payload, const FieldShape& wanted, void* into, std::size_t size) {
  for (std::size_t i = 0; i < payload.fields.size(); ++i) {
    const FieldDescriptor& field = payload.fields[i];
    if (field.shape.name != wanted.name) continue;
    const zmq::message_t& frame = payload.frames[i];
    if (field.shape != wanted || frame.size() != size)
      throw ProtocolError(fmt::format("field \"{}\" has {} x {} values, expected {} x {}", wanted.name,
                                      field.shape.count, field.shape.components, wanted.count, wanted.components));
    const Copied copied = copy_checked(into, frame.data(), size);
    if (copied.checksum != field.checksum)
      throw ProtocolError(fmt::format("field \"{}\" does not have the checksum its sender announced", wanted.name));
    return copied.finite;
  }
  throw ProtocolError(fmt::format("field \"{}\" is missing", wanted.name));
}

FieldShape shape_of(const std::string& name, DataType type, std::int64_t components, std::size_t values) {
  return {name, type, components, static_cast<std::int64_t>(values) / components};
}

}  // namespace

std::int64_t size_of(DataType type) {
  return type == DataType::f64 ? 8 : 4;
}

std::int64_t byte_length(const FieldShape& shape) {
  if (shape.components < 1 || shape.components > most_components || shape.count < 0 || shape.count > most_items)
    throw ProtocolError(fmt::format("field \"{}\" announces {} x {} values; at most {} x {}", shape.name, shape.count,
                                    shape.components, most_items, most_components));
  return shape.count * shape.components * size_of(shape.type);
}

std::int64_t Payload::bytes() const {
  std::int64_t sum = 0;
  for (const zmq::message_t& frame : frames) sum += static_cast<std::int64_t>(frame.size());
  return sum;
}

std::vector<FieldShape> Payload::shapes() const {
  std::vector<FieldShape> list;
  for (const FieldDescriptor& field : fields) list.push_back(field.shape);
  return list;
}

bool Payload::finite() const {
  for (const FieldDescriptor& field : fields)
    if (!field.finite) return false;
  return true;
}

void Payload::add(const std::string& name, std::int64_t components, std::span<const double> values) {
  add_frame(*this, shape_of(name, DataType::f64, components, values.size()), values.data(), values.size_bytes());
}

void Payload::add(const std::string& name, std::int64_t components, std::span<const std::int32_t> values) {
  add_frame(*this, shape_of(name, DataType::i32, components, values.size()), values.data(), values.size_bytes());
}

void Payload::take(const std::string& name, std::int64_t components, std::span<double> values) const {
  if (take_frame(*this, shape_of(name, DataType::f64, components, values.size()), values.data(), values.size_bytes()))
    return;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) {
      const auto width = static_cast<std::size_t>(components);
      throw ProtocolError(
          fmt::format("field \"{}\" is {} at item {}, component {}", name, values[i], i / width, i % width));
    }
}

void Payload::take(const std::string& name, std::int64_t components, std::span<std::int32_t> values) const {
  take_frame(*this, shape_of(name, DataType::i32, components, values.size()), values.data(), values.size_bytes());
}

}  // namespace standoff
