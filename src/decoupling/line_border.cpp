#include "decoupling/line_border.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

namespace lamina::decoupling {

namespace {

/// Adds the part of a loop between two of its vertices, from the one to the other; the whole loop where both are the
/// same.
void append_part(const LineLoop& loop, std::size_t from, std::size_t to, LineLoop& part) {
    assert(from < loop.vertices && to < loop.vertices);
    std::size_t left = to > from ? to - from : to + loop.vertices - from;
    std::size_t i = 0;
    for (; from >= loop.stretches[i].segments(); ++i) from -= loop.stretches[i].segments();
    for (; left > 0; i = i + 1 < loop.stretches.size() ? i + 1 : 0) {
        const Stretch& stretch = loop.stretches[i];
        const auto begin = static_cast<std::uint32_t>(from);
        const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(stretch.segments(), from + left));
        part.add({stretch.line, stretch.place(begin), stretch.place(end)});
        left -= end - begin;
        from = 0;
    }
}

/// Returns whether a loop runs along a line in both directions.
bool runs_both_ways(const LineLoop& loop) {
    const auto& stretches = loop.stretches;
    for (std::size_t i = 0; i < stretches.size(); ++i)
        for (std::size_t j = i + 1; j < stretches.size(); ++j)
            if (stretches[i].line == stretches[j].line &&
                (stretches[i].first < stretches[i].last) != (stretches[j].first < stretches[j].last))
                return true;
    return false;
}

Stretch reversed(const Stretch& stretch) { return {stretch.line, stretch.last, stretch.first}; }

/// Successive vertices of a loop whose ids ascend or descend one by one.
struct IdRun {
    std::uint32_t first_id = 0;  ///< the lowest
    std::uint32_t count = 0;
    std::uint32_t line = 0, place = 0;  ///< of the vertex with the lowest id
    bool ascends = true;
    std::uint32_t local = 0;  ///< of that vertex, once it is numbered
};

/// Calls f for the runs of a stretch without its last vertex.
template <class F>
void for_runs(const Stretch& stretch, const Lines& lines, F&& f) {
    const std::uint32_t n = stretch.segments();
    const bool ascends = stretch.first < stretch.last;
    const auto single = [&](std::uint32_t place) {
        f(IdRun{lines.id(stretch.line, place).value, 1, stretch.line, place, true, 0});
    };
    if (lines.is_loop(stretch.line)) {
        for (std::uint32_t i = 0; i < n; ++i) single(stretch.place(i));
        return;
    }
    const bool begins_at_end = stretch.first == 0 || stretch.first == lines.segments(stretch.line);
    const std::uint32_t skipped = begins_at_end ? 1 : 0;
    if (begins_at_end) single(stretch.first);
    if (n == skipped) return;
    const std::uint32_t lowest = ascends ? stretch.first + skipped : stretch.last + 1;
    f(IdRun{lines.id(stretch.line, lowest).value, n - skipped, stretch.line, lowest, ascends, 0});
}

/// Numbers the vertices of runs, in which some may stand twice, in ascending order of their ids.
void number_runs(std::vector<IdRun*>& by_id, const Lines& lines, LocalBorder& local) {
    std::sort(by_id.begin(), by_id.end(), [](const IdRun* a, const IdRun* b) { return a->first_id < b->first_id; });
    for (IdRun* run : by_id) {
        // Vertices that stand twice belong to runs that overlap; those before have all lower ids, one after the other.
        const std::uint32_t last = local.global.empty() ? 0 : local.global.back().value;
        std::uint32_t known = 0;
        if (!local.global.empty() && run->first_id <= last) known = std::min(run->count, last - run->first_id + 1);
        const auto begin = std::lower_bound(local.global.begin(), local.global.end(), VertexId{run->first_id});
        run->local = static_cast<std::uint32_t>(begin - local.global.begin());
        for (std::uint32_t k = known; k < run->count; ++k) {
            local.global.push_back(VertexId{run->first_id + k});
            local.points.push_back(lines.point(run->line, run->place + k));
        }
    }
}

}  // namespace

