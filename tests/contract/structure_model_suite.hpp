#pragma once
// The contract suite of structural models: one list of laws, run on every model of the registry.
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "structure_solver/models/structural_model.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure::testing {

/// A plate; for a pipe the same metal, wall and quarter of the mass rolled up, 16 elements round it.
inline CaseSpec model_case(const std::string& name, bool quarter = true, const char* edges = "clamped") {
  CaseSpec spec = plate_case(4, quarter);
  if (name == "pipe_hex64") {
    spec.plate.pipe = {0.406 / M_PI - 0.0034, 0.0034, 0.406};
    spec.plate.elements = {16, 4, 1};
  }
  spec.plate.model = name;
  spec.plate.edges = spec.plate.is_pipe() ? "free" : edges;
  spec.run.until = 1e-3;
  return spec;
}

/// The quarter, and the whole for models that can be whole.
inline std::vector<bool> symmetries(const std::string& name) {
  return name == "pipe_hex64" ? std::vector<bool>{true} : std::vector<bool>{true, false};
}

/// The area of the loaded face of the simulated part; a pipe shows 12 flat quads round its quarter.
inline double loaded_area(const CaseSpec& spec) {
  const PipeSpec& pipe = spec.plate.pipe;
  const int round = 3 * spec.plate.elements[0];
  const double whole = spec.plate.is_pipe() ? round * pipe.inner_diameter * std::sin(M_PI / round) * pipe.length
                                            : spec.plate.size.x * spec.plate.size.y;
  return whole / spec.copies();
}

/// Unit vector towards the charge from a point of the loaded face.
inline Vec3 inwards(const CaseSpec& spec, const Vec3& x) {
  const double radius = std::hypot(x.x, x.y);
  return spec.plate.is_pipe() ? Vec3{-x.x / radius, -x.y / radius, 0.0} : Vec3{0.0, 0.0, 1.0};
}

/// The area that belongs to each surface node, as a vector along the normal of the loaded side: a quarter of each quad.
inline std::vector<Vec3> node_areas(const SurfaceMesh& surface) {
  std::vector<Vec3> area(surface.position.size());
  for (const auto& q : surface.quads) {
    const auto at = [&](std::size_t i) { return surface.position[static_cast<std::size_t>(q[i])]; };
    const Vec3 whole = 0.5 * cross(at(2) - at(0), at(3) - at(1));
    for (const std::int32_t node : q) area[static_cast<std::size_t>(node)] += 0.25 * whole;
  }
  return area;
}

inline std::vector<Vec3> pressure_on(const SurfaceMesh& surface, double pressure) {
  std::vector<Vec3> force = node_areas(surface);
  for (Vec3& f : force) f = -pressure * f;
  return force;
}

/// Uneven hits on random quads, others every five steps, hard enough that metal flows.
class Hammer {
 public:
  void strike(StructuralModel& model, int steps) {
    const SurfaceMesh& surface = model.surface();
    for (int i = 0; i < steps; ++i, ++count_) {
      if (count_ % 5 == 0) {
        std::vector<Vec3> force(surface.position.size());
        for (int hit = 0; hit < 4; ++hit) {
          const auto quad = static_cast<std::size_t>(random_.uniform() * static_cast<double>(surface.quads.size()));
          for (const std::int32_t node : surface.quads[quad])
            force[static_cast<std::size_t>(node)] +=
                Vec3{4e3 * random_.normal(), 4e3 * random_.normal(), -4e4 * random_.uniform()};
        }
        model.set_surface_force(force);
      }
      model.step(model.stable_step());
    }
  }

 private:
  CounterRandom random_{7, RandomUse::test, 1};
  long count_ = 0;
};

inline std::uint64_t hash_of(const StructuralModel& model) {
  StateHash hash;
  model.add_to(hash);
  return hash.value();
}

inline std::string saved(const StructuralModel& model) {
  StateWriter writer;
  model.save(writer);
  return writer.bytes();
}

class StructureModel : public ::testing::TestWithParam<std::string> {};

}  // namespace standoff::structure::testing
