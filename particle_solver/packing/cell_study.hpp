#pragma once
// Several unit cells of one soil, packed with different seeds and compressed: the material test behind `standoff cell`
// [Borvik 2011, sec. 3.3, figs. 11 and 13].
//
// A cell at random close packing has a stress before it is strained. It is a property of the cell, not of the load: it
// is reported, and subtracted from the curve, axis by axis.
#include <cmath>
#include <cstdint>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/packing/cell_compression.hpp"

namespace standoff::particles {

struct CellSample {
  std::uint64_t seed = 0;
  double overlap = 0.0;                                 // largest, in mean diameters
  double coordination = 0.0;                            // mean contacts of a grain
  double residual_axial = 0.0, residual_lateral = 0.0;  // Pa at zero strain
  std::vector<CompressionPoint> curve;                  // residual stress subtracted; the first point is zero
};

struct CellStudy {
  double packing = 0.0;      // solid fraction, the same in every cell
  double mean_radius = 0.0;  // m for a cell of 1 m
  std::vector<CellSample> samples;
  std::vector<CompressionPoint> mean;  // over samples
};

/// Seeds `seed`, seed + 1, ...; `turning`: friction turns the grains while they are compressed. Samples are worked on
/// side by side, and do not depend on the number of threads.
CellStudy study_cells(const SoilSpec& soil, const CellSpec& cell, std::uint64_t seed, int threads,
                      bool turning = false);

/// Standard deviation over samples of value(point n); 0 for a single sample.
template <class Value>
double deviation(const CellStudy& study, std::size_t n, const Value& value) {
  const auto count = static_cast<double>(study.samples.size());
  double mean = 0.0, squares = 0.0;
  for (const CellSample& sample : study.samples) mean += value(sample.curve[n]) / count;
  for (const CellSample& sample : study.samples) squares += std::pow(value(sample.curve[n]) - mean, 2);
  return count > 1.0 ? std::sqrt(squares / (count - 1.0)) : 0.0;
}

/// Pa; every contact moves with the mean strain: K = phi Z k0 / (6 pi R) for a cell of 1 m, Z the present mean number
/// of contacts. An upper estimate [Walton, J. Mech. Phys. Solids 35, 213 (1987), for normal stiffness k].
double affine_bulk_modulus(const CellStudy& study, double stiffness, double coordination);

}  // namespace standoff::particles
