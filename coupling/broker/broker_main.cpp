// standoff-broker: the window clock and referee between a load side and a structure.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "coupling/base/stop.hpp"
#include "coupling/broker/broker.hpp"
#include "coupling/broker/checkpoint_store.hpp"
#include "coupling/contract/process_watch.hpp"
#include "coupling/transport/endpoint.hpp"

namespace {

using namespace standoff;

struct CommandLine {
  BrokerOptions broker;
  std::string scheme = "parallel", window = "auto", resume, curve_secret, curve_allow, new_keys;
};

WindowRule parse_window(const std::string& text) {
  if (text == "auto") return {WindowRule::Kind::automatic, 0.0};
  if (text == "step") return {WindowRule::Kind::structure_step, 0.0};
  try {
    std::size_t used = 0;
    const double length = std::stod(text, &used);
    if (used == text.size() && length > 0.0 && length < 1e300) return {WindowRule::Kind::fixed, length};
  } catch (const std::logic_error&) {
    // falls through to the message
  }
  throw CLI::ValidationError("--window", "\"" + text + "\" is not step, auto or a positive number of seconds");
}

CLI::Validator seconds_check(bool zero_too) {
  return {[zero_too](std::string& text) -> std::string {
            double value = -1.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            if (number && (value > 0.0 || (zero_too && value == 0.0))) return {};
            return "\"" + text + "\" is not a positive number of seconds" + (zero_too ? " or 0" : "");
          },
          ""};
}

void declare(CLI::App& app, CommandLine& line) {
  const CLI::Validator positive = seconds_check(false), not_negative = seconds_check(true);
  Deadlines& limit = line.broker.rules.deadlines;
  app.add_option("--listen", line.broker.listen, "ipc:///folder/name or tcp://127.0.0.1:port")
      ->required()
      ->check(why_out_of_reach);
  app.add_option("--token", line.broker.rules.token, "run token, hexadecimal; participants must give the same")
      ->required();
  app.add_option("--until", line.broker.rules.until, "end of the windows, s")->required()->check(positive);
  app.add_option("--scheme", line.scheme, "parallel | serial")
      ->check(CLI::IsMember({"parallel", "serial"}))
      ->capture_default_str();
  app.add_option("--window", line.window, "step | auto | seconds")->capture_default_str();
  app.add_option("--expect", line.broker.rules.expected, "names of the participants")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  app.add_option("--join-deadline", limit.join, "s to wait for participants")->check(positive)->capture_default_str();
  app.add_option("--beat-deadline", limit.beat, "s of silence after which a participant is lost")
      ->check(positive)
      ->capture_default_str();
  app.add_option("--progress-deadline", limit.progress, "s a solver may stand still; 0: for ever")
      ->check(not_negative)
      ->capture_default_str();
  app.add_flag("--insecure", line.broker.insecure, "allow an address other machines can reach, unencrypted");
  app.add_option("--curve-secret", line.curve_secret, "file with the broker's secret key: the connection is encrypted")
      ->envname("STANDOFF_CURVE_SECRET");
  app.add_option("--curve-allow", line.curve_allow, "file with the public keys that are let in, one a line")
      ->envname("STANDOFF_CURVE_ALLOW");
  // Listed for --help; it stands alone, see make_keys.
  app.add_option("--new-keys", line.new_keys, "write a new pair of keys, PREFIX.secret and PREFIX.public, and end");
}

void declare_checkpoints(CLI::App& app, CommandLine& line) {
  CheckpointRule& rule = line.broker.rules.checkpoint;
  app.add_option("--checkpoint", rule.folder, "folder for checkpoints; without it there are none");
  app.add_option("--checkpoint-every", rule.every, "s of wall clock between checkpoints; 0: not by time")
      ->check(seconds_check(true))
      ->capture_default_str();
  app.add_option("--checkpoint-windows", rule.every_windows, "windows between checkpoints; 0: not by count")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--build", line.broker.build, "what the checkpoints say of the program that wrote them");
  app.add_option("--tape", line.broker.tape, "file that every exchange is recorded in");
  app.add_option("--resume", line.resume, "checkpoint to go on from, a folder window-NUMBER");
}

/// Participants may run in another folder.
std::string absolute(const std::string& path) {
  return path.empty() ? "" : std::filesystem::absolute(path).lexically_normal().string();
}

/// `--new-keys PREFIX` and nothing else.
bool make_keys(int argc, char** argv) {
  if (argc != 3 || std::string(argv[1]) != "--new-keys") return false;
  write_new_keys(argv[2]);
  return true;
}

void print_line(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Window clock and referee of a coupled Standoff run"};
  CommandLine line;
  declare(app, line);
  declare_checkpoints(app, line);
  try {
    if (make_keys(argc, argv)) return 0;
    app.parse(argc, argv);
    line.broker.keys = read_broker_keys(line.curve_secret, line.curve_allow);
    line.broker.rules.window = parse_window(line.window);
    line.broker.rules.parallel = line.scheme == "parallel";
    // Beats must come often enough for the deadline.
    Deadlines& limit = line.broker.rules.deadlines;
    limit.beat_interval = std::min(limit.beat_interval, limit.beat / 4.0);
    line.broker.print = print_line;
    line.broker.rules.checkpoint.folder = absolute(line.broker.rules.checkpoint.folder);
    if (!line.resume.empty()) line.broker.rules.resume = read_checkpoint(absolute(line.resume));
    watch_process();
    reuse_large_blocks();
    return run_broker(line.broker);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_case);
  } catch (const Stop& stop) {
    std::fprintf(stderr, "standoff-broker: error: %s\n", stop.what());
    return static_cast<int>(stop.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "standoff-broker: error: %s\n", error.what());
    return static_cast<int>(ExitCode::participant_lost);
  }
}
