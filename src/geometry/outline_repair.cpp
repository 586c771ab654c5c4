#include "geometry/outline_repair.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/predicates.hpp>

#include "core/bounding_box.hpp"
#include "core/polygon.hpp"
#include "core/segments.hpp"
#include "geometry/folds.hpp"
#include "geometry/half_section.hpp"
#include "geometry/length_units.hpp"
#include "geometry/point_runs.hpp"
#include "geometry/scatter.hpp"
#include "geometry/tail_crossing.hpp"

namespace lamina::geometry {

namespace {

using SourcePoints = std::vector<SourcePoint>;

constexpr const char* advice_for_sheets = "a body without thickness is given as --sheet NAME:FILE";

/// Returns the distance below which neighbours are the same point, written with different rounding.
double merge_tolerance(const SourcePoints& points) { return 1e-12 * extent(points); }

/// Throws InputError for fewer than three points and for points on one line.
void check_extent(const SourcePoints& points, const std::string& file) {
    const InputPlace place{file, points.empty() ? 0 : points[0].line, {}};
    if (points.size() < 3)
        throw InputError(place, fmt::format("only {} distinct point{}; an outline needs at least three; {}",
                                            points.size(), points.size() == 1 ? "" : "s", advice_for_sheets));
    const bool flat = std::all_of(points.begin(), points.end(), [&](const SourcePoint& p) {
        return orient2d(points[0].at, points[1].at, p.at) == 0;
    });
    if (flat)
        throw InputError(place, fmt::format("all {} points lie on one line; {}", points.size(), advice_for_sheets));
}

/// Returns the points without those that repeat the one before them or, at the end, the first one. Throws InputError as
/// above: before it says what was removed, since that may be millions of lines.
SourcePoints without_duplicates(const SourcePoints& points, const std::string& file,
                                std::vector<std::string>& repairs) {
    const double tolerance = merge_tolerance(points);
    const auto repeats = [&](const SourcePoint& a, const SourcePoint& b) { return distance(a.at, b.at) <= tolerance; };
    SourcePoints kept;
    for (const SourcePoint& p : points)
        if (kept.empty() || !repeats(kept.back(), p)) kept.push_back(p);
    const std::size_t duplicates = points.size() - kept.size();
    std::vector<std::string> closing;
    while (kept.size() > 1 && repeats(kept.front(), kept.back())) {
        closing.push_back(fmt::format("line {}: closing point merged with line {} {}", kept.back().line,
                                      kept.front().line, coordinates(kept.back().at)));
        kept.pop_back();
    }
    check_extent(kept, file);
    repairs.reserve(repairs.size() + duplicates + closing.size());
    const SourcePoint* last = nullptr;
    for (const SourcePoint& p : points) {
        if (!last || !repeats(*last, p))
            last = &p;
        else
            repairs.push_back(
                fmt::format("line {}: duplicate of line {} removed {}", p.line, last->line, coordinates(p.at)));
    }
    repairs.insert(repairs.end(), closing.begin(), closing.end());
    return kept;
}

/// Merges neighbours that are too near to each other to be seen apart and whose other edges cross. Rounding to a few
/// digits makes such pairs where the two surfaces meet. The second of the two is removed, but never the first point of
/// the outline.
///
///       ---___                       ---___
///     ___---==x=-- first     ->     ___---===- first
///              \\ last
void merge_crossed_neighbours(SourcePoints& points, std::vector<std::string>& repairs) {
    constexpr double max_distance_share = 1e-4;  // of the extent
    const double max_distance = max_distance_share * extent(points);
    for (std::size_t i = 0; i < points.size() && points.size() >= 5; ++i) {
        const std::size_t n = points.size(), next = (i + 1) % n;
        if (distance(points[i].at, points[next].at) > max_distance ||
            !core::segments_meet(points[(i + n - 1) % n].at, points[i].at, points[next].at, points[(i + 2) % n].at))
            continue;
        const std::size_t removed = next == 0 ? i : next, kept = next == 0 ? next : i;
        repairs.push_back(fmt::format("lines {} and {}: the edges on both sides of them cross; {} merged with {}",
                                      points[removed].line, points[kept].line, coordinates(points[removed].at),
                                      coordinates(points[kept].at)));
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(removed));
    }
}

/// Cuts off a trailing edge that is drawn as a line, since the two surfaces have their last points in common.
///
///     ---___                         ---___
///            x------ first   ->             x first
///     ___---                         ___---
void cut_flat_tail(SourcePoints& points, std::vector<std::string>& repairs) {
    constexpr double max_length_share = 0.01;  // of the extent
    const double tolerance = merge_tolerance(points), max_length = max_length_share * extent(points);
    while (points.size() >= 5 && distance(points[1].at, points.back().at) <= tolerance &&
           distance(points[0].at, points[1].at) <= max_length) {
        repairs.push_back(fmt::format("lines {}, {} and {}: a tail of no thickness cut off, from {} to {}",
                                      points[0].line, points[1].line, points.back().line, coordinates(points[1].at),
                                      coordinates(points[0].at)));
        points.erase(points.begin());
        points.pop_back();
    }
}

/// Returns "line 7: ", or "lines 2, 3 and 98: ", or the first and the last of many; nothing without lines.
std::string line_prefix(const std::vector<std::size_t>& lines) {
    constexpr std::size_t max_listed = 8;
    if (lines.empty()) return "";
    if (lines.size() == 1) return fmt::format("line {}: ", lines[0]);
    if (lines.size() > max_listed) return fmt::format("{} lines from {} to {}: ", lines.size(), lines[0], lines.back());
    return fmt::format("lines {} and {}: ", fmt::join(lines.begin(), lines.end() - 1, ", "), lines.back());
}

/// Adds a note to an element, as a repair with its lines and as a warning.
void warn(Element& element, const std::vector<std::size_t>& lines, Warning warning) {
    element.repairs.push_back(line_prefix(lines) + warning.message);
    element.warnings.push_back(std::move(warning));
}

Warning fold_warning(const Fold& fold, std::string message) {
    return {.code = WarningCode::folded_outline,
            .at = fold.first.at,
            .number = fold.share,
            .unit = "extent",
            .message = std::move(message)};
}

/// Leaves out points, or exchanges them, where the outline folds back between two neighbours, and says so. Where there
/// are many folds, they are noise rather than slips, and all of them stay.
void mend_folds(SourcePoints& points, bool closed, Element& element) {
    constexpr std::size_t most_slips = 8;
    SourcePoints mended = points;
    std::vector<Fold> folds;
    while (const std::optional<Fold> fold = mend_fold(mended, closed)) {
        folds.push_back(*fold);
        if (folds.size() > most_slips) return;
    }
    points = std::move(mended);
    for (const Fold& fold : folds) {
        const std::string first = coordinates(fold.first.at), second = coordinates(fold.second.at);
        if (fold.mend == FoldMend::exchanged)
            warn(
                element, {fold.first.line, fold.second.line},
                fold_warning(fold, fmt::format("the points {} and {} exchanged, since the outline ran back from one to "
                                               "the other",
                                               first, second)));
        else
            warn(
                element, {fold.first.line},
                fold_warning(fold, fmt::format("the point {} left out, since the outline ran back on itself between it "
                                               "and {}; one of its digits may be wrong",
                                               first, second)));
    }
}

/// Says where an outline still folds back on itself.
void warn_of_folds(const SourcePoints& points, Element& element) {
    const std::vector<Fold> folds = find_narrow_folds(points);
    if (folds.empty()) return;
    const Fold& longest =
        *std::max_element(folds.begin(), folds.end(), [](const auto& a, const auto& b) { return a.share < b.share; });
    const std::string count = folds.size() == 1 ? "" : fmt::format(" in {} places", folds.size());
    element.warnings.push_back(fold_warning(
        longest,
        fmt::format("{}the outline runs back on itself{}, from {} to {}, {:.2g} % of the section's length: are "
                    "points out of order?",
                    line_prefix({longest.first.line, longest.second.line}), count, coordinates(longest.first.at),
                    coordinates(longest.second.at), 100 * longest.share)));
}

/// Says where an outline looks like one half of a symmetric section that its chord closes.
void warn_of_half(const SourcePoints& points, Element& element) {
    if (!is_closed_half(points)) return;
    element.warnings.push_back({.code = WarningCode::half_section,
                                .at = points[0].at,
                                .message =
                                    "one side is straight from nose to tail, as that of half a "
                                    "symmetric section: --mirror-half adds the other half (--close: it is whole)"});
}

/// Cuts off a tail behind a crossing of the two surfaces, and says so.
void cut_crossed_tail(SourcePoints& points, Element& element) {
    while (const std::optional<TailCut> cut = cut_crossing_tail(points)) {
        const std::string text = fmt::format(
            "the surfaces {} near the trailing edge, at {}; the tail behind that, {:.2g} % of the section's "
            "length, was cut off",
            cut->at_vertex ? "meet" : "cross", coordinates(cut->at), 100 * cut->share);
        warn(element, cut->removed_lines,
             {.code = WarningCode::crossing_tail_cut,
              .at = cut->at,
              .number = cut->share,
              .unit = "extent",
              .message = text});
    }
}

/// Returns whether the ends of an open outline are no trailing edge: no farther apart than other neighbours, and the
/// outline goes on from one to the other.
bool goes_on_at_ends(const SourcePoints& points) {
    constexpr std::size_t reach = 8;  // points
    const std::size_t n = points.size();
    if (n < 4 * reach) return false;
    double longest = 0;
    for (std::size_t i = 1; i < n; ++i) longest = std::max(longest, distance(points[i - 1].at, points[i].at));
    const Point before = points[n - 1].at - points[n - 1 - reach].at, after = points[reach].at - points[0].at;
    return distance(points[n - 1].at, points[0].at) <= longest &&
           dot(before, after) > 0.5 * length(before) * length(after);
}

/// Smooths points that scatter about the outline as white noise does, and says so. The corners of outlines are found
/// again later, as of any points.
void remove_noise(SourcePoints& points, bool closed, Element& element) {
    PointSequence sequence{{}, closed || goes_on_at_ends(points)};
    for (const SourcePoint& p : points) sequence.points.push_back(p.at);
    const std::optional<double> noise = white_noise(sequence);
    if (!noise) return;
    const std::vector<Point> smooth = without_noise(sequence, find_corners_above_noise(sequence, *noise), *noise);
    double moved = 0;
    Point farthest{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (distance(points[i].at, smooth[i]) > moved) {
            moved = distance(points[i].at, smooth[i]);
            farthest = points[i].at;
        }
        points[i].at = smooth[i];
    }
    element.samples_of_curve = true;
    const std::string message = fmt::format(
        "the {} points scatter about the outline by {:.2g} (standard deviation), as those of a scan do; they were "
        "smoothed, and moved by up to {:.2g}",
        points.size(), *noise, moved);
    warn(element, {},
         {.code = WarningCode::noise_smoothed, .at = farthest, .number = *noise, .unit = "units", .message = message});
}

/// Throws InputError where an open outline came back to its start before its end.
void check_closed_once(const SourcePoints& points, const std::string& file) {
    const SourcePoint &first = points.front(), &last = points.back();
    const auto again =
        std::find_if(points.begin() + 1, points.end(), [&](const SourcePoint& p) { return p.at == first.at; });
    if (again == points.end()) return;
    throw InputError(
        {file, last.line, last.at},
        fmt::format("the outline is back at its start {} on line {}, but goes on to line {}: a point out of "
                    "place, or a second body without a line that divides them",
                    coordinates(first.at), again->line, last.line));
}

/// Throws InputError for an outline that is too far open, which says what may be done.
[[noreturn]] void refuse_open(const SourcePoints& points, const std::string& file) {
    const SourcePoint &first = points.front(), &last = points.back();
    const std::string remedy = symmetry_line(points) ? ", or --mirror-half if this is half of a symmetric section" : "";
    throw InputError(
        {file, last.line, last.at},
        fmt::format("the outline is open: its end is {:.3g} away from its start {} on line {}, too far to "
                    "be closed by a base edge; where a straight edge belongs there, repeat the first point "
                    "at the end or give --close{}; {}",
                    distance(last.at, first.at), coordinates(first.at), first.line, remedy, advice_for_sheets));
}

/// Divides the edge from the last point back to the first into edges about as long as the shorter of its neighbours.
/// Throws InputError where that edge is too long to be a base, unless `at_any_length`.
void close_outline(SourcePoints& points, const std::string& file, bool at_any_length,
                   std::vector<std::string>& repairs) {
    constexpr double max_edges = 64;
    check_closed_once(points, file);
    const SourcePoint last = points.back(), first = points.front();
    const double base = distance(last.at, first.at);
    double perimeter = 0;
    for (std::size_t i = 1; i < points.size(); ++i) perimeter += distance(points[i - 1].at, points[i].at);
    if (base > 0.5 * perimeter && !at_any_length && !is_side_of_plate(points)) refuse_open(points, file);
    const double neighbour =
        std::min(distance(points[0].at, points[1].at), distance(points[points.size() - 2].at, points.back().at));
    const auto edges = static_cast<std::size_t>(std::clamp(std::floor(base / neighbour + 0.5), 1.0, max_edges));
    // Each vertex is placed from the nearer end, so that a symmetric base gets symmetric vertices, exactly.
    for (std::size_t i = 1; i < edges; ++i) {
        const auto share = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(edges); };
        const Point at = 2 * i == edges  ? midpoint(last.at, first.at)
                         : 2 * i < edges ? last.at + share(i) * (first.at - last.at)
                                         : first.at + share(edges - i) * (last.at - first.at);
        points.push_back({at, 0});
    }
    repairs.push_back(fmt::format("lines {} and {}: open end closed from {} to {} by {} edge{}, {:.4g} long", last.line,
                                  first.line, coordinates(last.at), coordinates(first.at), edges, edges == 1 ? "" : "s",
                                  base));
}

