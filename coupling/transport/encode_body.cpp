#include "coupling/transport/codec_body.hpp"

namespace standoff {
namespace {

using google::protobuf::RepeatedPtrField;

void put(const NamedValues& values, RepeatedPtrField<wire::NamedValue>& into) {
  for (const auto& [name, value] : values) {
    wire::NamedValue* entry = into.Add();
    entry->set_name(name);
    entry->set_value(value);
  }
}

struct Put {
  wire::Envelope& to;

  void operator()(const message::Hello& body) {
    wire::Hello* out = to.mutable_hello();
    out->set_name(body.name);
    out->set_role(body.role == Role::load ? wire::LOAD : wire::STRUCTURE);
    out->set_software_version(body.software_version);
    out->set_case_hash(body.case_hash);
    out->set_pid(body.pid);
    out->set_host(body.host);
    out->set_keeps(body.keeps);
  }
  void operator()(const message::Welcome& body) {
    wire::Welcome* out = to.mutable_welcome();
    out->set_epoch(body.epoch);
    out->set_beat_interval(body.beat_interval);
    out->set_beat_deadline(body.beat_deadline);
  }
  void operator()(const message::Reject& body) {
    wire::Reject* out = to.mutable_reject();
    out->set_code(static_cast<int>(body.code));
    out->set_reason(body.reason);
    out->set_remedy(body.remedy);
  }
  void operator()(const message::Surface& body) {
    wire::Surface* out = to.mutable_surface();
    out->set_nodes(body.nodes);
    out->set_quads(body.quads);
    out->set_digest(body.digest);
  }
  void operator()(const message::Ready& body) {
    wire::Ready* out = to.mutable_ready();
    out->set_stable_step(body.needs.stable_step);
    out->set_window_limit(body.needs.window_limit);
    out->set_surface_digest(body.surface_digest);
  }
  void operator()(const message::Start& body) {
    wire::Start* out = to.mutable_start();
    out->set_window(body.clock.window);
    out->set_windows(body.clock.windows);
    out->set_parallel(body.clock.parallel);
    out->set_first(body.clock.first);
    out->set_folder(body.folder);
    out->set_checksum(body.checksum);
  }
  void operator()(const message::Grant& body) {
    wire::Grant* out = to.mutable_grant();
    out->set_window(body.window);
    out->set_begin(body.begin);
    out->set_drain(body.drain);
  }
  void operator()(const message::Advance& body) {
    wire::Advance* out = to.mutable_advance();
    out->set_window(body.window);
    const Vec3& impulse = body.totals.impulse;
    for (const double component : {impulse.x, impulse.y, impulse.z}) out->mutable_totals()->add_impulse(component);
    out->mutable_totals()->set_work(body.totals.work);
    out->set_compute(body.compute);
    out->set_wait(body.wait);
  }
  void operator()(const message::StopWindows& body) {
    to.mutable_stop()->set_windows(body.windows);
    to.mutable_stop()->set_reason(body.reason);
    to.mutable_stop()->set_interrupted(body.interrupted);
  }
  void operator()(const message::Beat& body) { to.mutable_beat()->set_progress(body.progress); }
  void operator()(const message::Abort& body) {
    wire::Abort* out = to.mutable_abort();
    out->set_origin(body.origin);
    out->set_code(static_cast<int>(body.code));
    out->set_reason(body.reason);
    out->set_window(body.window);
  }
  void operator()(const message::Bye&) { to.mutable_bye(); }
  void operator()(const message::ByeAck&) { to.mutable_bye_ack(); }
  void operator()(const message::Progress& body) { put(body.values, *to.mutable_progress()->mutable_values()); }
  void operator()(const message::Sample& body) {
    to.mutable_sample()->set_time(body.time);
    put(body.values, *to.mutable_sample()->mutable_values());
  }
  void operator()(const message::Report& body) { to.mutable_report()->set_json(body.json); }
  void operator()(const message::Checkpoint& body) {
    to.mutable_checkpoint()->set_windows(body.windows);
    to.mutable_checkpoint()->set_folder(body.folder);
  }
  void operator()(const message::Saved& body) {
    wire::Saved* out = to.mutable_saved();
    out->set_windows(body.windows);
    out->set_bytes(body.bytes);
    out->set_checksum(body.checksum);
  }
};

}  // namespace

void put_body(const Message& body, wire::Envelope& into) {
  std::visit(Put{into}, body);
}

}  // namespace standoff
