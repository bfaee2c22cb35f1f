#pragma once
// The inner loop of sand_pairs: the law of grain_contact.hpp over the pair lists of one block, four pairs at a time.
// What a scene does not have (friction, damping, different radii, periodic box, grains that turn) is compiled out.
#include <array>
#include <cstring>
#include <type_traits>
#include <vector>

#include "particle_solver/kernels/grain_contact.hpp"
#include "particle_solver/kernels/grain_rotation.hpp"
#include "particle_solver/search/grain_pairs.hpp"

namespace standoff::particles {

/// What all pairs share in one call.
struct PassInput {
  GrainLaw law;
  const GrainRecord* grains = nullptr;  // x, y, z, radius; sorted, one more far away
  const GrainRecord* moves = nullptr;   // displacement since the last call and 1/mass
  const GrainRecord* turns = nullptr;   // grains that turn: radius times rotation since the last call, m
  std::uint32_t far_away = 0;           // the one that is far away
  double reach = 0.0;                   // m, equal grains: the diameter
  double dashpot_per_step = 0.0;        // N/m, equal grains
  double dt = 0.0;                      // s
  Vec3 box, per_box, box_change;        // periodic: lengths, their inverses, change since the last call
};

/// Sums over one list. Only periodic cells sum the virial.
struct PassSums {
  double elastic = 0.0, friction_loss = 0.0, damping_loss = 0.0;  // J
  double largest_overlap = 0.0;                                   // m
  Vec3 virial;                                                    // J, sum of f_a d_a along each axis
  Vec3 mirror_force;                                              // N on the planes
  double touching = 0.0, most_touching = 0.0;                     // contacts seen from the grains; most on one grain

