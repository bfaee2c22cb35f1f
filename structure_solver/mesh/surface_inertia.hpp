#pragma once
// How heavy the plate's surface is under a short impulse at a surface node: what a particle that hits it feels.
//
// An impulse f_s at the surface changes the velocity of the degrees of freedom by M^-1 N^T f_s and that of the surface
// by A f_s, A = N M^-1 N^T. The other side of the interface knows one mass m_a per surface node and the bilinear
// weights w of a hit, so it answers with sum w_a^2 / m_a instead of w.A w. The masses that give every hit the right
// answer on average over where it lands are
//   1/m_a = sum_b A_ab C_ab / C_aa,      C_ab = mean of w_a w_b  (the consistent mass matrix of the bilinear quads).
// On a regular plate A and C are products of one matrix along x and one along y, so m_a = rho h l_x l_y with effective
// widths l. M is taken through the whole thickness, which answers as one column once a wave has gone through it and
// back; over a shorter time T < 2 h / c the column answers like a half space, dx = F T / (rho c), which is lighter by T
// c / (2 h), but never lighter than the layer of nodes of the loaded face: that is what the mesh answers with at once.
// A clamped node does not answer: its mass is the tributary one times `fixed_factor`. Tributary masses
// instead of these leave the work across the interface short by some 10 % with coarse particles.
#include <vector>

#include "structure_solver/mesh/plate_mesh.hpp"

namespace standoff::structure {

/// One mass [kg] per surface node of plate_surface(mesh); answer_time [s]: how long the impulse acts (the window).
std::vector<double> surface_inertia(const PlateMesh& mesh, double wave_speed, double answer_time);

}  // namespace standoff::structure
