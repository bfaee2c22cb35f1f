#include "particle_solver/app/particle_run.hpp"

#include <algorithm>

#include "particle_solver/app/particle_books.hpp"
#include "particle_solver/app/particle_files.hpp"
#include "particle_solver/scene/scene.hpp"
#include "particle_solver/step/time_loop.hpp"

namespace standoff::particles {
namespace {

constexpr double seconds_between_progress = 0.5;

/// Counts how often `interval` has been reached, so that rows fall on the same times on both sides of the interface.
class Every {
 public:
  explicit Every(double interval) : interval_(interval) {}
  bool due(double time, double slack) {
    if (time + slack < static_cast<double>(next_) * interval_) return false;
    next_ = static_cast<long>((time + slack) / interval_) + 1;
    return true;
  }
  template <class Archive>
  void archive(Archive& a) {
    a(next_);
  }

 private:
  double interval_;
  long next_ = 0;
};

}  // namespace

void run_particles(const CaseSpec& spec, const ParticleRunOptions& options, Participant& link) {
  const SurfaceMesh mesh = link.receive_surface();
  Scene scene = build_scene(spec, mesh, options.threads);
  TimeLoop loop(spec, scene, options.threads);
  ParticleBooks books(spec, scene, loop);
  ParticleFiles files(options.out);
  Every row(spec.observe.interval), frame(spec.run.until / static_cast<double>(std::max(1L, spec.observe.snapshots)));
  link.trace_stages(loop.timers());
  link.keep([&](auto& archive) { archive(loop, books, files, row, frame); });
  const CouplingClock clock = link.ready({std::min(loop.stable_step(), spec.run.until), window_limit(spec, scene)});

  Stopwatch since_progress;
  const auto draw = [&](double time) {
    files.frame(time, scene.gas, scene.sand, scene.has_air ? &scene.air->particles : nullptr);
  };
  auto observe = [&](double time, long window) {
    const double slack = 0.5 * clock.window;
    books.observe(time);
    books.guard(time, clock.window);
    if (row.due(time, slack)) link.sample(time, books.sample(time));
    if (frame.due(time, slack)) draw(time);
    if (window == clock.windows || since_progress.seconds() > seconds_between_progress) {
      link.progress(books.progress(time, window, clock.windows));
      since_progress = {};
    }
  };
  if (clock.first == 0) observe(0.0, 0);
  SurfaceLoad load;
  while (const auto grant = link.next()) {
    scene.sheet.begin_window(grant->motion, clock.parallel);
    loop.advance(grant->begin, clock.window);
    scene.sheet.collect_load(clock.window, load);
    observe(grant->begin + clock.window, grant->window + 1);
    link.advance(load, {scene.sheet.total_impulse(), scene.sheet.total_work()});
  }
  files.impulse_map(scene.sheet, spec.run.quarter_symmetry);
  link.finish(books.report(link.times()).dump());
}

}  // namespace standoff::particles
