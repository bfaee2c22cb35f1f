#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "coupling/conform/rules.hpp"
#include "coupling/contract/surface_fields.hpp"

namespace standoff::conform {
namespace {

constexpr std::int64_t few = 5;  // windows

/// Windows 0 .. few - 1 and, for the structure, the drain; then the goodbye.
void whole_run(Play& play, const std::function<void(std::int64_t)>& each = nullptr) {
  play.begin(few);
  const std::int64_t last = play.is_structure() ? few : few - 1;
  for (std::int64_t k = 0; k <= last; ++k) {
    play.grant(k, k == few);
    play.advance(k);
    if (each) each(k);
  }
  play.stop();
  play.goodbye();
}

void runs_to_the_end(Play& play) {
  whole_run(play);
}

void opens_with_hello(Play& play) {
  play.hello();
  const Envelope& first = play.peer.first_envelope();
  if (first.window != -1) throw RuleBroken(fmt::format("HELLO says window {}, -1 is before the first", first.window));
  play.welcome();
}

void same_surface_twice(Play& play) {
  play.hello(), play.welcome(), play.surface();
  Play again(play.subject);
  again.hello(), again.welcome(), again.surface();
  if (again.digest != play.digest)
    throw RuleBroken(fmt::format("digest {} in one run, {} in another", play.digest, again.digest));
}

void waits_for_grant(Play& play) {
  play.begin(few);
  play.peer.expect_quiet(0.5);
  play.grant(0);
  play.advance(0);
  play.peer.expect_quiet(0.5);
}

void starts_at_rest(Play& play) {
  play.begin(few);
  for (std::int64_t k = 0; k < few; ++k) {
    play.grant_with(k, to_fields(SurfaceLoad{std::vector<Vec3>(play.mesh.position.size())}));
    play.advance(k);
    for (std::size_t i = 0; i < play.mesh.position.size(); ++i) {
      const Vec3 moved = play.motion.position[i] - play.mesh.position[i];
      // A body without load does not move: only rounding, far below a nanometre over microseconds.
      if (norm(moved) > 1e-12 || norm(play.motion.velocity[i]) > 1e-6)
        throw RuleBroken(fmt::format("node {} moves by {:.3g} m at {:.3g} m/s in window {} without any load", i,
                                     norm(moved), norm(play.motion.velocity[i]), k));
    }
  }
}

/// The sums that a structure must hand in, kept beside it.
void structure_sums(Play& play) {
  InterfaceTotals sum;
  double scale = 0.0, work_scale = 0.0;
  std::vector<Vec3> before;
  whole_run(play, [&](std::int64_t k) {
    if (before.empty()) before = play.mesh.position;
    const auto force = k == 0 ? std::vector<Vec3>(before.size()) : play.usual_force(k);
    for (std::size_t i = 0; i < force.size(); ++i) {
      sum.impulse += play.window * force[i];
      scale += play.window * norm(force[i]);
      const double work = dot(force[i], play.motion.position[i] - before[i]);
      sum.work += work;
      work_scale += std::abs(work);
    }
    before = play.motion.position;
    // Rounding of sums of some hundred terms.
    if (norm(play.totals.impulse - sum.impulse) > 1e-12 * scale)
      throw RuleBroken(
          fmt::format("window {}: totals.impulse is ({:.10g}, {:.10g}, {:.10g}) N s, the forces give "
                      "({:.10g}, {:.10g}, {:.10g})",
                      k, play.totals.impulse.x, play.totals.impulse.y, play.totals.impulse.z, sum.impulse.x,
                      sum.impulse.y, sum.impulse.z));
    // Displacements of nanometres are differences of positions near a metre: their rounding is 1e-16 m times a force.
    const double rounding = 1e-15 * scale / play.window;
    if (std::abs(play.totals.work - sum.work) > 1e-9 * work_scale + rounding)
      throw RuleBroken(fmt::format("window {}: totals.work is {:.10g} J, force times displacement gives {:.10g}", k,
                                   play.totals.work, sum.work));
  });
}

void load_sums(Play& play) {
  InterfaceTotals sum;
  double scale = 0.0;
  whole_run(play, [&](std::int64_t k) {
    for (const Vec3& force : play.load.force) {
      sum.impulse += play.window * force;
      scale += play.window * norm(force);
    }
    if (norm(play.totals.impulse - sum.impulse) > 1e-12 * scale)
      throw RuleBroken(fmt::format("window {}: totals.impulse differs from the sum of forces by {:.3g} N s", k,
                                   norm(play.totals.impulse - sum.impulse)));
    // Its work is its own view, with the answer of the node masses inside a window: not judged beyond being a number.
    if (!std::isfinite(play.totals.work))
      throw RuleBroken(fmt::format("window {}: totals.work is {}", k, play.totals.work));
  });
}

std::vector<Vec3> fields_of(const Play& play) {
  std::vector<Vec3> values;
  for (const auto* field : {&play.motion.position, &play.motion.velocity, &play.load.force})
    values.insert(values.end(), field->begin(), field->end());
  return values;
}

void repeats_itself(Play& play) {
  const auto course = [](Play& run) {
    std::vector<Vec3> values;
    whole_run(run, [&](std::int64_t) {
      const std::vector<Vec3> now = fields_of(run);
      values.insert(values.end(), now.begin(), now.end());
    });
    return values;
  };
  Play again(play.subject);
  if (course(play) != course(again)) throw RuleBroken("two runs with the same input give different fields");
}

/// Windows `first` .. `last` - 1, and what came of the last one.
std::vector<Vec3> windows_to(Play& play, std::int64_t first, std::int64_t last) {
  for (std::int64_t k = first; k < last; ++k) play.grant(k), play.advance(k);
  return fields_of(play);
}

void goes_on_from_a_checkpoint(Play& play) {
  play.begin(few);
  if (!play.keeps) return;  // HELLO did not offer it
  windows_to(play, 0, 2);
  const std::string folder = play.scratch_folder() + "/state";
  play.peer.say(message::Checkpoint{2, folder});
  const auto saved = std::get<message::Saved>(play.peer.expect<message::Saved>().body);
  if (saved.windows != 2) throw RuleBroken(fmt::format("SAVED after {} windows, CHECKPOINT said 2", saved.windows));
  const std::vector<Vec3> through = windows_to(play, 2, few);
  Play again(play.subject);
  again.hello(), again.welcome(), again.surface(), again.ready();
  again.start_again(few, folder, saved);
  if (windows_to(again, 2, few) != through)
    throw RuleBroken("continued from a checkpoint it gives other bits than without the stop");
}

void ends_early(Play& play) {
  play.begin(1000000);
  play.grant(0);
  play.advance(0);
  play.stop();
  play.goodbye();
}

void beats_while_it_waits(Play& play) {
  constexpr double deadline = 1.0;  // asks for a beat each 0.2 s
  play.begin(few, deadline);
  play.peer.expect_quiet(2.5);
  double last = play.peer.seconds() - 2.5, longest = 0.0;
  for (const auto& beat : play.peer.beats()) longest = std::max(longest, beat.at - last), last = beat.at;
  longest = std::max(longest, play.peer.seconds() - last);
  if (longest > deadline)
    throw RuleBroken(fmt::format("silent for {:.2f} s where WELCOME allows {:g} s; {} beats came", longest, deadline,
                                 play.peer.beats().size()));
}

void shows_progress(Play& play) {
  play.begin(few, 1.0);
  play.peer.expect_quiet(0.6);
  const auto before = play.peer.beats();
  for (std::int64_t k = 0; k < 3; ++k) play.grant(k), play.advance(k);
  play.peer.expect_quiet(0.6);
  const auto& after = play.peer.beats();
  if (before.empty() || after.size() == before.size()) throw RuleBroken("no beats to tell of progress");
  if (after.back().progress == before.back().progress)
    throw RuleBroken(fmt::format("progress stands at {} although three windows were computed", after.back().progress));
}

void bears_a_slow_partner(Play& play) {
  constexpr double deadline = 1.0;
  play.begin(few, deadline);
  play.grant(0);
  play.advance(0);
  play.peer.expect_quiet(2.5 * deadline);  // we beat all the while
  play.grant(1);
  play.advance(1);
}

void ignores_unknown_members(Play& play) {
  // Member 100, a varint, as a later release of the same version may add it.
  const auto add = [](Frames& frames) {
    std::string text = frames[0].to_string() + std::string("\xA0\x06\x01", 3);
    frames[0] = zmq::message_t(text.data(), text.size());
  };
  play.hello(), play.welcome(5.0, add), play.surface(), play.ready(), play.start(few);
  play.grant(0, false, add);
  play.advance(0);
}

}  // namespace

std::vector<Rule> rules_of_conduct() {
  const std::optional<Role> both, structure = Role::structure, load = Role::load;
  return {
      {"hello", "opens with HELLO: our token, sequence 1, its name and role", both, opens_with_hello},
      {"whole_run", "goes through a whole run and ends with 0", both, runs_to_the_end},
      {"same_surface", "offers the same surface in every run of a case", structure, same_surface_twice},
      {"waits_for_grant", "computes nothing that was not granted", both, waits_for_grant},
      {"starts_at_rest", "stays at rest without load", structure, starts_at_rest},
      {"structure_sums", "totals.impulse and totals.work are the sums over the forces received", structure,
       structure_sums},
      {"load_sums", "totals.impulse is the sum over the forces sent", load, load_sums},
      {"repeatable", "gives the same bits in two runs", both, repeats_itself},
      {"checkpoint", "goes on from a checkpoint with the same bits, if HELLO offers it", both,
       goes_on_from_a_checkpoint},
      {"stops_early", "ends when STOP comes, however early", both, ends_early},
      {"beats", "beats while it waits", both, beats_while_it_waits},
      {"progress", "moves the progress of its beats with the windows", both, shows_progress},
      {"slow_partner", "bears a partner that is slow but beats", both, bears_a_slow_partner},
      {"unknown_members", "ignores members it does not know", both, ignores_unknown_members},
  };
}

}  // namespace standoff::conform
