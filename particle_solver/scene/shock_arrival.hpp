#pragma once
// When the shock reaches the outer surface of the sand: the first time the mass-mean radial velocity of the grains that
// began within two diameters of that surface exceeds 5 % of its later maximum (run.json results.shock_arrival_...).
#include <cstdint>
#include <vector>

#include "coupling/case/soil_body.hpp"
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

class ShockArrival {
 public:
  /// Marks the outermost grains of `body`; velocities are radial from the charge `centre` [m].
  ShockArrival(const SandState& sand, const Vec3& centre, const SoilBody& body);
  /// Notes the mean radial velocity at `time`; kept until the maximum is past.
  void observe(const SandState& sand, double time);
  /// Time of arrival [s], or NaN if nothing moved yet.
  double time() const;
  /// The marks are those of the constructor.
  template <class Archive>
  void archive(Archive& a) {
    a(times_, velocities_, highest_);
  }

 private:
  Vec3 centre_;
  std::vector<std::uint8_t> outermost_;  // by grain id
  std::vector<double> times_, velocities_;
  double highest_ = 0.0;
};

}  // namespace standoff::particles
