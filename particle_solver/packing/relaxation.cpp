#include "particle_solver/packing/relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::particles {

namespace {

void hold(const BodyBounds& bounds, SandState& grains) {
  for (Vec3& p : grains.position)
    if (bounds.body.beyond(p) > bounds.play) p = bounds.body.held(p, bounds.play);
}

/// One FIRE minimisation with unit masses; see the header for the equations.
class Fire {
 public:
  /// Turns velocities towards the forces, or stops them where they climb.
  void steer(SandState& grains) {
    double power = 0.0, speed2 = 0.0, force2 = 0.0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      power += dot(grains.force[i], grains.velocity[i]);
      speed2 += squared_norm(grains.velocity[i]), force2 += squared_norm(grains.force[i]);
    }
    if (power > 0.0) {
      const double towards = mixing_ * std::sqrt(speed2 / force2);
      for (std::size_t i = 0; i < grains.size(); ++i) {
        const bool touched = grains.force[i] != Vec3{};  // a grain that came free stops, or it would fly off
        grains.velocity[i] = (touched ? 1.0 - mixing_ : 0.0) * grains.velocity[i] + towards * grains.force[i];
      }
      if (++downhill_ > 5) step_ = std::min(1.1 * step_, longest_), mixing_ *= 0.99;
    } else {
      std::fill(grains.velocity.begin(), grains.velocity.end(), Vec3{});
      step_ = std::max(0.5 * step_, shortest_), mixing_ = 0.1, downhill_ = 0;
    }
  }
  /// Semi-implicit Euler; a grain that starts deep inside another is not thrown across the cell.
  void move(SandState& grains) const {
    const double farthest = 0.1 * grains.radius;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      grains.velocity[i] += step_ * grains.force[i];
      const Vec3 by = step_ * grains.velocity[i];
      const double length = norm(by);
      grains.position[i] += (length > farthest ? farthest / length : 1.0) * by;
    }
  }

 private:
  static constexpr double longest_ = 0.35, shortest_ = 0.02;
  double step_ = 0.1, mixing_ = 0.1;
  int downhill_ = 0;
};

}  // namespace

RelaxResult relax_overlaps(SandState& grains, SandPairs& pairs, const RelaxOptions& options) {
  RelaxResult result;
  Fire fire;
  const double diameter = 2.0 * grains.radius;
  pairs.forces(grains, 0.0);
  for (;; ++result.iterations) {
    const SandBooks& books = pairs.books();
    result.overlap = books.overlap_over_radius * 0.5;
    result.free = result.overlap <= options.overlap;
    // With k = 1 the root mean square contact force is sqrt(2 E / contacts).
    const double contacts = 0.5 * books.coordination * static_cast<double>(grains.size());
    const double typical = contacts > 0.0 ? std::sqrt(2.0 * books.elastic_energy / contacts) : diameter;
    double largest = 0.0;
    for (const Vec3& f : grains.force) largest = std::max(largest, squared_norm(f));
    result.balance = std::sqrt(largest) / typical;
    if (result.free || result.balance < options.balance || result.iterations == options.most_iterations) break;
    fire.steer(grains);
    fire.move(grains);
    if (options.bounds) hold(*options.bounds, grains);
    pairs.forces(grains, 0.0);
  }
  std::fill(grains.velocity.begin(), grains.velocity.end(), Vec3{});
  std::fill(grains.force.begin(), grains.force.end(), Vec3{});
  return result;
}

}  // namespace standoff::particles
