#include "particle_solver/step/gas_collide.hpp"

#include <algorithm>

#include "coupling/base/stop.hpp"
#include "particle_solver/kernels/larsen_borgnakke.hpp"
#include "particle_solver/step/gas_work.hpp"

namespace standoff::particles {
namespace {

// A sub-step needs 3 to 15 rounds. Only a jam (many spheres overlapping at one place and instant) could need hundreds;
// what is left then overlaps in the next sub-step and fires at once, so nothing is lost but time.
constexpr int most_rounds = gas::Marks::most_rounds;

// Neighbours in space are kept neighbours in memory by putting the state in cell order now and then.
constexpr std::uint32_t calls_between_sorts = 32;

int rounds_until_most(const std::vector<long>& hits_by_round) {
  if (hits_by_round.empty() || hits_by_round.back() == 0) return 0;
  const double most = 0.98 * static_cast<double>(hits_by_round.back());
  const auto done = std::find_if(hits_by_round.begin(), hits_by_round.end(),
                                 [&](long hits) { return static_cast<double>(hits) >= most; });
  return static_cast<int>(done - hits_by_round.begin()) + 1;
}

}  // namespace

struct GasCollide::Impl {
  GasCollideOptions options;
  gas::Work work;
  std::vector<long> hits_by_round;  // in all, after each round
};

GasCollide::GasCollide(const GasCollideOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
GasCollide::~GasCollide() = default;

GasCellGrid& GasCollide::idle_grid() {
  return impl_->work.grid;
}

GasCollideCounts GasCollide::run(GasState& gas, SandState* sand, SurfaceSheet* sheet, double h, std::uint32_t step) {
  GasCollideCounts counts;
  if (gas.size() == 0) return counts;
  gas::Work& work = impl_->work;
  const GasCollideOptions& options = impl_->options;
  const bool repeats = options.periodic.on();
  if (repeats && (options.mirrors.on || options.walls.on))
    throw Stop(ExitCode::guard, "gas_collide: a scene that repeats has neither mirrors nor walls");
  if (gas.size() >= gas::Choices::most_partners)
    throw Stop(ExitCode::guard, "gas_collide: more than 2^29 gas particles; lower charge.particles");
  work.h = h, work.per_step = 1.0 / h, work.step = step, work.sheet = sheet, work.gas = &gas, work.sand = sand;
  work.seed = options.seed, work.threads = options.threads,
  work.planes = reflecting_planes(options.mirrors.on, options.walls.on, options.walls.lower, options.walls.upper);
  work.periodic = options.periodic;
  work.zeta = options.internal_energy ? internal_degrees_of_freedom(gas.gamma) : 0.0;

  std::vector<long>& hits_by_round = impl_->hits_by_round;
  hits_by_round.clear();
  gas::load(work);
  for (work.round = 1; work.round <= most_rounds && (work.round == 1 || !work.visit.empty()); ++work.round) {
    const gas::Looked looked = gas::search(work);
    if (looked.searches == 0) break;  // all wait
    counts.searches += looked.searches, counts.candidates += looked.candidates;
    gas::resolve(work, counts);
    gas::choose_visitors(work);
    hits_by_round.push_back(counts.hits());
  }
  counts.rounds = work.round - 1;
  counts.usual_rounds = rounds_until_most(hits_by_round);
  if (!work.visit.empty()) counts.deferred = static_cast<long>(work.waiting.size());
  if (step % calls_between_sorts == 0) gas::sort_state(work);
  return counts;
}

}  // namespace standoff::particles