std::vector<VertexId> ids_of(const LineLoop& loop, const Lines& lines) {
    std::vector<VertexId> ids;
    ids.reserve(loop.vertices);
    for (const Stretch& stretch : loop.stretches)
        for_runs(stretch, lines, [&](const IdRun& run) {
            for (std::uint32_t k = 0; k < run.count; ++k)
                ids.push_back(VertexId{run.ascends ? run.first_id + k : run.first_id + run.count - 1 - k});
        });
    assert(ids.size() == loop.vertices);
    return ids;
}

LineVertex vertex_of(const LineBorder& border, LoopVertex at, const Lines& lines) {
    std::size_t index = at.index;
    for (const Stretch& stretch : border.loops[at.loop].stretches) {
        if (index < stretch.segments())
            return lines.vertex(stretch.line, stretch.place(static_cast<std::uint32_t>(index)));
        index -= stretch.segments();
    }
    assert(false);
    return {};
}

LocalBorder localize(const LineBorder& border, Lines& lines, const SizeField& size) {
    LocalBorder local;
    std::vector<IdRun> runs;
    std::vector<std::size_t> runs_end;  // per loop
    for (const LineLoop& loop : border.loops) {
        for (const Stretch& stretch : loop.stretches) {
            lines.divide(stretch.line, size);
            for_runs(stretch, lines, [&](const IdRun& run) { runs.push_back(run); });
        }
        runs_end.push_back(runs.size());
        local.loops.push_back(loop.vertices);
    }
    std::vector<IdRun*> by_id;
    by_id.reserve(runs.size());
    for (IdRun& run : runs) by_id.push_back(&run);
    const std::size_t vertices = border.vertices();
    local.global.reserve(vertices);
    local.points.reserve(vertices);
    number_runs(by_id, lines, local);
    local.segments.reserve(vertices);
    std::size_t next = 0;
    for (const std::size_t end : runs_end) {
        const std::size_t first_segment = local.segments.size();
        for (; next < end; ++next) {
            const IdRun& run = runs[next];
            for (std::uint32_t k = 0; k < run.count; ++k) {
                const VertexId v{static_cast<std::size_t>(run.ascends ? run.local + k : run.local + run.count - 1 - k)};
                if (local.segments.size() > first_segment) local.segments.back().b = v;
                local.segments.push_back({v, v});
            }
        }
        if (local.segments.size() > first_segment) local.segments.back().b = local.segments[first_segment].a;
    }
    assert(local.segments.size() == vertices && local.points.size() == local.global.size());
    assert(std::adjacent_find(local.global.begin(), local.global.end(), std::greater_equal<>()) == local.global.end());
    return local;
}

BorderHalves split(const LineBorder& border, std::size_t from, std::size_t to, const Stretch& line) {
    assert(border.loops.size() == 1 && from != to);
    LineLoop first, second;
    first.add(line);
    append_part(border.loops.front(), to, from, first);
    second.add(reversed(line));
    append_part(border.loops.front(), from, to, second);
    assert(first.vertices + second.vertices == border.vertices() + std::size_t{2} * line.segments());
    const bool first_may_dangle = border.may_dangle && runs_both_ways(first);
    const bool second_may_dangle = border.may_dangle && runs_both_ways(second);
    return {{{std::move(first)}, first_may_dangle}, {{std::move(second)}, second_may_dangle}};
}

LineBorder join(const LineBorder& border, LoopVertex from, LoopVertex to, const Stretch& line) {
    assert(from.loop != to.loop && from.loop < border.loops.size() && to.loop < border.loops.size());
    LineLoop joined;
    append_part(border.loops[from.loop], from.index, from.index, joined);
    joined.add(line);
    append_part(border.loops[to.loop], to.index, to.index, joined);
    joined.add(reversed(line));
    LineBorder result = border;
    result.may_dangle = true;
    result.loops[std::min(from.loop, to.loop)] = std::move(joined);
    result.loops.erase(result.loops.begin() + static_cast<std::ptrdiff_t>(std::max(from.loop, to.loop)));
    assert(result.vertices() == border.vertices() + std::size_t{2} * line.segments());
    return result;
}

}  // namespace lamina::decoupling
