#include "particle_solver/step/sand_pairs.hpp"

#include <algorithm>
#include <cmath>

#include <omp.h>

#include "coupling/base/stop.hpp"
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/search/grain_cells.hpp"
#include "particle_solver/search/grain_drift.hpp"
#include "particle_solver/step/sand_pairs_pass.hpp"

namespace standoff::particles {

GrainLaw grain_law(const SoilSpec& soil, double cell_size) {
  return {soil.stiffness * cell_size, soil.friction, soil.damping};
}

double recommended_step(const GrainLaw& law, double mass) {
  const double spring = 2.0 * std::sqrt(mass / law.stiffness);
  const double dashpot = std::sqrt(0.5 * mass / law.stiffness) / (2.0 * std::max(law.damping, 1e-300));  // m_red / c
  return 0.05 * std::min(spring, dashpot);
}

namespace {

constexpr double first_skin = 0.15, thinnest_skin = 0.08, thickest_skin = 0.8;  // in diameters
constexpr GrainRecord far_away{1e100, 1e100, 1e100, 0.0};

std::size_t largest_id(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::uint32_t largest = 0;
  for (const auto* ids : {&a, &b})
    for (const std::uint32_t i : *ids) largest = std::max(largest, i);
  return largest;
}

}  // namespace

struct SandPairs::Impl {
  explicit Impl(const SandPairsOptions& given) : options(given), box(given.periodic_box.value_or(Vec3{})) {}

  bool same_grains(const SandState& sand) const;
  void copy_in(const SandState& sand);
  void moves_of_changed_set(SandState& sand);
  void hand_moves_over(SandState& sand) const;
  void book_removed(const std::vector<std::uint32_t>& place);
  void measure(const SandState& sand);
  void adapt_skin();
  void make_lists(const SandState& sand, std::span<const Vec3> list_position, std::span<const Vec3> moved);
  PassInput pass_input(double dt) const;
  bool turning() const { return options.turning && options.law.friction > 0.0; }
  void collect_turns(const SandState& sand, double dt);
  void hand_torques_over(const GrainBlock& block, const std::vector<GrainRecord>& torque, SandState& sand) const;
  void run_blocks(SandState& sand, double dt);
  void deep_in_block(const GrainBlock& block, double share, std::vector<DeepContact>& found) const;
  void close_books(const std::vector<PassSums>& sums, double dt, std::size_t count);

