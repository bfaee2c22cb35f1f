#include "particle_solver/step/gas_drift.hpp"

namespace standoff::particles {

void gas_drift(GasState& gas, SandState* sand, SurfaceSheet* sheet, double h) {
  if (gas.all_released()) {
    for (std::size_t i = 0; i < gas.size(); ++i) gas.position[i] += gas.velocity[i] * h;
  } else {
    for (std::size_t i = 0; i < gas.size(); ++i)
      if (gas.released[i] != 0) gas.position[i] += gas.velocity[i] * h;
  }
  if (sand != nullptr)
    for (std::size_t i = 0; i < sand->size(); ++i) sand->position[i] += sand->velocity[i] * h;
  if (sheet != nullptr) sheet->drift(h);
}

}  // namespace standoff::particles
