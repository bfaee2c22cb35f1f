#pragma once
// A state as bytes and back, described once. A class says what outlives a step in one place,
//
//   template <class Archive> void archive(Archive& a) { a(position, velocity, steps); }
//
// and that one list writes and reads it: StateWriter{}(object), StateReader{bytes}(object). Values, strings, vectors
// and optionals of values, and classes with `archive` or tuples of them. Bits are kept, NaN payloads too; the bytes are
// those of this machine (little-endian), as a checkpoint is read by the same build. What does not fit throws Stop with
// code 6.
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "coupling/base/stop.hpp"

namespace standoff {

template <class T, class Archive>
concept Archivable = requires(T& object, Archive& archive) {
  object.archive(archive);
};

class StateWriter {
 public:
  static constexpr bool reading = false;
  template <class... T>
  StateWriter& operator()(const T&... values) {
    (write(values), ...);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (Archivable<T, StateWriter>)
      const_cast<T&>(value).archive(*this);  // the same list reads, so it cannot be const; a writer changes nothing
    else {
      static_assert(std::is_trivially_copyable_v<T>, "give the class a member function archive");
      append(&value, sizeof value);
    }
  }
  template <class T>
  void write(const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    append(&count, sizeof count);
    if constexpr (std::is_trivially_copyable_v<T> && !Archivable<T, StateWriter>)
      append(values.data(), values.size() * sizeof(T));
    else
      for (const T& value : values) write(value);
  }
  void write(const std::string& text) {
    const std::uint64_t count = text.size();
    append(&count, sizeof count);
    append(text.data(), text.size());
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  void append(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

class StateReader {
 public:
  static constexpr bool reading = true;
  explicit StateReader(std::span<const char> bytes) : rest_(bytes) {}
  template <class... T>
  StateReader& operator()(T&... values) {
    (read(values), ...);
    return *this;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (Archivable<T, StateReader>)
      value.archive(*this);
    else {
      static_assert(std::is_trivially_copyable_v<T>, "give the class a member function archive");
      take(&value, sizeof value);
    }
  }
  template <class T>
  void read(std::vector<T>& values) {
    if constexpr (std::is_trivially_copyable_v<T> && !Archivable<T, StateReader>) {
      values.resize(count(sizeof(T)));
      take(values.data(), values.size() * sizeof(T));
    } else {
      values.resize(count(1));
      for (T& value : values) read(value);
    }
  }
  void read(std::string& text) {
    text.resize(count(1));
    take(text.data(), text.size());
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool present = false;
    read(present);
    if (present)
      read(value.emplace());
    else
      value.reset();
  }
  /// Number of items, none of which is smaller than `least` bytes: never more than there are bytes left.
  std::size_t count(std::size_t least) {
    std::uint64_t n = 0;
    take(&n, sizeof n);
    if (n > rest_.size() / least) throw_short();
    return static_cast<std::size_t>(n);
  }
  void take(void* data, std::size_t size) {
    if (size > rest_.size()) throw_short();
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  [[noreturn]] static void throw_short() {
    throw Stop(ExitCode::checkpoint_incompatible,
               "the saved state ends early: it was written by another version, or is damaged");
  }

  std::span<const char> rest_;
};

}  // namespace standoff
