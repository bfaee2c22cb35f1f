// What one exchange costs: positions and velocities of the surface out to the load side, forces back, through the
// broker; beside it a ROUTER that forwards the same bytes and does nothing else. Processes are real (threads for
// inproc), solvers compute nothing.
//
//   one window = GRANT (motion) -> ADVANCE (force), GRANT (force) -> ADVANCE (motion), serial scheme
//   raw        = the same four messages of the same sizes: DEALER -> ROUTER -> DEALER, forwarded by move; a side copies
//                its arrays into frames and the frames it gets into arrays, as whoever computes with them must
//
// Both are measured in turns, so that what else the machine does meets both; the ratio is the median over the turns.
//
//   benchmark_exchange [WINDOWS [TURNS [TRANSPORT]]]      prints the table of README.md
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zmq.hpp>

#include "coupling/broker/broker.hpp"
#include "coupling/contract/participant_main.hpp"
#include "coupling/contract/process_watch.hpp"
#include "coupling/launcher/private_folder.hpp"
#include "coupling/transport/curve.hpp"
#include "coupling/transport/socket_watch.hpp"

namespace {

using namespace standoff;
using Clock = std::chrono::steady_clock;
constexpr std::size_t settling = 20;  // windows until caches and the system have settled

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Where and how; the keys are empty but for CURVE.
struct Place {
  std::string name, listen;
  std::size_t nodes = 0;
  long windows = 0;
  CurveKeys broker, side;
  Endpoint endpoint() const { return parse_endpoint(listen, false); }
};

struct Turn {
  std::vector<double> times;  // s, of each window
  double cpu = 0.0;           // s a window, of all three processes
};

double children_cpu() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

using Body = std::function<void()>;

pid_t in_process(const Body& body) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  try {
    reuse_large_blocks();
    body();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    _exit(1);
  }
  _exit(0);
}

/// Runs the bodies at once, as processes or as threads of one; each may write times, which come back.
Turn run_together(const Place& place, const std::function<std::vector<Body>(int times_to)>& bodies_with) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const double before = children_cpu();
  const std::vector<Body> bodies = bodies_with(ends[1]);
  std::vector<pid_t> crew;
  if (place.endpoint().inproc)
    crew.push_back(in_process([&] {
      const auto common = context_for(place.endpoint());  // lives as long as any of them
      std::vector<std::jthread> threads;
      for (const Body& body : bodies) threads.emplace_back(body);
    }));
  else
    for (const Body& body : bodies) crew.push_back(in_process(body));
  close(ends[1]);
  Turn turn;
  for (double time = 0.0; read(ends[0], &time, sizeof time) == sizeof time;) turn.times.push_back(time);
  close(ends[0]);
  for (const pid_t pid : crew) waitpid(pid, nullptr, 0);
  turn.times.erase(turn.times.begin(), turn.times.begin() + static_cast<long>(std::min(settling, turn.times.size())));
  turn.cpu = (children_cpu() - before) / static_cast<double>(place.windows);
  return turn;
}

void write_times(int to, const std::vector<double>& times) {
  for (const double time : times)
    if (write(to, &time, sizeof time) != sizeof time) throw std::runtime_error("pipe");
}

SurfaceMesh strip(std::size_t nodes) {
  SurfaceMesh mesh;
  const auto half = static_cast<std::int32_t>(nodes / 2);
  for (std::int32_t i = 0; i < 2 * half; ++i)
    mesh.position.push_back({static_cast<double>(i % half), static_cast<double>(i / half), 0.0});
  if (nodes % 2 != 0) mesh.position.push_back({static_cast<double>(half), 0.0, 0.0});
  for (std::int32_t i = 0; i + 1 < half; ++i) mesh.quads.push_back({i, i + 1, half + i + 1, half + i});
  mesh.node_mass.assign(nodes, 1.0);
  return mesh;
}

