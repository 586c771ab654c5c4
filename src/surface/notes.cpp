#include "surface/notes.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/reproducible_math.hpp"
#include "core/text.hpp"
#include "surface/noise.hpp"

namespace lamina::surface {

void add_noise_note(Element& e) {
    constexpr std::size_t min_vertices = 3;
    constexpr double smoothing_factor = 1.5;  // suggested tolerance over amplitude
    const NoiseEstimate noise = estimate_noise(e.points, e.features.corners);
    if (noise.vertices < min_vertices) return;
    e.surface_notes.push_back(
        fmt::format("{} zigzag by up to {:.2g} degrees, about {:.1g} in the units of the input: smoothing would help "
                    "(--smooth {:.1g}u)",
                    core::counted(noise.vertices, "point"), core::degrees(noise.max_turning), noise.amplitude,
                    smoothing_factor * noise.amplitude));
}

void add_misplaced_point_notes(Element& e) {
    constexpr std::size_t max_notes = 3;
    const std::vector<std::size_t> misplaced = find_misplaced_points(e.points);
    if (misplaced.size() > max_notes) return;
    for (const std::size_t i : misplaced) {
        const Point p = e.points[i];
        const std::string line = i < e.lines.size() && e.lines[i] > 0 ? fmt::format("line {}: ", e.lines[i]) : "";
        e.surface_notes.push_back(fmt::format(
            "{}({}, {}) stands off the curve of its neighbours: a slip? It is kept; take it out if it is wrong", line,
            p.x, p.y));
    }
}

}  // namespace lamina::surface
