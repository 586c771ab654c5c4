// The program without its main(): reads the command line, runs one command, and turns an error into one line and an
// exit code.
#pragma once

#include <lamina/ranks.hpp>

namespace lamina::app {

/// Runs the program with the arguments of main(), and returns its exit code. `ranks`: all processes of the run; null:
/// this is the only one. Of several processes all return the same exit code, and rank 0 prints the error.
int run_program(int argc, char** argv, Ranks* ranks);

}  // namespace lamina::app
