// Writes inputs to begin with into FOLDER/{envelope,frames,tape}: a message of each kind, messages with arrays, a small
// tape. Those of the case target are the case files of cases/.
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "coupling/contract/surface_fields.hpp"
#include "coupling/tape/tape_writer.hpp"
#include "coupling/transport/codec.hpp"

using namespace standoff;

namespace {

SurfaceMesh one_quad() {
  SurfaceMesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.quads = {{0, 1, 2, 3}};
  mesh.node_mass.assign(4, 0.1);
  return mesh;
}

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string joined(const Frames& frames) {
  std::string bytes;
  for (const zmq::message_t& frame : frames) {
    bytes += static_cast<char>(frame.size() & 255);
    bytes += static_cast<char>(frame.size() >> 8);
    bytes += frame.to_string();
  }
  return bytes;
}

void write_messages(const std::string& folder) {
  const Envelope envelope{"c0ffee", 1, 2, "structure", 3};
  const std::vector<Message> all = {message::Hello{"structure", Role::structure, "v", "case", 7, "host", true},
                                    message::Welcome{1, 1.0, 5.0},
                                    message::Reject{ExitCode::bad_case, "reason", "remedy"},
                                    message::Ready{{1e-6, 1e-5}, "0123456789abcdef01234567"},
                                    message::Start{{1e-6, 100, true, 5}, "/run/checkpoint", 9},
                                    message::Grant{3, 3e-6, true},
                                    message::Advance{3, {{1, 2, 3}, 4}, 0.5, 0.25},
                                    message::StopWindows{7, "enough", true},
                                    message::Beat{9},
                                    message::Abort{"particles", ExitCode::guard, "unstable", 3},
                                    message::Bye{},
                                    message::ByeAck{},
                                    message::Progress{{{"time_s", 1e-6}}},
                                    message::Sample{1e-6, {{"impulse_Ns", 2.0}}},
                                    message::Report{"{}"},
                                    message::Checkpoint{5, "/run/checkpoint/window-5.part"},
                                    message::Saved{5, 100, 11}};
  for (const Message& body : all)
    write_file(fmt::format("{}/envelope/{}", folder, message_name(body)),
               encode(envelope, body, nullptr)[0].to_string());
  const SurfaceMesh mesh = one_quad();
  const Payload surface = to_fields(mesh), load = to_fields(SurfaceLoad{mesh.position}),
                motion = to_fields(SurfaceMotion{mesh.position, mesh.position});
  write_file(folder + "/frames/SURFACE",
             joined(encode(envelope, message::Surface{4, 1, surface_digest(surface)}, &surface)));
  write_file(folder + "/frames/force", joined(encode(envelope, message::Advance{3, {}, 0, 0}, &load)));
  write_file(folder + "/frames/motion", joined(encode(envelope, message::Grant{3, 3e-6, false}, &motion)));
  write_file(folder + "/frames/HELLO", joined(encode({"", 0, 1, "structure", -1}, all[0], nullptr)));
}

void write_tape(const std::string& path) {
  TapeWriter tape(path);
  tape.head({"case", {1e-6, 4, true, 0}, {1e-8, 0}, {1e-7, 0}, one_quad()});
  const auto load = std::make_shared<Payload>(to_fields(SurfaceLoad{std::vector<Vec3>(4)}));
  const auto motion = std::make_shared<Payload>(to_fields(SurfaceMotion{one_quad().position, one_quad().position}));
  for (std::int64_t k = 0; k < 2; ++k) {
    tape.frame(Role::load, k, {}, 0.0, load);
    tape.frame(Role::structure, k, {{0, 0, 1}, 2}, 0.0, motion);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  for (const char* target : {"envelope", "frames", "tape"}) std::filesystem::create_directories(folder + "/" + target);
  write_messages(folder);
  write_tape(folder + "/tape/two_windows");
  return 0;
}
