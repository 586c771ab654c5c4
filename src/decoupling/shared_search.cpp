#include "decoupling/shared_search.hpp"

#include <algorithm>
#include <cassert>
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
std::uint64_t work_of(const SubdomainBorder& border) {
    std::uint64_t vertices = 0;
    for (const auto& loop : border.loops) vertices += loop.size();
    return vertices;
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
        packer.put(Found::separator);
        pack_end(result.separator->from, packer);
        pack_end(result.separator->to, packer);
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
        result.separator = {from, unpack_end(unpacker), {}};
    } else {
        result.estimate.lattice = found == Found::nothing;
        result.estimate.triangles = unpacker.get<double>();
    }
    return result;
}

}  // namespace

SearchDealer::SearchDealer(unsigned processes) {
    for (unsigned process = 0; process < processes; ++process) heap_.emplace_back(0, process);
}

unsigned SearchDealer::deal(const SubdomainBorder& border) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    auto& [work, process] = heap_.back();
    work += work_of(border);
    most_ = std::max(most_, work);
    const unsigned dealt_to = process;
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    return dealt_to;
}

bool SearchDealer::has_room(const SubdomainBorder& border) const {
    return heap_.front().first + work_of(border) <= most_;
}

std::vector<SearchResult> search_together(std::span<const Point> points, std::span<const DealtBorder> borders,
                                          const SeparatorSpacing& spacing, double pieces_target, Ranks& ranks) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < borders.size(); ++i)
        if (borders[i].process == ranks.rank()) own.push_back(i);
    std::vector<SearchResult> results(borders.size());
    core::parallel_for(own.size(), 1, [&](std::size_t i, std::size_t) {
        results[own[i]] = search_separator(points, *borders[own[i]].border, spacing, pieces_target);
    });
    Packer packer;
    for (const std::size_t i : own) pack_result(results[i], packer);
    const std::vector<std::string> told = ranks.all_gather(packer.take());

    std::vector<Unpacker> unpackers(told.begin(), told.end());
    std::vector<std::size_t> undivided;
    for (std::size_t i = 0; i < borders.size(); ++i) {
        if (borders[i].process == ranks.rank()) continue;
        results[i] = unpack_result(unpackers[borders[i].process]);
        if (results[i].separator) undivided.push_back(i);
    }
    core::parallel_for(undivided.size(), 1, [&](std::size_t k, std::size_t) {
        const auto& loops = borders[undivided[k]].border->loops;
        Separator& separator = *results[undivided[k]].separator;
        const auto at = [&](LoopVertex v) { return points[loops[v.loop][v.index].index()]; };
        separator.interior = divide_separator(at(separator.from), at(separator.to), spacing);
    });
    return results;
}

}  // namespace lamina::decoupling
