#include "structure_solver/models/pipe_hex64/pipe_hex64.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::structure {
namespace {

PlateMesh mesh_of(const CaseSpec& spec) {
  const PipeSpec& pipe = spec.plate.pipe;
  if (!spec.run.quarter_symmetry)
    throw Stop(ExitCode::bad_case,
               "plate.model = \"pipe_hex64\" is computed as a quarter\n  run.symmetry = \"quarter\"");
  return make_pipe_mesh({pipe.inner_diameter, pipe.wall, pipe.length, spec.plate.elements, spec.plate.material.density,
                         spec.plate.edges});
}

/// Share of the circumference that each node of a line round the wall stands for: the lumped masses, sum 1.
std::vector<double> shares_round(const PlateMesh& mesh) {
  std::vector<double> share;
  double sum = 0.0;
  for (int i = 0; i < mesh.nodes[0]; ++i) sum += mesh.mass[static_cast<std::size_t>(mesh.node(i, 0, 0))];
  for (int i = 0; i < mesh.nodes[0]; ++i)
    share.push_back(mesh.mass[static_cast<std::size_t>(mesh.node(i, 0, 0))] / sum);
  return share;
}

}  // namespace

PipeHex64::PipeHex64(const CaseSpec& spec, int threads) : PlateHex64(mesh_of(spec), spec, threads) {
  const PlateMesh& mesh = plate().mesh();
  for (const double z : spec.observe.probes) {
    const double place = z / mesh.edge.y;
    const int element = std::clamp(static_cast<int>(place), 0, mesh.elements[1] - 1);
    stations_.push_back({z, 3 * element, lagrange(lobatto_node, 2.0 * (place - element) - 1.0)});
  }
}

std::vector<WallProbe> PipeHex64::probes() const {
  const PlateMesh& mesh = plate().mesh();
  const std::vector<double> share = shares_round(mesh);
  std::vector<WallProbe> probes;
  for (const Station& station : stations_) {
    WallProbe probe{station.z, 0.0, 0.0};
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < mesh.nodes[0]; ++i) {
        const auto node = static_cast<std::size_t>(mesh.node(i, station.first + a, 0));  // k = 0: the outer face
        const double weight = station.weight[static_cast<std::size_t>(a)] * share[static_cast<std::size_t>(i)];
        probe.displacement += weight * dot(mesh.outward(i), plate().state().u[node]);
        probe.velocity += weight * dot(mesh.outward(i), plate().state().v[node]);
      }
    probes.push_back(probe);
  }
  return probes;
}

}  // namespace standoff::structure
