#pragma once
// A session in virtual time: events go in at a time the test chooses, actions are collected. No sockets, no waiting.
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/session/session.hpp"

namespace standoff::test {

class VirtualSession {
 public:
  explicit VirtualSession(SessionRules rules = default_rules()) : state(open_session(std::move(rules), 0.0)) {}
  static SessionRules default_rules() {
    SessionRules rules;
    rules.token = std::string("t");  // assigning the literal trips -Wrestrict of gcc 12
    rules.until = 1.0;
    rules.window = {WindowRule::Kind::fixed, 0.25};  // four windows
    return rules;
  }

  void happen(const SessionEvent& event) {
    SessionStep step = step_session(std::move(state), event, now);
    state = std::move(step.state);
    for (SessionAction& action : step.actions) actions.push_back(std::move(action));
  }
  /// A message of `name` with the right envelope; the address of a participant is its name.
  void say(const std::string& name, Message body, std::vector<FieldShape> fields = {}) {
    Received received{name, {"t", 0, 1, name, -1}, std::move(body), std::move(fields), nullptr, 0};
    if (const Peer* peer = find(name))
      received.envelope.epoch = peer->epoch, received.envelope.sequence = peer->received + 1;
    happen(received);
  }
  /// Ticks every half second until `time`; both sides beat if asked to.
  void pass_to(double time, bool beating = true) {
    while (now < time) {
      now += 0.5;
      for (const Peer& peer : std::vector<Peer>(state.peers))
        if (beating && peer.stage != Stage::closed) say(peer.name, message::Beat{peer.progress});
      happen(Tick{});
    }
  }

  void join(const std::string& name, Role role) {
    say(name, message::Hello{name, role, "v", "case", 1, "host", keeps});
  }
  void offer_surface() {
    say("structure", message::Surface{2, 1, "digest"},
        {{"position", DataType::f64, 3, 2}, {"quads", DataType::i32, 4, 1}, {"node_mass", DataType::f64, 1, 2}});
  }
  void ready(const std::string& name) { say(name, message::Ready{{0.25, 0.0}, "digest"}); }
  void advance(const std::string& name, std::int64_t window) {
    std::vector<FieldShape> fields = {{"position", DataType::f64, 3, 2}, {"velocity", DataType::f64, 3, 2}};
    if (name == "particles") fields = {{"force", DataType::f64, 3, 2}};
    say(name, message::Advance{window, {{0.0, 0.0, 1.0 + static_cast<double>(window)}, 2.0}, 0.0, 0.0}, fields);
  }
  void saved(const std::string& name, std::int64_t windows) { say(name, message::Saved{windows, 100, 7}); }
  /// Halves of checkpoints that the broker was told to commit, oldest first.
  std::vector<InterfaceState> commits() const {
    std::vector<InterfaceState> found;
    for (const SessionAction& action : actions)
      if (const auto* commit = std::get_if<Commit>(&action)) found.push_back(commit->state);
    return found;
  }
  /// Both sides at their first window.
  void start() {
    join("particles", Role::load);
    join("structure", Role::structure);
    offer_surface();
    ready("particles");
    ready("structure");
  }

  const Peer* find(const std::string& name) const {
    for (const Peer& peer : state.peers)
      if (peer.name == name) return &peer;
    return nullptr;
  }
  Stage stage(const std::string& name) const { return find(name) ? find(name)->stage : Stage::absent; }
  /// All messages of this kind sent to `name`, oldest first.
  template <class Body>
  std::vector<Body> sent(const std::string& name) const {
    std::vector<Body> found;
    for (const SessionAction& action : actions)
      if (const auto* send = std::get_if<Send>(&action))
        if (const auto* body = std::get_if<Body>(&send->body); body && send->address == name) found.push_back(*body);
    return found;
  }
  template <class What>
  std::vector<What> announced() const {
    std::vector<What> found;
    for (const SessionAction& action : actions)
      if (const auto* announce = std::get_if<Announce>(&action))
        if (const auto* what = std::get_if<What>(&announce->what)) found.push_back(*what);
    return found;
  }
  std::vector<int> finished() const {
    std::vector<int> codes;
    for (const SessionAction& action : actions)
      if (const auto* finish = std::get_if<Finish>(&action)) codes.push_back(static_cast<int>(finish->code));
    return codes;
  }
  std::string cause() const { return state.failure ? first_cause(*state.failure) : "none"; }

  SessionState state;
  std::vector<SessionAction> actions;
  double now = 0.0;
  bool keeps = true;  // who joins can save
};

}  // namespace standoff::test
