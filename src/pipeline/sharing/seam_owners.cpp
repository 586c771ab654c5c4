#include "pipeline/sharing/seam_owners.hpp"

#include <algorithm>
#include <limits>

namespace lamina::pipeline {

namespace {

using decoupling::LineRun;

constexpr std::uint32_t no_owner = std::numeric_limits<std::uint32_t>::max();

}  // namespace

SeamOwners::SeamOwners(const decoupling::CutRegion& cut, std::size_t layer_vertices, unsigned self)
    : lines_(cut.lines),
      runs_(cut.rings.runs()),
      layer_(layer_vertices),
      rows_begin_(cut.lines.first_in_rows()),
      lines_in_rows_(cut.lines.lines_in_rows()) {
    find_owners_of_others(cut);
    find_own_vertices(self);
}

void SeamOwners::find_owners_of_others(const decoupling::CutRegion& cut) {
    of_other_line_.assign(lines_.size() - lines_in_rows_, no_owner);
    const auto is_of_layer = [&](std::uint32_t line) {
        return lines_.is_loop(line) && is_in_layer(lines_.id(line, 0));
    };
    for (const decoupling::EstimatedBorder& piece : cut.borders) {
        if (!piece.border) continue;
        for (const decoupling::LineLoop& loop : piece.border->loops)
            for (const decoupling::Stretch& stretch : loop.stretches) {
                if (lines_.is_in_row(stretch.line)) continue;
                std::uint32_t& owner = of_other_line_[other_line(stretch.line)];
                if (owner == no_owner) owner = is_of_layer(stretch.line) ? 0 : piece.process;
            }
    }
    std::replace(of_other_line_.begin(), of_other_line_.end(), no_owner, 0u);
}

void SeamOwners::find_own_vertices(unsigned self) {
    const auto add = [&](std::size_t begin, std::size_t end) {
        if (begin < end) own_.push_back({begin, end, own_vertices()});
    };
    const auto add_lines = [&](std::uint32_t begin, std::uint32_t end) {
        add(lines_.first_inside(begin).index(), lines_.first_inside(end - 1).index() + lines_.own_vertices(end - 1));
    };
    std::vector<LineRun> own_runs;
    for (const LineRun& run : runs_)
        if (run.process == self) own_runs.push_back(run);
    if (runs_.empty() && self == 0 && lines_in_rows_ > 0)
        own_runs.push_back({rows_begin_, rows_begin_ + lines_in_rows_, 0});
    // Junctions come before the vertices of lines.
    const std::size_t junctions = lines_.junctions() - layer_;
    for (const LineRun& run : own_runs)
        add(layer_ + run.begin - rows_begin_, layer_ + std::min<std::size_t>(run.end - rows_begin_, junctions));
    const auto add_others = [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t line = begin; line < end; ++line)
            if (of_other_line_[other_line(line)] == self) add_lines(line, line + 1);
    };
    add_others(0, rows_begin_);
    for (const LineRun& run : own_runs) add_lines(run.begin, run.end);
    add_others(rows_begin_ + lines_in_rows_, static_cast<std::uint32_t>(lines_.size()));
}

unsigned SeamOwners::owner_in_rows(std::uint32_t line) const {
    if (runs_.empty()) return 0;
    return std::upper_bound(runs_.begin(), runs_.end(), line,
                            [](std::uint32_t number, const LineRun& run) { return number < run.end; })
        ->process;
}

unsigned SeamOwners::owner(const decoupling::LineVertex& v) const {
    if (v.line != decoupling::LineVertex::no_line) return owner(v.line);
    // The first lines in rows begin at the junctions, in their order.
    return is_in_layer(v.id) ? 0u : owner_in_rows(static_cast<std::uint32_t>(rows_begin_ + v.id.index() - layer_));
}

std::size_t SeamOwners::place(VertexId v) const {
    const auto at = std::upper_bound(own_.begin(), own_.end(), v.index(),
                                     [](std::size_t id, const OwnVertices& run) { return id < run.end; });
    return at->place + (v.index() - at->begin);
}

}  // namespace lamina::pipeline
