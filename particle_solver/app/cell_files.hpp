#pragma once
// What the test of the unit cell leaves in its folder.
#include <string>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/packing/cell_study.hpp"

namespace standoff::particles {

/// stress_strain.csv: a row per strain, means over the cells and their standard deviations.
std::string stress_strain_csv(const CellStudy& study, double stiffness);
/// cells.csv: a row per cell and strain.
std::string cells_csv(const CellStudy& study);
/// cell.json: what was tested, how it was packed, what it resists.
std::string cell_json(const CaseSpec& spec, const CellStudy& study);

}  // namespace standoff::particles
