#include "particle_solver/step/detonate.hpp"

#include <algorithm>

#include "particle_solver/kernels/gas_release.hpp"

namespace standoff::particles {

long detonate(GasState& gas, double time) {
  if (gas.all_released()) return 0;
  long released = 0;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    if (gas.released[i] != 0 || gas.release_time[i] > time) continue;
    const Release loose = release(gas.mass, gas.velocity[i], gas.internal_energy[i], gas.latent_impulse[i]);
    gas.velocity[i] = loose.velocity;
    gas.internal_energy[i] = loose.internal_energy;
    gas.latent_impulse[i] = {};
    gas.released[i] = 1;
    ++released;
  }
  if (std::all_of(gas.released.begin(), gas.released.end(), [](auto flag) { return flag != 0; })) {
    gas.released = {};
    gas.release_time = {};
    gas.latent_impulse = {};
  }
  return released;
}

GasTotals gas_totals(const GasState& gas) {
  GasTotals totals;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    const double kinetic = 0.5 * gas.mass * squared_norm(gas.velocity[i]);
    totals.momentum += gas.velocity[i] * gas.mass;
    if (gas.all_released() || gas.released[i] != 0) {
      totals.kinetic += kinetic;
      totals.internal += gas.internal_energy[i];
    } else {
      totals.momentum += gas.latent_impulse[i];
      totals.waiting += kinetic + gas.internal_energy[i];
    }
  }
  return totals;
}

}  // namespace standoff::particles
