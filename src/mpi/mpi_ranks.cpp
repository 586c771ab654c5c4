// Processes of MPI. Collective functions run on one thread of each process at a time; the counter is taken by all
// threads one after the other, with one-sided communication: nobody waits for an answer of the process that holds it.
#include <lamina/mpi_ranks.hpp>

#include <mpi.h>

#include <cstdlib>
#include <limits>
#include <list>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "mpi/mpi_file.hpp"

namespace lamina::mpi {

namespace {

int int_size(std::size_t bytes) {
    if (bytes > std::numeric_limits<int>::max())
        throw MeshError("one process has more than 2 GiB to tell the others: use more processes");
    return static_cast<int>(bytes);
}

class MpiRanks : public core::ConnectedRanks {
public:
    MpiRanks() {
        MPI_Comm_dup(MPI_COMM_WORLD, &all_);
        MPI_Comm_rank(all_, &rank_);
        MPI_Comm_size(all_, &size_);
        const MPI_Aint bytes = rank_ == 0 ? sizeof(std::uint64_t) : 0;
        MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, all_, &counter_, &window_);
        if (rank_ == 0) *counter_ = 0;
        MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
        MPI_Barrier(all_);
    }
    ~MpiRanks() override {
        for (Sent& sent : sent_) MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
        MPI_Win_unlock_all(window_);
        MPI_Win_free(&window_);
        MPI_Comm_free(&all_);
    }

    unsigned rank() const override { return static_cast<unsigned>(rank_); }
    unsigned size() const override { return static_cast<unsigned>(size_); }

protected:
    unsigned lowest_failed(bool failed) override {
        int lowest = failed ? rank_ : size_;
        MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT, MPI_MIN, all_);
        return static_cast<unsigned>(lowest);
    }

    std::vector<std::string> do_gather(std::string_view bytes) override {
        const int mine = int_size(bytes.size());
        std::vector<int> sizes(rank_ == 0 ? size() : 0), offsets;
        MPI_Gather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, all_);
        std::string joined;
        if (rank_ == 0) joined.resize(offsets_of(sizes, offsets));
        MPI_Gatherv(bytes.data(), mine, MPI_BYTE, joined.data(), sizes.data(), offsets.data(), MPI_BYTE, 0, all_);
        return cut(joined, sizes, offsets);
    }

    std::vector<std::string> do_all_gather(std::string_view bytes) override {
        const int mine = int_size(bytes.size());
        std::vector<int> sizes(size()), offsets;
        MPI_Allgather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, all_);
        std::string joined(offsets_of(sizes, offsets), '\0');
        MPI_Allgatherv(bytes.data(), mine, MPI_BYTE, joined.data(), sizes.data(), offsets.data(), MPI_BYTE, all_);
        return cut(joined, sizes, offsets);
    }

    std::vector<std::string> do_exchange(const std::vector<std::string>& bytes) override {
        std::vector<int> sizes, offsets, of_others(size()), offsets_of_others;
        const std::string joined = join(bytes, sizes, offsets);
        MPI_Alltoall(sizes.data(), 1, MPI_INT, of_others.data(), 1, MPI_INT, all_);
        std::string told(offsets_of(of_others, offsets_of_others), '\0');
        MPI_Alltoallv(joined.data(), sizes.data(), offsets.data(), MPI_BYTE, told.data(), of_others.data(),
                      offsets_of_others.data(), MPI_BYTE, all_);
        return cut(told, of_others, offsets_of_others);
    }

    std::string do_scatter(const std::vector<std::string>& bytes) override {
        std::vector<int> sizes, offsets;
        std::string joined;
        if (rank_ == 0) joined = join(bytes, sizes, offsets);
        int mine = 0;
        MPI_Scatter(sizes.data(), 1, MPI_INT, &mine, 1, MPI_INT, 0, all_);
        std::string text(static_cast<std::size_t>(mine), '\0');
        MPI_Scatterv(joined.data(), sizes.data(), offsets.data(), MPI_BYTE, text.data(), mine, MPI_BYTE, 0, all_);
        return text;
    }

    std::string do_broadcast(std::string_view bytes, unsigned from) override {
        std::string text(rank() == from ? bytes : std::string_view());
        int size = int_size(text.size());
        MPI_Bcast(&size, 1, MPI_INT, static_cast<int>(from), all_);
        text.resize(static_cast<std::size_t>(size));
        MPI_Bcast(text.data(), size, MPI_BYTE, static_cast<int>(from), all_);
        return text;
    }

    void do_send(unsigned to, std::string_view bytes) override {
        const std::lock_guard lock(mutex_);
        sent_.remove_if([](Sent& sent) {
            int has_left = 0;
            MPI_Test(&sent.request, &has_left, MPI_STATUS_IGNORE);
            return has_left != 0;
        });
        Sent& sent = sent_.emplace_back(std::string(bytes));
        MPI_Isend(sent.bytes.data(), int_size(bytes.size()), MPI_BYTE, static_cast<int>(to), 0, all_, &sent.request);
    }

    bool do_has_bytes(unsigned from) override {
        const std::lock_guard lock(mutex_);
        int are_there = 0;
        MPI_Iprobe(static_cast<int>(from), 0, all_, &are_there, MPI_STATUS_IGNORE);
        return are_there != 0;
    }

    std::string do_receive(unsigned from) override {
        const std::lock_guard lock(mutex_);
        MPI_Status status;
        MPI_Probe(static_cast<int>(from), 0, all_, &status);
        int size = 0;
        MPI_Get_count(&status, MPI_BYTE, &size);
        std::string bytes(static_cast<std::size_t>(size), '\0');
        MPI_Recv(bytes.data(), size, MPI_BYTE, static_cast<int>(from), 0, all_, MPI_STATUS_IGNORE);
        return bytes;
    }

    void do_reset_counter() override {
        if (rank_ == 0) {
            const std::uint64_t zero = 0;
            std::uint64_t before = 0;
            MPI_Fetch_and_op(&zero, &before, MPI_UINT64_T, 0, 0, MPI_REPLACE, window_);
            MPI_Win_flush(0, window_);
        }
        MPI_Barrier(all_);
    }

    std::uint64_t do_add_to_counter(std::uint64_t number) override {
        const std::lock_guard lock(mutex_);
        std::uint64_t before = 0;
        MPI_Fetch_and_op(&number, &before, MPI_UINT64_T, 0, 0, MPI_SUM, window_);
        MPI_Win_flush(0, window_);
        return before;
    }

    std::unique_ptr<core::SharedFile> do_open_file(const std::filesystem::path& file,
                                                   const std::filesystem::path&) override {
        return std::make_unique<MpiFile>(all_, file);
    }

