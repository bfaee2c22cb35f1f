// Law: a surface of the finest plate (14,641 nodes, 351 kB a field) crosses the broker intact in every window: forces
// one way, positions and velocities the other, each value exact. The time of an exchange is printed, never asserted.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {
namespace {

constexpr int side = 121;  // nodes: 40 x 40 elements with three quads along an edge
constexpr std::int64_t windows = 1000;

SurfaceMesh plate() {
  SurfaceMesh mesh;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) mesh.position.push_back({0.0025 * i, 0.0025 * j, 0.0});
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      const int corner = j * side + i;
      mesh.quads.push_back({corner, corner + 1, corner + side + 1, corner + side});
    }
  mesh.node_mass.assign(mesh.position.size(), 1e-4);
  return mesh;
}

/// The same value everywhere, another one in each window.
std::vector<Vec3> field_of(std::int64_t k, std::size_t nodes) {
  return std::vector<Vec3>(nodes, {static_cast<double>(k), 0.5, -static_cast<double>(k)});
}

void structure(Participant& link) {
  const SurfaceMesh mesh = plate();
  link.offer_surface(mesh);
  link.ready({1e-3, 0.0});
  while (const auto grant = link.next()) {
    if (grant->load.force != field_of(grant->window, mesh.position.size())) throw Stop(ExitCode::check_failed, "force");
    link.advance(SurfaceMotion{field_of(grant->window, mesh.position.size()), mesh.position}, {});
  }
  link.finish("{}");
}

void load(Participant& link) {
  const SurfaceMesh mesh = link.receive_surface();
  link.ready({1e-3, 0.0});
  std::vector<double> microseconds;
  auto sent = std::chrono::steady_clock::now();
  while (const auto grant = link.next()) {
    const auto now = std::chrono::steady_clock::now();
    if (grant->window > 0) {
      microseconds.push_back(std::chrono::duration<double, std::micro>(now - sent).count());
      const auto expected = field_of(grant->window - 1, mesh.position.size());
      if (grant->motion.position != expected || grant->motion.velocity != mesh.position)
        throw Stop(ExitCode::check_failed, "motion");
    }
    const SurfaceLoad out{field_of(grant->window, mesh.position.size())};
    sent = std::chrono::steady_clock::now();
    link.advance(out, {});
  }
  std::sort(microseconds.begin(), microseconds.end());
  std::printf("one exchange, 14,641 nodes: median %.0f us, min %.0f us\n", microseconds[microseconds.size() / 2],
              microseconds[0]);
  link.finish("{}");
}

class FinestPlate : public testing::TestWithParam<const char*> {};

TEST_P(FinestPlate, AThousandWindows_EveryValueArrives) {
  CoupledRun run;
  run.broker.rules.parallel = false;  // strictly there and back: one window is one exchange
  run.broker.rules.window = {WindowRule::Kind::fixed, 1.0 / windows};
  if (*GetParam()) run.broker.listen = GetParam();
  Child broker = run.start_broker();
  Child plate_side = run.start(run.options(Role::structure), structure);
  Child load_side = run.start(run.options(Role::load), load);
  EXPECT_EQ(load_side.wait(120.0), 0) << run.errors("particles");
  EXPECT_EQ(plate_side.wait(), 0) << run.errors("structure");
  EXPECT_EQ(broker.wait(), 0) << run.errors("broker");
  const auto nodes = static_cast<std::int64_t>(plate().position.size());
  EXPECT_EQ(run.events("interface").at(0)["bytes"], windows * nodes * 72 + nodes * 32 + 120 * 120 * 16);
}

INSTANTIATE_TEST_SUITE_P(Coupling, FinestPlate, testing::Values("", "tcp://127.0.0.1:*"));

}  // namespace
}  // namespace standoff::test
