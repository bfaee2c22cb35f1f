#include "coupling/launcher/command_line.hpp"

int main(int argc, char** argv) {
  return standoff::launch::launch(argc, argv);
}
