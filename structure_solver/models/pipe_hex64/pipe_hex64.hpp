#pragma once
// Model "pipe_hex64": the solid of plate_hex64 rolled up (mesh/pipe_mesh.hpp), loaded from inside: the cylinder test.
// Deflection is the growth of the radius in the middle of the wall. Stations along the axis record the outer wall, as a
// streak camera does: mean over the circumference of radius gained and radial velocity.
#include "structure_solver/mesh/pipe_mesh.hpp"
#include "structure_solver/models/plate_hex64/plate_hex64.hpp"

namespace standoff::structure {

class PipeHex64 final : public PlateHex64 {
 public:
  PipeHex64(const CaseSpec& spec, int threads);
  /// A fifth of what is stable: a detonation drives the wall by a shock of tens of GPa, in which metal flows within few
  /// steps, and the energy books of longer steps stay open by several percent.
  double stable_step() const override { return 0.2 * PlateHex64::stable_step(); }
  std::vector<WallProbe> probes() const override;

 private:
  /// Four neighbours along the axis and their weights.
  struct Station {
    double z;
    int first;
    Line4 weight;
  };
  std::vector<Station> stations_;
};

}  // namespace standoff::structure