void run_our_broker(const Place& place) {
  BrokerOptions options;
  options.listen = place.listen;
  options.keys = place.broker;
  options.rules.token = std::string("benchmark");
  options.rules.until = static_cast<double>(place.windows);
  options.rules.parallel = false;
  options.rules.window = {WindowRule::Kind::fixed, 1.0};
  options.print = [](const std::string&) {};
  if (run_broker(options) != 0) throw std::runtime_error("the broker failed");
}

ParticipantOptions options_of(const Place& place, Role role) {
  ParticipantOptions options{
      role == Role::load ? "particles" : "structure", role, place.listen, "benchmark", "case", "bench"};
  options.keys = place.side;
  return options;
}

void run_structure(const Place& place) {
  with_link(options_of(place, Role::structure), [&](Participant& link) {
    link.offer_surface(strip(place.nodes));
    link.ready({1.0, 0.0});
    const SurfaceMotion motion{strip(place.nodes).position, std::vector<Vec3>(place.nodes, Vec3{1, 2, 3})};
    while (link.next()) link.advance(motion, {});
    link.finish("{}");
  });
}

void run_load(const Place& place, int times_to) {
  std::vector<double> times;
  with_link(options_of(place, Role::load), [&](Participant& link) {
    link.receive_surface();
    link.ready({1.0, 0.0});
    const SurfaceLoad force{std::vector<Vec3>(place.nodes, Vec3{1, 2, 3})};
    auto begin = Clock::now();
    while (link.next()) {
      times.push_back(seconds_since(begin));
      begin = Clock::now();
      link.advance(force, {});
    }
    link.finish("{}");
  });
  write_times(times_to, times);
}

Turn through_broker(const Place& place) {
  return run_together(place, [&](int times_to) -> std::vector<Body> {
    return {[&] { run_our_broker(place); }, [&] { run_structure(place); },
            [&place, times_to] { run_load(place, times_to); }};
  });
}

/// A message as big as ours: an envelope of some 150 bytes and the arrays.
void send_raw(zmq::socket_t& socket, const std::vector<char>& data, int frames) {
  zmq::message_t envelope(150);
  std::memset(envelope.data(), 0, envelope.size());
  socket.send(envelope, zmq::send_flags::sndmore);
  for (int i = 0; i < frames; ++i)
    socket.send(zmq::message_t(data.data(), data.size()),
                i + 1 < frames ? zmq::send_flags::sndmore : zmq::send_flags::none);
}
void receive_raw(zmq::socket_t& socket, std::vector<char>& into) {
  zmq::message_t frame;
  char* at = into.data();
  do {
    if (!socket.recv(frame)) return;
    if (frame.size() == 0 || at + frame.size() > into.data() + into.size()) continue;
    std::memcpy(at, frame.data(), frame.size());
    at += frame.size();
  } while (frame.more());
}

zmq::socket_t raw_socket(const Place& place, zmq::context_t& context, zmq::socket_type type, const char* name) {
  zmq::socket_t socket(context, type);
  socket.set(zmq::sockopt::linger, 1000);
  if (*name != '\0') socket.set(zmq::sockopt::routing_id, name);
  if (place.broker.on()) *name != '\0' ? use_as_client(socket, place.side) : use_as_server(socket, place.broker);
  return socket;
}

void run_raw_side(const Place& place, const char* name, int frames, int times_to) {
  const bool first = times_to >= 0;
  const auto context = context_for(place.endpoint());
  zmq::socket_t socket = raw_socket(place, *context, zmq::socket_type::dealer, name);
  socket.connect(place.listen);
  const std::vector<char> data(place.nodes * sizeof(Vec3), 1);
  std::vector<char> taken(2 * data.size() + 150);
  std::vector<double> times;
  socket.send(zmq::str_buffer("hello"), zmq::send_flags::none);
  receive_raw(socket, taken);
  for (long k = 0; k < place.windows; ++k) {
    const auto begin = Clock::now();
    if (first)
      send_raw(socket, data, frames), receive_raw(socket, taken);
    else
      receive_raw(socket, taken), send_raw(socket, data, frames);
    times.push_back(seconds_since(begin));
  }
  if (first) write_times(times_to, times);
}

