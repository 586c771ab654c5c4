#include "decoupling/shared_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/packing.hpp"
#include "core/parallel.hpp"

namespace lamina::decoupling {

namespace {

using core::Packer;
using core::Unpacker;

/// What is known of a border that is cut. Smaller numbers are work_code() of one that is not.
constexpr std::uint8_t has_separator = 255;

/// Numbers of triangles within 6 % of each other as a number below 255: eight of them double the work.
constexpr int codes_per_doubling = 8;

std::uint8_t work_code(double triangles) {
    int exponent = 0;
    const double share = std::frexp(std::max(triangles, 1.0), &exponent);  // from 1/2 to below 1
    const int code = codes_per_doubling * (exponent - 1) + static_cast<int>((2 * share - 1) * codes_per_doubling);
    return static_cast<std::uint8_t>(std::min(code, has_separator - 1));
}

/// Returns the middle of the numbers of triangles with this code.
double decoded_work(std::uint8_t code) {
    const int steps = code % codes_per_doubling;
    return std::ldexp(1 + (steps + 0.5) / codes_per_doubling, code / codes_per_doubling);
}

void pack_end(LoopVertex end, Packer& packer) {
    packer.put_short(end.loop);
    packer.put_short(end.index);
}

LoopVertex unpack_end(Unpacker& unpacker) {
    const auto loop = static_cast<std::size_t>(unpacker.get_short());
    return {loop, static_cast<std::size_t>(unpacker.get_short())};
}

void pack_result(const SearchResult& result, Packer& packer) {
    if (result.separator) {
        packer.put(has_separator);
        pack_end(result.separator->from, packer);
        pack_end(result.separator->to, packer);
        packer.put_short(result.separator->vertices);
        return;
    }
    packer.put(work_code(result.estimate->triangles));
}

/// Takes what pack_result() has put there. The separator is still to be divided.
SearchResult unpack_result(Unpacker& unpacker) {
    SearchResult result;
    const auto found = unpacker.get<std::uint8_t>();
    if (found == has_separator) {
        const LoopVertex from = unpack_end(unpacker);
        const LoopVertex to = unpack_end(unpacker);
        result.separator = {from, to, static_cast<std::size_t>(unpacker.get_short())};
    } else {
        result.work = decoded_work(found);
    }
    return result;
}

}  // namespace

SearchDealer::SearchDealer(unsigned processes) : work_(processes, 0), in_round_(processes, 0), of_deal_(processes, 0) {
    for (unsigned process = 0; process < processes; ++process) least_.emplace_back(0, process);
}

void SearchDealer::begin_round() {
    in_round_.assign(in_round_.size(), 0);
    most_ = 0;
}

unsigned SearchDealer::deal(std::size_t vertices, unsigned process) {
    const std::uint64_t work = 2 * vertices;
    if (process == any_process) {
        while (least_.front().first != of_deal_[least_.front().second]) {
            std::pop_heap(least_.begin(), least_.end(), std::greater<>());
            least_.pop_back();
        }
        process = least_.front().second;
    }
    of_deal_[process] += work;
    least_.emplace_back(of_deal_[process], process);
    std::push_heap(least_.begin(), least_.end(), std::greater<>());
    work_[process] += work;
    in_round_[process] += work;
    most_ = std::max(most_, in_round_[process]);
    return process;
}

bool SearchDealer::deal_if_room(unsigned process, std::size_t vertices) {
    if (in_round_[process] + vertices > most_) return false;
    in_round_[process] += vertices;
    work_[process] += vertices;
    return true;
}

std::vector<SearchResult> search_together(Lines& lines, std::span<const DealtBorder> borders,
                                          const SeparatorSpacing& spacing, double pieces_target, Ranks& ranks) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < borders.size(); ++i)
        if (borders[i].process == ranks.rank()) own.push_back(i);
    std::vector<SearchResult> results(borders.size());
    core::parallel_for(own.size(), 1, [&](std::size_t i, std::size_t) {
        results[own[i]] = search_separator(localize(*borders[own[i]].border, lines, spacing), spacing, pieces_target);
    });
    Packer packer;
    for (const std::size_t i : own) pack_result(results[i], packer);
    const std::vector<std::string> told = ranks.all_gather(packer.take());
    std::vector<Unpacker> unpackers(told.begin(), told.end());
    for (std::size_t i = 0; i < borders.size(); ++i) {
        SearchResult& result = results[i];
        const unsigned process = borders[i].process;
        if (process != ranks.rank())
            result = unpack_result(unpackers[process]);
        else if (!result.separator)
            result.work = decoded_work(work_code(result.estimate->triangles));  // what the others know
        result.process = process;
    }
    return results;
}

std::vector<std::size_t> region_shares(std::size_t regions, unsigned processes) {
    std::vector<std::size_t> shares;
    for (unsigned process = 0; process <= processes; ++process) shares.push_back(regions * process / processes);
    return shares;
}

void number_together(Lines& lines, std::span<const unsigned> process, const SeparatorSpacing& spacing, Ranks& ranks) {
    std::vector<std::uint32_t> own;
    for (std::uint32_t line = 0; line < lines.size(); ++line)
        if (process[line] == ranks.rank() && !lines.is_loop(line)) own.push_back(line);
    core::parallel_for(own.size(), 1, [&](std::size_t i, std::size_t) { lines.divide(own[i], spacing); });
    Packer packer;
    for (const std::uint32_t line : own) packer.put_short(lines.divide(line, spacing));
    const std::vector<std::string> told = ranks.all_gather(packer.take());
    std::vector<Unpacker> unpackers(told.begin(), told.end());
    for (std::uint32_t line = 0; line < lines.size(); ++line)
        if (!lines.is_loop(line)) lines.number(line, unpackers[process[line]].get_short());
}

}  // namespace lamina::decoupling