private:
    MPI_Comm all_ = MPI_COMM_NULL;
    int rank_ = 0, size_ = 1;
    MPI_Win window_ = MPI_WIN_NULL;
    std::uint64_t* counter_ = nullptr;  ///< on rank 0
    std::mutex mutex_;                  ///< guards MPI where several threads may call it

    /// Bytes that are on their way, perhaps.
    struct Sent {
        explicit Sent(std::string text) : bytes(std::move(text)) {}
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    std::list<Sent> sent_;

    /// Stores where each of several texts begins, and returns the size of all.
    static std::size_t offsets_of(const std::vector<int>& sizes, std::vector<int>& offsets) {
        std::size_t sum = 0;
        for (const int size : sizes) {
            offsets.push_back(int_size(sum));
            sum += static_cast<std::size_t>(size);
        }
        int_size(sum);
        return sum;
    }

    /// Joins texts, and stores how long they are and where they begin.
    static std::string join(const std::vector<std::string>& bytes, std::vector<int>& sizes, std::vector<int>& offsets) {
        std::string joined;
        for (const std::string& one : bytes) {
            sizes.push_back(int_size(one.size()));
            joined += one;
        }
        offsets_of(sizes, offsets);
        return joined;
    }

    /// Cuts joined texts apart.
    static std::vector<std::string> cut(const std::string& joined, const std::vector<int>& sizes,
                                        const std::vector<int>& offsets) {
        std::vector<std::string> all;
        for (std::size_t i = 0; i < sizes.size(); ++i)
            all.push_back(joined.substr(static_cast<std::size_t>(offsets[i]), static_cast<std::size_t>(sizes[i])));
        return all;
    }
};

}  // namespace

}  // namespace lamina::mpi

namespace lamina {

MpiSession::MpiSession(int& argc, char**& argv) {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) {
        MPI_Finalize();
        throw UsageError("this MPI cannot be called by several threads (MPI_THREAD_SERIALIZED)");
    }
    ranks_ = std::make_unique<mpi::MpiRanks>();
}

MpiSession::~MpiSession() {
    ranks_.reset();
    MPI_Finalize();
}

Ranks& MpiSession::ranks() { return *ranks_; }

void MpiSession::abort(int exit_code) {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
}

}  // namespace lamina
