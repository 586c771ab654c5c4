// Processes compare hashes of what they have cut.
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/packing.hpp"
#include "core/word_hash.hpp"
#include "decoupling/cut_region.hpp"

namespace lamina::decoupling {

LinesHash hash_of_lines(const Lines& lines) {
    core::WordHash hash;
    for (std::size_t i = 0; i < lines.junctions(); ++i) hash.add(lines.point(LineVertex{VertexId{i}}));
    for (const LineRow& row : lines.rows())
        for (const std::uint32_t number :
             {row.count, row.first_from, row.from_step, row.first_to, row.to_step, row.to_shift, row.min_segments})
            hash.add(std::uint64_t{number});
    // Before the rows there are loops alone, and behind them nothing yet.
    for (std::uint32_t line = 0; line < lines.size() && !lines.is_in_row(line); ++line)
        for (std::uint32_t i = 0; i < lines.segments(line); ++i) hash.add(lines.point(line, i));
    hash.add(std::uint64_t{lines.vertices()});
    return static_cast<LinesHash>(hash.value() >> 48);
}

void require_same_hashes(std::span<const std::string> told, std::size_t bytes_of_hash) {
    const auto hash_of = [&](const std::string& text) { return std::string_view(text).substr(0, bytes_of_hash); };
    for (std::size_t rank = 0; rank < told.size(); ++rank)
        if (hash_of(told[rank]) != hash_of(told.front()))
            throw MeshError(
                fmt::format("process {} has cut the domain in another way than process 0: all must run the same "
                            "program on the same input",
                            rank));
}

void require_same_borders(const CutRegion& cut, core::ConnectedRanks& ranks) {
    const Lines& lines = cut.lines;
    core::WordHash hash;
    hash.add(std::uint64_t{lines.vertices()});
    // The numbers of vertices of two lines, at a time.
    for (std::uint32_t line = 0; line < lines.size(); line += 2)
        hash.add(std::uint64_t{lines.segments(line)} << 32 |
                 (line + 1 < lines.size() ? lines.segments(line + 1) : std::uint32_t{0}));
    for (const EstimatedBorder& estimated : cut.borders) {
        hash.add(std::uint64_t{std::bit_cast<std::uint32_t>(estimated.work)} << 32 | estimated.process);
        hash.add(std::uint64_t{estimated.trapezoid});
        if (!estimated.border) continue;
        for (const LineLoop& loop : estimated.border->loops)
            for (const Stretch& stretch : loop.stretches)
                hash.add((std::uint64_t{stretch.line} << 40) ^ (std::uint64_t{stretch.first} << 20) ^ stretch.last);
    }
    core::Packer packer;
    packer.put(hash.value());
    require_same_hashes(ranks.gather(packer.take()), sizeof hash.value());
}

}  // namespace lamina::decoupling
