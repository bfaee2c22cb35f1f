#include <cmath>

#include <fmt/format.h>

#include "coupling/transport/codec_body.hpp"
#include "coupling/transport/field.hpp"

namespace standoff {
namespace {

using google::protobuf::RepeatedPtrField;

double finite(double value, const char* what) {
  if (!std::isfinite(value)) throw ProtocolError(fmt::format("{} is {}", what, value));
  return value;
}

/// Exit codes are part of the contract; anything else counts as a lost participant.
ExitCode exit_code(int code) {
  switch (static_cast<ExitCode>(code)) {
    case ExitCode::bad_case:
    case ExitCode::guard:
    case ExitCode::out_of_resources:
    case ExitCode::checkpoint_incompatible:
    case ExitCode::interrupted:
      return static_cast<ExitCode>(code);
    default:
      return ExitCode::participant_lost;
  }
}

NamedValues named(const RepeatedPtrField<wire::NamedValue>& from) {
  NamedValues values;
  for (const wire::NamedValue& entry : from) values.emplace_back(entry.name(), entry.value());
  return values;
}

message::Hello hello(const wire::Hello& in) {
  if (in.name().empty()) throw ProtocolError("HELLO without a name");
  if (in.role() != wire::LOAD && in.role() != wire::STRUCTURE)
    throw ProtocolError(fmt::format("HELLO with role {}; known: LOAD, STRUCTURE", static_cast<int>(in.role())));
  return {in.name(),
          in.role() == wire::LOAD ? Role::load : Role::structure,
          in.software_version(),
          in.case_hash(),
          in.pid(),
          in.host(),
          in.keeps()};
}

message::Advance advance(const wire::Advance& in) {
  const auto& impulse = in.totals().impulse();
  if (impulse.size() != 3)
    throw ProtocolError(fmt::format("ADVANCE with {} impulse components, expected 3", impulse.size()));
  const char* what = "a total of the interface ledger";
  return {in.window(),
          {{finite(impulse[0], what), finite(impulse[1], what), finite(impulse[2], what)},
           finite(in.totals().work(), what)},
          in.compute(),
          in.wait()};
}

message::Start start(const wire::Start& in) {
  if (!(finite(in.window(), "the window of START") > 0.0) || in.windows() < 1)
    throw ProtocolError(fmt::format("START with {} windows of {} s", in.windows(), in.window()));
  if (in.first() < 0 || in.first() > in.windows())
    throw ProtocolError(fmt::format("START goes on with window {} of {}", in.first(), in.windows()));
  return {{in.window(), in.windows(), in.parallel(), in.first()}, in.folder(), in.checksum()};
}

}  // namespace

Message get_body(const wire::Envelope& from) {
  switch (from.body_case()) {
    case wire::Envelope::kHello:
      return hello(from.hello());
    case wire::Envelope::kWelcome: {
      const wire::Welcome& in = from.welcome();
      return message::Welcome{in.epoch(), finite(in.beat_interval(), "beat_interval"),
                              finite(in.beat_deadline(), "beat_deadline")};
    }
    case wire::Envelope::kReject:
      return message::Reject{exit_code(from.reject().code()), from.reject().reason(), from.reject().remedy()};
    case wire::Envelope::kSurface:
      return message::Surface{from.surface().nodes(), from.surface().quads(), from.surface().digest()};
    case wire::Envelope::kReady:
      return message::Ready{
          {finite(from.ready().stable_step(), "stable_step"), finite(from.ready().window_limit(), "window_limit")},
          from.ready().surface_digest()};
    case wire::Envelope::kStart:
      return start(from.start());
    case wire::Envelope::kGrant:
      return message::Grant{from.grant().window(), finite(from.grant().begin(), "begin"), from.grant().drain()};
    case wire::Envelope::kAdvance:
      return advance(from.advance());
    case wire::Envelope::kStop:
      return message::StopWindows{from.stop().windows(), from.stop().reason(), from.stop().interrupted()};
    case wire::Envelope::kBeat:
      return message::Beat{from.beat().progress()};
    case wire::Envelope::kAbort:
      return message::Abort{from.abort().origin(), exit_code(from.abort().code()), from.abort().reason(),
                            from.abort().window()};
    case wire::Envelope::kBye:
      return message::Bye{};
    case wire::Envelope::kByeAck:
      return message::ByeAck{};
    case wire::Envelope::kProgress:
      return message::Progress{named(from.progress().values())};
    case wire::Envelope::kSample:
      return message::Sample{finite(from.sample().time(), "the time of SAMPLE"), named(from.sample().values())};
    case wire::Envelope::kReport:
      return message::Report{from.report().json()};
    case wire::Envelope::kCheckpoint:
      return message::Checkpoint{from.checkpoint().windows(), from.checkpoint().folder()};
    case wire::Envelope::kSaved:
      return message::Saved{from.saved().windows(), from.saved().bytes(), from.saved().checksum()};
    case wire::Envelope::BODY_NOT_SET:
      break;
  }
  throw ProtocolError("a message whose body this version does not know");
}

}  // namespace standoff
