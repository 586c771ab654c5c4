// The program, as one process.
#include "app/kept_memory.hpp"
#include "app/run_program.hpp"

int main(int argc, char** argv) {
    lamina::app::keep_freed_memory();
    return lamina::app::run_program(argc, argv, nullptr);
}
