// Ranks that are threads of the test, in place of processes.
#pragma once

#include <atomic>
#include <barrier>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/connected_ranks.hpp"

namespace lamina::test {

/// What the threads share.
struct RankHub {
    RankHub(unsigned n, unsigned taker) : ranks(n), slots(n), from_to(n), sent(n), first_taker(taker), barrier(n) {}
    const unsigned ranks;  ///< their number
    std::vector<std::string> slots;
    std::vector<std::vector<std::string>> from_to;  ///< what each rank sends to each
    /// The messages that were sent to a rank and that it has not received yet, by their senders.
    struct Mailbox {
        std::mutex mutex;
        std::condition_variable more;
        std::map<unsigned, std::deque<std::string>> messages;
    };
    std::deque<Mailbox> sent;
    std::atomic<unsigned> lowest_failed{0};
    std::atomic<std::uint64_t> counter{0};
    std::atomic<unsigned> first_taker;  ///< the rank that takes the first number; size(): any
    std::mutex file_mutex;
    std::barrier<> barrier;
};

/// A file that the threads write to one after the other.
class ThreadFile : public core::SharedFile {
public:
    ThreadFile(const std::filesystem::path& file, RankHub& hub)
        : out_(file, std::ios::binary | std::ios::in | std::ios::out), hub_(hub) {}
    void write(const std::vector<Block>& blocks) override {
        {
            const std::lock_guard lock(hub_.file_mutex);
            for (const Block& block : blocks) {
                out_.seekp(static_cast<std::streamoff>(block.offset));
                out_.write(block.bytes.data(), static_cast<std::streamsize>(block.bytes.size()));
            }
            out_.flush();
        }
        hub_.barrier.arrive_and_wait();
    }
    std::string close() override { return out_ ? "" : "cannot write"; }

private:
    std::fstream out_;
    RankHub& hub_;
};

class ThreadRanks : public core::ConnectedRanks {
public:
    ThreadRanks(unsigned rank, RankHub& hub) : rank_(rank), hub_(hub) {}
    unsigned rank() const override { return rank_; }
    unsigned size() const override { return hub_.ranks; }

protected:
    unsigned lowest_failed(bool failed) override {
        if (rank_ == 0) hub_.lowest_failed = size();
        wait();
        if (failed)
            for (unsigned lowest = hub_.lowest_failed; rank_ < lowest;)
                if (hub_.lowest_failed.compare_exchange_weak(lowest, rank_)) break;
        wait();
        const unsigned lowest = hub_.lowest_failed;
        wait();
        return lowest;
    }
    std::vector<std::string> do_gather(std::string_view bytes) override {
        hub_.slots[rank_] = bytes;
        wait();
        std::vector<std::string> all;
        if (rank_ == 0) all = hub_.slots;
        wait();
        return all;
    }
    std::vector<std::string> do_all_gather(std::string_view bytes) override {
        hub_.slots[rank_] = bytes;
        wait();
        std::vector<std::string> all = hub_.slots;
        wait();
        return all;
    }
    std::string do_scatter(const std::vector<std::string>& bytes) override {
        if (rank_ == 0) hub_.slots = bytes;
        wait();
        std::string mine = hub_.slots[rank_];
        wait();
        return mine;
    }
    std::vector<std::string> do_exchange(const std::vector<std::string>& bytes) override {
        hub_.from_to[rank_] = bytes;
        wait();
        std::vector<std::string> told;
        for (const auto& from : hub_.from_to) told.push_back(from[rank_]);
        wait();
        return told;
    }
    std::string do_broadcast(std::string_view bytes, unsigned from) override {
        if (rank_ == from) hub_.slots[from] = bytes;
        wait();
        std::string text = hub_.slots[from];
        wait();
        return text;
    }
    void do_send(unsigned to, std::string_view bytes) override {
        RankHub::Mailbox& box = hub_.sent[to];
        {
            const std::lock_guard lock(box.mutex);
            box.messages[rank_].emplace_back(bytes);
        }
        box.more.notify_one();
    }
    bool do_has_bytes(unsigned from) override {
        return has_bytes(from, [](std::string_view) { return true; });
    }
    /// Returns whether the first bytes of a rank that this one has not received yet are there, and are such.
    template <class AreSuch>
    bool has_bytes(unsigned from, AreSuch&& are_such) {
        RankHub::Mailbox& box = hub_.sent[rank_];
        const std::lock_guard lock(box.mutex);
        const std::deque<std::string>& sent = box.messages[from];
        return !sent.empty() && are_such(sent.front());
    }
    std::string do_receive(unsigned from) override {
        RankHub::Mailbox& box = hub_.sent[rank_];
        std::unique_lock lock(box.mutex);
        std::deque<std::string>& sent = box.messages[from];
        box.more.wait(lock, [&] { return !sent.empty(); });
        std::string bytes = std::move(sent.front());
        sent.pop_front();
        return bytes;
    }
    void do_reset_counter() override {
        wait();
        hub_.counter = 0;
        wait();
    }
    std::uint64_t do_add_to_counter(std::uint64_t number) override {
        if (number == 0) return hub_.counter;  // only asks whether a rank has failed
        while (hub_.first_taker != size() && hub_.first_taker != rank_) std::this_thread::yield();
        const std::uint64_t taken = hub_.counter.fetch_add(number);
        hub_.first_taker = size();
        return taken;
    }
    std::unique_ptr<core::SharedFile> do_open_file(const std::filesystem::path& file,
                                                   const std::filesystem::path&) override {
        if (rank_ == 0) std::ofstream(file, std::ios::binary | std::ios::app);
        wait();
        return std::make_unique<ThreadFile>(file, hub_);
    }
    /// Returns once all threads have called it.
    virtual void wait() { hub_.barrier.arrive_and_wait(); }

private:
    unsigned rank_;
    RankHub& hub_;
};

/// Calls work(ranks) as each of `n` ranks at once. What it throws goes through Ranks::fail(), as in the program, and
/// the line that all ranks end with is returned; empty: none has failed. `first_taker` is the rank that takes the first
/// piece.
template <class RankClass = ThreadRanks, class Work>
std::string run_ranks(unsigned n, Work&& work, std::optional<unsigned> first_taker = {}) {
    RankHub hub(n, first_taker.value_or(n));
    std::vector<std::string> lines(n);
    const auto run = [&](unsigned rank) {
        RankClass ranks(rank, hub);
        try {
            try {
                work(ranks);
                ranks.agree();
            } catch (const RankFailure&) {
                throw;
            } catch (const Error& error) {
                ranks.fail(error.exit_code(), error.what());
            } catch (const std::exception& error) {
                ranks.fail(ExitCode::mesh_failed, error.what());
            }
        } catch (const RankFailure& failure) {
            lines[rank] = failure.what();
        }
    };
    std::vector<std::thread> threads;
    for (unsigned rank = 0; rank < n; ++rank) threads.emplace_back(run, rank);
    for (std::thread& thread : threads) thread.join();
    for (const std::string& line : lines)
        if (line != lines.front()) return "ranks end differently: '" + line + "' and '" + lines.front() + "'";
    return lines.front();
}

}  // namespace lamina::test
