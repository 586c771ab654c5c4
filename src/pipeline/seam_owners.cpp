#include "pipeline/seam_owners.hpp"

#include <limits>

namespace lamina::pipeline {

namespace {

constexpr std::uint32_t no_owner = std::numeric_limits<std::uint32_t>::max();

}  // namespace

SeamOwners::SeamOwners(const decoupling::CutRegion& cut, std::size_t layer_vertices, unsigned self)
    : layer_(layer_vertices),
      of_line_(cut.lines.size(), no_owner),
      of_junction_(cut.lines.junctions() - layer_vertices, no_owner),
      first_id_(cut.lines.size()),
      first_place_(cut.lines.size()),
      first_place_of_junction_(of_junction_.size()) {
    const decoupling::Lines& lines = cut.lines;
    const auto is_of_layer = [&](std::uint32_t line) { return lines.is_loop(line) && is_in_layer(lines.id(line, 0)); };
    for (std::size_t piece = 0; piece < cut.borders.size(); ++piece)
        cut.for_lines(piece, [&](std::uint32_t line) {
            if (std::uint32_t& owner = of_line_[line]; owner == no_owner)
                owner = is_of_layer(line) ? 0 : cut.borders[piece].process;
        });
    const auto own = [&](std::uint32_t owner, std::size_t vertices) {
        const auto first = static_cast<std::uint32_t>(own_vertices_);
        if (owner == self) own_vertices_ += vertices;
        return first;
    };
    for (std::uint32_t line = 0; line < lines.size(); ++line) {
        if (of_line_[line] == no_owner) of_line_[line] = 0;
        first_id_[line] = static_cast<std::uint32_t>(lines.first_inside(line).index());
        first_place_[line] = own(of_line_[line], lines.own_vertices(line));
        if (lines.is_loop(line)) continue;
        const decoupling::LineVertex from = lines.ends(line).first;
        if (from.line != decoupling::LineVertex::no_line || is_in_layer(from.id)) continue;
        if (std::uint32_t& owner = of_junction_[from.id.index() - layer_]; owner == no_owner) owner = of_line_[line];
    }
    for (std::size_t i = 0; i < of_junction_.size(); ++i) {
        if (of_junction_[i] == no_owner) of_junction_[i] = 0;
        first_place_of_junction_[i] = own(of_junction_[i], 1);
    }
}

}  // namespace lamina::pipeline
