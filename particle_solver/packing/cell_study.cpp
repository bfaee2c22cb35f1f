#include "particle_solver/packing/cell_study.hpp"

#include <numbers>

#include "particle_solver/step/sand_pairs.hpp"

namespace standoff::particles {

namespace {

/// Takes the stress at zero strain off every point.
void subtract_residual(CellSample& sample) {
  sample.residual_axial = sample.curve.front().axial, sample.residual_lateral = sample.curve.front().lateral;
  for (CompressionPoint& p : sample.curve) p.axial -= sample.residual_axial, p.lateral -= sample.residual_lateral;
}

std::vector<CompressionPoint> mean_of(const std::vector<CellSample>& samples) {
  std::vector<CompressionPoint> mean(samples.front().curve.size());
  const double share = 1.0 / static_cast<double>(samples.size());
  for (const CellSample& sample : samples)
    for (std::size_t n = 0; n < mean.size(); ++n) {
      const CompressionPoint& p = sample.curve[n];
      mean[n].strain = p.strain;
      mean[n].axial += share * p.axial, mean[n].lateral += share * p.lateral;
      mean[n].coordination += share * p.coordination, mean[n].friction_work += share * p.friction_work;
    }
  return mean;
}

}  // namespace

CellStudy study_cells(const SoilSpec& soil, const CellSpec& cell, std::uint64_t seed, int threads, bool turning) {
  CellStudy study;
  std::vector<const PackedCell*> packed;
  for (long n = 0; n < cell.cells; ++n)
    packed.push_back(&pack_cell(
        {static_cast<int>(cell.grains), soil.packing, soil.radius_spread, seed + static_cast<std::uint64_t>(n)}));
  study.packing = soil.packing, study.mean_radius = packed.front()->mean_radius;
  study.samples.resize(packed.size());
  const GrainLaw law = grain_law(soil, 1.0);
  const CompressionOptions options{cell.strain, static_cast<int>(cell.points), static_cast<int>(cell.steps), 0.1, 1,
                                   turning};
  const auto count = static_cast<int>(packed.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int n = 0; n < count; ++n) {
    const PackedCell& one = *packed[static_cast<std::size_t>(n)];
    CellSample& sample = study.samples[static_cast<std::size_t>(n)];
    sample = {seed + static_cast<std::uint64_t>(n), one.max_overlap, one.coordination, 0.0, 0.0,
              compress_cell(one, law, options)};
    subtract_residual(sample);
  }
  study.mean = mean_of(study.samples);
  return study;
}

double affine_bulk_modulus(const CellStudy& study, double stiffness, double coordination) {
  return study.packing * coordination * stiffness / (6.0 * std::numbers::pi * study.mean_radius);
}

}  // namespace standoff::particles
