#pragma once
// Writes a tape while a run goes on. The thread that forwards messages only puts a frame into a queue; encoding,
// checksums and the disk are another thread's.
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "coupling/session/session.hpp"
#include "coupling/tape/tape_file.hpp"

namespace standoff {

class TapeWriter {
 public:
  /// Throws Stop(out_of_resources) if the file cannot be written.
  explicit TapeWriter(std::string path);
  /// Writes what is queued and the index.
  ~TapeWriter();
  TapeWriter(const TapeWriter&) = delete;
  TapeWriter& operator=(const TapeWriter&) = delete;

  void head(TapeHead head);
  /// `fields` are shared with the message that goes on its way, not copied here. Throws Stop(out_of_resources) once
  /// the disk is full.
  void frame(Role role, std::int64_t window, const InterfaceTotals& totals, double wall, PayloadHandle fields);

 private:
  struct Item {
    std::optional<TapeHead> head;
    TapeFrame frame;
    PayloadHandle fields;
  };
  void push(Item item);
  void run();
  void write(const Item& item);
  void append(const std::string& record);
  void close();

  std::string path_;
  int file_ = -1;
  std::uint64_t offset_ = 0;
  std::vector<TapeEntry> entries_;

  std::mutex mutex_;
  std::condition_variable wakes_;
  std::deque<Item> queue_;
  bool over_ = false;
  std::string error_;
  std::thread thread_;
};

}  // namespace standoff
