#include "geometry/join_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/point_runs.hpp"

namespace lamina::geometry {

namespace {

void append(PointRun& run, const PointRun& more) { run.insert(run.end(), more.begin(), more.end()); }

/// Returns whether the step from the end of a to the start of b is at most twice as long as a neighbouring step.
bool steps_evenly(const PointRun& a, const PointRun& b) {
    double neighbour = 0;
    if (a.size() > 1) neighbour = distance(a[a.size() - 2].at, a.back().at);
    if (b.size() > 1) neighbour = std::max(neighbour, distance(b[0].at, b[1].at));
    return distance(a.back().at, b.front().at) <= 2 * neighbour;
}

/// Returns whether b continues a, so that only a blank line divides one run.
bool continues(const PointRun& a, const PointRun& b) {
    if (a.size() > 1 && a.front().at == a.back().at) return false;
    if (is_loop(b) || (is_loop(a) && b.size() > a.size())) return false;
    return steps_evenly(a, b);
}

/// Returns where a second surface begins in a run that steps back from the end of the first one to its start.
std::optional<std::size_t> start_of_second_surface(const PointRun& run) {
    const double size = extent(run);
    for (std::size_t i = 2; i < run.size(); ++i)
        if (distance(run[i - 1].at, run[0].at) > 0.5 * size && distance(run[i].at, run[0].at) <= 0.1 * size &&
            distance(run[i - 1].at, run[i].at) > 0.5 * size)
            return i;
    return std::nullopt;
}

/// Returns how far the end of a run is from completing an outline; infinity where the run is too short for one.
double gap_of_outline(const PointRun& run) {
    if (const auto second = start_of_second_surface(run)) return distance(run[*second - 1].at, run.back().at);
    return is_loop(run) ? distance(run.front().at, run.back().at) : HUGE_VAL;
}

/// Returns whether a run is a whole outline, so that the points behind it belong to another one.
bool ends_before(const PointRun& run, const PointRun& next) {
    constexpr double clear_share = 0.1;
    const double step = distance(run.back().at, next.front().at);
    if (run.size() < 3 || step == 0) return false;
    const bool is_closed = run.front().at == run.back().at;
    if (!is_closed && next.size() < 3 && steps_evenly(run, next)) return false;  // quick, for many comments
    if (is_closed && is_loop(next)) return true;
    const double gap = gap_of_outline(run);
    return gap < step && (gap <= clear_share * step || !steps_evenly(run, next) || is_loop(next));
}

/// Returns whether the first point of a run belongs to no outline: the rest is a loop that it does not help to close,
/// and the step from it is long.
bool starts_with_lone_point(const PointRun& run) {
    if (run.size() < 4) return false;
    const Point lone = run[0].at, first = run[1].at, last = run.back().at;
    return distance(last, lone) > distance(last, first) && distance(lone, first) > 2 * distance(first, run[2].at) &&
           is_loop({run.begin() + 1, run.end()}) && !find_second_surface(run);
}

}  // namespace

void join_commented_blocks(CoordinateSection& section) {
    const bool all_single = section.size() > 2 && std::all_of(section.begin(), section.end(), [](const auto& block) {
                                return block.points.size() == 1;
                            });
    CoordinateSection joined;
    for (std::size_t i = 0; i < section.size();) {
        CoordinateBlock block = std::move(section[i]);
        const bool starts_alone = block.points.size() == 1;
        const auto is_complete = [&] {
            const PointRun &run = block.points, &next = section[i].points;
            return ends_before(run, next) ||
                   (starts_alone && starts_with_lone_point(run) && ends_before({run.begin() + 1, run.end()}, next));
        };
        const auto goes_on = [&] { return (all_single || section[i].after_comment) && !is_complete(); };
        for (++i; i < section.size() && goes_on(); ++i) append(block.points, section[i].points);
        if (starts_alone && starts_with_lone_point(block.points)) {
            joined.push_back({{block.points[0]}, {}, block.after_comment});
            block.points.erase(block.points.begin());
        }
        joined.push_back(std::move(block));
    }
    section = std::move(joined);
}

void join_continued_blocks(CoordinateSection& section) {
    CoordinateSection joined;
    for (CoordinateBlock& block : section) {
        if (!joined.empty() && continues(joined.back().points, block.points)) {
            append(joined.back().points, block.points);
        } else {
            joined.push_back(std::move(block));
        }
    }
    section = std::move(joined);
}

PointSpan all_points(const CoordinateSection& section, PointRun& copies) {
    if (section.size() == 1) return section[0].points;
    for (const CoordinateBlock& block : section) append(copies, block.points);
    return copies;
}

std::size_t remove_blocks(CoordinateSection& section, std::size_t points) {
    while (points > 0 && points >= section[0].points.size()) {
        points -= section[0].points.size();
        section.erase(section.begin());
    }
    return points;
}

}  // namespace lamina::geometry
