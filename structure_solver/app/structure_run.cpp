#include "structure_solver/app/structure_run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "coupling/base/stop.hpp"
#include "coupling/output/atomic_file.hpp"
#include "coupling/output/csv_table.hpp"
#include "coupling/output/vtk_file.hpp"
#include "structure_solver/app/energy_guard.hpp"
#include "structure_solver/app/structure_books.hpp"

namespace standoff::structure {
namespace {

/// Writes plate/plate.pvd and profile.csv into the run folder, or nothing without one.
class PlateFiles {
 public:
  PlateFiles(const std::string& folder) : folder_(folder) {
    if (!folder.empty()) series_.emplace(folder + "/plate", "plate", "vtu");
  }
  void frame(double time, const StructuralModel& model) {
    if (series_) write(time, model.frame());
  }
  /// The state in which a guard stopped the run, if it can be shown; says where it is.
  std::string last_frame(double time, const StructuralModel& model) {
    if (!series_) return "";
    if (const StructureFrame now = model.frame(); can_be_shown(now)) write(time, now);
    return "\n  the last sound shape is the last frame of plate/plate.pvd";
  }
  template <class Archive>
  void archive(Archive& a) {
    if (series_) a(*series_);
  }
  void profile(const StructuralModel& model) const {
    if (folder_.empty()) return;
    std::vector<std::vector<double>> rows;
    for (const ProfilePoint& p : model.profile()) rows.push_back({p.x, p.deflection});
    write_atomically(folder_ + "/profile.csv", csv_text({"x_m", "deflection_m"}, rows));
  }

 private:
  void write(double time, const StructureFrame& now) {
    VtkGrid grid{now.position, now.cells, now.vtk_cell_type, {}, {}};
    grid.point_data = {vtk_array("displacement_m", now.displacement), vtk_array("velocity_m_per_s", now.velocity)};
    for (const auto& [name, values] : now.cell_data) grid.cell_data.push_back(vtk_array(name, values));
    series_->add(time, vtu_text(grid));
  }

  std::string folder_;
  std::optional<PvdSeries> series_;
};

/// wall_velocity.csv: a row per station at every sample, written at the end.
class ProbeFile {
 public:
  explicit ProbeFile(const std::string& folder) : folder_(folder) {}
  void sample(double time, const StructuralModel& model) {
    for (const WallProbe& p : model.probes()) rows_.push_back({time, p.place, p.displacement, p.velocity});
  }
  void write() const {
    if (folder_.empty() || rows_.empty()) return;
    write_atomically(folder_ + "/wall_velocity.csv",
                     csv_text({"time_s", "place_m", "displacement_m", "velocity_m_per_s"}, rows_));
  }
  template <class Archive>
  void archive(Archive& a) {
    std::size_t count = rows_.size();
    a(count);
    rows_.resize(count);
    for (auto& row : rows_) a(row);
  }

 private:
  std::string folder_;
  std::vector<std::vector<double>> rows_;
};

/// The window this side asks for: a longitudinal wave goes through the thickness and back, so that a hit is answered by
/// the whole thickness, which is what the surface masses say (mesh/surface_inertia.hpp). Shorter would not be more
/// accurate.
double window_limit(const CaseSpec& spec) {
  const MaterialSpec& m = spec.plate.material;
  const double nu = m.poissons_ratio;
  const double modulus = m.youngs_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return 2.0 * spec.plate.size.z / std::sqrt(modulus / m.density);
}

template <class Archive>
void archive_model(Archive& a, StructuralModel& model) {
  if constexpr (Archive::reading)
    model.restore(a);
  else
    model.save(a);
}

/// Equal steps that fill a window and respect the stable step. Returns how many.
long advance_model(StructuralModel& model, double window) {
  double left = window;
  long steps = 0;
  while (left > 1e-12 * window) {
    const double count = std::ceil(left / model.stable_step() * (1.0 - 1e-12));
    const double dt = left / std::max(1.0, count);
    model.step(dt);
    left -= dt;
    ++steps;
  }
  return steps;
}

RelaxationResult come_to_rest(StructuralModel& model, StructureBooks& books, Participant& link) {
  RelaxationOptions options;
  options.peak_kinetic_energy = books.peak_kinetic();
  options.progress = [&](double time, double deflection, double kinetic_ratio) {
    link.beat();
    link.progress({{"relax_time_s", time}, {"centre_deflection_m", deflection}, {"kinetic_ratio", kinetic_ratio}});
  };
  const RelaxationResult result = relax_to_rest(*model.relaxation(), options);
  books.observe(model);
  return result;
}

}  // namespace

void run_structure(const CaseSpec& spec, const StructureRunOptions& options, Participant& link) {
  const std::unique_ptr<StructuralModel> model = make_structural_model(spec, options.threads);
  PlateFiles files(options.out);
  ProbeFile probes(options.out);
  StructureBooks books(spec);
  SurfaceMotion motion;

  const double frame_interval = spec.run.until / static_cast<double>(std::max(1L, spec.observe.snapshots));
  long steps = 0, samples = 0, frames = 0;
  link.offer_surface(model->surface());
  link.trace_stages(model->timers());
  link.keep([&](auto& archive) {
    archive_model(archive, *model);
    archive(books, files, probes, steps, samples, frames);
  });
  const CouplingClock clock = link.ready({model->stable_step(), window_limit(spec)});
  model->surface_motion(motion);

  auto observe = [&](double time) {
    books.observe(*model);
    const double slack = 0.5 * clock.window;
    if (time + slack >= static_cast<double>(samples) * spec.observe.interval) {
      link.sample(time, books.sample(*model));
      probes.sample(time, *model);
      samples = static_cast<long>((time + slack) / spec.observe.interval) + 1;
    }
    if (time + slack >= static_cast<double>(frames) * frame_interval) {
      files.frame(time, *model);
      frames = static_cast<long>((time + slack) / frame_interval) + 1;
    }
  };
  if (clock.first == 0) observe(0.0);
  const auto follow_windows = [&] {
    while (const auto grant = link.next()) {
      model->set_surface_force(grant->load.force);
      steps += advance_model(*model, clock.window);
      model->surface_motion(motion);
      if (!grant->drain) observe(grant->begin + clock.window);
      const StructureLedger now = model->ledger();
      link.advance(motion, {now.impulse_received, now.external_work});
    }
  };
  try {
    follow_windows();
  } catch (const Stop& stop) {
    if (stop.code() != ExitCode::guard) throw;
    throw Stop(ExitCode::guard, stop.what() + files.last_frame(model->time(), *model));
  }
  books.observe(*model);
  books.close_momentum(*model);

  std::optional<RelaxationResult> rest;
  if (spec.run.settle && model->relaxation() != nullptr) {
    const std::vector<Vec3> no_force(model->surface().position.size());
    model->set_surface_force(no_force);
    rest = come_to_rest(*model, books, link);
    files.frame(model->time() + rest->simulated_time, *model);
  }
  files.profile(*model);
  probes.write();
  link.finish(books.report(*model, rest ? &*rest : nullptr, steps, link.times()).dump());
}

}  // namespace standoff::structure
