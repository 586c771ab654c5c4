#include "geometry/joined_files.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "geometry/point_runs.hpp"

namespace lamina::geometry {

namespace {

/// Returns the only outline of a file if it is a surface from nose to tail; empty for other files.
PointRun lone_surface(const OutlinesOfFile& file) {
    PointRun run;
    if (file.outlines.size() != 1) return run;
    for (const SourcePoint& p : file.outlines[0].points) run.push_back({p});
    if (is_loop(run)) run.clear();
    return run;
}

/// Returns whether the outline of a file is a plate, which needs four corners.
bool is_plate(const OutlinesOfFile& file) {
    const std::vector<SourcePoint>& points = file.outlines[0].points;
    return points.size() >= 4 && is_side_of_plate(points);
}

/// Returns the outline of two surfaces that may run either way; nothing where they do not have both ends in common.
std::optional<std::vector<SourcePoint>> joined(PointRun a, PointRun b) {
    if (a.empty() || b.empty()) return std::nullopt;
    if (!are_two_surfaces(a, b)) std::reverse(b.begin(), b.end());
    if (!are_two_surfaces(a, b)) return std::nullopt;
    const double start_gap = distance(a.front().at, b.front().at), end_gap = distance(a.back().at, b.back().at);
    // The outline is closed where the gap is wider, at the tail; a section that is sharp there has its tail at larger
    // x.
    const bool from_nose = start_gap != end_gap ? start_gap < end_gap : a.front().at.x < a.back().at.x;
    if (!from_nose) {
        std::reverse(a.begin(), a.end());
        std::reverse(b.begin(), b.end());
    }
    return join_surfaces(a, b);
}

}  // namespace

void join_files(std::vector<OutlinesOfFile>& files) {
    std::vector<OutlinesOfFile> result;
    for (OutlinesOfFile& file : files) {
        std::optional<std::vector<SourcePoint>> run =
            result.empty() ? std::nullopt : joined(lone_surface(result.back()), lone_surface(file));
        if (!run || (is_plate(result.back()) && is_plate(file))) {
            result.push_back(std::move(file));
            continue;
        }
        RawOutline& outline = result.back().outlines[0];
        outline.points = std::move(*run);
        outline.notes.push_back(fmt::format("joined with the other surface, from {}", file.file));
        std::copy(file.outlines[0].notes.begin(), file.outlines[0].notes.end(), std::back_inserter(outline.notes));
    }
    files = std::move(result);
}

}  // namespace lamina::geometry
