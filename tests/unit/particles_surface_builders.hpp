#pragma once
// Small sheets for the tests of the surface.
#include <cmath>
#include <vector>

#include "coupling/base/counter_random.hpp"
#include "coupling/contract/surface.hpp"

namespace standoff::particles::test {

/// n x n quads over [x0, x1]^2, moved by `shape(x, y)`; each node has `node_mass` kg.
template <class Shape>
SurfaceMesh sheet_mesh(int n, double x0, double x1, double node_mass, Shape&& shape) {
  SurfaceMesh mesh;
  const double h = (x1 - x0) / n;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.position.push_back(shape(x0 + h * i, x0 + h * j));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  mesh.node_mass.assign(mesh.position.size(), node_mass);
  return mesh;
}

inline SurfaceMesh flat_mesh(int n, double half_size, double node_mass) {
  return sheet_mesh(n, -half_size, half_size, node_mass, [](double x, double y) { return Vec3{x, y, 0.0}; });
}

/// Nodes at rest where the mesh has them.
inline SurfaceMotion at_rest(const SurfaceMesh& mesh) {
  return {mesh.position, std::vector<Vec3>(mesh.position.size())};
}

inline double between(CounterRandom& random, double low, double high) {
  return low + (high - low) * random.uniform();
}
inline Vec3 random_vector(CounterRandom& random, double size) {
  return {between(random, -size, size), between(random, -size, size), between(random, -size, size)};
}

}  // namespace standoff::particles::test
