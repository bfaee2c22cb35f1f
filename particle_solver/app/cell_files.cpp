#include "particle_solver/app/cell_files.hpp"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "coupling/output/csv_table.hpp"

namespace standoff::particles {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double modulus(const CompressionPoint& p) {
  return p.strain > 0.0 ? p.pressure() / p.strain : nothing;
}
double ratio(const CompressionPoint& p) {
  return p.strain > 0.0 ? p.lateral / p.axial : nothing;
}

/// Mean and standard deviation over the samples.
template <class Value>
nlohmann::json mean_and_deviation(const CellStudy& study, const Value& value) {
  const auto count = static_cast<double>(study.samples.size());
  double mean = 0.0, squares = 0.0;
  for (const CellSample& sample : study.samples) mean += value(sample) / count;
  for (const CellSample& sample : study.samples) squares += std::pow(value(sample) - mean, 2);
  return {{"mean", mean}, {"deviation", count > 1.0 ? std::sqrt(squares / (count - 1.0)) : 0.0}};
}

}  // namespace

std::string stress_strain_csv(const CellStudy& study, double stiffness) {
  std::vector<std::vector<double>> rows;
  for (std::size_t n = 0; n < study.mean.size(); ++n) {
    const CompressionPoint& p = study.mean[n];
    rows.push_back({p.strain, p.axial, p.lateral, p.pressure(), modulus(p), ratio(p), p.coordination, p.friction_work,
                    affine_bulk_modulus(study, stiffness, p.coordination),
                    deviation(study, n, [](const CompressionPoint& q) { return q.axial; }),
                    deviation(study, n, [](const CompressionPoint& q) { return q.lateral; }),
                    n > 0 ? deviation(study, n, modulus) : nothing});
  }
  return csv_text({"strain", "axial_Pa", "lateral_Pa", "pressure_Pa", "secant_bulk_modulus_Pa", "lateral_over_axial",
                   "coordination", "friction_work_J_per_m3", "affine_bulk_modulus_Pa", "axial_deviation_Pa",
                   "lateral_deviation_Pa", "secant_bulk_modulus_deviation_Pa"},
                  rows);
}

std::string cells_csv(const CellStudy& study) {
  std::vector<std::vector<double>> rows;
  for (const CellSample& sample : study.samples)
    for (const CompressionPoint& p : sample.curve)
      rows.push_back(
          {static_cast<double>(sample.seed), p.strain, p.axial, p.lateral, modulus(p), ratio(p), p.coordination});
  return csv_text(
      {"seed", "strain", "axial_Pa", "lateral_Pa", "secant_bulk_modulus_Pa", "lateral_over_axial", "coordination"},
      rows);
}

std::string cell_json(const CaseSpec& spec, const CellStudy& study) {
  nlohmann::ordered_json j;
  j["case"] = spec.name, j["kind"] = spec.soil.kind == SoilKind::wet ? "wet" : "dry";
  j["stiffness_N_per_m"] = spec.soil.stiffness, j["friction"] = spec.soil.friction, j["damping"] = spec.soil.damping;
  if (spec.effect("grain_rotation")) j["grain_rotation"] = true;
  j["packing"] = study.packing, j["radius_spread"] = spec.soil.radius_spread;
  j["grains"] = spec.cell.grains, j["cells"] = spec.cell.cells, j["first_seed"] = spec.run.seed;
  j["steps"] = spec.cell.steps, j["mean_radius_m"] = study.mean_radius;
  j["overlap_over_diameter"] = mean_and_deviation(study, [](const CellSample& s) { return s.overlap; });
  j["coordination"] = mean_and_deviation(study, [](const CellSample& s) { return s.coordination; });
  j["residual_axial_Pa"] = mean_and_deviation(study, [](const CellSample& s) { return s.residual_axial; });
  j["residual_lateral_Pa"] = mean_and_deviation(study, [](const CellSample& s) { return s.residual_lateral; });
  for (std::size_t n = 1; n < study.mean.size(); ++n) {
    const CompressionPoint& p = study.mean[n];
    j["points"].push_back({{"strain", p.strain},
                           {"axial_Pa", p.axial},
                           {"lateral_Pa", p.lateral},
                           {"secant_bulk_modulus_Pa", modulus(p)},
                           {"secant_bulk_modulus_deviation_Pa", deviation(study, n, modulus)},
                           {"lateral_over_axial", ratio(p)},
                           {"coordination", p.coordination}});
  }
  return j.dump(2) + "\n";
}

}  // namespace standoff::particles
