// Stage air_drag: still air brakes the grains that fly through it.
#include "particle_solver/kernels/air_drag.hpp"

#include "particle_solver/effects/particle_effect.hpp"

namespace standoff::particles {
namespace {

constexpr double viscosity =
    1.8e-5;  // Pa s, of air at 20 C [Incropera, Fundamentals of Heat and Mass Transfer, tab. A.4]

class AirDrag final : public ParticleEffect {
 public:
  explicit AirDrag(double density) : density_(density) {}
  const char* name() const override { return "air_drag"; }

  void run(SandState& sand, double h) override {
    for (std::size_t i = 0; i < sand.size(); ++i) {
      const Vec3 before = sand.velocity[i];
      const double mass = sand.mass_of(i);
      const double left = drag_factor(norm(before), sand.radius_of(i), mass, density_, viscosity, h);
      sand.velocity[i] = before * left;
      books.loss += 0.5 * mass * squared_norm(before) * (1.0 - left * left);
      books.momentum += before * (mass * (1.0 - left));
    }
  }

 private:
  double density_;  // kg/m3
};

}  // namespace

std::unique_ptr<ParticleEffect> make_air_drag(const CaseSpec& spec, int) {
  return std::make_unique<AirDrag>(spec.air.density);
}

}  // namespace standoff::particles