  void add(const PassSums& b, double share) {
    elastic += share * b.elastic, friction_loss += share * b.friction_loss, damping_loss += share * b.damping_loss;
    largest_overlap = larger(largest_overlap, b.largest_overlap);
    virial += share * b.virial, mirror_force += share * b.mirror_force;
    touching += b.touching, most_touching = larger(most_touching, b.most_touching);
  }
};

/// Memory that a thread keeps from block to block.
struct PassScratch {
  std::vector<GrainRecord> force;   // N on the block's grains; w counts contacts
  std::vector<GrainRecord> torque;  // N, torque over radius on the block's grains, if they turn
  std::vector<std::uint32_t> hits;  // slots of a list that need the law, with the two bits below
  std::vector<double> springs;
};

/// Bits of a hit beside its slot: the pair has a spring from the last call; it touches now.
inline constexpr std::uint32_t had_spring = 1u << 31, touches_now = 1u << 30, slot_bits = touches_now - 1;

using FourSlots = std::uint32_t __attribute__((vector_size(16)));
/// The bits of a group, spread to the same bit of each of its four slots.
inline constexpr auto spread_bits = [] {
  std::array<std::array<std::uint32_t, 4>, 16> table{};
  for (unsigned bits = 0; bits < 16; ++bits)
    for (unsigned lane = 0; lane < 4; ++lane) table[bits][lane] = bits >> lane & 1u;
  return table;
}();
inline FourSlots spread(unsigned bits) {
  FourSlots four;
  std::memcpy(&four, spread_bits[bits].data(), sizeof(four));
  return four;
}

inline constexpr std::size_t fetch_ahead = 8;  // groups

using FourPairs = std::array<GrainPair, 4>;

/// Differences between the records of i and j, as components. `Sum`: the fourth component is the sum of the fourth
/// numbers.
template <bool Sum>
[[gnu::always_inline]] inline void pair_difference(const GrainRecord* records, const GrainPair* pairs, Triple<Lanes>& d,
                                                   Lanes& w) {
  const auto difference = [&](int lane) {
    const Lanes other = load(records[pairs[lane].j]);
    return load(records[pairs[lane].i]) - (Sum ? flip_fourth(other) : other);
  };
  d.x = difference(0), d.y = difference(1), d.z = difference(2), w = difference(3);
  transpose(d.x, d.y, d.z, w);
}

/// Separation, reach and which periodic image is the nearest.
template <bool Radii, bool Periodic>
[[gnu::always_inline]] inline void pair_distance(const PassInput& in, const GrainPair* pairs,
                                                 GrainPairInput<Lanes>& pair, Triple<Lanes>& image) {
  Triple<Lanes>& d = pair.separation;
  pair_difference<Radii>(in.grains, pairs, d, pair.reach);
  if constexpr (!Radii) pair.reach = all_lanes(in.reach);
  if constexpr (Periodic) {
    image = {nearest_integer(d.x * in.per_box.x), nearest_integer(d.y * in.per_box.y),
             nearest_integer(d.z * in.per_box.z)};
    d = {d.x - image.x * in.box.x, d.y - image.y * in.box.y, d.z - image.z * in.box.z};
  }
}

/// The pairs of four slots; those from `used` on are the filling, which never touches.
template <class Pair>
inline FourPairs pairs_of(const PassInput& in, const PairList<Pair>& list, const std::uint32_t* slots,
                          std::size_t used) {
  const auto pair = [&](std::size_t lane) { return whole_pair(list.pairs[slots[lane] & slot_bits], 0); };
  FourPairs four{pair(0), pair(1), pair(2), pair(3)};
  for (std::size_t lane = used; lane < 4; ++lane) four[lane].j = in.far_away;
  return four;
}

/// Slots of pairs that touch or still hold a spring, in order; filled up to a multiple of four with an empty slot. Most
/// listed pairs do not touch, so the law runs over this selection. Returns their number without the filling.
template <bool Friction, bool Radii, bool Periodic, class Pair>
std::size_t select_hits(const PassInput& in, PairList<Pair>& list, std::vector<std::uint32_t>& hits) {
  if (hits.size() < list.pairs.size() + 4) hits.resize(list.pairs.size() + 4);
  std::size_t found = 0;
  for (std::size_t g = 0; g < list.groups(); ++g) {
    if (4 * (g + fetch_ahead) <
        list.pairs.size())  // the partners of later pairs are all over the block: ask for them early
      for (std::size_t lane = 0; lane < 4; ++lane)
        __builtin_prefetch(&in.grains[list.pairs[4 * (g + fetch_ahead) + lane].j]);
    const auto slot = static_cast<std::uint32_t>(4 * g);
    FourSlots slots{slot, slot + 1, slot + 2, slot + 3};
    const Pair* four = &list.pairs[4 * g];
    const FourPairs pairs{whole_pair(four[0], 0), whole_pair(four[1], 0), whole_pair(four[2], 0),
                          whole_pair(four[3], 0)};
    GrainPairInput<Lanes> pair;
    Triple<Lanes> image;
    pair_distance<Radii, Periodic>(in, pairs.data(), pair, image);
    const auto touching = dot(pair.separation, pair.separation) < pair.reach * pair.reach;
    unsigned bits = lane_bits(touching);
    if (4 * g + 4 > list.count) bits &= (1u << (list.count - 4 * g)) - 1u;  // without the filling
    if constexpr (Friction) {
      const unsigned had = list.stretched[g];
      slots |= spread(had) << 31 | spread(bits) << 30;
      list.stretched[g] = static_cast<std::uint8_t>(bits), bits |= had;
    }
    found += append_chosen(bits, reinterpret_cast<const std::uint32_t*>(&slots), &hits[found]);
  }
  for (std::size_t k = found; k % 4 != 0; ++k) hits[k] = static_cast<std::uint32_t>(list.count);
  return found;
}

/// Adds forces to i and, inside a block, their opposite to j; torques are the same for both. The fourth number counts
/// contacts for both.
template <bool Rim, bool Opposite>
[[gnu::always_inline]] inline void scatter(const Triple<Lanes>& force, Lanes touching, const FourPairs& pairs,
                                           std::size_t used, std::uint32_t begin, GrainRecord* block_force) {
  Lanes a = force.x, b = force.y, c = force.z, d = touching;
  transpose(a, b, c, d);
  const auto one = [&](Lanes f, const GrainPair& pair) __attribute__((always_inline)) {
    GrainRecord& i = block_force[pair.i - begin];
    store(i, load(i) + f);
    if constexpr (!Rim) {
      GrainRecord& j = block_force[pair.j - begin];
      store(j, Opposite ? load(j) - flip_fourth(f) : load(j) + f);
    }
  };
  one(a, pairs[0]);
  if (used > 1) one(b, pairs[1]);
  if (used > 2) one(c, pairs[2]);
  if (used > 3) one(d, pairs[3]);
}

/// Reads the springs of a list and writes the new ones, both in the order of slots. A spring is read and written with
/// the number that follows it.
template <class Pair>
class SpringStream {
 public:
  SpringStream(PairList<Pair>& list, std::vector<double>& scratch, std::size_t hits) : list_(list), fresh_(scratch) {
    if (fresh_.size() < 3 * hits + 16) fresh_.resize(3 * hits + 16);
  }
  /// The springs of four slots; zero for a pair that had none.
  [[gnu::always_inline]] Triple<Lanes> read(const std::uint32_t* slots) {
    const auto next = [&](std::uint32_t slot) {
      const bool has = slot >= had_spring;
      const Lanes spring = has ? load_anywhere(&list_.springs[read_]) : Lanes{};
      read_ += has ? 3 : 0;
      return spring;
    };
    Triple<Lanes> s;
    s.x = next(slots[0]), s.y = next(slots[1]), s.z = next(slots[2]);
    Lanes behind = next(slots[3]);
    transpose(s.x, s.y, s.z, behind);
    return s;
  }
  /// Keeps the springs of the pairs that touch.
  [[gnu::always_inline]] void write(const Triple<Lanes>& s, const std::uint32_t* slots) {
    Lanes a = s.x, b = s.y, c = s.z, d{};
    transpose(a, b, c, d);
    const auto keep = [&](Lanes spring, unsigned lane) {
      store_anywhere(&fresh_[written_], spring);
      written_ += (slots[lane] & touches_now) != 0 ? 3 : 0;
    };
    keep(a, 0), keep(b, 1), keep(c, 2), keep(d, 3);
  }
  ~SpringStream() {
    const auto first = fresh_.begin();
    list_.springs.assign(first, first + static_cast<std::ptrdiff_t>(written_) + 1);
  }
  SpringStream(const SpringStream&) = delete;
  SpringStream& operator=(const SpringStream&) = delete;

