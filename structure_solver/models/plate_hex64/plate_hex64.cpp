#include "structure_solver/models/plate_hex64/plate_hex64.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/base/stop.hpp"
#include "structure_solver/mesh/surface_inertia.hpp"

namespace standoff::structure {
namespace {

constexpr double strain_rate_interval = 10e-6;  // s, the contract's definition of max_strain_rate

/// Longitudinal wave through the thickness, m/s.
double wave_speed(const MaterialSpec& m) {
  const double nu = m.poissons_ratio;
  return std::sqrt(m.youngs_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu) * m.density));
}

}  // namespace

/// How long a hit is answered by the masses alone: the window, where it is known before the run.
double PlateHex64::answer_time(const CaseSpec& spec) const {
  if (spec.coupling.window_rule == CouplingSpec::Window::structure_step) return plate_.stable_step();
  if (spec.coupling.window_rule == CouplingSpec::Window::fixed) return spec.coupling.window;
  return spec.run.until;
}

PlateHex64::PlateHex64(const CaseSpec& spec, int threads)
    : PlateHex64(make_plate_mesh(mesh_options(spec)), spec, threads) {}

PlateHex64::PlateHex64(PlateMesh mesh, const CaseSpec& spec, int threads)
    : plate_(std::move(mesh), spec, threads),
      map_(plate_.mesh()),
      probes_(plate_.mesh()),
      relaxation_(plate_, probes_),
      external_force_(timers_.add("external_force")),
      internal_force_(timers_.add("internal_force")),
      integrate_(timers_.add("integrate")) {
  map_.show_inertia(surface_inertia(plate_.mesh(), wave_speed(spec.plate.material), answer_time(spec)));
  if (metal_effects(spec).rate != RateLaw::none)
    strain_mark_.assign(static_cast<std::size_t>(plate_.mesh().element_count() * plate_.forces().points()), 0.0);
}

void PlateHex64::surface_motion(SurfaceMotion& motion) const {
  const std::vector<Vec3>& rest = surface().position;
  motion.position.resize(rest.size());
  motion.velocity.resize(rest.size());
  map_.to_surface(plate_.state().u, motion.position);
  map_.to_surface(plate_.state().v, motion.velocity);
  for (std::size_t i = 0; i < rest.size(); ++i) motion.position[i] += rest[i];
}

void PlateHex64::set_surface_force(std::span<const Vec3> force) {
  if (force.size() != surface().position.size())
    throw Stop(ExitCode::participant_lost, "structure: the load has " + std::to_string(force.size()) +
                                               " forces, the plate surface has " +
                                               std::to_string(surface().position.size()) +
                                               " nodes\n  both sides must use the surface of the handshake");
  timers_.time(external_force_, [&] { map_.to_nodes(force, plate_.external()); });
}

void PlateHex64::step(double dt) {
  timers_.time(integrate_, [&] { plate_.kick_and_drift_nodes(dt); });
  timers_.time(internal_force_, [&] { plate_.update_elements(dt); });
  timers_.time(integrate_, [&] { plate_.kick_nodes(dt); });
  if (!strain_mark_.empty() && plate_.time() >= mark_time_ + strain_rate_interval - 0.5 * dt) watch_strain_rate();
}

void PlateHex64::watch_strain_rate() {
  const double interval = plate_.time() - mark_time_;
  double largest = 0.0;
  const auto points = static_cast<std::size_t>(plate_.forces().points());
  for (std::size_t i = 0; i < strain_mark_.size(); ++i) {
    const double now = plate_.forces().plastic_strain(static_cast<long>(i / points), static_cast<int>(i % points));
    largest = std::max(largest, now - strain_mark_[i]);
    strain_mark_[i] = now;
  }
  max_strain_rate_ = std::max(max_strain_rate_, largest / interval);
  mark_time_ = plate_.time();
}

StructureLedger PlateHex64::ledger() const {
  const NodalState& s = plate_.state();
  const PlateBooks& books = plate_.books();
  StructureLedger ledger;
  for (std::size_t i = 0; i < s.v.size(); ++i) {
    ledger.kinetic += 0.5 * s.mass[i] * squared_norm(s.v[i]);
    ledger.momentum += s.mass[i] * s.v[i];
  }
  ledger.elastic = plate_.elastic();
  ledger.plastic = books.inelastic_work;
  ledger.damping = books.damping;
  ledger.external_work = books.external_work;
  ledger.impulse_received = books.received;
  ledger.impulse_of_supports = books.of_supports;
  return ledger;
}

StructureExtremes PlateHex64::extremes() const {
  StructureExtremes x = probes_.extremes(plate_.forces());
  x.max_strain_rate = max_strain_rate_;
  return x;
}

double PlateHex64::mass() const {
  double sum = 0.0;
  for (const double m : plate_.state().mass) sum += m;
  return sum;
}

void PlateHex64::add_to(StateHash& hash) const {
  hash.add(std::span<const Vec3>(plate_.state().u));
  hash.add(std::span<const Vec3>(plate_.state().v));
  plate_.forces().add_to(hash);
}

}  // namespace standoff::structure
