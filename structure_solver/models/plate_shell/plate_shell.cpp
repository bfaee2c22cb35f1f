#include "structure_solver/models/plate_shell/plate_shell.hpp"

#include <algorithm>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {
namespace {

constexpr double strain_rate_interval = 10e-6;  // s, the contract's definition of max_strain_rate
constexpr double held_factor = 1e6;             // a held node does not answer a hit

/// The nodes are the surface: N = 1, and each answers with its own mass, at once through the whole thickness.
SurfaceMesh surface_of(const ShellMesh& mesh) {
  SurfaceMesh surface{mesh.position, mesh.quads, mesh.mass};
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    if (mesh.fixed[i] & fixed_z) surface.node_mass[i] *= held_factor;
  return surface;
}

}  // namespace

PlateShell::PlateShell(const CaseSpec& spec, int threads)
    : plate_(spec, threads),
      surface_(surface_of(plate_.mesh())),
      probes_(plate_.mesh()),
      relaxation_(plate_, probes_),
      external_force_(timers_.add("external_force")),
      internal_force_(timers_.add("internal_force")),
      integrate_(timers_.add("integrate")) {
  if (metal_effects(spec).rate != RateLaw::none)
    strain_mark_.assign(plate_.mesh().quads.size() * shell_material_points, 0.0);
}

void PlateShell::surface_motion(SurfaceMotion& motion) const {
  motion.position = plate_.translation().u;
  motion.velocity = plate_.translation().v;
  for (std::size_t i = 0; i < motion.position.size(); ++i) motion.position[i] += surface_.position[i];
}

void PlateShell::set_surface_force(std::span<const Vec3> force) {
  if (force.size() != surface_.position.size())
    throw Stop(ExitCode::participant_lost, "structure: the load has " + std::to_string(force.size()) +
                                               " forces, the plate surface has " +
                                               std::to_string(surface_.position.size()) +
                                               " nodes\n  both sides must use the surface of the handshake");
  timers_.time(external_force_, [&] { std::copy(force.begin(), force.end(), plate_.external().begin()); });
}

void PlateShell::step(double dt) {
  timers_.time(integrate_, [&] { plate_.kick_and_drift_nodes(dt); });
  timers_.time(internal_force_, [&] { plate_.update_elements(dt); });
  timers_.time(integrate_, [&] { plate_.kick_nodes(dt); });
  if (!strain_mark_.empty() && plate_.time() >= mark_time_ + strain_rate_interval - 0.5 * dt) watch_strain_rate();
}

void PlateShell::watch_strain_rate() {
  const double interval = plate_.time() - mark_time_;
  double largest = 0.0;
  for (std::size_t i = 0; i < strain_mark_.size(); ++i) {
    const double now =
        plate_.forces().plastic_strain(i / shell_material_points, static_cast<int>(i % shell_material_points));
    largest = std::max(largest, now - strain_mark_[i]);
    strain_mark_[i] = now;
  }
  max_strain_rate_ = std::max(max_strain_rate_, largest / interval);
  mark_time_ = plate_.time();
}

StructureLedger PlateShell::ledger() const {
  const PlateBooks& books = plate_.books();
  const NodalState& s = plate_.translation();
  StructureLedger ledger;
  for (std::size_t i = 0; i < s.v.size(); ++i) ledger.momentum += s.mass[i] * s.v[i];
  ledger.kinetic = plate_.kinetic();
  ledger.elastic = plate_.elastic();
  ledger.plastic = books.inelastic_work;
  ledger.damping = books.damping;
  ledger.external_work = books.external_work;
  ledger.impulse_received = books.received;
  ledger.impulse_of_supports = books.of_supports;
  return ledger;
}

StructureExtremes PlateShell::extremes() const {
  StructureExtremes x = probes_.extremes(plate_.forces());
  x.max_strain_rate = max_strain_rate_;
  return x;
}

double PlateShell::mass() const {
  double sum = 0.0;
  for (const double m : plate_.mesh().mass) sum += m;
  return sum;
}

void PlateShell::add_to(StateHash& hash) const {
  for (const NodalState* s : {&plate_.translation(), &plate_.slip()}) {
    hash.add(std::span<const Vec3>(s->u));
    hash.add(std::span<const Vec3>(s->v));
  }
  plate_.forces().add_to(hash);
}

}  // namespace standoff::structure
