// standoff-particles: the load side of a coupled run; `standoff-particles cell` tests the unit cell of the sand
// instead.
#include "coupling/contract/participant_program.hpp"
#include "particle_solver/app/cell_program.hpp"
#include "particle_solver/app/particle_run.hpp"

int main(int argc, char** argv) {
  using namespace standoff;
  if (particles::asks_for_cell(argc, argv)) return particles::cell_program(argc, argv);
  const ParticipantIdentity identity{"standoff-particles", "particles", Role::load,
                                     "Particles of a coupled run: gas and sand that load a surface"};
  return participant_program(argc, argv, identity,
                             [](const CaseSpec& spec, const ParticipantCommand& command, Participant& link) {
                               particles::run_particles(spec, {command.out, command.threads}, link);
                             });
}
