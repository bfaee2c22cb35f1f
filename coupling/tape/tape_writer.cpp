#include "coupling/tape/tape_writer.hpp"

#include <cstring>

#include <errno.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "coupling/base/state_archive.hpp"
#include "coupling/transport/field.hpp"

namespace standoff {
namespace {

void take(const Payload& payload, const char* name, std::vector<Vec3>& into) {
  for (const FieldDescriptor& field : payload.fields) {
    if (field.shape.name != name) continue;
    into.resize(static_cast<std::size_t>(field.shape.count));
    payload.take(name, 3, std::span<double>(reinterpret_cast<double*>(into.data()), 3 * into.size()));
  }
}

}  // namespace

TapeWriter::TapeWriter(std::string path)
    : path_(std::move(path)), file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
  if (file_ < 0)
    throw Stop(ExitCode::out_of_resources, fmt::format("cannot write tape {}: {}", path_, strerror(errno)));
  thread_ = std::thread([this] { run(); });
}

TapeWriter::~TapeWriter() {
  {
    const std::lock_guard guard(mutex_);
    over_ = true;
  }
  wakes_.notify_all();
  thread_.join();
  ::close(file_);
}

void TapeWriter::head(TapeHead head) {
  push({std::move(head), {}, nullptr});
}

void TapeWriter::frame(Role role, std::int64_t window, const InterfaceTotals& totals, double wall,
                       PayloadHandle fields) {
  TapeFrame frame;
  frame.role = role, frame.window = window, frame.totals = totals, frame.wall = wall;
  push({std::nullopt, std::move(frame), std::move(fields)});
}

void TapeWriter::push(Item item) {
  {
    const std::lock_guard guard(mutex_);
    if (!error_.empty()) throw Stop(ExitCode::out_of_resources, error_);
    queue_.push_back(std::move(item));
  }
  wakes_.notify_all();
}

void TapeWriter::run() {
  for (;;) {
    std::deque<Item> items;
    bool last = false;
    {
      std::unique_lock guard(mutex_);
      wakes_.wait(guard, [&] { return over_ || !queue_.empty(); });
      items.swap(queue_);
      last = over_;
    }
    try {
      for (const Item& item : items) write(item);
      if (last) return close();
    } catch (const std::exception& error) {
      const std::lock_guard guard(mutex_);
      error_ = error.what();
      return;
    }
  }
}

void TapeWriter::write(const Item& item) {
  StateWriter body;
  if (item.head) {
    body(*item.head);
    append(std::string(tape_magic) + tape_record(TapeKind::head, body.bytes()));
    return;
  }
  TapeFrame frame = item.frame;
  if (item.fields) {
    take(*item.fields, "force", frame.force);
    take(*item.fields, "position", frame.position);
    take(*item.fields, "velocity", frame.velocity);
  }
  body(frame);
  const std::string record = tape_record(TapeKind::frame, body.bytes());
  entries_.push_back({offset_, record.size(), frame.role, 0, frame.window});
  append(record);
}

void TapeWriter::append(const std::string& record) {
  for (std::size_t done = 0; done < record.size();) {
    const ssize_t count = ::write(file_, record.data() + done, record.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw Stop(ExitCode::out_of_resources, fmt::format("cannot write tape {}: {}", path_, strerror(errno)));
    done += static_cast<std::size_t>(count);
  }
  offset_ += record.size();
}

void TapeWriter::close() {
  if (offset_ == 0) return;  // a run that never started: no head, no tape
  StateWriter body;
  body(entries_);
  const std::uint64_t place = offset_;
  append(tape_record(TapeKind::index, body.bytes()));
  append(std::string(reinterpret_cast<const char*>(&place), sizeof place) + std::string(tape_end));
  fsync(file_);
}

}  // namespace standoff
