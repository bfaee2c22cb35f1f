#pragma once
// The unit cell as a material test: slow uniaxial compression of a periodic cell, pressures against strain
// [Borvik 2011, sec. 3.3, figs. 11 and 13].
//
// The box shortens along z at a constant rate of engineering strain, lateral lengths stay; grains follow affinely and
// keep what they move beyond that. Viscous drag on that motion, v <- v (1 - drag dt), keeps it quasi-static:
//   inertia: stress errs by about rho (strain rate * L)^2; with 20000 steps to 10 % strain that is 1e-7 of k0/L0.
// Where grains turn, spins have the same drag. The step, 0.2 sqrt(m/k), is then within the bound of
// kernels/grain_rotation.hpp up to 14 contacts on a grain.
// Stress along an axis = sum f_a d_a / V over contacts (virial), V the present volume; true (Cauchy) pressure.
//
//   strain = 1 - length/initial length;  secant bulk modulus = change of (axial + 2 lateral)/3 over strain
//
// A cell that keeps overlap at zero strain (random close packing) has a pressure there: the first point reports it.
#include <vector>

#include "particle_solver/kernels/grain_contact.hpp"
#include "particle_solver/packing/packed_cell.hpp"

namespace standoff::particles {

struct CompressionOptions {
  double strain = 0.10;  // at the end
  int points = 20;       // rows after the one at zero strain
  int steps = 20000;     // in all
  double drag = 0.1;     // of sqrt(k/m)
  int threads = 1;
  bool turning = false;  // friction turns the grains
};

struct CompressionPoint {
  double strain = 0.0;
  double axial = 0.0, lateral = 0.0;  // Pa, compression positive
  double coordination = 0.0;
  double friction_work = 0.0;  // J per m3 of the initial cell, since the start
  double pressure() const { return (axial + 2.0 * lateral) / 3.0; }
};

/// Pa; the pressure that the cell had before it was compressed is subtracted.
inline double secant_bulk_modulus(const CompressionPoint& start, const CompressionPoint& now) {
  return (now.pressure() - start.pressure()) / now.strain;
}

/// `law` is that of a cell of 1 m (stiffness k0). Stresses do not depend on the size of the cell, since k ~ L.
std::vector<CompressionPoint> compress_cell(const PackedCell& cell, const GrainLaw& law,
                                            const CompressionOptions& options);

}  // namespace standoff::particles
