#pragma once
// Definition behind batch_kernels.hpp; included only by the files that instantiate it.
#include "structure_solver/step/batch_kernels.hpp"
#include "structure_solver/step/hex8_force.hpp"

namespace standoff::structure {

template <int N, class Law, bool Curved>
BatchSums batch_kernel(const MetalParameters& metal, const BatchShape& shape, const PointStep& step, bool commit,
                       const Vec3* u, const std::int32_t* nodes, Pack4* history, Pack4* alpha, Pack4* force) {
  constexpr int count = N * N * N;
  Pack4 local[3][count];
  for (int a = 0; a < count; ++a) {
    const std::int32_t* n = nodes + 4 * a;
    const Vec3 &p = u[n[0]], &q = u[n[1]], &r = u[n[2]], &s = u[n[3]];
    local[0][a] = Pack4(Pack4::Raw{p.x, q.x, r.x, s.x});
    local[1][a] = Pack4(Pack4::Raw{p.y, q.y, r.y, s.y});
    local[2][a] = Pack4(Pack4::Raw{p.z, q.z, r.z, s.z});
  }
  auto& out = *reinterpret_cast<Pack4(*)[3][count]>(force);
  ElementSums<Pack4> sums;
  static_assert(N == 4 || !Curved, "only pipe_hex64 is curved");
  if constexpr (N == 2) {
    sums = hex8_force<Law>(metal, BoxGeometryOf<2>::of_box(shape.box), step, commit, local, history, *alpha, out);
  } else if constexpr (Curved) {
    turn(shape.cosine, shape.sine, local);
    sums = hex_force<Law>(metal, *shape.curved, step, commit, local, history, out);
    turn(shape.cosine, -shape.sine, out);
  } else {
    sums = hex_force<Law>(metal, BoxGeometryOf<N>::of_box(shape.box), step, commit, local, history, out);
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
KernelChoice choice_of(ElementKind kind) {
  const BatchKernel kernel = kind.curved                ? &batch_kernel<4, Law, true>
                             : kind.nodes_per_edge == 2 ? &batch_kernel<2, Law, false>
                             : kind.nodes_per_edge == 3 ? &batch_kernel<3, Law, false>
                                                        : &batch_kernel<4, Law, false>;
  return {
      kernel,
      {Law::fields, Law::strain_field, Law::temperature_field, Law::static_stress_field, Law::x_field, Law::expansion}};
}

template <Hardening Hard, RateLaw Rate>
KernelChoice choose_kernel_with(const MetalEffects& e, ElementKind kind) {
  if (!e.heating) return choice_of<Metal<Hard, Rate, false, false>>(kind);
  return e.expansion ? choice_of<Metal<Hard, Rate, true, true>>(kind) : choice_of<Metal<Hard, Rate, true, false>>(kind);
}

template <RateLaw Rate>
KernelChoice choose_kernel_with_rate(const MetalEffects& e, ElementKind kind) {
  switch (e.hardening) {
    case Hardening::power:
      return choose_kernel_with<Hardening::power, Rate>(e, kind);
    case Hardening::table:
      return choose_kernel_with<Hardening::table, Rate>(e, kind);
    case Hardening::none:
      break;
  }
  return choose_kernel_with<Hardening::none, Rate>(e, kind);
}

}  // namespace standoff::structure
