#pragma once
// Definition behind batch_kernels.hpp; included only by the files that instantiate it.
#include "structure_solver/step/batch_kernels.hpp"

namespace standoff::structure {

template <class Law>
BatchSums batch_kernel(const MetalParameters& metal, const BoxGeometry& geometry, const PointStep& step, bool commit,
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
  const ElementSums<Pack4> sums = hex64_force<Law>(metal, geometry, step, commit, local, history, out);
  BatchSums result{};
  for (int i = 0; i < 4; ++i) {
    result.elastic[i] = lane(sums.elastic, i);
    result.inelastic[i] = lane(sums.inelastic, i);
    result.sound |= static_cast<unsigned>(lane(sums.sound, i)) << i;
  }
  return result;
}

template <class Law>
KernelChoice choice_of() {
  return {
      &batch_kernel<Law>,
      {Law::fields, Law::strain_field, Law::temperature_field, Law::static_stress_field, Law::x_field, Law::expansion}};
}

template <Hardening Hard, RateLaw Rate>
KernelChoice choose_kernel_with(const MetalEffects& e) {
  if (!e.heating) return choice_of<Metal<Hard, Rate, false, false>>();
  return e.expansion ? choice_of<Metal<Hard, Rate, true, true>>() : choice_of<Metal<Hard, Rate, true, false>>();
}

template <RateLaw Rate>
KernelChoice choose_kernel_with_rate(const MetalEffects& e) {
  switch (e.hardening) {
    case Hardening::power:
      return choose_kernel_with<Hardening::power, Rate>(e);
    case Hardening::table:
      return choose_kernel_with<Hardening::table, Rate>(e);
    case Hardening::none:
      break;
  }
  return choose_kernel_with<Hardening::none, Rate>(e);
}

}  // namespace standoff::structure