  SandPairsOptions options;
  Vec3 box, old_box, list_box;  // m, periodic: now, at the last call, when the list was made
  GrainCells cells;
  GrainDrift drift;
  GrainHistory history;
  std::vector<GrainBlock> blocks;
  std::vector<std::uint32_t> id;           // sorted order
  std::vector<GrainRecord> grains, moves;  // sorted order
  std::vector<GrainRecord> turns;          // sorted order, m, radius times rotation of the last call; if grains turn
  std::vector<Vec3> list_position;         // sorted order, where the list was made
  std::vector<PassScratch> scratch;        // one a thread
  std::vector<double> block_overlap;       // m, largest in each block at the last call
  bool radii = false, ready = false;
  double mean_radius = 0.0, largest_radius = 0.0, smallest_radius = 0.0, lightest = 0.0, skin = 0.0;
  long calls_since_list = 0;
  Vec3 mirror_force;
  SandBooks books;
};

bool SandPairs::Impl::same_grains(const SandState& sand) const {
  if (!ready || sand.size() != id.size()) return false;
  bool same = true;
  const auto count = static_cast<long>(id.size());
  const std::uint32_t* order = cells.order().data();
#pragma omp parallel for schedule(static) reduction(&& : same) num_threads(options.threads)
  for (long i = 0; i < count; ++i) same = same && sand.id[order[i]] == id[static_cast<std::size_t>(i)];
  return same;
}

/// The shortest of a displacement and its periodic images.
Vec3 shortest(const Vec3& d, const Vec3& box) {
  const auto along = [](double a, double length) {
    return length > 0.0 ? a - length * nearest_integer(a / length) : a;
  };
  return {along(d.x, box.x), along(d.y, box.y), along(d.z, box.z)};
}

/// New positions and what changed since the last call; boxes of displacements since the list was made.
void SandPairs::Impl::copy_in(const SandState& sand) {
  const bool periodic = options.periodic_box.has_value();  // a position may have been wrapped in between
  const std::uint32_t* order = cells.order().data();
  const auto regions = static_cast<long>(drift.regions().size());
#pragma omp parallel for schedule(static) num_threads(options.threads)
  for (long r = 0; r < regions; ++r) {
    const GrainDrift::Region& region = drift.regions()[static_cast<std::size_t>(r)];
    DriftBox region_box;
    for (std::size_t i = region.begin; i < region.end; ++i) {
      const Vec3 x = sand.position[order[i]];
      GrainRecord& grain = grains[i];
      Vec3 move = x - Vec3{grain.x, grain.y, grain.z}, since = x - list_position[i];
      if (periodic) move = shortest(move, box), since = shortest(since, box);
      moves[i].x = move.x, moves[i].y = move.y, moves[i].z = move.z;
      grain.x = x.x, grain.y = x.y, grain.z = x.z;
      region_box.add(Lanes{since.x, since.y, since.z, 0.0});
    }
    drift.box(static_cast<std::size_t>(r)) = region_box;
  }
}

/// Displacements of a set of grains that was sorted anew, thinned or added to: found by id. They go to SandState::force
/// as in hand_moves_over.
void SandPairs::Impl::moves_of_changed_set(SandState& sand) {
  std::vector<std::uint32_t> place(largest_id(sand.id, id) + 1, GrainHistory::nobody);
  for (std::size_t s = 0; s < sand.size(); ++s) place[sand.id[s]] = static_cast<std::uint32_t>(s);
  if (ready) book_removed(place);
  std::fill(sand.force.begin(), sand.force.end(), Vec3{});
  for (std::size_t i = 0; i < id.size(); ++i) {
    const std::uint32_t s = place[id[i]];
    if (s == GrainHistory::nobody) continue;
    const Vec3 move = sand.position[s] - Vec3{grains[i].x, grains[i].y, grains[i].z};
    sand.force[s] = options.periodic_box ? shortest(move, box) : move;
  }
}

/// Energy in the normal springs of grains that are no longer there, where they were last seen. `place` is by id.
void SandPairs::Impl::book_removed(const std::vector<std::uint32_t>& place) {
  const auto gone = [&](std::uint32_t i) { return place[id[i]] == GrainHistory::nobody; };
  bool any_gone = false;
  for (std::uint32_t i = 0; i < id.size() && !any_gone; ++i) any_gone = gone(i);
  if (!any_gone) return;
  const auto stored = [&](double overlap) {
    return overlap > 0.0 ? 0.5 * options.law.stiffness * overlap * overlap : 0.0;
  };
  for (const GrainBlock& block : blocks) {
    block.for_each_pair([&](GrainPair pair) {
      if (pair.i > pair.j || !(gone(pair.i) || gone(pair.j))) return;  // a rim pair is listed from both sides
      const GrainRecord &a = grains[pair.i], &b = grains[pair.j];
      const Vec3 d{a.x - b.x, a.y - b.y, a.z - b.z};
      books.escaped_elastic += stored(a.w + b.w - norm(options.periodic_box ? shortest(d, box) : d));
    });
    for (std::uint32_t i = block.begin; options.mirrors.on && i < block.end; ++i) {
      if (!gone(i)) continue;  // half of a spring to the own image is the grain's
      books.escaped_elastic += 0.5 * stored(2.0 * (grains[i].w - grains[i].x));
      books.escaped_elastic += 0.5 * stored(2.0 * (grains[i].w - grains[i].y));
    }
  }
}

/// What depends on the set of grains alone.
void SandPairs::Impl::measure(const SandState& sand) {
  const std::size_t count = sand.size();
  if (sand.velocity.size() != count || sand.id.size() != count || sand.force.size() != count)
    throw Stop(ExitCode::guard, "sand: position, velocity, force and id must have one entry per grain");
  if (options.turning && (sand.spin.size() != count || sand.torque.size() != count))
    throw Stop(ExitCode::guard, "sand: grains that turn need a spin and a torque each");
  radii = !sand.grain_radius.empty() || !sand.grain_mass.empty();
  mean_radius = largest_radius = smallest_radius = sand.radius, lightest = sand.mass;
  for (std::size_t i = 0; radii && i < count; ++i) {
    largest_radius = std::max(i == 0 ? 0.0 : largest_radius, sand.radius_of(i));
    smallest_radius = i == 0 ? sand.radius_of(i) : std::min(smallest_radius, sand.radius_of(i));
    lightest = i == 0 ? sand.mass_of(i) : std::min(lightest, sand.mass_of(i));
  }
  if (!(options.law.stiffness > 0.0) || !(mean_radius > 0.0) || !(lightest > 0.0))
    throw Stop(ExitCode::guard, "sand: stiffness, grain radius and grain mass must be above zero");
}

/// Lists that last short are made thicker, lists that last long thinner; steps are counted, not seconds.
void SandPairs::Impl::adapt_skin() {
  const double diameter = 2.0 * mean_radius;
  if (options.skin > 0.0)
    skin = options.skin * diameter;
  else if (books.list_builds == 0)
    skin = first_skin * diameter;
  else if (calls_since_list < 10)
    skin = std::min(1.25 * skin, thickest_skin * diameter);
  else if (calls_since_list > 30)
    skin = std::max(skin / 1.15, thinnest_skin * diameter);
}

/// Displacements since the last call into SandState::force, which is about to be set anew: lists take them from there.
void SandPairs::Impl::hand_moves_over(SandState& sand) const {
  const std::uint32_t* order = cells.order().data();
#pragma omp parallel for schedule(static) num_threads(options.threads)
  for (std::size_t i = 0; i < id.size(); ++i) sand.force[order[i]] = {moves[i].x, moves[i].y, moves[i].z};
}

/// Sorts the grains and lists candidate pairs for where they are at `at`; `moved` are displacements since the last call
/// (both in the order of SandState).
void SandPairs::Impl::make_lists(const SandState& sand, std::span<const Vec3> at, std::span<const Vec3> moved) {
  const std::size_t count = sand.size(), old_count = id.size();
  const bool springs = options.law.friction > 0.0;
  std::vector<std::uint32_t> old_place(largest_id(sand.id, id) + 1, GrainHistory::nobody);
  for (std::size_t i = 0; i < old_count; ++i) old_place[id[i]] = static_cast<std::uint32_t>(i);
  if (springs && history.empty()) history.collect(blocks, old_count, options.threads);

  const Vec3* periodic = options.periodic_box ? &box : nullptr;
  const double contact = 2.0 * largest_radius, cutoff = contact + skin;
  // The arrays of displacements come back last: without them there is room for old beside new springs.
  moves = std::vector<GrainRecord>(), list_position = std::vector<Vec3>();
  cells.build(at, cutoff, periodic);
  grains.assign(count + 1, far_away);
  id.resize(count);
  std::vector<std::uint32_t> old_index(springs ? count : 0);
#pragma omp parallel for schedule(static) num_threads(options.threads)
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t s = cells.order()[i];
    id[i] = sand.id[s];
    if (springs) old_index[i] = old_place[id[i]];
    grains[i] = {at[s].x, at[s].y, at[s].z, sand.radius_of(s)};
  }
  old_place = std::vector<std::uint32_t>();
  list_grain_pairs(cells, grains, {cutoff, skin, radii, springs, periodic, period_of(box).per_length, options.threads},
                   blocks);
  if (springs && !history.empty()) {
    history.apply(blocks, old_index, options.threads);
    books.friction_loss += 0.5 * options.law.stiffness * history.finish();
  }
  moves.resize(count + 1), list_position.resize(count);
#pragma omp parallel for schedule(static) num_threads(options.threads)
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t s = cells.order()[i];
    list_position[i] = at[s];
    moves[i] = {moved[s].x, moved[s].y, moved[s].z, 1.0 / sand.mass_of(s)};
  }
  drift.restart(cells, contact, skin);
  list_box = box, calls_since_list = 0, ready = true;
  ++books.list_builds;
}

