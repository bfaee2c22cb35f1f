// A free plate that is stretched until all of it flows: as PlateSolid composes the scene, or central differences and
// the element kernel of a metal without heat by hand.
#include "coupling/base/state_hash.hpp"
#include "structure_solver/models/plate_hex64/plate_solid.hpp"
#include "structure_solver/step/hex_force.hpp"
#include "tests/absence/measured.hpp"

namespace {

using namespace standoff;
using namespace standoff::structure;

constexpr int steps = 40;             // fewer than pass between two estimates of the stable step
constexpr double stretch_rate = 2e3;  // 1/s: yields within ten steps
using ColdMetal = Metal<Hardening::power, RateLaw::power, false, false>;  // neither heat nor expansion

std::vector<Vec3> stretching(const PlateMesh& mesh) {
  std::vector<Vec3> v;
  for (const Vec3& x : mesh.position) v.push_back(stretch_rate * Vec3{x.x, x.y, -2.0 * x.z});
  return v;
}

/// Four elements side by side.
struct Batch {
  std::size_t nodes[hex_nodes][4];
  Pack4 u[3][hex_nodes];
  std::vector<Pack4> history;
};

struct BatchForces {
  Pack4 of_node[3][hex_nodes];
};

/// What an explicit plate of cold metal needs, and nothing else.
class ByHand {
 public:
  explicit ByHand(const CaseSpec& spec)
      : mesh_(make_plate_mesh(mesh_options(spec))),
        metal_(metal_parameters(spec.plate.material)),
        batches_(static_cast<std::size_t>(mesh_.element_count() / 4)),
        forces_(batches_.size()) {
    const std::size_t n = mesh_.node_count();
    state_.u.resize(n), state_.internal.resize(n), state_.external.resize(n);
    state_.v = stretching(mesh_);
    state_.mass = mesh_.mass;
    for (const double mass : mesh_.mass) state_.inverse_mass.push_back({1.0 / mass, 1.0 / mass, 1.0 / mass});
    const double virgin = static_flow<Hardening::power, false>(metal_.flow, 0.0, metal_.flow.room_temperature).stress;
    for (Batch& batch : batches_) {
      batch.history.assign(static_cast<std::size_t>(hex_points * ColdMetal::fields), Pack4(0.0));
      for (int q = 0; q < hex_points; ++q)
        batch.history[static_cast<std::size_t>(q * ColdMetal::fields + ColdMetal::static_stress_field)] = virgin;
    }
    std::vector<std::vector<std::int32_t>> parts(n);
    for (std::size_t e = 0; e < 4 * batches_.size(); ++e)
      for (std::size_t a = 0; a < hex_nodes; ++a) {
        const auto node = static_cast<std::size_t>(mesh_.element_node(static_cast<long>(e), static_cast<int>(a)));
        batches_[e / 4].nodes[a][e % 4] = node;
        parts[node].push_back(static_cast<std::int32_t>((e / 4 * 3 * hex_nodes + a) * 4 + e % 4));
      }
    for (const auto& of_node : parts) {
      begin_.push_back(static_cast<std::int32_t>(entry_.size()));
      entry_.insert(entry_.end(), of_node.begin(), of_node.end());
    }
    begin_.push_back(static_cast<std::int32_t>(entry_.size()));
  }
  void step(double dt) {
    elastic_ = gained_ = 0.0;
    kick_and_drift(state_, dt, 1);
    for (std::size_t b = 0; b < batches_.size(); ++b) elements(b, {dt, true}, true);
    inelastic_ += gained_;
    kick_with(state_, dt, 1, [&](std::size_t i) { return force_at(i); });
  }
  const NodalState& state() const { return state_; }
  double energy() const { return sound_ ? elastic_ + inelastic_ : -1.0; }

 private:
  /// Compiled as any kernel is: without knowing what it will be called with.
  [[gnu::noipa]] void elements(std::size_t b, const PointStep& step, bool commit) {
    Batch& batch = batches_[b];
    for (int a = 0; a < hex_nodes; ++a) {
      const auto& n = batch.nodes[a];
      const Vec3 &p = state_.u[n[0]], &q = state_.u[n[1]], &r = state_.u[n[2]], &s = state_.u[n[3]];
      batch.u[0][a] = Pack4(Pack4::Raw{p.x, q.x, r.x, s.x});
      batch.u[1][a] = Pack4(Pack4::Raw{p.y, q.y, r.y, s.y});
      batch.u[2][a] = Pack4(Pack4::Raw{p.z, q.z, r.z, s.z});
    }
    const auto sums = hex_force_of(
        mesh_.geometry(), batch.u, forces_[b].of_node, [&](int points, const double* weight, Pack4* gradient) {
          return cold_metal_(metal_, step, commit, points, weight, gradient, batch.history.data());
        });
    for (int i = 0; i < 4; ++i) {
      elastic_ += lane(sums.elastic, i), gained_ += lane(sums.inelastic, i);
      sound_ = sound_ && lane(sums.sound, i);
    }
  }
  Vec3 force_at(std::size_t node) const {
    Vec3 sum;
    for (std::int32_t e = begin_[node]; e < begin_[node + 1]; ++e) {
      const double* f = reinterpret_cast<const double*>(forces_.data()) + entry_[static_cast<std::size_t>(e)];
      sum += Vec3{f[0], f[4 * hex_nodes], f[8 * hex_nodes]};
    }
    return sum;
  }

  PlateMesh mesh_;
  MetalParameters metal_;
  PointUpdate cold_metal_ = &update_points<ColdMetal, Pack4>;
  NodalState state_;
  double elastic_ = 0.0, inelastic_ = 0.0, gained_ = 0.0;  // J: stored, spent since the start, spent in this step
  bool sound_ = true;
  std::vector<Batch> batches_;
  std::vector<BatchForces> forces_;
  std::vector<std::int32_t> begin_, entry_;  // where the forces on each node stand, in the order of the elements
};

void print_hash(const NodalState& state, double energy) {
  StateHash hash;
  for (const auto* array : {&state.u, &state.v}) hash.add(std::span<const Vec3>(*array));
  hash.add(energy);
  std::printf("%s\n", hash.hex().c_str());
}

void run(const standoff::test::Order& order) {
  PlateSolid plate(make_plate_mesh(mesh_options(order.spec)), order.spec, 1);
  const double dt = plate.stable_step();
  if (order.by_hand) {
    ByHand by_hand(order.spec);
    measured([&] {
      for (int i = 0; i < steps; ++i) by_hand.step(dt);
    });
    return print_hash(by_hand.state(), by_hand.energy());
  }
  plate.set_motion(plate.state().u, stretching(plate.mesh()));
  measured([&] {
    for (int i = 0; i < steps; ++i) plate.kick_and_drift_nodes(dt), plate.update_elements(dt), plate.kick_nodes(dt);
  });
  print_hash(plate.state(), plate.elastic() + plate.books().inelastic_work);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(standoff::test::order_of(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "absence_plate: %s\n", error.what());
    return 2;
  }
  return 0;
}
