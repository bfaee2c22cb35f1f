#include "particle_solver/effects/particle_effect.hpp"

namespace standoff::particles {

using Make = std::unique_ptr<ParticleEffect> (*)(const CaseSpec&, int threads);
std::unique_ptr<ParticleEffect> make_air_drag(const CaseSpec& spec, int threads);

namespace {

struct Entry {
  const char* name;
  Make make;
};
constexpr Entry entries[] = {
    {"air_drag", make_air_drag},
};

}  // namespace

std::vector<std::unique_ptr<ParticleEffect>> particle_effects(const CaseSpec& spec, int threads) {
  std::vector<std::unique_ptr<ParticleEffect>> list;
  for (const Entry& entry : entries)
    if (spec.effect(entry.name)) list.push_back(entry.make(spec, threads));
  return list;
}

}  // namespace standoff::particles
