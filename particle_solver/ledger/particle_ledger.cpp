#include "particle_solver/ledger/particle_ledger.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::particles {

double ParticleLedger::observe(const ParticleEnergy& energy) {
  const double scale = initial_energy_ + std::max(0.0, energy.inflow);
  const double error = scale > 0.0 ? std::abs(energy.total() - initial_energy_) / scale : 0.0;
  if (!(error <= energy_error_)) energy_error_ = error;  // a book that is not a number is the worst of all
  return error;
}

}  // namespace standoff::particles
