// Several processes that make one mesh together, as MPI starts them (mpi_ranks.hpp). Each has a number, its rank.
//
// Guarantees:
//  1. A rank that fails ends the work of all: each throws the RankFailure of the lowest rank that has failed.
// Limits:
//  1. Functions marked as collective are called by all ranks in the same order, each by one thread at a time. They
//     begin with a question: has any rank failed? A rank that fails answers it through fail(), wherever the others are.
#pragma once

#include <string_view>

#include <lamina/error.hpp>

namespace lamina {

namespace core {
class ConnectedRanks;
}

/// A failure that all processes of a run know of: each throws the same one.
class LAMINA_EXPORT RankFailure : public Error {
public:
    /// Makes an error whose what() is this line.
    RankFailure(ExitCode code, const std::string& line) : Error(code, line) {}
};

/// The number and the size of the messages that a process has handed over for others.
struct RankTraffic {
    std::size_t messages = 0;  ///< number of messages; one for each call of a collective function, and for each number
    std::size_t bytes = 0;     ///< bytes in them, without what the transport adds
};

/// The processes of a run, as one of them sees them. Rank 0 reports to the user.
class LAMINA_EXPORT Ranks {
public:
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    virtual ~Ranks() = default;

    virtual unsigned rank() const = 0;  ///< the number of this process, from 0
    virtual unsigned size() const = 0;  ///< the number of processes
    /// Collective: does nothing but ask whether a rank has failed.
    virtual void agree() = 0;
    /// Collective: returns the bytes of all ranks, in their order, on rank 0; nothing elsewhere.
    virtual std::vector<std::string> gather(std::string_view bytes) = 0;
    /// Ends the work of all ranks with this line, in place of the next collective function. Throws RankFailure.
    [[noreturn]] virtual void fail(ExitCode code, const std::string& line) = 0;
    virtual RankTraffic traffic() const = 0;  ///< what this rank has sent so far

private:
    friend class core::ConnectedRanks;
    Ranks() = default;
};

}  // namespace lamina
