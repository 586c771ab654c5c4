// The program, as one process.
#include "app/run_program.hpp"

int main(int argc, char** argv) { return lamina::app::run_program(argc, argv, nullptr); }
