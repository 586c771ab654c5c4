#include "surface/notes.hpp"

#include <vector>

#include "core/reproducible_math.hpp"
#include "surface/noise.hpp"

namespace lamina::surface {

void note_noise(Element& e) {
    constexpr std::size_t fewest = 3;
    constexpr double enough = 1.5;
    const Noise noise = find_noise(e.points, e.features.corners);
    if (noise.vertices < fewest) return;
    e.surface_notes.push_back(fmt::format(
        "{} zigzag by up to {:.2g} degrees, about {:.1g} in the units of the input: smoothing would help "
        "(--smooth {:.1g})",
        counted(noise.vertices, "point"), core::degrees(noise.turning), noise.amplitude, enough * noise.amplitude));
}

void note_misplaced(Element& e) {
    constexpr std::size_t most = 3;
    const std::vector<std::size_t> misplaced = find_misplaced(e.points);
    if (misplaced.size() > most) return;
    for (const std::size_t i : misplaced) {
        const Point p = e.points[i];
        const std::string line = i < e.lines.size() && e.lines[i] > 0 ? fmt::format("line {}: ", e.lines[i]) : "";
        e.surface_notes.push_back(fmt::format(
            "{}({}, {}) stands off the curve of its neighbours: a slip? It is kept; take it out if it is wrong", line,
            p.x, p.y));
    }
}

}  // namespace lamina::surface
