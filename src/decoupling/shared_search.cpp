#include "decoupling/shared_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/difference_packing.hpp"
#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "decoupling/cut_region.hpp"

namespace lamina::decoupling {

namespace {

using core::Packer;
using core::Unpacker;

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

void pack_separator(const Separator& separator, Packer& packer) {
    pack_end(separator.from, packer);
    pack_end(separator.to, packer);
    packer.put_short(separator.vertices);
}

Separator unpack_separator(Unpacker& unpacker) {
    const LoopVertex from = unpack_end(unpacker);
    const LoopVertex to = unpack_end(unpacker);
    return {from, to, static_cast<std::size_t>(unpacker.get_short())};
}

}  // namespace

void pack_result(const SearchResult& result, Packer& packer) {
    if (result.separator) {
        packer.put(has_separator);
        pack_separator(*result.separator, packer);
        return;
    }
    packer.put(work_code(result.work));
}

SearchResult unpack_result(Unpacker& unpacker) {
    SearchResult result;
    const auto found = unpacker.get<std::uint8_t>();
    if (found == has_separator)
        result.separator = unpack_separator(unpacker);
    else
        result.work = decoded_work(found);
    return result;
}

void make_as_told(SearchResult& result) {
    if (!result.separator) result.work = decoded_work(work_code(result.work));
}

void ResultsPacker::put(const SearchResult& result) {
    codes_.put(result.separator ? has_separator : work_code(result.work));
    if (result.separator) pack_separator(*result.separator, separators_);
}

void ResultsPacker::finish(Packer& packer) {
    packer.put_text(codes_.take());
    packer.put_bytes(separators_.take());
}

bool ResultsUnpacker::next_is_cut() {
    const auto code = static_cast<std::uint8_t>(codes_.get());
    if (code == has_separator) return true;
    // Most are equal to the one before.
    if (code != std::exchange(code_, code)) work_ = static_cast<float>(decoded_work(code));
    return false;
}

Separator ResultsUnpacker::separator() { return unpack_separator(separators_); }

SearchDealer::SearchDealer(unsigned processes) : work_(processes, 0) {
    for (unsigned process = 0; process < processes; ++process) least_.emplace_back(0, process);
}

unsigned SearchDealer::deal(std::size_t vertices, unsigned process) {
    if (process == any_process) {
        while (least_.front().first != work_[least_.front().second]) {
            std::pop_heap(least_.begin(), least_.end(), std::greater<>());
            least_.pop_back();
        }
        process = least_.front().second;
    }
    work_[process] += vertices;
    least_.emplace_back(work_[process], process);
    std::push_heap(least_.begin(), least_.end(), std::greater<>());
    return process;
}

std::vector<SearchResult> search_together(Lines& lines, std::span<const DealtBorder> borders, const SizeField& size,
                                          double pieces_target, core::ConnectedRanks& ranks) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < borders.size(); ++i)
        if (borders[i].process == ranks.rank()) own.push_back(i);
    std::vector<SearchResult> results(borders.size());
    core::parallel_for(own.size(), 1, [&](std::size_t i, std::size_t) {
        results[own[i]] = search_separator(localize(*borders[own[i]].border, lines, size), size, pieces_target);
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
        else
            make_as_told(result);
        result.process = process;
    }
    return results;
}

unsigned cutting_processes(std::size_t others, unsigned processes) {
    // Few processes lose little while most of them wait, in the first rounds, and nobody waits for them while there are
    // other pieces to make. There are 130 pieces round a body and more: fewer than eight processes would have too many
    // of them, and of the edges between them. Where there is little else to do, or one process would have most of the
    // work, all cut.
    if (others < processes || processes < 4) return processes;
    return std::max(processes / 32, std::min(processes / 4, 8u));
}

std::vector<std::size_t> region_shares(std::size_t regions, unsigned processes) {
    unsigned cutting = cutting_processes(regions, processes);
    if (cutting == processes) cutting = 0;
    std::vector<std::size_t> shares(cutting + 1, 0);
    for (unsigned process = cutting + 1; process <= processes; ++process)
        shares.push_back(regions * (process - cutting) / (processes - cutting));
    return shares;
}

void number_together(Lines& lines, std::span<const LineRun> runs, const SizeField& size, core::ConnectedRanks& ranks) {
    std::vector<std::uint32_t> own;
    for (const LineRun& run : runs)
        for (std::uint32_t line = run.begin; run.process == ranks.rank() && line < run.end; ++line) own.push_back(line);
    core::parallel_for(own.size(), 1, [&](std::size_t i, std::size_t) { lines.divide(own[i], size); });
    core::DifferencePacker numbers;
    for (const std::uint32_t line : own) numbers.put(static_cast<std::uint32_t>(lines.divide(line, size)));
    Packer packer;
    packer.put(hash_of_lines(lines));
    packer.put_bytes(numbers.take());
    const std::vector<std::string> told = ranks.all_gather(packer.take());
    require_same_hashes(told, sizeof(LinesHash));
    std::vector<core::DifferenceUnpacker> unpackers;
    unpackers.reserve(told.size());
    for (const std::string& text : told) unpackers.emplace_back(std::string_view(text).substr(sizeof(LinesHash)));
    for (const LineRun& run : runs) {
        core::DifferenceUnpacker unpacker = unpackers[run.process];
        for (std::uint32_t line = run.begin; line < run.end; ++line) lines.number(line, unpacker.get());
        unpackers[run.process] = unpacker;
    }
}

}  // namespace lamina::decoupling
