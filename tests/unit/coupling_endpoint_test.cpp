// Law: an endpoint that cannot work, or that opens the run to other machines, is refused before anything starts, with a
// text that says what to write instead. 107 characters is the length of sun_path on Linux less its end mark.
#include <filesystem>

#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "coupling/transport/endpoint.hpp"

namespace standoff::test {
namespace {

std::string refusal(const std::string& text, bool insecure = false) {
  try {
    parse_endpoint(text, insecure);
    return "";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::bad_case);
    return stop.what();
  }
}

TEST(Endpoint, LocalAddresses_AreAccepted) {
  for (const char* text :
       {"ipc:///tmp/x/broker", "tcp://127.0.0.1:5555", "tcp://127.0.0.1:*", "tcp://localhost:1", "tcp://[::1]:7"})
    EXPECT_EQ(refusal(text), "") << text;
}

TEST(Endpoint, AddressesOtherMachinesCanReach_NeedInsecure) {
  for (const char* text : {"tcp://0.0.0.0:5555", "tcp://*:5555", "tcp://192.168.1.4:5555", "tcp://127.example.org:1"}) {
    EXPECT_NE(refusal(text).find("--insecure"), std::string::npos) << text;
    EXPECT_EQ(refusal(text, true), "") << text;
  }
}

TEST(Endpoint, ImpossibleAddresses_AreRefused) {
  EXPECT_EQ(refusal("ipc:///" + std::string(106, 'a')), "");
  EXPECT_NE(refusal("ipc:///" + std::string(107, 'a')).find("the system allows 107"), std::string::npos);
  EXPECT_NE(refusal("ipc://relative").find("absolute"), std::string::npos);
  for (const char* text : {"", "tcp://", "tcp://127.0.0.1", "udp://127.0.0.1:1", "inproc://", "tcp://127.0.0.1:65536",
                           "tcp://127.0.0.1:x"})
    EXPECT_NE(refusal(text).find("expected ipc://"), std::string::npos) << text;
}

TEST(Endpoint, InprocOfAProgram_IsOutOfReach) {
  EXPECT_NE(why_out_of_reach("inproc://x").find("use ipc:///folder/name"), std::string::npos);
  for (const char* text : {"ipc:///tmp/x/broker", "tcp://127.0.0.1:5555"}) EXPECT_EQ(why_out_of_reach(text), "");
}

TEST(EndpointLock, HeldByOneBroker_RefusesASecondAndLeavesNothing) {
  char folder[] = "/tmp/standoff-test-XXXXXX";
  const std::string path = std::string(mkdtemp(folder)) + "/broker";
  const Endpoint endpoint = parse_endpoint("ipc://" + path, false);
  {
    const EndpointLock first(endpoint);
    EXPECT_THROW(EndpointLock second(endpoint), Stop);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  { const EndpointLock again(endpoint); }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace standoff::test
