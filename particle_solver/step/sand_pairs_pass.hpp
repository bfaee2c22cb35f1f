#pragma once
// The inner loop of sand_pairs: the law of grain_contact.hpp over the pair lists of one block, four pairs at a time.
// What a scene does not have (friction, damping, different radii, periodic box) is compiled out.
#include <span>

#include "particle_solver/kernels/grain_contact.hpp"
#include "particle_solver/search/grain_pairs.hpp"

namespace standoff::particles {

/// What all pairs share in one call.
struct PassInput {
  GrainLaw law;
  const GrainRecord* grains = nullptr;  // x, y, z, radius; sorted, one more far away
  const GrainRecord* moves = nullptr;   // displacement since the last call and 1/mass
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

/// Differences between the records of i and j, as components. `Sum`: the fourth component is the sum of the fourth
/// numbers.
template <bool Sum>
inline void pair_difference(const GrainRecord* records, const GrainPair* pairs, Lanes& x, Lanes& y, Lanes& z,
                            Lanes& w) {
  const auto difference = [&](int lane) {
    const Lanes other = load(records[pairs[lane].j]);
    return load(records[pairs[lane].i]) - (Sum ? flip_fourth(other) : other);
  };
  x = difference(0), y = difference(1), z = difference(2), w = difference(3);
  transpose(x, y, z, w);
}

/// Adds forces to i and, inside a block, their opposite to j. The fourth number counts contacts for both.
template <bool Rim>
inline void scatter(const Triple<Lanes>& force, Lanes touching, const GrainPair* pairs, std::size_t used,
                    std::uint32_t begin, GrainRecord* block_force) {
  Lanes a = force.x, b = force.y, c = force.z, d = touching;
  transpose(a, b, c, d);
  const auto one = [&](Lanes f, const GrainPair& pair) {
    GrainRecord& i = block_force[pair.i - begin];
    store(i, load(i) + f);
    if constexpr (!Rim) {
      GrainRecord& j = block_force[pair.j - begin];
      store(j, load(j) - flip_fourth(f));
    }
  };
  one(a, pairs[0]);
  if (used > 1) one(b, pairs[1]);
  if (used > 2) one(c, pairs[2]);
  if (used > 3) one(d, pairs[3]);
}

template <bool Friction, bool Damping, bool Radii, bool Periodic, bool Rim>
PassSums run_list(const PassInput& in, PairList& list, std::uint32_t begin, GrainRecord* block_force) {
  const Lanes zero{};
  Lanes elastic{}, friction_loss{}, damping_loss{}, largest{}, virial_x{}, virial_y{}, virial_z{};
  const std::size_t groups = list.groups();
  for (std::size_t g = 0; g < groups; ++g) {
    const GrainPair* pairs = &list.pairs[4 * g];
    GrainPairInput<Lanes> pair;
    Triple<Lanes>& d = pair.separation;
    pair_difference<Radii>(in.grains, pairs, d.x, d.y, d.z, pair.reach);
    if constexpr (!Radii) pair.reach = all_lanes(in.reach);
    Triple<Lanes> image{};
    if constexpr (Periodic) {
      for (std::size_t lane = list.count - 4 * g; lane < 4; ++lane)
        pair.reach[lane] = 0.0;  // every image is near: no filling
      image = {nearest_integer(d.x * in.per_box.x), nearest_integer(d.y * in.per_box.y),
               nearest_integer(d.z * in.per_box.z)};
      d = {d.x - image.x * in.box.x, d.y - image.y * in.box.y, d.z - image.z * in.box.z};
    }
    const auto touching = dot(d, d) < pair.reach * pair.reach;
    if (!any(touching) && !(Friction && list.stretched[g])) continue;

    if constexpr (Friction || Damping) {
      Triple<Lanes>& s = pair.slip;
      Lanes inverse_masses;
      pair_difference<Radii>(in.moves, pairs, s.x, s.y, s.z, inverse_masses);
      if constexpr (Periodic)
        s = {s.x - image.x * in.box_change.x, s.y - image.y * in.box_change.y, s.z - image.z * in.box_change.z};
      if constexpr (Damping)
        pair.dashpot_per_step =
            Radii ? dashpot_over_step(in.law, inverse_masses, in.dt) : all_lanes(in.dashpot_per_step);
    }
    if constexpr (Friction) {
      const SpringGroup& old = list.springs[g];
      pair.spring = {load(old.x.data()), load(old.y.data()), load(old.z.data())};
    }
    const GrainContact<Lanes> contact = grain_contact<Friction, Damping>(in.law, pair);
    if constexpr (Friction) {
      SpringGroup& fresh = list.springs[g];
      store(fresh.x.data(), contact.spring.x), store(fresh.y.data(), contact.spring.y);
      store(fresh.z.data(), contact.spring.z);
      list.stretched[g] = any(touching);
      friction_loss += contact.friction_loss;
    }
    if constexpr (Damping) damping_loss += contact.damping_loss;
    if constexpr (Periodic)
      virial_x += contact.force.x * d.x, virial_y += contact.force.y * d.y, virial_z += contact.force.z * d.z;
    elastic += contact.elastic;
    largest = larger(largest, contact.overlap);
    scatter<Rim>(contact.force, choose(touching, zero + 1.0, zero), pairs, list.count - 4 * g, begin, block_force);
  }
  PassSums sums{lane_sum(elastic), lane_sum(friction_loss), lane_sum(damping_loss), lane_largest(largest), {}, {}};
  if constexpr (Periodic) sums.virial = {lane_sum(virial_x), lane_sum(virial_y), lane_sum(virial_z)};
  return sums;
}

/// Both lists of a block. A rim pair is seen by two blocks, half of its energies each.
template <bool Friction, bool Damping, bool Radii, bool Periodic>
PassSums run_block(const PassInput& in, GrainBlock& block, GrainRecord* block_force) {
  PassSums sums = run_list<Friction, Damping, Radii, Periodic, false>(in, block.inner, block.begin, block_force);
  sums.add(run_list<Friction, Damping, Radii, Periodic, true>(in, block.rim, block.begin, block_force), 0.5);
  return sums;
}

using RunBlock = PassSums (*)(const PassInput&, GrainBlock&, GrainRecord*);

/// The loop for a scene; chosen once.
RunBlock choose_pass(bool friction, bool damping, bool radii, bool periodic);

/// Contacts of a block's grains with their images in the mirror planes x = 0 and y = 0.
PassSums run_mirrors(const PassInput& in, const GrainBlock& block, GrainRecord* block_force);

}  // namespace standoff::particles
