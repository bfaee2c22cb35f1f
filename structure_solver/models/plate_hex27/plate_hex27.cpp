#include "structure_solver/models/plate_hex27/plate_hex27.hpp"

namespace standoff::structure {
namespace {

PlateMesh mesh_of(const CaseSpec& spec) {
  PlateMeshOptions options = mesh_options(spec);
  options.nodes_per_edge = 3;
  return make_plate_mesh(options);
}

}  // namespace

PlateHex27::PlateHex27(const CaseSpec& spec, int threads) : PlateHex64(mesh_of(spec), spec, threads) {}

}  // namespace standoff::structure
