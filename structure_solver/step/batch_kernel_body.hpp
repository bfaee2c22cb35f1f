#pragma once
// Definition behind batch_kernels.hpp; included only by the files that instantiate it.
#include "structure_solver/step/batch_kernels.hpp"

namespace standoff::structure {

template <class Law, bool Curved>
BatchSums batch_kernel(const MetalParameters& metal, const BatchShape& shape, const PointStep& step, bool commit,
                       const Vec3* u, const std::int32_t* nodes, Pack4* history, Pack4* force) {
  Pack4 local[3][hex_nodes];
  for (int a = 0; a < hex_nodes; ++a) {
    const std::int32_t* n = nodes + 4 * a;
    const Vec3 &p = u[n[0]], &q = u[n[1]], &r = u[n[2]], &s = u[n[3]];
    local[0][a] = Pack4(Pack4::Raw{p.x, q.x, r.x, s.x});
    local[1][a] = Pack4(Pack4::Raw{p.y, q.y, r.y, s.y});
    local[2][a] = Pack4(Pack4::Raw{p.z, q.z, r.z, s.z});
  }
  auto& out = *reinterpret_cast<Pack4(*)[3][hex_nodes]>(force);
  ElementSums<Pack4> sums;
  if constexpr (Curved) {
    turn(shape.cosine, shape.sine, local);
    sums = hex64_force<Law>(metal, *shape.curved, step, commit, local, history, out);
    turn(shape.cosine, -shape.sine, out);
  } else {
    sums = hex64_force<Law>(metal, shape.box, step, commit, local, history, out);
  }
  BatchSums result{};
  for (int i = 0; i < 4; ++i) {
    result.elastic[i] = lane(sums.elastic, i);
    result.inelastic[i] = lane(sums.inelastic, i);
    result.sound |= static_cast<unsigned>(lane(sums.sound, i)) << i;
  }
  return result;
}

template <class Law>
KernelChoice choice_of(bool curved) {
  return {
      curved ? &batch_kernel<Law, true> : &batch_kernel<Law, false>,
      {Law::fields, Law::strain_field, Law::temperature_field, Law::static_stress_field, Law::x_field, Law::expansion}};
}

template <Hardening Hard, RateLaw Rate>
KernelChoice choose_kernel_with(const MetalEffects& e, bool curved) {
  if (!e.heating) return choice_of<Metal<Hard, Rate, false, false>>(curved);
  return e.expansion ? choice_of<Metal<Hard, Rate, true, true>>(curved)
                     : choice_of<Metal<Hard, Rate, true, false>>(curved);
}

template <RateLaw Rate>
KernelChoice choose_kernel_with_rate(const MetalEffects& e, bool curved) {
  switch (e.hardening) {
    case Hardening::power:
      return choose_kernel_with<Hardening::power, Rate>(e, curved);
    case Hardening::table:
      return choose_kernel_with<Hardening::table, Rate>(e, curved);
    case Hardening::none:
      break;
  }
  return choose_kernel_with<Hardening::none, Rate>(e, curved);
}

}  // namespace standoff::structure
