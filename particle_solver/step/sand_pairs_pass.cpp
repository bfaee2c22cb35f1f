#include "particle_solver/step/sand_pairs_pass.hpp"

namespace standoff::particles {

namespace {

template <bool... Chosen>
RunBlock choose_rest() {
  return &run_block<Chosen...>;
}
/// Turns run-time switches into template arguments, one after the other.
template <bool... Chosen, class... Rest>
RunBlock choose_rest(bool next, Rest... rest) {
  return next ? choose_rest<Chosen..., true>(rest...) : choose_rest<Chosen..., false>(rest...);
}

}  // namespace

RunBlock choose_pass(bool friction, bool damping, bool radii, bool periodic, bool turning) {
  return choose_rest<>(friction, damping, radii, periodic, turning);
}

PassSums run_mirrors(const PassInput& in, const GrainBlock& block, PassScratch& scratch) {
  PassSums sums;
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    const GrainRecord& grain = in.grains[i];
    if (grain.x >= grain.w && grain.y >= grain.w) continue;
    const GrainRecord& move = in.moves[i];
    GrainRecord& force = scratch.force[i - block.begin];
    const double dashpot = in.law.damping > 0.0 ? dashpot_over_step(in.law, 2.0 * move.w, in.dt) : 0.0;
    const auto touch = [&](double height, double approach, double& force_component, double& plane_component) {
      const MirrorContact contact = mirror_contact(in.law, height, grain.w, approach, dashpot);
      if (height >= grain.w) return;
      force_component += contact.force, plane_component -= contact.force;
      force.w += 1.0;
      sums.elastic += contact.elastic, sums.damping_loss += contact.damping_loss;
      sums.largest_overlap = larger(sums.largest_overlap, 2.0 * (grain.w - height));
    };
    touch(grain.x, -move.x, force.x, sums.mirror_force.x);
    touch(grain.y, -move.y, force.y, sums.mirror_force.y);
  }
  return sums;
}

}  // namespace standoff::particles
