#include "coupling/launcher/run_session.hpp"

#include <cstdio>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "coupling/launcher/result_table.hpp"
#include "coupling/launcher/text_format.hpp"
#include "coupling/output/atomic_file.hpp"
#include "coupling/tape/tape_reader.hpp"

namespace standoff::launch {
namespace {

constexpr int sample_sources = 2;  // the load side and the structure each send half a row
constexpr double progress_log_period = 1.0;

std::string window_argument(const CouplingSpec& coupling, const RunOptions& options) {
  // The windows of a recorded side are known; with them it sends the recorded bits.
  for (const std::string& tape : {options.structure_tape, options.particle_tape})
    if (!tape.empty()) return fmt::format("{:.17g}", TapeReader(tape).head().clock.window);
  switch (coupling.window_rule) {
    case CouplingSpec::Window::structure_step:
      return "step";
    case CouplingSpec::Window::fixed:
      return fmt::format("{:.17g}", coupling.window);
    default:
      return "auto";
  }
}

/// Two processes share the cores: a thread that waits must not spin, and a library must not start threads of its own.
std::map<std::string, std::string> thread_environment(int threads) {
  return {{"OMP_WAIT_POLICY", "passive"}, {"OMP_NUM_THREADS", std::to_string(threads)}, {"OPENBLAS_NUM_THREADS", "1"}};
}

ChildCommand participant(const std::string& name, const std::string& folder, const std::string& endpoint,
                         const std::string& token, int threads) {
  return {name,
          {program_path("standoff-" + name), "--case", folder + "/case.resolved.toml", "--connect", endpoint, "--token",
           token, "--out", folder, "--threads", std::to_string(threads)},
          thread_environment(threads)};
}

/// A program of the user's, by the shell's rules of quoting; it gets the options that our own program gets.
void replace_program(ChildCommand& command, const std::string& words) {
  command.argv[0] = words;
  command.argv.insert(command.argv.begin(), {"/bin/sh", "-c", "exec " + words + " \"$@\""});
}

/// histories.csv, empty or up to where the run is taken up.
GrowingFile open_histories(const std::string& path, HistoryTable& table, const std::optional<Continuation>& from) {
  if (!from) return GrowingFile(path);
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  write_atomically(path, table.take_up(text.str(), from->time + 0.5 * from->window));
  return GrowingFile(path, true);
}

std::vector<std::string> file_arguments(const CheckpointOptions& options, const std::string& tape,
                                        const std::string& folder, const std::optional<Continuation>& from) {
  std::vector<std::string> arguments;
  if (options.on)
    arguments = {"--checkpoint",
                 folder + "/checkpoint",
                 "--checkpoint-every",
                 fmt::format("{:g}", options.every),
                 "--checkpoint-windows",
                 std::to_string(options.windows),
                 "--build",
                 build_id()};
  if (!tape.empty()) arguments.insert(arguments.end(), {"--tape", tape});
  if (from) arguments.insert(arguments.end(), {"--resume", from->checkpoint});
  return arguments;
}

/// A recorded side in place of a program.
void replay_instead(ChildCommand& command, const std::string& tape) {
  command.argv[0] = program_path("standoff-replay");
  command.argv.insert(command.argv.end(),
                      {"--tape", tape, "--role", command.name == "structure" ? "structure" : "load"});
}

RunFacts initial_facts(const RunOptions& options, const CaseRead& read, const CostPrediction& plan) {
  RunFacts facts;
  if (!options.structure_command.empty()) facts.structure_model = "exec:" + options.structure_command;
  if (!options.structure_tape.empty()) facts.structure_model = "replay:" + options.structure_tape;
  facts.case_hash = read.hash;
  facts.particle_threads = plan.particle_threads;
  facts.structure_threads = plan.structure_threads;
  facts.build = build_facts();
  facts.cpu = cpu_name();
  for (const EffectPrice& effect : plan.effects) facts.effect_bytes[effect.name] = effect.bytes;
  return facts;
}

}  // namespace

RunSession::RunSession(const RunOptions& options, const CaseRead& read, std::string folder,
                       std::optional<Continuation> continuation)
    : options_(options),
      read_(read),
      folder_(std::move(folder)),
      continuation_(std::move(continuation)),
      plan_(
          predict_cost(read.spec, usable_cores(), options.threads.particle_count(), options.threads.structure_count())),
      facts_(initial_facts(options, read, plan_)),
      log_(folder_, continuation_ ? continuation_->wall : 0.0),
      table_(read.spec.observe.interval, sample_sources),
      histories_(open_histories(folder_ + "/histories.csv", table_, continuation_)),
      view_(view_mode(options.quiet, options.json)),
      supervisor_({options.max_time}, {[this](const ChildProcess& child, bool error_output, const std::string& line) {
                                         take_line(child, error_output, line);
                                       },
                                       [this] { view_.show(supervisor_.seconds()); }}) {}

double RunSession::wall() const {
  return supervisor_.seconds() + (continuation_ ? continuation_->wall : 0.0);
}

int RunSession::run() {
  if (!continuation_) write_atomically(folder_ + "/case.resolved.toml", read_.resolved);
  write_record();
  log_.line("launcher", fmt::format("{} {} ({}), case {}, level {}, seed {}", "standoff", facts_.build.version,
                                    facts_.build.git, read_.spec.name, read_.spec.level, read_.spec.run.seed));
  view_.note(fmt::format("{}{}{}, seed {}: predicted {}; writing {}", read_.spec.name,
                         read_.spec.level.empty() ? "" : ", level ", read_.spec.level, read_.spec.run.seed,
                         wall_text(plan_.wall_s), folder_));
  if (continuation_) {
    const std::string text = fmt::format("going on after {} windows, {}, from {}", continuation_->windows,
                                         duration_text(continuation_->time), continuation_->checkpoint);
    view_.note(text);
    log_.line("launcher", text);
  }
  std::optional<Cause> cause;
  try {
    start_processes();
    cause = supervisor_.watch();
  } catch (const Stop& stop) {
    cause = Cause{stop.code(), "", stop.what()};
  }
  return close(cause);
}

void RunSession::start_processes() {
  const std::string endpoint = "ipc://" + sockets_.path() + "/broker", token = run_token();
  const CouplingSpec& coupling = read_.spec.coupling;
  ChildCommand broker{
      "broker",
      {program_path("standoff-broker"), "--listen", endpoint, "--token", token, "--until",
       fmt::format("{:.17g}", read_.spec.run.until), "--scheme",
       coupling.scheme == Scheme::parallel ? "parallel" : "serial", "--window", window_argument(coupling, options_)},
      thread_environment(1)};
  const auto more = file_arguments(options_.checkpoint, options_.tape, folder_, continuation_);
  broker.argv.insert(broker.argv.end(), more.begin(), more.end());
  supervisor_.start(broker);
  ChildCommand structure = participant("structure", folder_, endpoint, token, plan_.structure_threads);
  if (!options_.structure_command.empty()) replace_program(structure, options_.structure_command);
  ChildCommand particles = participant("particles", folder_, endpoint, token, plan_.particle_threads);
  if (!options_.structure_tape.empty()) replay_instead(structure, options_.structure_tape);
  if (!options_.particle_tape.empty()) replay_instead(particles, options_.particle_tape);
  if (options_.structure_command.empty()) trace_into(structure);
  trace_into(particles);
  supervisor_.start(structure);
  supervisor_.start(particles);
}

void RunSession::trace_into(ChildCommand& command) const {
  if (!options_.trace.empty()) command.argv.insert(command.argv.end(), {"--trace", folder_ + "/trace." + command.name});
}

/// The tracks of all processes as one file.
void RunSession::join_traces() const {
  if (options_.trace.empty()) return;
  std::string all;
  for (const char* name : {"structure", "particles"}) {
    const std::string part = folder_ + "/trace." + name;
    std::ifstream lines(part);
    for (std::string line; std::getline(lines, line);) all += (all.empty() ? "" : ",\n") + line;
    std::remove(part.c_str());
  }
  write_atomically(options_.trace, "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [\n" + all + "\n]}\n");
}

void RunSession::take_line(const ChildProcess& child, bool error_output, const std::string& line) {
  const bool event_stream = child.name == "broker" && !error_output;
  if (const auto event = event_stream ? parse_event(line) : std::nullopt)
    std::visit(*this, *event);
  else
    log_.line(child.name, line);
}

void RunSession::operator()(const JoinedEvent& event) {
  log_.event("broker", fmt::format("{} joined as {} (process {})", event.name, event.role, event.pid),
             {{"event", "joined"}, {"name", event.name}, {"role", event.role}, {"pid", event.pid}});
}

void RunSession::operator()(const ClockEvent& event) {
  facts_.clock = event;
  view_.progress().take(event);
  log_.event("broker",
             fmt::format("{} windows of {}, {} scheme", event.windows, duration_text(event.window_s), event.scheme),
             {{"event", "clock"}, {"window_s", event.window_s}, {"windows", event.windows}, {"scheme", event.scheme}});
  write_record();
}

void RunSession::operator()(const WaitingEvent& event) {
  std::string names;
  for (const std::string& name : event.names) names += (names.empty() ? "" : ", ") + name;
  const std::string text = fmt::format("waiting for {} since {:.0f} s{}{}", names, event.since_s,
                                       event.stage.empty() ? "" : ": ", event.stage);
  view_.note(text);
  log_.event("broker", text,
             {{"event", "waiting"}, {"for", event.names}, {"since_s", event.since_s}, {"stage", event.stage}});
}

void RunSession::operator()(const ProgressEvent& event) {
  view_.progress().take(event);
  const double now = supervisor_.seconds();
  if (now - last_progress_logged_ < progress_log_period) return;
  last_progress_logged_ = now;
  log_.event(event.name, progress_line(view_.progress()),
             {{"event", "progress"}, {"name", event.name}, {"values", event.values}});
}

void RunSession::operator()(const SampleEvent& event) {
  histories_.append(table_.add(event));
}

void RunSession::operator()(const ReportEvent& event) {
  reports_[event.name] = event.report;
  log_.event("broker", "report of " + event.name + " received", {{"event", "report"}, {"name", event.name}});
}

void RunSession::operator()(const InterfaceEvent& event) {
  facts_.interface_ledger = event;
}

void RunSession::operator()(const SavingEvent& event) {
  supervisor_.broker_saves();
  view_.note("saving a checkpoint at the end of this window; a second Ctrl-C leaves at once");
  log_.event("broker", "saving before the run is left: " + event.reason,
             {{"event", "saving"}, {"reason", event.reason}});
}

void RunSession::operator()(const CheckpointEvent& event) {
  saved_windows_ = event.windows;
  log_.event("broker", fmt::format("checkpoint after {} windows, {}", event.windows, duration_text(event.time_s)),
             {{"event", "checkpoint"}, {"windows", event.windows}, {"time_s", event.time_s}, {"bytes", event.bytes}});
}

void RunSession::operator()(const FailedEvent& event) {
  supervisor_.broker_failed(event);
  log_.event("broker", fmt::format("failed: {}: {}", event.origin, event.reason),
             {{"event", "failed"},
              {"origin", event.origin},
              {"code", event.code},
              {"reason", event.reason},
              {"window", event.window}});
}

void RunSession::operator()(const DoneEvent&) {
  supervisor_.broker_done();
}

void RunSession::write_record() {
  facts_.wall_s = wall();
  facts_.largest_work_error = table_.largest_work_error();
  facts_.largest_external_work = table_.largest_external_work();
  write_atomically(
      folder_ + "/run.json",
      run_record(read_.spec, facts_, reports_).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

int RunSession::close(std::optional<Cause> cause) {
  for (const ChildProcess& child : supervisor_.children()) {
    facts_.peak_bytes[child.name] = child.peak_bytes;
    facts_.cpu_s[child.name] = child.cpu_s;
  }
  try {
    histories_.append(table_.finish());
    join_traces();
  } catch (const Stop& stop) {
    if (!cause) cause = Cause{stop.code(), "", stop.what()};
  }
  const ExitCode code = cause ? cause->code : ExitCode::done;
  facts_.status = !cause ? "done" : code == ExitCode::interrupted ? "interrupted" : "failed";
  facts_.exit_code = static_cast<int>(code);
  if (cause) facts_.reason = cause->who.empty() ? cause->what : cause->who + ": " + cause->what;
  if (cause && cause->window >= 0) view_.progress().window = cause->window;
  view_.end_line();
  if (cause) explain(*cause);
  write_record();
  log_.line("launcher", facts_.status + (facts_.reason.empty() ? "" : ": " + facts_.reason));
  print_result(run_record(read_.spec, facts_, reports_));
  return static_cast<int>(code);
}

void RunSession::explain(const Cause& cause) const {
  std::fprintf(stderr, "standoff: %s%s%s\n", cause.who.empty() ? "" : (cause.who + ": ").c_str(), cause.what.c_str(),
               cause.code == ExitCode::interrupted ? "" : " (everything else was stopped)");
  std::fprintf(stderr, "  when: %s, after %s of wall clock\n", when_text(view_.progress()).c_str(),
               wall_text(supervisor_.seconds()).c_str());
  for (const ChildProcess& child : supervisor_.children()) {
    if (child.name != cause.who || child.last_lines.empty()) continue;
    std::fprintf(stderr, "  last lines of %s:\n", child.name.c_str());
    for (const std::string& line : child.last_lines) std::fprintf(stderr, "    %s\n", line.c_str());
  }
  if (saved_windows_ > 0)
    std::fprintf(stderr, "  a checkpoint holds %ld windows: standoff resume %s\n", saved_windows_, folder_.c_str());
  std::fprintf(stderr, "  exit %d; see %s/log.txt\n", static_cast<int>(cause.code), folder_.c_str());
}

void RunSession::print_result(const OrderedJson& record) {
  if (facts_.status != "done" && view_.mode() != ViewMode::json) return;
  const auto warnings = facts_.status == "done" ? result_warnings(record) : std::vector<std::string>{};
  for (const std::string& warning : warnings) std::fprintf(stderr, "standoff: warning: %s\n", warning.c_str());
  if (view_.mode() == ViewMode::quiet) return;
  if (view_.mode() == ViewMode::json) {
    const OrderedJson line{{"event", "result"}, {"folder", folder_}, {"run", record}};
    std::printf("%s\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return;
  }
  std::printf("\n%s\ndone in %s, results in %s\n", result_table(record, read_.spec.references).c_str(),
              wall_text(facts_.wall_s).c_str(), folder_.c_str());
}

}  // namespace standoff::launch