PassInput SandPairs::Impl::pass_input(double dt) const {
  PassInput in;
  in.law = options.law;
  in.grains = grains.data(), in.moves = moves.data();
  in.turns = turns.data();
  in.far_away = static_cast<std::uint32_t>(grains.size() - 1);
  in.reach = 2.0 * mean_radius;
  in.dt = dt;
  if (in.law.damping > 0.0) in.dashpot_per_step = dashpot_over_step(in.law, 2.0 / lightest, dt);
  if (options.periodic_box) {
    in.box = box, in.box_change = box - old_box;
    in.per_box = period_of(box).per_length;
  }
  return in;
}

/// Spins stand still between two calls but for what surface_contact did before the drift.
void SandPairs::Impl::collect_turns(const SandState& sand, double dt) {
  turns.resize(id.size() + 1);
#pragma omp parallel for schedule(static) num_threads(options.threads)
  for (std::size_t i = 0; i < id.size(); ++i) {
    const std::uint32_t s = cells.order()[i];
    const Vec3 turn = sand.spin[s] * (sand.radius_of(s) * dt);
    turns[i] = {turn.x, turn.y, turn.z, 0.0};
  }
  turns.back() = {};
}

void SandPairs::Impl::run_blocks(SandState& sand, double dt) {
  if (turning()) collect_turns(sand, dt);
  const PassInput in = pass_input(dt);
  const RunBlock run = choose_pass(options.law.friction > 0.0, options.law.damping > 0.0, radii,
                                   options.periodic_box.has_value(), turning());
  std::vector<PassSums> sums(blocks.size());
  scratch.resize(static_cast<std::size_t>(options.threads));
  const auto count = static_cast<int>(blocks.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(options.threads)
  for (int b = 0; b < count; ++b) {
    GrainBlock& block = blocks[static_cast<std::size_t>(b)];
    PassScratch& mine = scratch[static_cast<std::size_t>(omp_get_thread_num())];
    mine.force.assign(block.end - block.begin, {});
    if (turning()) mine.torque.assign(block.end - block.begin, {});
    PassSums& sum = sums[static_cast<std::size_t>(b)];
    sum = run(in, block, mine);
    if (options.mirrors.on) sum.add(run_mirrors(in, block, mine), 1.0);
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const GrainRecord& f = mine.force[i - block.begin];
      sand.force[cells.order()[i]] = {f.x, f.y, f.z};
      sum.touching += f.w, sum.most_touching = std::max(sum.most_touching, f.w);
    }
    if (turning()) hand_torques_over(block, mine.torque, sand);
  }
  block_overlap.resize(sums.size());
  std::transform(sums.begin(), sums.end(), block_overlap.begin(), [](const PassSums& s) { return s.largest_overlap; });
  close_books(sums, dt, sand.size());
}

