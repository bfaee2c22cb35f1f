#include "structure_solver/models/plate_hex8/plate_hex8.hpp"

namespace standoff::structure {
namespace {

PlateMesh mesh_of(const CaseSpec& spec) {
  PlateMeshOptions options = mesh_options(spec);
  options.nodes_per_edge = 2;
  options.elements[0] *= PlateHex8::cuts, options.elements[1] *= PlateHex8::cuts;
  return make_plate_mesh(options);
}

}  // namespace

PlateHex8::PlateHex8(const CaseSpec& spec, int threads) : PlateHex64(mesh_of(spec), spec, threads) {}

}  // namespace standoff::structure
