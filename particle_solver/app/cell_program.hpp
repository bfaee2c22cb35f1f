#pragma once
// `standoff-particles cell`: packs and compresses the unit cell of a case's soil. Needs no broker and no plate.

namespace standoff::particles {

/// True if the first argument is "cell".
bool asks_for_cell(int argc, char** argv);

/// Reads the case, tests the cell, writes cell.json, stress_strain.csv and cells.csv; returns the exit code.
int cell_program(int argc, char** argv);

}  // namespace standoff::particles
