#pragma once
// Energy and momentum of the simulated particles: what is in them now, what has left, and whether it adds up.
// Everything is in SI and for the simulated part; results for the full domain are multiplied by the copies when they
// leave.
#include "coupling/base/vec3.hpp"

namespace standoff::particles {

/// One reading of the books, J. Columns of absent media stay zero and are not reported.
struct ParticleEnergy {
  double air_kinetic = 0.0, air_internal = 0.0;
  double gas_kinetic = 0.0, gas_internal = 0.0, sand_kinetic = 0.0, sand_elastic = 0.0;
  double sand_rotation = 0.0;
  double friction_loss = 0.0, damping_loss = 0.0, contact_loss = 0.0;  // since the start; contact: grains on the plate
  double effect_loss = 0.0;                                            // taken by stages of effects, effects/
  double escaped_gas = 0.0, escaped_sand = 0.0, escaped_air = 0.0;     // carried out of the domain, springs included
  double work_to_structure = 0.0;                                      // done on the plate
  double inflow = 0.0;  // brought in by ambient air, work of its pressure on the rear of the plate included
  double escaped() const { return escaped_gas + escaped_sand + escaped_air; }
  double total() const {
    return air_kinetic + air_internal + gas_kinetic + gas_internal + sand_kinetic + sand_elastic + sand_rotation +
           friction_loss + damping_loss + contact_loss + effect_loss + escaped() + work_to_structure - inflow;
  }
};

/// Compares every reading with the first.
class ParticleLedger {
 public:
  void open(const ParticleEnergy& energy, const Vec3& momentum) {
    initial_energy_ = energy.total();
    initial_momentum_ = momentum;
  }
  /// Books one reading; returns |balance| over (initial energy + inflow) of this one.
  double observe(const ParticleEnergy& energy);
  /// Largest so far: run.json conservation.energy_error_particles.
  double energy_error() const { return energy_error_; }
  double initial_energy() const { return initial_energy_; }
  const Vec3& initial_momentum() const { return initial_momentum_; }

 private:
  double initial_energy_ = 0.0, energy_error_ = 0.0;
  Vec3 initial_momentum_;
};

}  // namespace standoff::particles
