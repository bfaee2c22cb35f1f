#pragma once
// What one unit of work costs on one core, wall-clock: the only numbers behind `standoff plan`. Measured on an AMD EPYC
// (Zen 3) core with AVX2; to be measured anew when a kernel changes. The prediction is for choosing a level, not a
// promise: within a factor of two.
namespace standoff::launch {

struct CostConstants {
  // particles
  double gas_particle_step = 300e-9;  // s: one gas particle through one sub-step, search and rounds included
  double gas_beside_sand = 110e-9;    // s more where grains are searched too
  double air_particle_step = 120e-9;  // s: one air particle that is awake through one window
  double grain_step = 180e-9;         // s: one grain through one step without friction (about 4 contacts a grain)
  double grain_friction = 80e-9;      // s more with tangential history
  double grain_damping = 5e-9;        // s more with a dashpot
  double packing_grain = 2e-3;        // s per grain of the unit cell (1000 grains, once)
  // structure
  double gauss_point_step = 80e-9;  // s: one Gauss point of a cubic hexahedron through one explicit step
  double relaxation_call = 700e-9;  // s per Gauss point and force call, preconditioner solves included
  double relaxation_calls = 3500;   // force calls of a certified rest at rtol 1e-4
  // coupling
  double exchange_window = 0.35e-3;  // s per window: two messages each way through the broker
  double exchange_byte = 1.5e-9;     // s per byte on the wire, both directions together
  double start_up = 0.6;             // s: processes, handshake, first files
  // threads
  double thread_efficiency = 0.85;  // gain of every core after the first

  // numerics that set the number of steps
  double gas_step_fraction = 0.1;     // sub-step times rms speed over sphere diameter, dense gas
  double gas_path_fraction = 0.25;    // sub-step times rms speed over mean free path, dilute gas
  double sand_step_fraction = 0.05;   // of 2 sqrt(m/k)
  double hexahedron_courant = 0.224;  // stable step times sound speed over shortest edge, 64 nodes, lumped mass
  double structure_safety = 0.8;      // share of the stable step that an explicit plate takes
};

}  // namespace standoff::launch
