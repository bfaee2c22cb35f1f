#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <new>
#include <thread>

#include <unistd.h>

#include "coupling/contract/participant_main.hpp"
#include "coupling/contract/process_watch.hpp"

namespace standoff {
namespace {

using namespace std::chrono_literals;

/// A solver that does not come to a coupling call, or has not joined yet, is ended here.
class LastResort {
 public:
  explicit LastResort(const std::string& program) : program_(program), thread_([this] { watch(); }) {}
  ~LastResort() {
    {
      const std::lock_guard guard(mutex_);
      over_ = true;
    }
    wakes_.notify_all();
    thread_.join();
  }

 private:
  bool sleep(std::chrono::milliseconds time) {
    std::unique_lock guard(mutex_);
    return wakes_.wait_for(guard, time, [&] { return over_; });
  }
  void watch() {
    std::string reason;
    while ((reason = reason_to_end()).empty())
      if (sleep(100ms)) return;
    if (sleep(4s)) return;
    // The broker ends an interrupted run after some 25 s at the latest (Deadlines::save), saved or not.
    for (int i = 0; i < 300 && is_saving(); ++i)
      if (sleep(100ms)) return;
    std::fprintf(stderr, "%s: error: %s\n", program_.c_str(), reason.c_str());
    _exit(static_cast<int>(ExitCode::interrupted));
  }

  const std::string& program_;
  std::mutex mutex_;
  std::condition_variable wakes_;
  bool over_ = false;
  std::thread thread_;
};

/// Exit code and text of the exception being handled.
std::pair<ExitCode, std::string> current_failure() {
  try {
    throw;
  } catch (const Stop& stop) {
    return {stop.code(), stop.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::out_of_resources, "out of memory: use a coarser level or fewer particles"};
  } catch (const std::exception& error) {
    return {ExitCode::guard, std::string("unexpected failure: ") + error.what()};
  } catch (...) {
    return {ExitCode::guard, "unexpected failure of unknown kind"};
  }
}

}  // namespace

int participant_main(const std::string& program, const std::function<void()>& body) noexcept {
  try {
    watch_process();
    reuse_large_blocks();
    const LastResort last_resort(program);
    body();
    return static_cast<int>(ExitCode::done);
  } catch (...) {
    const auto [code, text] = current_failure();
    std::fprintf(stderr, "%s: error: %s\n", program.c_str(), text.c_str());
    return static_cast<int>(code);
  }
}

void with_link(const ParticipantOptions& options, const std::function<void(Participant&)>& body) {
  Participant link(options);
  try {
    body(link);
  } catch (...) {
    const auto [code, text] = current_failure();
    link.abort(static_cast<int>(code), text);
    link.throw_first_cause();
    throw;
  }
}

}  // namespace standoff
