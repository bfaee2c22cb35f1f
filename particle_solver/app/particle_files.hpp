#pragma once
// What the particle process writes into the run folder: particles/particles.pvd and impulse_map.csv.
#include <optional>
#include <string>

#include "coupling/output/vtk_file.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

class ParticleFiles {
 public:
  /// An empty folder writes nothing.
  explicit ParticleFiles(const std::string& folder);
  /// Frame of the simulated particles: velocity, radius, medium (0 gas, 1 sand).
  void frame(double time, const GasState& gas, const SandState& sand, const GasState* air);
  /// Specific impulse of every plate node, full plate: mirrored if a quarter was simulated.
  void impulse_map(const SurfaceSheet& sheet, bool quarter) const;
  template <class Archive>
  void archive(Archive& a) {
    if (series_) a(*series_);
  }

 private:
  std::string folder_;
  std::optional<PvdSeries> series_;
};

}  // namespace standoff::particles
