#include "decoupling/shared_search.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "core/packing.hpp"
#include "core/parallel.hpp"

namespace lamina::decoupling {

namespace {

using core::Packer;
using core::Unpacker;

/// What is known of a border once it is searched.
enum class Found : std::uint8_t { nothing, nothing_without_lattice, separator };

/// The time of a search is about in proportion to the vertices of the border.
std::uint64_t work_of(const LineBorder& border) { return border.vertices(); }

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
        packer.put(Found::separator);
        pack_end(result.separator->from, packer);
        pack_end(result.separator->to, packer);
        packer.put_short(result.separator->vertices);
        return;
    }
    packer.put(result.estimate.lattice ? Found::nothing : Found::nothing_without_lattice);
    packer.put(result.estimate.triangles);
}

/// Takes what pack_result() has put there. The separator is still to be divided.
SearchResult unpack_result(Unpacker& unpacker) {
    SearchResult result;
    const auto found = unpacker.get<Found>();
    if (found == Found::separator) {
        const LoopVertex from = unpack_end(unpacker);
        const LoopVertex to = unpack_end(unpacker);
        result.separator = {from, to, static_cast<std::size_t>(unpacker.get_short())};
    } else {
        result.estimate.lattice = found == Found::nothing;
        result.estimate.triangles = unpacker.get<double>();
    }
    return result;
}

}  // namespace

SearchDealer::SearchDealer(unsigned processes) : work_(processes, 0) {
    for (unsigned process = 0; process < processes; ++process) dealt_.emplace_back(0, process);
}

void SearchDealer::begin_round() {
    work_.assign(work_.size(), 0);
    most_ = 0;
}

unsigned SearchDealer::deal(const LineBorder& border) {
    std::pop_heap(dealt_.begin(), dealt_.end(), std::greater<>());
    auto& [work, process] = dealt_.back();
    work += work_of(border);
    const unsigned dealt_to = process;
    std::push_heap(dealt_.begin(), dealt_.end(), std::greater<>());
    deal_to(dealt_to, border);
    return dealt_to;
}

void SearchDealer::deal_to(unsigned process, const LineBorder& border) {
    work_[process] += work_of(border);
    most_ = std::max(most_, work_[process]);
}

bool SearchDealer::has_room(unsigned process, const LineBorder& border) const {
    return work_[process] + work_of(border) <= most_;
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
        if (borders[i].process != ranks.rank()) results[i] = unpack_result(unpackers[borders[i].process]);
        results[i].process = borders[i].process;
    }
    return results;
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
