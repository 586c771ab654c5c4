// Ranks that are processes of MPI. This header is installed with builds that have LAMINA_MPI.
#pragma once

#include <memory>

#include <lamina/export.hpp>
#include <lamina/ranks.hpp>

namespace lamina {

/// MPI, from its beginning to its end: one object for each process, made first and destroyed last.
class LAMINA_EXPORT MpiSession {
public:
    /// Starts MPI with the arguments of main(). Throws UsageError where MPI cannot serve several threads.
    MpiSession(int& argc, char**& argv);
    /// Ends it, and waits for all other processes that have not ended.
    ~MpiSession();
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;

    /// Returns all processes of the run.
    Ranks& ranks();
    /// Ends all processes at once, wherever they are, with this exit code.
    [[noreturn]] void abort(int exit_code);

private:
    std::unique_ptr<Ranks> ranks_;
};

}  // namespace lamina
