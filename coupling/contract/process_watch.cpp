#include "coupling/contract/process_watch.hpp"

#include <atomic>

#include <malloc.h>
#include <signal.h>
#include <unistd.h>

namespace standoff {
namespace {

std::atomic<int> noted_signal{0};  // the first; written by the handler, read by every thread
static_assert(std::atomic<int>::is_always_lock_free, "what a signal handler may touch");
std::atomic<pid_t> parent{0};  // 0: not watched
std::atomic<bool> saving{false};

extern "C" void note_signal(int number) {
  int none = 0;
  noted_signal.compare_exchange_strong(none, number);
}

}  // namespace

void watch_process() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of write, like a full disk
  const pid_t now = getppid();
  if (now > 1) parent = now;
}

void reuse_large_blocks() {
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
}

bool is_saving() {
  return saving;
}

void set_saving() {
  if (noted_signal != 0) saving = true;
}

std::string reason_to_end() {
  if (noted_signal == SIGINT) return "interrupted by SIGINT";
  if (noted_signal == SIGTERM) return "interrupted by SIGTERM";
  // Polled: the signal Linux can send on a parent's death is tied to the thread that started us, not to its process.
  const pid_t watched = parent.load();
  if (watched != 0 && getppid() != watched) return "the program that started this process has ended";
  return {};
}

}  // namespace standoff
