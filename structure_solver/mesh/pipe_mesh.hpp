#pragma once
// A quarter of a pipe about the z axis, from z = 0 to its length: the plate's grid (plate_mesh.hpp), rolled up.
//
//      y ^ i = 0, held in x       x runs round the wall from the y axis to the x axis, y along the axis,
//        |""--._                  z from the outer face (k = 0) to the inner one, which is loaded and looks inwards
//        |      "\   i = last      radius = inner + wall at k = 0, inner at the last k
//        |        |  held in y    ends are free, clamped, or held along the axis (symmetry: plane strain)
//        +--------+-> x
//
// Every element is a copy of the first of its layer of the wall, turned about z and moved along it. Nodes lie on true
// circles; between them the wall is cubic, 1e-6 of the radius off at four elements a quarter. Masses are those of the
// true cylinder: the Lobatto rule integrates r exactly.
#include "structure_solver/mesh/plate_mesh.hpp"

namespace standoff::structure {

struct PipeMeshOptions {
  double inner_diameter = 0.0, wall = 0.0, length = 0.0;  // m
  std::array<int, 3> elements{16, 10, 1};                 // round the full pipe, along, through the wall
  double density = 0.0;                                   // kg/m3
  std::string ends = "free";                              // "free" | "clamped" | "symmetry"
};

/// Throws Stop(bad_case) for a pipe that cannot be meshed, with the remedy.
PlateMesh make_pipe_mesh(const PipeMeshOptions& options);

}  // namespace standoff::structure
