#include "geometry/join_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/growing_run.hpp"
#include "geometry/point_runs.hpp"

namespace lamina::geometry {

namespace {

/// Returns whether the step from the end of a to the start of b is at most twice as long as a neighbouring step.
bool steps_evenly(PointSpan a, PointSpan b) {
    double neighbour = 0;
    if (a.size() > 1) neighbour = distance(a[a.size() - 2].at, a.back().at);
    if (b.size() > 1) neighbour = std::max(neighbour, distance(b[0].at, b[1].at));
    return distance(a.back().at, b.front().at) <= 2 * neighbour;
}

/// Returns whether b continues a, so that only a blank line divides one run.
bool continues(const GrowingRun& run, PointSpan b) {
    const PointSpan a = run.points();
    if (a.size() > 1 && a.front().at == a.back().at) return false;
    if (is_loop(b) || (b.size() > a.size() && run.is_loop())) return false;
    return steps_evenly(a, b);
}

/// Returns how far the end of a run is from completing an outline; infinity where the run is too short for one.
double gap_of_outline(GrowingRun& growing) {
    const PointSpan run = growing.points();
    if (const auto second = growing.return_to_start()) return distance(run[*second - 1].at, run.back().at);
    return growing.is_loop() ? distance(run.front().at, run.back().at) : HUGE_VAL;
}

/// Returns whether a run is a whole outline, so that the points behind it belong to another one.
bool ends_before(GrowingRun& growing, PointSpan next) {
    constexpr double clear_share = 0.1;
    const PointSpan run = growing.points();
    if (run.size() < 3) return false;
    const double step = distance(run.back().at, next.front().at);
    if (step == 0) return false;
    const bool is_closed = run.front().at == run.back().at;
    if (!is_closed && next.size() < 3 && steps_evenly(run, next)) return false;  // quick, for many comments
    if (is_closed && is_loop(next)) return true;
    const double gap = gap_of_outline(growing);
    return gap < step && (gap <= clear_share * step || !steps_evenly(run, next) || is_loop(next));
}

/// A run of blocks that comments divide. It may start with a single point that is none of the outline behind it.
class CommentedRun {
public:
    /// The run that has the points from `first` on, and none yet.
    CommentedRun(PointSpan points, std::size_t first, bool starts_alone)
        : whole_(points, first), rest_(points, std::min(first + 1, points.size())), starts_alone_(starts_alone) {}

    void grow_to(std::size_t end) {
        whole_.grow_to(end);
        rest_.grow_to(end);
    }

    /// Returns whether the first point belongs to no outline: the rest is a loop that it does not help to close, and
    /// the step from it is long.
    bool starts_with_lone_point() const {
        const PointSpan run = whole_.points();
        if (!starts_alone_ || run.size() < 4) return false;
        const Point lone = run[0].at, first = run[1].at, last = run.back().at;
        return distance(last, lone) > distance(last, first) && distance(lone, first) > 2 * distance(first, run[2].at) &&
               rest_.is_loop() && !whole_.second_surface();
    }

    bool is_complete_before(PointSpan next) {
        return ends_before(whole_, next) || (starts_with_lone_point() && ends_before(rest_, next));
    }

private:
    GrowingRun whole_, rest_;  ///< the latter without the first point
    bool starts_alone_;
};

}  // namespace

void join_commented_blocks(CoordinateSection& section) {
    const std::size_t n = section.blocks.size();
    const bool all_single = n > 2 && section.points.size() == n;
    std::vector<CoordinateBlock> joined;
    for (std::size_t i = 0; i < n;) {
        CoordinateBlock block = section.blocks[i];
        CommentedRun run(section.points, block.first, section.block(i).size() == 1);
        const auto end_of = [&](std::size_t k) {
            return k + 1 < n ? section.blocks[k + 1].first : section.points.size();
        };
        run.grow_to(end_of(i));
        const auto goes_on = [&] {
            return (all_single || section.blocks[i].after_comment) && !run.is_complete_before(section.block(i));
        };
        for (++i; i < n && goes_on(); ++i) run.grow_to(end_of(i));
        if (run.starts_with_lone_point()) {
            joined.push_back({block.first, 0, 0, block.after_comment});
            ++block.first;
        }
        joined.push_back(block);
    }
    section.blocks = std::move(joined);
}

void join_continued_blocks(CoordinateSection& section) {
    std::vector<CoordinateBlock> joined;
    std::optional<GrowingRun> last;
    for (std::size_t i = 0; i < section.blocks.size(); ++i) {
        const std::size_t first = section.blocks[i].first;
        if (!last || !continues(*last, section.block(i))) {
            joined.push_back(section.blocks[i]);
            last.emplace(section.points, first);
        }
        last->grow_to(first + section.block(i).size());
    }
    section.blocks = std::move(joined);
}

}  // namespace lamina::geometry
