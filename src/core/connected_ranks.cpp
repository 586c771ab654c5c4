// What all kinds of ranks have in common: the question before each collective function, and the count of what is sent.
#include "core/connected_ranks.hpp"

#include <exception>
#include <utility>

#include "core/packing.hpp"

namespace lamina::core {

namespace {

/// A number beyond all that are handed out, so that ranks that take numbers end soon.
constexpr std::uint64_t beyond_all = std::uint64_t{1} << 48;

}  // namespace

void ConnectedRanks::count(std::size_t bytes) {
    ++messages_;
    bytes_ += bytes;
}

void ConnectedRanks::agree() {
    count(sizeof(int));
    const unsigned failed = lowest_failed(false);
    if (failed == size()) return;
    const std::string packed = do_broadcast({}, failed);
    Unpacker failure(packed);
    const auto code = failure.get<ExitCode>();
    throw RankFailure(code, failure.get_text());
}

void ConnectedRanks::fail(ExitCode code, const std::string& line) {
    do_add_to_counter(beyond_all);
    Packer failure;
    failure.put(code);
    failure.put_text(line);
    const std::string packed = failure.take();
    count(sizeof(int) + packed.size());
    const unsigned failed = lowest_failed(true);
    const std::string of_lowest = do_broadcast(packed, failed);
    Unpacker lowest(of_lowest);
    const auto its_code = lowest.get<ExitCode>();
    throw RankFailure(its_code, lowest.get_text());
}

void ConnectedRanks::reset_counter() {
    agree();
    do_reset_counter();
}

std::uint64_t ConnectedRanks::next_number() {
    count(sizeof(std::uint64_t));
    return do_add_to_counter(1);
}

bool ConnectedRanks::has_failed() {
    count(sizeof(std::uint64_t));
    return do_add_to_counter(0) >= beyond_all;
}

std::vector<std::string> ConnectedRanks::gather(std::string_view bytes) {
    agree();
    count(rank() == 0 ? 0 : bytes.size());
    return do_gather(bytes);
}

//      rank   0   1   2   3   4   5
//             0 <-1   2 <-3   4 <-5
//             0 <---- 2       4
//             0 <------------ 4
std::string ConnectedRanks::reduce(std::string bytes, const Join& join) {
    agree();
    std::exception_ptr failure;
    for (unsigned step = 1; step < size(); step *= 2) {
        if (rank() % (2 * step) != 0) {
            count(bytes.size());
            do_send(rank() - step, std::exchange(bytes, {}));
            break;
        }
        if (rank() + step >= size()) continue;
        const std::string other = do_receive(rank() + step);
        // A rank that fails goes on as the others expect it to: they learn of it at the next question.
        try {
            if (!failure) bytes = join(bytes, other);
        } catch (...) {
            failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
    return bytes;
}

std::vector<std::string> ConnectedRanks::all_gather(std::string_view bytes) {
    agree();
    count((size() - 1) * bytes.size());
    return do_all_gather(bytes);
}

std::string ConnectedRanks::scatter(const std::vector<std::string>& bytes) {
    agree();
    std::size_t sent = 0;
    if (rank() == 0)
        for (std::size_t i = 1; i < bytes.size(); ++i) sent += bytes[i].size();
    count(sent);
    return do_scatter(bytes);
}

std::vector<std::string> ConnectedRanks::exchange(const std::vector<std::string>& bytes) {
    agree();
    std::size_t sent = 0;
    for (unsigned to = 0; to < size(); ++to)
        if (to != rank()) sent += bytes[to].size();
    count(sent);
    return do_exchange(bytes);
}

// As in reduce(), and then in the other direction.
std::vector<std::string> ConnectedRanks::all_gather_among(unsigned members, std::string_view bytes) {
    Packer packer;
    packer.put_text(bytes);
    std::string packed = packer.take();
    const auto send = [&](unsigned to) {
        count(packed.size());
        do_send(to, packed);
    };
    unsigned step = 1;
    for (; step < members && rank() % (2 * step) == 0; step *= 2)
        if (rank() + step < members) packed += do_receive(rank() + step);
    if (step < members) {
        send(rank() - step);
        packed = do_receive(rank() - step);
    }
    while ((step /= 2) > 0)
        if (rank() + step < members) send(rank() + step);
    std::vector<std::string> all;
    for (Unpacker unpacker(packed); !unpacker.at_end();) all.push_back(unpacker.get_text());
    return all;
}

std::unique_ptr<PendingGather> ConnectedRanks::start_all_gather(std::string_view bytes) {
    return std::unique_ptr<PendingGather>(new PendingGather(*this, bytes));
}

std::string ConnectedRanks::broadcast(std::string_view bytes) {
    agree();
    count(rank() == 0 ? (size() - 1) * bytes.size() : 0);
    return do_broadcast(bytes, 0);
}

std::unique_ptr<SharedFile> ConnectedRanks::open_file(const std::filesystem::path& file,
                                                      const std::filesystem::path& target) {
    agree();
    return do_open_file(file, target);
}

}  // namespace lamina::core
