#include "particle_solver/ledger/particle_ledger.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::particles {

double ParticleLedger::observe(const ParticleEnergy& energy) {
  const double error = initial_energy_ > 0.0 ? std::abs(energy.total() - initial_energy_) / initial_energy_ : 0.0;
  energy_error_ = std::max(energy_error_, error);
  return error;
}

}  // namespace standoff::particles
