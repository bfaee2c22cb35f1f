#pragma once
// A proxy between one participant and the broker that does one thing to one message and passes everything else on as it
// is. Deterministic: the first message of kind `message` whose envelope says `window`.
#include <stdexcept>
#include <string>
#include <thread>

#include <signal.h>
#include <standoff/wire/envelope.pb.h>
#include <unistd.h>

#include "coupling/transport/checksum.hpp"
#include "coupling/transport/codec.hpp"
#include "coupling/transport/dealer.hpp"
#include "coupling/transport/router.hpp"

namespace standoff::test {

struct Chaos {
  std::string message;  // "ADVANCE", "GRANT", ...
  std::int64_t window = -1;
  std::string what;  // drop duplicate delay SECONDS truncate pad miscount overcount behead corrupt nan garbage token
                     // version case name cut kill
};

/// Parses the envelope, lets `edit` change it, and puts it back.
inline void edit_envelope(Frames& frames, const std::function<void(wire::Envelope&)>& edit) {
  wire::Envelope envelope;
  envelope.ParseFromArray(frames[0].data(), static_cast<int>(frames[0].size()));
  edit(envelope);
  const std::string text = envelope.SerializeAsString();
  frames[0] = zmq::message_t(text.data(), text.size());
}

/// Another last array; its checksum and, if it is to look right, its count with it.
inline void replace_array(Frames& frames, const std::string& bytes, bool look_right) {
  frames.back() = zmq::message_t(bytes.data(), bytes.size());
  if (!look_right) return;
  edit_envelope(frames, [&](wire::Envelope& e) {
    wire::Field& field = *e.mutable_fields(e.fields_size() - 1);
    field.set_count(bytes.size() / 8 / field.components());
    field.set_byte_length(bytes.size());
    field.set_checksum(crc32c(bytes.data(), bytes.size()));
  });
}

/// What `what` does to the frames of a message; throws for a word it does not know.
inline void spoil(const std::string& what, Frames& frames) {
  std::string bytes = frames.back().to_string();
  if (what == "truncate") return replace_array(frames, bytes.substr(0, bytes.size() - 24), false);
  if (what == "pad") return replace_array(frames, bytes + std::string(24, '\0'), false);
  if (what == "miscount") return replace_array(frames, bytes.substr(0, bytes.size() - 24), true);
  if (what == "corrupt") return bytes[5] = static_cast<char>(bytes[5] ^ 1), replace_array(frames, bytes, false);
  if (what == "nan") return bytes.replace(0, 8, "\0\0\0\0\0\0\xf8\x7f", 8), replace_array(frames, bytes, true);
  if (what == "behead") return frames.pop_back();
  if (what == "garbage") return void(frames[0] = zmq::message_t("?!", 2));
  edit_envelope(frames, [&](wire::Envelope& e) {
    if (what == "overcount") return e.mutable_fields(0)->set_count(~0ull);
    if (what == "token") return void(e.set_token("bad"));
    if (what == "version") return e.set_wire_version(9);
    if (what == "case") return void(e.mutable_hello()->set_case_hash("other"));
    if (what == "name") return void(e.mutable_hello()->set_name("structure"));
    throw std::runtime_error("the proxy does not know \"" + what + "\"");
  });
}

class ChaosProxy {
 public:
  ChaosProxy(const std::string& listen, const std::string& broker, Chaos chaos)
      : chaos_(std::move(chaos)), front_(parse_endpoint(listen, false)), back_(broker) {}

  /// Until one side has gone.
  int run() {
    using std::chrono::milliseconds;
    for (bool over = false; !over;) {
      front_.wait(milliseconds(1));
      back_.wait(milliseconds(1));
      over = !front_.take_gone().empty();
      back_.look();
      over = over || back_.lost();
      while (auto arrival = front_.receive()) {
        address_ = arrival->address;
        pass(std::move(arrival->frames), [&](Frames frames) { back_.send(std::move(frames), milliseconds(2000)); });
      }
      while (auto frames = back_.receive())
        pass(std::move(*frames), [&](Frames copy) { front_.send(address_, std::move(copy)); });
    }
    return 0;
  }

 private:
  using Onward = std::function<void(Frames)>;

  static Frames copy_of(const Frames& frames) {
    Frames copies;
    for (const zmq::message_t& frame : frames) copies.emplace_back(frame.data(), frame.size());
    return copies;
  }

  void pass(Frames frames, const Onward& onward) {
    const Parcel parcel = decode(copy_of(frames));
    if (const auto* hello = std::get_if<message::Hello>(&parcel.body)) pid_ = static_cast<pid_t>(hello->pid);
    const bool due = !done_ && message_name(parcel.body) == chaos_.message && parcel.envelope.window == chaos_.window;
    if (!due) return onward(std::move(frames));
    done_ = true;
    if (chaos_.what == "drop") return;
    if (chaos_.what == "cut") _exit(0);
    if (chaos_.what == "kill") return void(kill(pid_, SIGKILL));
    if (chaos_.what == "duplicate")
      onward(copy_of(frames));
    else if (chaos_.what.starts_with("delay "))
      std::this_thread::sleep_for(std::chrono::duration<double>(std::stod(chaos_.what.substr(6))));
    else
      spoil(chaos_.what, frames);
    onward(std::move(frames));
  }

  Chaos chaos_;
  Router front_;
  Dealer back_;
  std::string address_;
  pid_t pid_ = 0;
  bool done_ = false;
};

}  // namespace standoff::test
