#pragma once
// The particle side of a case over a surface that gives way at a steady pace, and its state as bytes.
#include <functional>
#include <string>

#include "coupling/base/state_archive.hpp"
#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles::test {

struct Side {
  /// `prepare` may change the scene before the loop sees it.
  Side(const CaseSpec& spec, int threads, SurfaceMesh surface, const std::function<void(Scene&)>& prepare = {})
      : mesh(std::move(surface)),
        motion(at_rest(mesh)),
        scene(prepared(build_scene(spec, mesh, threads), prepare)),
        loop(spec, scene, threads) {}

  /// Windows [first, last); the surface gives way, so that the local answer matters too.
  void run(int first, int last) {
    for (int k = first; k < last; ++k) {
      for (std::size_t n = 0; n < motion.position.size(); ++n) {
        motion.velocity[n] = {0.0, 0.0, -pace};
        motion.position[n] = mesh.position[n] + Vec3{0.0, 0.0, -pace * window * k};
      }
      scene.sheet.begin_window(motion, true);
      loop.advance(window * k, window);
      scene.sheet.collect_load(window, load);
    }
  }
  std::string saved() {
    StateWriter writer;
    writer(loop);
    return writer.bytes();
  }
  void read(const std::string& bytes) {
    StateReader reader(bytes);
    reader(loop);
    EXPECT_TRUE(reader.at_end());
  }
  /// The state without the seconds of its stages, which are the only thing that differs between two runs.
  std::string state() {
    loop.forget_times();
    return saved();
  }

  static constexpr double window = 2e-6, pace = 20.0;  // s, m/s
  SurfaceMesh mesh;
  SurfaceMotion motion;
  Scene scene;
  TimeLoop loop;
  SurfaceLoad load;

 private:
  static Scene prepared(Scene scene, const std::function<void(Scene&)>& prepare) {
    if (prepare) prepare(scene);
    return scene;
  }
};

}  // namespace standoff::particles::test
