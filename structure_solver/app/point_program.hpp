#pragma once
// `standoff-structure point`: the flow curves of a case's material from the point driver, without broker or particles.
// Writes flow_curves.csv into the run folder:
//
//   plastic_strain, rate_per_s, start_temperature_K, heated, stress_Pa, temperature_K
//
// hardening: each rate at room temperature, isothermal and adiabatic; temperature: held, at the middle rate.

namespace standoff::structure {

bool asks_for_point(int argc, char** argv);
/// Exit code.
int point_program(int argc, char** argv);

}  // namespace standoff::structure
