// The program as one of the processes that mpirun starts.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <lamina/error.hpp>
#include <lamina/mpi_ranks.hpp>

#include "app/kept_memory.hpp"
#include "app/run_program.hpp"

int main(int argc, char** argv) {
    lamina::app::keep_freed_memory();
    try {
        lamina::MpiSession session(argc, argv);
        // What is printed on standard output is the same everywhere.
        if (session.ranks().rank() != 0 && std::freopen("/dev/null", "w", stdout) == nullptr) session.abort(5);
        return lamina::app::run_program(argc, argv, &session.ranks());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "lamina: error: %s\n", error.what());
        return static_cast<int>(lamina::ExitCode::usage);
    }
}
