// standoff-particles: the load side of a coupled run.
#include "coupling/contract/participant_program.hpp"
#include "particle_solver/app/particle_run.hpp"

int main(int argc, char** argv) {
  using namespace standoff;
  const ParticipantIdentity identity{"standoff-particles", "particles", Role::load,
                                     "Particles of a coupled run: gas and sand that load a surface"};
  return participant_program(argc, argv, identity,
                             [](const CaseSpec& spec, const ParticipantCommand& command, Participant& link) {
                               particles::run_particles(spec, {command.out, command.threads}, link);
                             });
}
