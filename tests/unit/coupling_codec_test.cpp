// Law: what is encoded is decoded to the same message, and no sequence of bytes does anything but throw ProtocolError.
// The checksum of "123456789" is 0xE3069283 (RFC 3720, appendix B.4). Exact, no tolerances.
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/transport/checksum.hpp"
#include "coupling/transport/codec.hpp"

namespace standoff::test {
namespace {

std::uint32_t slow_crc32c(const unsigned char* data, std::size_t size) {
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0x82F63B78u : 0u);
  }
  return ~crc;
}

/// By streams, and by folding where this processor can.
std::vector<bool> ways() {
  return processor_folds() ? std::vector<bool>{false, true} : std::vector<bool>{false};
}

TEST(Checksum, KnownTextAndEveryLength_MatchTheBitwiseDefinition) {
  EXPECT_EQ(crc32c("123456789", 9), 0xE3069283u);
  std::vector<unsigned char> bytes(40000);
  CounterRandom random(7, RandomUse::test, 0);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(256.0 * random.uniform());
  for (const bool fold : ways())
    for (const std::size_t size : {0u, 1u, 7u, 8u, 100u, 127u, 128u, 129u, 255u, 256u, 3071u, 3072u, 3073u, 12287u,
                                   12288u, 12289u, 24576u, 39999u}) {
      const std::uint32_t defined = slow_crc32c(bytes.data() + 1, size);
      EXPECT_EQ(crc32c(bytes.data() + 1, size, fold), defined) << size << (fold ? " folded" : " in streams");
      std::vector<unsigned char> copy(size + 2);
      EXPECT_EQ(copy_checked(copy.data() + 1, bytes.data() + 1, size, fold).checksum, defined) << size;
      EXPECT_TRUE(std::equal(copy.begin() + 1, copy.end() - 1, bytes.begin() + 1)) << size;
      EXPECT_TRUE(copy.front() == 0 && copy.back() == 0) << size << ": written beyond the end";
    }
}

TEST(AllFinite, OneBadValueAnywhere_IsFound) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> values(1001, -std::numeric_limits<double>::max()), copy(values.size());
  values[3] = 5e-324;
  EXPECT_TRUE(all_finite(values.data(), values.size()));
  for (const bool fold : ways()) {
    EXPECT_TRUE(copy_checked(copy.data(), values.data(), 8 * values.size(), fold).finite);
    for (const double bad : {std::nan(""), -std::nan(""), infinity, -infinity})
      for (std::size_t at = 0; at < values.size(); ++at) {
        std::vector<double> spoilt = values;
        spoilt[at] = bad;
        EXPECT_FALSE(all_finite(spoilt.data(), spoilt.size())) << bad << " at " << at;
        EXPECT_FALSE(copy_checked(copy.data(), spoilt.data(), 8 * spoilt.size(), fold).finite) << bad << " at " << at;
      }
  }
}

Parcel there_and_back(const Message& body, const Payload* payload = nullptr) {
  return decode(encode({"token", 3, 42, "particles", 17}, body, payload));
}

