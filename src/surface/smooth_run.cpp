#include "surface/smooth_run.hpp"

namespace lamina::surface {

std::vector<SmoothRun> split_at_corners(std::span<const Point> outline, std::span<const std::size_t> corners) {
    const std::size_t n = outline.size();
    if (corners.empty()) return {{{outline.begin(), outline.end()}, true}};
    std::vector<SmoothRun> runs;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t end = k + 1 < corners.size() ? corners[k + 1] : corners[0] + n;
        SmoothRun& run = runs.emplace_back();
        for (std::size_t i = corners[k]; i <= end; ++i) run.points.push_back(outline[i % n]);
    }
    return runs;
}

UnrolledRun unroll(const SmoothRun& run) {
    UnrolledRun u;
    u.points = run.points;
    if (run.closed) {
        const std::size_t n = run.points.size(), rounds_per_side = 1 + 40 / n;
        for (std::size_t k = 0; k < 2 * rounds_per_side; ++k)
            u.points.insert(u.points.end(), run.points.begin(), run.points.end());
        u.points.push_back(run.points.front());
        u.first = rounds_per_side * n;
    }
    u.t.push_back(0);
    for (std::size_t i = 1; i < u.points.size(); ++i)
        u.t.push_back(u.t.back() + distance(u.points[i - 1], u.points[i]));
    return u;
}

}  // namespace lamina::surface
