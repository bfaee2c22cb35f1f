#include <cmath>

#include <fmt/format.h>
#include <signal.h>
#include <standoff/wire/envelope.pb.h>

#include "coupling/conform/rules.hpp"
#include "coupling/contract/surface_fields.hpp"

namespace standoff::conform {
namespace {

constexpr double bound = 10.0;  // s from a failure to the end of every process

/// It must end by itself, with `code` or, where the rule names none, any but 0.
void expect_end(Play& play, std::optional<ExitCode> code, double seconds = bound) {
  const ProcessEnd end = play.peer.wait_end(seconds);
  if (end.by_signal) throw RuleBroken(fmt::format("it was killed by signal {}", end.number));
  if (code ? end.number == static_cast<int>(*code) : end.number != 0) return;
  throw RuleBroken(fmt::format("it ended with status {}, {} was due; it said {}", end.number,
                               code ? std::to_string(static_cast<int>(*code)) : "another", play.peer.said()));
}

void expect_said(const Play& play, const std::string& text) {
  if (play.peer.said().find(text) == std::string::npos)
    throw RuleBroken(
        fmt::format("its error output does not tell the first cause, \"{}\"; it said {}", text, play.peer.said()));
}

/// ABORT is due, then its end with the same code.
void expect_abort(Play& play, std::optional<ExitCode> code) {
  const Parcel parcel = play.peer.expect<message::Abort>(bound);
  const auto& failure = std::get<message::Abort>(parcel.body);
  if (failure.reason.empty()) throw RuleBroken("ABORT without a reason");
  if (code && failure.code != *code)
    throw RuleBroken(
        fmt::format("ABORT with code {}, {} was due", static_cast<int>(failure.code), static_cast<int>(*code)));
  expect_end(play, failure.code);
}

void obeys_reject(Play& play) {
  play.hello();
  play.peer.say(message::Reject{ExitCode::bad_case, "a participant of this name has already joined", "choose another"});
  expect_end(play, ExitCode::bad_case);
  expect_said(play, "a participant of this name has already joined");
}

void edit(Frames& frames, const std::function<void(wire::Envelope&)>& change) {
  wire::Envelope envelope;
  envelope.ParseFromArray(frames[0].data(), static_cast<int>(frames[0].size()));
  change(envelope);
  const std::string text = envelope.SerializeAsString();
  frames[0] = zmq::message_t(text.data(), text.size());
}

void refuses_another_version(Play& play) {
  play.hello();
  play.welcome(5.0, [](Frames& f) { edit(f, [](wire::Envelope& e) { e.set_wire_version(wire_version + 1); }); });
  expect_end(play, std::nullopt);
}

/// Two windows into a run.
void on_the_way(Play& play, double beat_deadline = 5.0) {
  play.begin(1000, beat_deadline);
  for (std::int64_t k = 0; k < 2; ++k) play.grant(k), play.advance(k);
}

void obeys_abort(Play& play) {
  on_the_way(play);
  play.peer.say(message::Abort{"somebody else", ExitCode::guard, "energy has grown by 12 %", 1});
  expect_end(play, ExitCode::guard);
  expect_said(play, "first cause: somebody else, window 1: energy has grown by 12 %");
}

void obeys_abort_before_start(Play& play) {
  play.hello(), play.welcome(), play.surface();
  play.peer.say(message::Abort{"somebody else", ExitCode::participant_lost, "was killed", -1});
  expect_end(play, ExitCode::participant_lost);
  expect_said(play, "somebody else: was killed");
}

void survives_no_broker(Play& play) {
  on_the_way(play, 1.0);
  play.peer.hang_up();
  expect_end(play, ExitCode::participant_lost);
}

void notices_a_frozen_broker(Play& play) {
  on_the_way(play, 1.0);
  play.peer.stop_beating();
  expect_end(play, ExitCode::participant_lost, bound + 1.0);
}

void interrupted_by(Play& play, int number) {
  on_the_way(play);
  play.peer.signal(number);
  const auto heard = play.peer.hear(bound);
  const auto* stop = heard ? std::get_if<message::StopWindows>(&heard->body) : nullptr;
  const auto* abort = heard ? std::get_if<message::Abort>(&heard->body) : nullptr;
  if (stop != nullptr && stop->interrupted)  // it would save first
    play.peer.say(message::Abort{"somebody", ExitCode::interrupted, stop->reason, 1});
  else if (abort == nullptr || abort->code != ExitCode::interrupted)
    throw RuleBroken(fmt::format("ABORT with code 130 was due, or STOP with `interrupted`; it sent {}",
                                 heard ? message_name(heard->body) : "nothing"));
  expect_end(play, ExitCode::interrupted);
}

/// What the other side may get wrong in a GRANT.
struct Spoilt {
  const char *name, *text;
  std::function<void(Play&, Payload)> say;
};

void say_spoilt(Play& play, const Payload& payload, const Counterpart::Spoil& spoil) {
  play.grant_with(2, payload, spoil);
}

Payload with_value(const Play& play, double value) {
  std::vector<Vec3> field = play.mesh.position;
  field.back().z = value;
  if (play.is_structure()) return to_fields(SurfaceLoad{field});
  return to_fields(SurfaceMotion{play.mesh.position, field});
}

Payload of_nodes(const Play& play, std::size_t nodes) {
  const std::vector<Vec3> field(nodes);
  return play.is_structure() ? to_fields(SurfaceLoad{field}) : to_fields(SurfaceMotion{field, field});
}

std::vector<Spoilt> spoilt_grants() {
  return {
      {"not_a_number", "ends on NaN in a field",
       [](Play& p, Payload) { say_spoilt(p, with_value(p, std::nan("")), nullptr); }},
      {"infinite", "ends on an infinity in a field",
       [](Play& p, Payload) { say_spoilt(p, with_value(p, -INFINITY), nullptr); }},
      {"truncated", "ends on a frame shorter than announced",
       [](Play& p, Payload good) {
         say_spoilt(p, good, [](Frames& f) { f[1] = zmq::message_t(f[1].data(), f[1].size() / 2); });
       }},
      {"oversized", "ends on a frame longer than announced",
       [](Play& p, Payload good) {
         say_spoilt(p, good, [](Frames& f) {
           const std::string longer = f[1].to_string() + std::string(24, '\0');
           f[1] = zmq::message_t(longer.data(), longer.size());
         });
       }},
      {"wrong_count", "ends on a field of another number of nodes",
       [](Play& p, Payload) { say_spoilt(p, of_nodes(p, p.mesh.position.size() - 1), nullptr); }},
      {"wrong_checksum", "ends on a field whose checksum does not fit",
       [](Play& p, Payload good) {
         say_spoilt(p, good, [](Frames& f) {
           edit(f, [](wire::Envelope& e) { e.mutable_fields(0)->set_checksum(e.fields(0).checksum() ^ 1u); });
         });
       }},
      {"missing_frame", "ends on a message without its last frame",
       [](Play& p, Payload good) { say_spoilt(p, good, [](Frames& f) { f.pop_back(); }); }},
      {"garbage", "ends on a first frame that is not an envelope",
       [](Play& p, Payload good) { say_spoilt(p, good, [](Frames& f) { f[0] = zmq::message_t("?!", 2); }); }},
      {"sequence_gap", "ends on a gap in the sequence of messages",
       [](Play& p, Payload good) {
         p.peer.skip_sequence_numbers(1);
         say_spoilt(p, good, nullptr);
       }},
      {"wrong_message", "ends on a message that is not due", [](Play& p, Payload) { p.peer.say(message::ByeAck{}); }},
  };
}

Rule rule_of(const Spoilt& spoilt) {
  return {spoilt.name, spoilt.text, std::nullopt, [say = spoilt.say](Play& play) {
            on_the_way(play);
            say(play, play.usual_field(2));
            expect_abort(play, ExitCode::participant_lost);
          }};
}

}  // namespace

std::vector<Rule> rules_of_failure() {
  const std::optional<Role> both;
  std::vector<Rule> rules = {
      {"reject", "obeys REJECT: its code, its reason", both, obeys_reject},
      {"wire_version", "refuses another wire version", both, refuses_another_version},
      {"abort", "obeys ABORT in mid-run and prints the first cause", both, obeys_abort},
      {"abort_early", "obeys ABORT before the first window", both, obeys_abort_before_start},
      {"broker_gone", "ends with 4 within 10 s when the broker is gone", both, survives_no_broker},
      {"broker_frozen", "ends with 4 within 10 s when the broker is silent", both, notices_a_frozen_broker},
      {"sigterm", "tells and ends with 130 on SIGTERM", both, [](Play& play) { interrupted_by(play, SIGTERM); }},
      {"sigint", "tells and ends with 130 on SIGINT", both, [](Play& play) { interrupted_by(play, SIGINT); }},
  };
  for (const Spoilt& spoilt : spoilt_grants()) rules.push_back(rule_of(spoilt));
  return rules;
}

}  // namespace standoff::conform