TEST(Codec, EveryKind_ComesBackAsItWas) {
  const auto hello =
      std::get<message::Hello>(there_and_back(message::Hello{"p", Role::structure, "1", "h", 9, "host"}).body);
  EXPECT_TRUE(hello.name == "p" && hello.role == Role::structure && hello.case_hash == "h" && hello.pid == 9);
  const auto reject =
      std::get<message::Reject>(there_and_back(message::Reject{ExitCode::bad_case, "why", "what"}).body);
  EXPECT_TRUE(reject.code == ExitCode::bad_case && reject.reason == "why" && reject.remedy == "what");
  const auto ready = std::get<message::Ready>(there_and_back(message::Ready{{1e-7, 2e-7}, "d"}).body);
  EXPECT_TRUE(ready.needs.stable_step == 1e-7 && ready.needs.window_limit == 2e-7 && ready.surface_digest == "d");
  const auto start = std::get<message::Start>(there_and_back(message::Start{{0.1 + 0.2, 7, false, 3}, "/f", 9}).body);
  EXPECT_TRUE(start.clock.window == 0.1 + 0.2 && start.clock.windows == 7 && !start.clock.parallel);
  EXPECT_TRUE(start.clock.first == 3 && start.folder == "/f" && start.checksum == 9);
  const auto saved = std::get<message::Saved>(there_and_back(message::Saved{5, 1ll << 40, 0xFFFFFFFF}).body);
  EXPECT_TRUE(saved.windows == 5 && saved.bytes == 1ll << 40 && saved.checksum == 0xFFFFFFFF);
  const auto order = std::get<message::Checkpoint>(there_and_back(message::Checkpoint{5, "/\xff"}).body);
  EXPECT_TRUE(order.windows == 5 && order.folder == "/\xff");
  const auto grant = std::get<message::Grant>(there_and_back(message::Grant{5, 0.5, true}).body);
  EXPECT_TRUE(grant.window == 5 && grant.begin == 0.5 && grant.drain);
  const auto advance = std::get<message::Advance>(there_and_back(message::Advance{4, {{1, 2, 3}, 4}, 5, 6}).body);
  EXPECT_TRUE(advance.window == 4 && advance.totals.impulse == (Vec3{1, 2, 3}) && advance.totals.work == 4.0);
  const auto abort =
      std::get<message::Abort>(there_and_back(message::Abort{"o", ExitCode::guard, "\xff raw", -1}).body);
  EXPECT_TRUE(abort.origin == "o" && abort.code == ExitCode::guard && abort.reason == "\xff raw" && abort.window == -1);
  const auto sample = std::get<message::Sample>(there_and_back(message::Sample{1.5, {{"a", 2.0}, {"b", 3.0}}}).body);
  EXPECT_TRUE(sample.time == 1.5 && sample.values == (NamedValues{{"a", 2.0}, {"b", 3.0}}));
  for (const Message& body : {Message(message::Welcome{1, 2, 3}), Message(message::Surface{1, 2, "d"}),
                              Message(message::StopWindows{3, "r"}), Message(message::Beat{7}), Message(message::Bye{}),
                              Message(message::ByeAck{}), Message(message::Progress{}), Message(message::Report{"{}"})})
    EXPECT_EQ(there_and_back(body).body.index(), body.index());
}

TEST(Codec, Payload_ComesBackBitForBit) {
  Payload payload;
  const std::vector<double> values = {0.1, -0.0, 1e-310, 1.7e308, 5.0, 6.0};
  const std::vector<std::int32_t> corners = {1, -2, 3, 4};
  payload.add("position", 3, std::span<const double>(values));
  payload.add("quads", 4, std::span<const std::int32_t>(corners));
  const Parcel parcel = there_and_back(message::Bye{}, &payload);
  std::vector<double> back(6);
  std::vector<std::int32_t> corners_back(4);
  parcel.payload->take("position", 3, std::span<double>(back));
  parcel.payload->take("quads", 4, std::span<std::int32_t>(corners_back));
  EXPECT_EQ(std::memcmp(back.data(), values.data(), 48), 0);
  EXPECT_EQ(corners_back, corners);
  EXPECT_THROW(parcel.payload->take("velocity", 3, std::span<double>(back)), ProtocolError);
  EXPECT_THROW(parcel.payload->take("position", 1, std::span<double>(back)), ProtocolError);
}

TEST(Codec, AnyBytes_AreReadOrRefusedNeverMore) {
  Payload payload;
  const std::vector<double> values(30, 1.0);
  payload.add("force", 3, std::span<const double>(values));
  const Frames good = encode({"token", 3, 42, "particles", 17}, message::Advance{}, &payload);
  CounterRandom random(11, RandomUse::test, 1);
  int refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Frames spoilt;
    for (const zmq::message_t& frame : good) spoilt.emplace_back(frame.data(), frame.size());
    zmq::message_t& victim = spoilt[0];
    for (int flips = 0; flips < 1 + trial % 3; ++flips)
      static_cast<unsigned char*>(
          victim.data())[static_cast<std::size_t>(random.uniform() * static_cast<double>(victim.size()))] ^=
          static_cast<unsigned char>(1u << static_cast<unsigned>(8.0 * random.uniform()));
    if (trial % 7 == 0)
      spoilt[0] = zmq::message_t(victim.data(),
                                 static_cast<std::size_t>(random.uniform() * static_cast<double>(victim.size())));
    try {
      const Parcel parcel = decode(std::move(spoilt));
      EXPECT_TRUE(!parcel.payload || parcel.payload->frames.size() == 1u);
    } catch (const ProtocolError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 5000) << "most single-bit errors hit a size, a tag or the magic";
}

}  // namespace
}  // namespace standoff::test