void run_raw_router(const Place& place) {
  const auto context = context_for(place.endpoint());
  std::optional<KeyGate> gate;
  if (place.broker.on()) gate.emplace(*context, place.broker.allowed);
  zmq::socket_t socket = raw_socket(place, *context, zmq::socket_type::router, "");
  socket.bind(place.listen);
  std::vector<char> greeting(64);
  for (int hello = 0; hello < 2; ++hello) receive_raw(socket, greeting);
  const auto address = [](bool load) { return load ? zmq::const_buffer("load", 4) : zmq::const_buffer("plate", 5); };
  for (const bool load : {true, false}) {
    socket.send(address(load), zmq::send_flags::sndmore);
    socket.send(zmq::str_buffer("go"), zmq::send_flags::none);
  }
  for (long messages = 2 * place.windows; messages > 0; --messages) {
    zmq::message_t from, frame;
    if (!socket.recv(from)) return;
    socket.send(address(from.size() != 4), zmq::send_flags::sndmore);
    for (bool more = true; more;) {
      if (!socket.recv(frame)) return;
      more = frame.more();
      socket.send(std::move(frame), more ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }
  }
}

Turn through_raw_router(const Place& place) {
  return run_together(place, [&](int times_to) -> std::vector<Body> {
    return {[&] { run_raw_router(place); }, [&] { run_raw_side(place, "plate", 2, -1); },
            [&place, times_to] { run_raw_side(place, "load", 1, times_to); }};
  });
}

struct Sum {
  std::vector<double> times, cpu;
  void add(const Turn& turn) {
    times.insert(times.end(), turn.times.begin(), turn.times.end());
    cpu.push_back(turn.cpu);
  }
  std::string cells() const {
    return fmt::format("{:.0f} | {:.0f} | {:.0f}", 1e6 * median_of(times),
                       1e6 * *std::min_element(times.begin(), times.end()), 1e6 * median_of(cpu));
  }
};

void print_row(const Place& place, int turns) {
  Sum ours, raw;
  std::vector<double> ratios;
  for (int turn = 0; turn < turns; ++turn) {
    const Turn bare = through_raw_router(place), full = through_broker(place);
    raw.add(bare), ours.add(full);
    ratios.push_back(median_of(full.times) / median_of(bare.times));
  }
  std::printf("| %s | %zu | %s | %s | %.2f |\n", place.name.c_str(), place.nodes, ours.cells().c_str(),
              raw.cells().c_str(), median_of(ratios));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const long windows = argc > 1 ? std::stol(argv[1]) : 400;
  const int turns = argc > 2 ? std::stoi(argv[2]) : 9;
  const launch::PrivateFolder folder;
  write_new_keys(folder.path() + "/broker");
  write_new_keys(folder.path() + "/side");
  const CurveKeys broker = read_broker_keys(folder.path() + "/broker.secret", folder.path() + "/side.public");
  const CurveKeys side = read_participant_keys(folder.path() + "/side.secret", folder.path() + "/broker.public");
  const std::string port = std::to_string(21000 + getpid() % 20000);
  std::printf(
      "| transport | nodes | exchange median us | min us | CPU us | raw median us | min us | CPU us | ours / raw |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::fflush(stdout);
  const std::string only = argc > 3 ? argv[3] : "";
  for (const std::size_t nodes : {std::size_t{961}, std::size_t{14641}})
    for (const Place& place : {Place{"inproc", "inproc://exchange", nodes, windows, {}, {}},
                               Place{"ipc", "ipc://" + folder.path() + "/exchange", nodes, windows, {}, {}},
                               Place{"tcp", "tcp://127.0.0.1:" + port, nodes, windows, {}, {}},
                               Place{"tcp, CURVE", "tcp://127.0.0.1:" + port, nodes, windows, broker, side}})
      if (only.empty() || only == place.name) print_row(place, turns);
  return 0;
}