 private:
  PairList<Pair>& list_;
  std::vector<double>& fresh_;
  std::size_t read_ = 0, written_ = 0;  // numbers
};

/// Stands for SpringStream where there are none.
template <class Pair>
struct NoSprings {
  NoSprings(PairList<Pair>&, std::vector<double>&, std::size_t) {}
};

/// Displacements of four pairs against each other, and their dashpots.
template <bool Damping, bool Radii, bool Periodic>
inline void pair_motion(const PassInput& in, const GrainPair* pairs, const Triple<Lanes>& image,
                        GrainPairInput<Lanes>& pair) {
  Triple<Lanes>& s = pair.slip;
  Lanes inverse_masses;
  pair_difference<Radii>(in.moves, pairs, s, inverse_masses);
  if constexpr (Periodic)
    s = {s.x - image.x * in.box_change.x, s.y - image.y * in.box_change.y, s.z - image.z * in.box_change.z};
  if constexpr (Damping)
    pair.dashpot_per_step = Radii ? dashpot_over_step(in.law, inverse_masses, in.dt) : all_lanes(in.dashpot_per_step);
}

/// Surfaces slide by spins too.
inline void pair_turns(const PassInput& in, const GrainPair* pairs, const Lanes& per_reach,
                       GrainPairInput<Lanes>& pair) {
  const auto sum = [&](int lane) { return load(in.turns[pairs[lane].i]) + load(in.turns[pairs[lane].j]); };
  Triple<Lanes> turns{sum(0), sum(1), sum(2)};
  Lanes unused = sum(3);
  transpose(turns.x, turns.y, turns.z, unused);
  pair.slip = surface_slip(pair.slip, turns, pair.separation, per_reach);
}

template <bool Friction, bool Damping, bool Radii, bool Periodic, bool Turning, class Pair>
PassSums run_list(PassInput in, PairList<Pair>& list, std::uint32_t begin, PassScratch& scratch) {
  constexpr bool Rim = std::is_same_v<Pair, GrainPair>;
  if constexpr (!Rim && Turning) in.turns += begin;
  if constexpr (!Rim) in.grains += begin, in.moves += begin, in.far_away -= begin, begin = 0;
  const Lanes zero{};
  Lanes elastic{}, friction_loss{}, damping_loss{}, largest{}, virial_x{}, virial_y{}, virial_z{};
  const std::size_t hits = select_hits<Friction, Radii, Periodic>(in, list, scratch.hits);
  std::conditional_t<Friction, SpringStream<Pair>, NoSprings<Pair>> springs(list, scratch.springs, hits);
  for (std::size_t h = 0; h < hits; h += 4) {
    const std::uint32_t* slots = &scratch.hits[h];
    if constexpr (Friction || Damping)
      if (h + 4 * fetch_ahead + 4 <= hits)
        for (std::size_t lane = 0; lane < 4; ++lane)
          __builtin_prefetch(&in.moves[list.pairs[slots[4 * fetch_ahead + lane] & slot_bits].j]);
    const FourPairs pairs = pairs_of(in, list, slots, hits - h);
    GrainPairInput<Lanes> pair;
    Triple<Lanes> image{};
    pair_distance<Radii, Periodic>(in, pairs.data(), pair, image);
    const Lanes per_reach = Turning ? 1.0 / pair.reach : zero;
    if constexpr (Periodic)
      for (std::size_t lane = hits - h; lane < 4; ++lane) pair.reach[lane] = 0.0;  // the filling
    if constexpr (Friction || Damping) pair_motion<Damping, Radii, Periodic>(in, pairs.data(), image, pair);
    if constexpr (Turning) pair_turns(in, pairs.data(), per_reach, pair);
    if constexpr (Friction) pair.spring = springs.read(slots);
    const GrainContact<Lanes> contact = grain_contact<Friction, Damping>(in.law, pair);
    const auto touching = contact.overlap > zero;
    if constexpr (Friction) springs.write(contact.spring, slots);
    if constexpr (Friction) friction_loss += contact.friction_loss;
    if constexpr (Damping) damping_loss += contact.damping_loss;
    if constexpr (Periodic) {
      const Triple<Lanes>& d = pair.separation;
      virial_x += contact.force.x * d.x, virial_y += contact.force.y * d.y, virial_z += contact.force.z * d.z;
    }
    elastic += contact.elastic;
    largest = larger(largest, contact.overlap);
    scatter<Rim, true>(contact.force, choose(touching, zero + 1.0, zero), pairs, hits - h, begin, scratch.force.data());
    if constexpr (Turning)
      scatter<Rim, false>(torque_over_radius(contact.force, pair.separation, per_reach), zero, pairs, hits - h, begin,
                          scratch.torque.data());
  }
  PassSums sums{lane_sum(elastic), lane_sum(friction_loss), lane_sum(damping_loss), lane_largest(largest), {}, {}};
  if constexpr (Periodic) sums.virial = {lane_sum(virial_x), lane_sum(virial_y), lane_sum(virial_z)};
  return sums;
}

/// Both lists of a block. A rim pair is seen by two blocks, half of its energies each.
template <bool Friction, bool Damping, bool Radii, bool Periodic, bool MayTurn>
PassSums run_block(const PassInput& in, GrainBlock& block, PassScratch& scratch) {
  constexpr bool Turning = MayTurn && Friction;  // normal forces turn nothing
  PassSums sums = run_list<Friction, Damping, Radii, Periodic, Turning>(in, block.inner, block.begin, scratch);
  sums.add(run_list<Friction, Damping, Radii, Periodic, Turning>(in, block.rim, block.begin, scratch), 0.5);
  return sums;
}

using RunBlock = PassSums (*)(const PassInput&, GrainBlock&, PassScratch&);

/// The loop for a scene; chosen once.
RunBlock choose_pass(bool friction, bool damping, bool radii, bool periodic, bool turning);

/// Contacts of a block's grains with their images in the mirror planes x = 0 and y = 0.
PassSums run_mirrors(const PassInput& in, const GrainBlock& block, PassScratch& scratch);

}  // namespace standoff::particles