void SandPairs::Impl::hand_torques_over(const GrainBlock& block, const std::vector<GrainRecord>& torque,
                                        SandState& sand) const {
  for (std::size_t i = block.begin; i < block.end; ++i) {
    const std::uint32_t s = cells.order()[i];
    const GrainRecord& t = torque[i - block.begin];
    sand.torque[s] = Vec3{t.x, t.y, t.z} * sand.radius_of(s);
  }
}

/// A rim pair is listed by two blocks: the one that holds the smaller index reports it.
void SandPairs::Impl::deep_in_block(const GrainBlock& block, double share, std::vector<DeepContact>& found) const {
  const auto& order = cells.order();
  const auto look = [&](GrainPair pair) {
    if (pair.i > pair.j) return;
    const GrainRecord &a = grains[pair.i], &b = grains[pair.j];
    const double core = share * (a.w + b.w);
    Vec3 apart{a.x - b.x, a.y - b.y, a.z - b.z};
    if (options.periodic_box) apart = shortest(apart, box);
    if (squared_norm(apart) < core * core)
      found.push_back({order[pair.i], order[pair.j], DeepContact::With::grain, apart});
  };
  // Where there are springs, a pair that touches has one.
  if (options.law.friction > 0.0)
    block.for_each_spring([&](GrainPair pair, const Vec3&) { look(pair); });
  else
    block.for_each_pair(look);
  for (std::uint32_t i = block.begin; options.mirrors.on && i < block.end; ++i) {
    const GrainRecord& grain = grains[i];
    if (grain.x < share * grain.w) found.push_back({order[i], order[i], DeepContact::With::image_x, {}});
    if (grain.y < share * grain.w) found.push_back({order[i], order[i], DeepContact::With::image_y, {}});
  }
}

