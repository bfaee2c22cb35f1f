#pragma once
// Two participants that count 200 windows and check every value they get: small integers times powers of two, exact.
//   parallel  load(k-1) acts on the structure in window k, motion(k-1) on the load side; one drain window at the end
//   serial    load(k) acts on the structure in window k, motion(k-1) on the load side; no drain
#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {

constexpr std::int64_t counted_windows = 200;

inline Vec3 force_of(std::int64_t k, std::size_t node) {
  return {0.25 * static_cast<double>(k), -1.0, static_cast<double>(k + 1) * static_cast<double>(node + 1)};
}
inline Vec3 motion_of(std::int64_t k, std::size_t node) {
  return {static_cast<double>(node), 0.5 * static_cast<double>(k + 1), static_cast<double>(-k)};
}

inline void require(bool truth, const std::string& what) {
  if (!truth) throw Stop(ExitCode::check_failed, what);
}

inline void count_load(Participant& link) {
  const SurfaceMesh mesh = link.receive_surface();
  const std::size_t nodes = mesh.position.size();
  require(mesh.position == strip(3).position && mesh.node_mass == strip(3).node_mass, "the surface has changed");
  const CouplingClock clock = link.ready({0.001, 0.0});
  require(clock.windows == counted_windows && clock.window == 1.0 / counted_windows,
          "the clock is not until / windows");
  InterfaceTotals totals;
  std::int64_t expected = 0;
  while (const auto grant = link.next()) {
    const std::int64_t k = grant->window;
    require(k == expected++ && grant->begin == static_cast<double>(k) * clock.window && !grant->drain, "wrong window");
    SurfaceLoad load;
    for (std::size_t i = 0; i < nodes; ++i) {
      const Vec3 wanted = k == 0 ? mesh.position[i] : motion_of(k - 1, i);
      require(grant->motion.position[i] == wanted, "wrong position in window " + std::to_string(k));
      require(grant->motion.velocity[i] == (k == 0 ? Vec3{} : -wanted),
              "wrong velocity in window " + std::to_string(k));
      load.force.push_back(force_of(k, i));
      totals.impulse += force_of(k, i) * clock.window;
    }
    link.progress({{"kinetic_J", static_cast<double>(k)}});
    link.advance(load, totals);
  }
  require(expected == counted_windows, "windows are missing");
  link.finish(R"({"results": {"impulse_Ns": 1.5}})");
}

inline void count_structure(Participant& link) {
  const std::size_t nodes = strip(3).position.size();
  link.offer_surface(strip(3));
  const CouplingClock clock = link.ready({0.005, 0.0});
  link.sample(0.0, {{"centre_deflection_m", 0.0}});
  InterfaceTotals totals;
  std::int64_t expected = 0;
  while (const auto grant = link.next()) {
    const std::int64_t k = grant->window, of = clock.parallel ? k - 1 : k;
    require(k == expected++ && grant->drain == (k == counted_windows), "wrong window");
    SurfaceMotion motion;
    for (std::size_t i = 0; i < nodes; ++i) {
      require(grant->load.force[i] == (of < 0 ? Vec3{} : force_of(of, i)),
              "wrong force in window " + std::to_string(k));
      totals.impulse += grant->load.force[i] * clock.window;
      motion.position.push_back(motion_of(k, i));
      motion.velocity.push_back(-motion_of(k, i));
    }
    link.advance(motion, totals);
  }
  require(expected == counted_windows + (clock.parallel ? 1 : 0), "windows are missing");
  link.finish(R"({"relaxation": {"at_rest": true}})");
}

}  // namespace standoff::test
