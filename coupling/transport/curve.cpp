#include "coupling/transport/curve.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "coupling/base/stop.hpp"
#include "coupling/transport/socket_watch.hpp"

namespace standoff {
namespace {

constexpr std::size_t key_characters = 40;
using KeyText = std::array<char, key_characters + 1>;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Stop(ExitCode::bad_case, fmt::format("key file {}: {}", path, why));
}

/// Lines that are not empty and no comment; each must be a key.
std::vector<std::string> keys_in(const std::string& path) {
  std::ifstream file(path);
  if (!file) refuse(path, "it cannot be opened");
  std::vector<std::string> keys;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::array<std::uint8_t, 32> bytes{};
    if (line.size() != key_characters || zmq_z85_decode(bytes.data(), line.c_str()) == nullptr)
      refuse(path, "a line is not a key of 40 characters; standoff-broker --new-keys makes a pair");
    keys.push_back(line);
  }
  if (keys.empty()) refuse(path, "it holds no key");
  return keys;
}

std::string secret_in(const std::string& path) {
  struct stat facts {};
  if (stat(path.c_str(), &facts) == 0 && (facts.st_mode & 077) != 0)
    refuse(path, "others can read this secret: chmod 600 it");
  return keys_in(path).front();
}

std::string public_of(const std::string& secret) {
  KeyText text{};
  if (zmq_curve_public(text.data(), secret.c_str()) != 0)
    throw Stop(ExitCode::bad_case, "this libzmq was built without CURVE, or the secret is not a key");
  return text.data();
}

void write_key(const std::string& path, const std::string& key, mode_t mode) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  const std::string line = key + "\n";
  const bool written = file >= 0 && write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  const std::string why = std::strerror(errno);
  if (file >= 0) close(file);
  if (!written) refuse(path, why);
}

}  // namespace

CurveKeys read_broker_keys(const std::string& secret_file, const std::string& allow_file) {
  if (secret_file.empty() != allow_file.empty())
    throw Stop(ExitCode::bad_case, "encryption needs both --curve-secret and --curve-allow");
  if (secret_file.empty()) return {};
  return {secret_in(secret_file), "", keys_in(allow_file)};
}

CurveKeys read_participant_keys(const std::string& secret_file, const std::string& server_file) {
  if (secret_file.empty() != server_file.empty())
    throw Stop(ExitCode::bad_case, "encryption needs both --curve-secret and --curve-server");
  if (secret_file.empty()) return {};
  return {secret_in(secret_file), keys_in(server_file).front(), {}};
}

void write_new_keys(const std::string& prefix) {
  KeyText known{}, secret{};
  if (zmq_curve_keypair(known.data(), secret.data()) != 0)
    throw Stop(ExitCode::bad_case, "this libzmq was built without CURVE");
  write_key(prefix + ".secret", secret.data(), 0600);
  write_key(prefix + ".public", known.data(), 0644);
}

void use_as_server(zmq::socket_t& socket, const CurveKeys& keys) {
  socket.set(zmq::sockopt::curve_server, true);
  socket.set(zmq::sockopt::curve_secretkey, keys.secret);
  socket.set(zmq::sockopt::zap_domain, "standoff");
}

void use_as_client(zmq::socket_t& socket, const CurveKeys& keys) {
  socket.set(zmq::sockopt::curve_serverkey, keys.server);
  socket.set(zmq::sockopt::curve_publickey, public_of(keys.secret));
  socket.set(zmq::sockopt::curve_secretkey, keys.secret);
}

struct KeyGate::Impl {
  zmq::socket_t questions, end_here, end_there;
  std::vector<std::string> allowed;
  std::thread thread;

  bool lets_in(const zmq::message_t& key) const {
    KeyText text{};
    if (key.size() != 32 || zmq_z85_encode(text.data(), key.data<std::uint8_t>(), 32) == nullptr) return false;
    return std::find(allowed.begin(), allowed.end(), text.data()) != allowed.end();
  }

  /// Asked: version, request, domain, address, identity, mechanism, key. Answered: version, request, status, text,
  /// user, metadata.
  void answer(const std::vector<zmq::message_t>& asked) {
    const bool yes = asked.size() == 7 && asked[5].to_string_view() == "CURVE" && lets_in(asked[6]);
    const std::string request = asked.size() > 1 ? asked[1].to_string() : "";
    const std::array<std::string, 6> reply = {"1.0", request, yes ? "200" : "400", yes ? "OK" : "unknown key", "", ""};
    for (std::size_t i = 0; i < reply.size(); ++i)
      questions.send(zmq::buffer(reply[i]), i + 1 < reply.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }

  void serve() {
    for (;;) {
      wait_for_input(questions, end_there, -1);
      if (receive_frames(end_there)) return;
      while (const auto asked = receive_frames(questions)) answer(*asked);
    }
  }
};

KeyGate::KeyGate(zmq::context_t& context, std::vector<std::string> allowed)
    : impl_(std::make_unique<Impl>(Impl{{context, zmq::socket_type::rep},
                                        {context, zmq::socket_type::pair},
                                        {context, zmq::socket_type::pair},
                                        std::move(allowed),
                                        {}})) {
  impl_->questions.bind("inproc://zeromq.zap.01");
  impl_->end_there.bind("inproc://key-gate");
  impl_->end_here.connect("inproc://key-gate");
  impl_->thread = std::thread([my = impl_.get()] { my->serve(); });
}

KeyGate::~KeyGate() {
  impl_->end_here.send(zmq::str_buffer("end"), zmq::send_flags::none);
  impl_->thread.join();
}

}  // namespace standoff
