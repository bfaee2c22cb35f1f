#pragma once
// Why a process should end although its work is not done: a signal, or the death of the program that started it (a
// launcher that was killed must leave nobody behind).
#include <string>

namespace standoff {

/// From now on SIGINT and SIGTERM are noted instead of ending the process, SIGPIPE and SIGXFSZ are ignored, and the
/// parent is watched unless it is the system's own first process. Call once, at the start of main.
void watch_process();

/// From now on blocks of up to some MB go back to the heap and not to the system: the arrays of an exchange then do not
/// cost a page fault for every 4 kB, each window anew.
void reuse_large_blocks();

/// Empty while there is no reason; otherwise a sentence. Costs a system call.
std::string reason_to_end();

/// A signal asks for the end; the run is being saved first and ends by itself.
bool is_saving();
void set_saving();

}  // namespace standoff
