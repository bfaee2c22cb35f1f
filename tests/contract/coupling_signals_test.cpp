// Law: a signal that a program has a handler for changes nothing in what is sent and received, whatever call of the
// system it falls into: every message arrives once, whole and in order. Counts, no tolerances.
#include <thread>

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>

#include "coupling/transport/dealer.hpp"
#include "coupling/transport/router.hpp"
#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {
namespace {

using namespace std::chrono_literals;

/// Signals to the thread that made it, so many that some fall into every call.
class Hail {
 public:
  Hail() {
    struct sigaction nothing {};
    nothing.sa_handler = [](int) {};
    sigaction(SIGUSR1, &nothing, nullptr);
    thread_ = std::jthread([target = pthread_self()](const std::stop_token& over) {
      for (; !over.stop_requested(); std::this_thread::yield()) pthread_kill(target, SIGUSR1);
    });
  }

 private:
  std::jthread thread_;
};

/// The next message on `socket`, or nothing after ten seconds; signals end each wait.
template <class Socket>
auto next_on(Socket& socket) {
  auto message = socket.receive();
  for (const auto until = std::chrono::steady_clock::now() + 10s; !message && std::chrono::steady_clock::now() < until;
       message = socket.receive())
    socket.wait(10ms);
  return message;
}

class HailOfSignals : public testing::TestWithParam<const char*> {};

TEST_P(HailOfSignals, MessagesThereAndBack_AllArriveWholeAndInOrder) {
  const CoupledRun run;
  const std::string kind = GetParam();
  Router router(parse_endpoint(kind == "inproc" ? "inproc://" + run.folder : "ipc://" + run.folder + "/hail", false));
  Dealer dealer(router.endpoint());
  ASSERT_TRUE(eventually(10.0, [&] { return dealer.look(), dealer.connected(); }));
  const Payload payload = [] {
    Payload one;
    one.add("force", 3, std::vector<double>(30, 1.0));
    return one;
  }();
  const Hail hail;
  for (std::uint64_t k = 1; k <= 5000; ++k) {
    ASSERT_TRUE(dealer.send(encode({"token", 1, k, "particles", 0}, message::Advance{}, &payload), 2s)) << k;
    auto there = next_on(router);
    ASSERT_TRUE(there.has_value() && !router.receive()) << k;
    ASSERT_EQ(decode(std::move(there->frames)).envelope.sequence, k);
    ASSERT_EQ(router.send(there->address, encode({"token", 1, k, "broker", 0}, message::Grant{}, &payload)),
              Router::Delivery::sent)
        << k;
    auto back = next_on(dealer);
    ASSERT_TRUE(back.has_value() && !dealer.receive()) << k;
    ASSERT_EQ(decode(std::move(*back)).envelope.sequence, k);
  }
  EXPECT_TRUE(router.take_gone().empty());
  dealer.look();
  EXPECT_FALSE(dealer.lost());
}

INSTANTIATE_TEST_SUITE_P(Each, HailOfSignals, testing::Values("inproc", "ipc"));

}  // namespace
}  // namespace standoff::test
