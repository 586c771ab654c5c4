// How the processes of a run (ranks.hpp) speak with each other. Transports derive from ConnectedRanks: src/mpi does.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/export.hpp>
#include <lamina/ranks.hpp>

namespace lamina::core {

/// A file that all processes write together.
class LAMINA_EXPORT SharedFile {
public:
    /// Bytes at a place in the file.
    struct Block {
        std::uint64_t offset = 0;  ///< from the begin of the file
        std::string_view bytes{};  ///< what stands there
    };

    SharedFile() = default;
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;
    virtual ~SharedFile() = default;

    /// Collective: writes the blocks of each process, which ascend and do not overlap. A failure is kept for close().
    virtual void write(const std::vector<Block>& blocks) = 0;
    /// Collective: closes the file. Returns what has failed in this process; empty: nothing.
    virtual std::string close() = 0;
};

class ConnectedRanks;

/// A PendingGather brings the bytes of all ranks to all of them while each goes on with its work:
/// ConnectedRanks::start_all_gather() makes one on each rank. Rank 0 collects the bytes, and each rank that has got
/// them passes them on to some others. So a rank should ask is_there() now and then; where the object ends, it waits
/// for the bytes, whatever has happened.
class LAMINA_EXPORT PendingGather {
public:
    PendingGather(const PendingGather&) = delete;
    PendingGather& operator=(const PendingGather&) = delete;
    ~PendingGather();

    /// Returns whether all is there. Any thread may call it, and no rank waits for another.
    bool is_there();
    /// Waits for the bytes of all ranks, and returns them in their order. May be called once, and by one thread.
    std::vector<std::string> take();

private:
    friend class ConnectedRanks;
    PendingGather(ConnectedRanks& ranks, std::string_view bytes);
    /// Receives what has come, or waits for what has not. Returns whether the bytes of all ranks are there.
    bool advance(bool waits);
    /// Sends the bytes of all ranks to those that this one is to tell.
    void pass_on();

    ConnectedRanks& ranks_;
    std::vector<std::string> collected_;  ///< on rank 0: the bytes of the first ranks
    std::string all_;                     ///< the bytes of all ranks, once they are there
    std::atomic<bool> is_there_ = false;
    std::mutex mutex_;  ///< guards all of the above
};

/// Ranks with all that they can tell each other. Functions marked as collective are as those of Ranks.
class LAMINA_EXPORT ConnectedRanks : public Ranks {
public:
    /// Collective: sets the counter that all ranks share to 0.
    void reset_counter();
    /// Returns the counter and adds 1 to it, at once for all ranks. Any thread may call it, and no rank waits for
    /// another.
    std::uint64_t next_number();
    /// Returns whether a rank has failed since the counter was set to 0. Any thread may call it, and no rank waits for
    /// another.
    bool has_failed();

    void agree() override;
    std::vector<std::string> gather(std::string_view bytes) override;
    /// Joins the bytes of two ranks, those of the lower one first.
    using Join = std::function<std::string(std::string_view, std::string_view)>;
    /// Collective: returns on rank 0 what `join` makes of the bytes of all ranks; nothing elsewhere. Ranks join them
    /// pairwise, so that none calls `join` more often than the logarithm of their number. It does not matter to the
    /// result of `join` which bytes are joined first.
    std::string reduce(std::string bytes, const Join& join);
    /// Collective: returns the bytes of all ranks, in their order, on all of them.
    std::vector<std::string> all_gather(std::string_view bytes);
    /// Returns the bytes of the first ranks, in their order, on all of these. So many of them call it, and no other
    /// rank. Nobody asks whether a rank has failed, and one that has must call it still.
    std::vector<std::string> all_gather_among(unsigned members, std::string_view bytes);
    /// Gives all ranks the bytes of all of them, and waits for nobody. All ranks call it. Nobody asks whether a rank
    /// has failed, and one that has must call it still. Other collective functions are to be called once it has ended.
    std::unique_ptr<PendingGather> start_all_gather(std::string_view bytes);
    /// Collective: returns on each rank the bytes that rank 0 has for it. The argument of other ranks does not count.
    std::string scatter(const std::vector<std::string>& bytes);
    /// Collective: sends each rank the bytes that are meant for it, of which there is one string for each rank. Returns
    /// the bytes of all ranks for this one, in their order.
    std::vector<std::string> exchange(const std::vector<std::string>& bytes);
    /// Collective: returns the bytes of rank 0.
    std::string broadcast(std::string_view bytes);
    /// Collective: opens a file, or creates it, for all ranks to write to. Throws IoError about the target on ranks
    /// that cannot open it.
    std::unique_ptr<SharedFile> open_file(const std::filesystem::path& file, const std::filesystem::path& target);

    [[noreturn]] void fail(ExitCode code, const std::string& line) override;
    RankTraffic traffic() const override { return {messages_, bytes_}; }

protected:
    /// Collective, as all of these: returns the lowest rank that has failed, or size().
    virtual unsigned lowest_failed(bool failed) = 0;
    /// Returns what gather() returns.
    virtual std::vector<std::string> do_gather(std::string_view bytes) = 0;
    /// Returns what all_gather() returns.
    virtual std::vector<std::string> do_all_gather(std::string_view bytes) = 0;
    /// Returns what scatter() returns.
    virtual std::string do_scatter(const std::vector<std::string>& bytes) = 0;
    /// Returns what exchange() returns.
    virtual std::vector<std::string> do_exchange(const std::vector<std::string>& bytes) = 0;
    /// Returns the bytes of rank `from`.
    virtual std::string do_broadcast(std::string_view bytes, unsigned from) = 0;
    /// Sends bytes to one rank, which receives them in the order in which they were sent. Does not wait for it. Any
    /// thread may call it, and the next two.
    virtual void do_send(unsigned to, std::string_view bytes) = 0;
    /// Returns whether bytes of one rank are there that this one has not received yet.
    virtual bool do_has_bytes(unsigned from) = 0;
    /// Waits for the bytes that one rank sends to this one, and returns them.
    virtual std::string do_receive(unsigned from) = 0;
    /// Sets the counter to 0.
    virtual void do_reset_counter() = 0;
    /// Returns what open_file() returns.
    virtual std::unique_ptr<SharedFile> do_open_file(const std::filesystem::path& file,
                                                     const std::filesystem::path& target) = 0;
    /// Not collective: returns the counter and adds a number to it. Any thread may call it.
    virtual std::uint64_t do_add_to_counter(std::uint64_t number) = 0;

private:
    friend class PendingGather;
    std::atomic<std::size_t> messages_ = 0, bytes_ = 0;

    void count(std::size_t bytes);
};

/// Returns the same ranks: there are no others.
inline ConnectedRanks& connected(Ranks& ranks) { return static_cast<ConnectedRanks&>(ranks); }

}  // namespace lamina::core