/// Returns whether an outline runs clockwise. Exact for simple outlines.
bool is_clockwise(const SourcePoints& points) {
    return core::polygon_orientation(points.size(), [&](std::size_t i) { return points[i].at; }) < 0;
}

}  // namespace

Element repair_outline(const RawOutline& outline, const std::string& file, const GeometryOptions& options) {
    Element element;
    element.file = file;
    element.title = outline.title;
    element.format = outline.format;
    element.unit = outline.unit;
    element.points_read = outline.points.size();
    element.repairs = outline.notes;

    const SourcePoints& given = outline.points;
    const bool closed = given.size() > 1 && distance(given.front().at, given.back().at) <= merge_tolerance(given);
    SourcePoints points = without_duplicates(given, file, element.repairs);
    element.samples_of_curve = outline.samples_of_curve;
    if (!outline.samples_of_curve) remove_noise(points, closed, element);
    const SourcePoint last = points.back();
    merge_crossed_neighbours(points, element.repairs);
    cut_flat_tail(points, element.repairs);
    mend_folds(points, closed, element);
    cut_crossed_tail(points, element);
    if (!closed && points.back().at == last.at) close_outline(points, file, options.close, element.repairs);
    warn_of_folds(points, element);
    if (closed && !options.close) warn_of_half(points, element);
    if (is_clockwise(points)) {
        std::reverse(points.begin() + 1, points.end());
        const std::string line = points[0].line > 0 ? fmt::format("line {}: ", points[0].line) : "";
        element.repairs.push_back(
            fmt::format("{}clockwise order reversed, starting from {}", line, coordinates(points[0].at)));
    }
    for (const SourcePoint& p : points) {
        if (p.is_corner) element.given_corners.push_back(element.points.size());
        element.points.push_back(p.at);
        element.lines.push_back(p.line);
    }
    if (element.unit.empty())
        if (const auto unit = unit_of_title(element.title, core::bounding_box(element.points).width()))
            element.unit = unit->name;
    return element;
}

}  // namespace lamina::geometry
