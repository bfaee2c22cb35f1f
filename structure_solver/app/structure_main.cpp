// standoff-structure: the structure side of a coupled run; `standoff-structure point` draws flow curves instead.
#include "coupling/contract/participant_program.hpp"
#include "structure_solver/app/point_program.hpp"
#include "structure_solver/app/structure_run.hpp"

int main(int argc, char** argv) {
  using namespace standoff;
  if (structure::asks_for_point(argc, argv)) return structure::point_program(argc, argv);
  const ParticipantIdentity identity{"standoff-structure", "structure", Role::structure,
                                     "Structure of a coupled run: a plate that is loaded, then comes to rest"};
  return participant_program(argc, argv, identity,
                             [](const CaseSpec& spec, const ParticipantCommand& command, Participant& link) {
                               structure::run_structure(spec, {command.out, command.threads}, link);
                             });
}
