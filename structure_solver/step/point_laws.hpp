#pragma once
// The metal of a scene: compiled once for every combination of effects and chosen once, before the time loop: an effect
// that is off has no instruction and no memory in it. Elements know it as a function pointer.
#include "structure_solver/step/gauss_points.hpp"

namespace standoff::structure {

/// Which effects the scene calls for.
struct MetalEffects {
  bool plasticity = true;
  Hardening hardening = Hardening::power;
  RateLaw rate = RateLaw::power;
  bool heating = true, expansion = true;
};

/// Where a field lies in the history of a Gauss point; -1 is absent. And whether temperature strains.
struct HistoryLayout {
  int fields = 0, strain = -1, temperature = -1, static_stress = -1, x = -1;
  bool expansion = false;
};

template <class Law>
inline constexpr HistoryLayout layout_of{
    Law::fields, Law::strain_field, Law::temperature_field, Law::static_stress_field, Law::x_field, Law::expansion};

/// update_points for four elements side by side.
using PointUpdate = ElementSums<Pack4> (*)(const MetalParameters&, const PointStep&, bool commit, int points,
                                           const double* weight, Pack4* gradient, Pack4* history);

struct PointLaw {
  PointUpdate update = nullptr;
  HistoryLayout layout;
};

/// Lanes of one register: two Gauss points of four elements in AVX-512, else one point. The bits are the same.
enum class Width { four_lanes, eight_lanes };
Width widest_here();
PointLaw choose_point_law(const MetalEffects& effects, Width width);

/// pick.template operator()<Metal<...>>() of the effects, for one law of the rate.
template <Hardening Hard, RateLaw Rate, class Pick>
auto with_heat(const MetalEffects& e, Pick pick) {
  if (!e.heating) return pick.template operator()<Metal<Hard, Rate, false, false>>();
  return e.expansion ? pick.template operator()<Metal<Hard, Rate, true, true>>()
                     : pick.template operator()<Metal<Hard, Rate, true, false>>();
}
template <RateLaw Rate, class Pick>
auto with_metal(const MetalEffects& e, Pick pick) {
  if (e.hardening == Hardening::power) return with_heat<Hardening::power, Rate>(e, pick);
  if (e.hardening == Hardening::table) return with_heat<Hardening::table, Rate>(e, pick);
  return with_heat<Hardening::none, Rate>(e, pick);
}

/// One rate law a file, so that they compile side by side.
template <RateLaw Rate>
PointLaw four_lane_law(const MetalEffects& effects);
template <RateLaw Rate>
PointUpdate eight_lane_update(const MetalEffects& effects);

}  // namespace standoff::structure
