// What one exchange costs: positions and velocities of the surface out to the load side, forces back, through the
// broker; beside it a ROUTER that forwards the same bytes and does nothing else. Processes are real, solvers compute
// nothing.
//
//   one window = GRANT (motion) -> ADVANCE (force), GRANT (force) -> ADVANCE (motion), serial scheme
//   raw        = the same four messages of the same sizes: DEALER -> ROUTER -> DEALER, forwarded by move
//
//   benchmark_exchange [WINDOWS]      prints the table of README.md
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zmq.hpp>

#include "coupling/broker/broker.hpp"
#include "coupling/contract/participant_main.hpp"
#include "coupling/contract/process_watch.hpp"

namespace {

using namespace standoff;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Result {
  double median = 0.0, least = 0.0, cpu = 0.0;  // s a window; cpu of all three processes
};

Result summary(std::vector<double> times, double cpu) {
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times.front(), cpu / static_cast<double>(times.size())};
}

double children_cpu() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

pid_t in_process(const std::function<void()>& body) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  try {
    body();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    _exit(1);
  }
  _exit(0);
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

/// Runs broker, structure and load side; the load side's window times come back through a pipe.
Result through_broker(const std::string& listen, std::size_t nodes, long windows) {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) return {};
  const double before = children_cpu();
  const pid_t broker = in_process([&] {
    reuse_large_blocks();
    BrokerOptions options;
    options.listen = listen;
    options.rules.token = "benchmark";
    options.rules.until = static_cast<double>(windows);
    options.rules.parallel = false;
    options.rules.window = {WindowRule::Kind::fixed, 1.0};
    options.print = [](const std::string&) {};
    if (run_broker(options) != 0) throw std::runtime_error("the broker failed");
  });
  const auto options = [&](const char* name, Role role) {
    return ParticipantOptions{name, role, listen, "benchmark", "case", "bench"};
  };
  const pid_t structure = in_process([&] {
    reuse_large_blocks();
    with_link(options("structure", Role::structure), [&](Participant& link) {
      link.offer_surface(strip(nodes));
      link.ready({1.0, 0.0});
      const SurfaceMotion motion{strip(nodes).position, std::vector<Vec3>(nodes, Vec3{1, 2, 3})};
      while (link.next()) link.advance(motion, {});
      link.finish("{}");
    });
  });
  const pid_t load = in_process([&] {
    reuse_large_blocks();
    std::vector<double> times;
    with_link(options("particles", Role::load), [&](Participant& link) {
      link.receive_surface();
      link.ready({1.0, 0.0});
      const SurfaceLoad force{std::vector<Vec3>(nodes, Vec3{1, 2, 3})};
      auto begin = Clock::now();
      while (link.next()) {
        times.push_back(seconds_since(begin));
        begin = Clock::now();
        link.advance(force, {});
      }
      link.finish("{}");
    });
    if (write(pipe_ends[1], times.data(), times.size() * sizeof(double)) < 0) throw std::runtime_error("pipe");
  });
  std::vector<double> times(static_cast<std::size_t>(windows));
  close(pipe_ends[1]);
  for (std::size_t done = 0; done < times.size() * sizeof(double);) {
    const ssize_t n =
        read(pipe_ends[0], reinterpret_cast<char*>(times.data()) + done, times.size() * sizeof(double) - done);
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  close(pipe_ends[0]);
  for (const pid_t pid : {broker, structure, load}) waitpid(pid, nullptr, 0);
  times.erase(times.begin(), times.begin() + 20);  // until caches and the system have settled
  return summary(times, children_cpu() - before);
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
void receive_raw(zmq::socket_t& socket) {
  zmq::message_t frame;
  do {
    if (!socket.recv(frame)) return;
  } while (frame.more());
}

Result raw_router(const std::string& listen, std::size_t nodes, long windows) {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) return {};
  const double before = children_cpu();
  const auto side = [&](const char* name, int frames, bool first) {
    zmq::context_t context;
    zmq::socket_t socket(context, ZMQ_DEALER);
    socket.set(zmq::sockopt::routing_id, name);
    socket.connect(listen);
    const std::vector<char> data(nodes * sizeof(Vec3), 1);
    std::vector<double> times;
    socket.send(zmq::str_buffer("hello"));
    receive_raw(socket);
    for (long k = 0; k < windows; ++k) {
      const auto begin = Clock::now();
      if (first)
        send_raw(socket, data, frames), receive_raw(socket);
      else
        receive_raw(socket), send_raw(socket, data, frames);
      times.push_back(seconds_since(begin));
    }
    socket.set(zmq::sockopt::linger, 1000);
    if (first && write(pipe_ends[1], times.data(), times.size() * sizeof(double)) < 0) throw std::runtime_error("pipe");
  };
  const pid_t router = in_process([&] {
    zmq::context_t context;
    zmq::socket_t socket(context, ZMQ_ROUTER);
    socket.bind(listen);
    long messages = 2 * windows;
    for (int hello = 0; hello < 2; ++hello) {
      zmq::message_t address, text;
      if (!socket.recv(address) || !socket.recv(text)) return;
    }
    for (const char* name : {"load", "plate"}) {
      socket.send(zmq::const_buffer(name, std::strlen(name)), zmq::send_flags::sndmore);
      socket.send(zmq::str_buffer("go"));
    }
    while (messages-- > 0) {
      zmq::message_t address, frame;
      if (!socket.recv(address)) return;
      const bool from_load = address.size() == 4;  // "load", "plate"
      socket.send(from_load ? zmq::const_buffer("plate", 5) : zmq::const_buffer("load", 4), zmq::send_flags::sndmore);
      for (bool more = true; more;) {
        if (!socket.recv(frame)) return;
        more = frame.more();
        socket.send(std::move(frame), more ? zmq::send_flags::sndmore : zmq::send_flags::none);
      }
    }
    socket.set(zmq::sockopt::linger, 1000);
  });
  usleep(100000);
  const pid_t load = in_process([&] { side("load", 1, true); });
  const pid_t plate = in_process([&] { side("plate", 2, false); });
  close(pipe_ends[1]);
  std::vector<double> times(static_cast<std::size_t>(windows));
  for (std::size_t done = 0; done < times.size() * sizeof(double);) {
    const ssize_t n =
        read(pipe_ends[0], reinterpret_cast<char*>(times.data()) + done, times.size() * sizeof(double) - done);
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  close(pipe_ends[0]);
  for (const pid_t pid : {router, load, plate}) waitpid(pid, nullptr, 0);
  times.erase(times.begin(), times.begin() + 20);
  return summary(times, children_cpu() - before);
}

void print_row(const char* name, std::size_t nodes, const Result& ours, const Result& raw) {
  std::printf("| %s | %zu | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.2f |\n", name, nodes, 1e6 * ours.median,
              1e6 * ours.least, 1e6 * ours.cpu, 1e6 * raw.median, 1e6 * raw.least, 1e6 * raw.cpu,
              ours.median / raw.median);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const long windows = argc > 1 ? std::stol(argv[1]) : 2000;
  char folder[] = "/tmp/standoff-benchmark-XXXXXX";
  if (mkdtemp(folder) == nullptr) return 1;
  const std::string place = folder;
  std::printf(
      "| transport | nodes | exchange median us | min us | CPU us | raw median us | min us | CPU us | median / raw |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::fflush(stdout);
  for (const std::size_t nodes : {std::size_t{961}, std::size_t{14641}})
    for (const bool tcp : {false, true}) {
      const int port = 21000 + static_cast<int>(getpid() % 20000) + static_cast<int>(nodes % 7);
      const auto address = [&](const char* name, int offset) {
        return tcp ? fmt::format("tcp://127.0.0.1:{}", port + offset)
                   : fmt::format("ipc://{}/{}{}", place, name, nodes);
      };
      const Result raw = raw_router(address("raw", 10), nodes, windows);
      const Result ours = through_broker(address("broker", 0), nodes, windows);
      print_row(tcp ? "tcp" : "ipc", nodes, ours, raw);
    }
  rmdir(folder);
  return 0;
}