void SandPairs::Impl::close_books(const std::vector<PassSums>& sums, double dt, std::size_t count) {
  PassSums all;
  for (const PassSums& sum : sums) all.add(sum, 1.0);
  books.elastic_energy = all.elastic;
  books.friction_loss += all.friction_loss, books.damping_loss += all.damping_loss;
  books.overlap_over_radius = all.largest_overlap / mean_radius;
  books.max_overlap_over_radius = std::max(books.max_overlap_over_radius, books.overlap_over_radius);
  // Each force acts in the half kick before and the one after its evaluation.
  books.mirror_impulse += 0.5 * dt * (mirror_force + all.mirror_force);
  mirror_force = all.mirror_force;
  books.virial = all.virial;
  books.coordination = count > 0 ? all.touching / static_cast<double>(count) : 0.0;
  books.most_contacts = static_cast<int>(all.most_touching);
  ++calls_since_list;
}

SandPairs::SandPairs(const SandPairsOptions& options) : impl_(std::make_unique<Impl>(options)) {}
SandPairs::~SandPairs() = default;
SandPairs::SandPairs(SandPairs&&) noexcept = default;

void SandPairs::forces(SandState& sand, double dt) {
  Impl& my = *impl_;
  if (!my.ready) my.old_box = my.box;
  if (!my.same_grains(sand)) {
    my.measure(sand);
    my.moves_of_changed_set(sand);
    if (!my.ready) my.adapt_skin();
    my.make_lists(sand, sand.position, sand.force);
  } else {
    my.copy_in(sand);
    const Vec3 stretch = my.box - my.list_box;
    if (my.drift.used(my.options.threads, norm(stretch)) > 1.0) {
      my.adapt_skin();
      my.hand_moves_over(sand);
      my.make_lists(sand, sand.position, sand.force);
    }
  }
  my.run_blocks(sand, dt);
  my.old_box = my.box;
}

const SandBooks& SandPairs::books() const {
  return impl_->books;
}

const GrainLaw& SandPairs::law() const {
  return impl_->options.law;
}

double SandPairs::stable_step() const {
  const double row_sum = impl_->options.law.stiffness * std::max(1, impl_->books.most_contacts);
  return std::min(recommended_step(impl_->options.law, impl_->lightest),
                  0.25 * std::sqrt(2.0 * impl_->lightest / row_sum));
}

void SandPairs::deep_contacts(double share, std::vector<DeepContact>& contacts) const {
  const Impl& my = *impl_;
  const auto count = static_cast<int>(my.blocks.size());
  std::vector<std::vector<DeepContact>> found(my.blocks.size());
  const double shallow = (1.0 - share) * 2.0 * my.smallest_radius;  // overlaps below are outside of every core
#pragma omp parallel for schedule(dynamic, 1) num_threads(my.options.threads)
  for (int b = 0; b < count; ++b) {
    const auto block = static_cast<std::size_t>(b);
    if (my.block_overlap[block] > shallow) my.deep_in_block(my.blocks[block], share, found[block]);
  }
  contacts.clear();
  for (const auto& part : found) contacts.insert(contacts.end(), part.begin(), part.end());
}

void SandPairs::set_box(const Vec3& box) {
  impl_->box = box;
}

SandPairsMemory SandPairs::memory(const SandState& sand) const {
  const Impl& my = *impl_;
  SandPairsMemory memory{std::vector<Vec3>(sand.size()),
                         stretched_springs(my.blocks, my.id),
                         my.books,
                         my.skin,
                         my.calls_since_list,
                         my.mirror_force};
  for (std::size_t i = 0; i < my.id.size(); ++i) memory.list_position[my.cells.order()[i]] = my.list_position[i];
  return memory;
}

void SandPairs::restore(const SandState& sand, const SandPairsMemory& memory) {
  Impl& my = *impl_;
  my = Impl(my.options);
  my.measure(sand);
  my.skin = memory.skin;
  my.old_box = my.box;
  my.make_lists(sand, memory.list_position, std::vector<Vec3>(sand.size()));
  my.history.collect(memory.springs, my.id);
  std::vector<std::uint32_t> same(my.id.size());
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<std::uint32_t>(i);
  my.history.apply(my.blocks, same, my.options.threads);
  my.history.finish();
  for (std::size_t i = 0; i < my.id.size(); ++i) {
    const Vec3 x = sand.position[my.cells.order()[i]];
    my.grains[i].x = x.x, my.grains[i].y = x.y, my.grains[i].z = x.z;
  }
  my.books = memory.books, my.calls_since_list = memory.calls_since_list, my.mirror_force = memory.mirror_force;
}

}  // namespace standoff::particles
