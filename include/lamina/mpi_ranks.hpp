// Ranks that are processes of MPI. This header is installed with builds that have LAMINA_MPI.
//
// Limits:
//  1. Each process has one MpiSession, made first and destroyed last. MPI must offer MPI_THREAD_SERIALIZED.
//
//     int main(int argc, char** argv) {
//         lamina::MpiSession session(argc, argv);
//         const lamina::SharedMesh mesh = lamina::share_mesh({"naca:0012"}, {}, session.ranks());  // stream.hpp
//     }
#pragma once

#include <memory>

#include <lamina/ranks.hpp>

namespace lamina {

/// MPI, from its beginning to its end.
class LAMINA_EXPORT MpiSession {
public:
    /// Starts MPI with the arguments of main(). Throws UsageError where it offers no threads.
    MpiSession(int& argc, char**& argv);
    ~MpiSession();  ///< ends it, and waits for all other processes that have not ended
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;

    Ranks& ranks();                          ///< all processes of the run
    [[noreturn]] void abort(int exit_code);  ///< ends all processes at once, wherever they are, with this exit code

private:
    std::unique_ptr<Ranks> ranks_;
};

}  // namespace lamina
