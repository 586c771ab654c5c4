// Bytes of all ranks for all of them, sent from one to one, since collective functions of MPI get on only while all
// ranks wait in them.
#include "core/connected_ranks.hpp"

#include <algorithm>
#include <utility>

#include "core/packing.hpp"

namespace lamina::core {

namespace {

/// Each rank passes on what it is told to so many others: after three steps 585 ranks have it.
//
//             0
//      1   2   3  ...  8
//    9..16 ...      65..72
//
constexpr unsigned told_by_each = 8;

}  // namespace

PendingGather::PendingGather(ConnectedRanks& ranks, std::string_view bytes) : ranks_(ranks) {
    if (ranks_.rank() == 0) {
        collected_.emplace_back(bytes);
        advance(false);
    } else {
        ranks_.count(bytes.size());
        ranks_.do_send(0, bytes);
    }
}

PendingGather::~PendingGather() {
    // Those that this rank is to tell wait for it.
    try {
        const std::lock_guard lock(mutex_);
        advance(true);
    } catch (...) {
        // They end with this rank: nothing can be sent any more.
    }
}

bool PendingGather::is_there() {
    if (is_there_) return true;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    return lock.owns_lock() && advance(false);
}

std::vector<std::string> PendingGather::take() {
    const std::lock_guard lock(mutex_);
    advance(true);
    std::vector<std::string> texts;
    for (Unpacker unpacker(all_); !unpacker.at_end();) texts.push_back(unpacker.get_text());
    all_ = {};
    return texts;
}

bool PendingGather::advance(bool waits) {
    if (is_there_) return true;
    if (ranks_.rank() == 0) {
        while (collected_.size() < ranks_.size()) {
            const auto next = static_cast<unsigned>(collected_.size());
            if (!waits && !ranks_.do_has_bytes(next)) return false;
            collected_.push_back(ranks_.do_receive(next));
        }
        Packer packer;
        for (const std::string& bytes : std::exchange(collected_, {})) packer.put_text(bytes);
        all_ = packer.take();
    } else {
        const unsigned from = (ranks_.rank() - 1) / told_by_each;
        if (!waits && !ranks_.do_has_bytes(from)) return false;
        all_ = ranks_.do_receive(from);
    }
    pass_on();
    is_there_ = true;
    return true;
}

void PendingGather::pass_on() {
    const unsigned first = told_by_each * ranks_.rank() + 1, end = std::min(first + told_by_each, ranks_.size());
    for (unsigned to = first; to < end; ++to) {
        ranks_.count(all_.size());
        ranks_.do_send(to, all_);
    }
}

}  // namespace lamina::core
