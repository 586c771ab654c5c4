// On outlines such as iced ones corners follow each other at every tenth edge, and edges are short beside the layer's
// height. Where each ray is normal to its wall, columns on the straight parts between corners are as narrow at the
// front as their edges, while those at the corners open like wedges:
//
//     |||||||      /           \   \  |  /    /
//     |||||||    /              \  \  |  /  /      front
//     |||||||  /  _/             \ \  | / / _/
//     ||||||| / _/ _/             \\  |// _/ _/
//     |||||||/_/ _/               \\\ |//_/ _/
//     -------o /                  -------o /      the wall turns at o
//              `.                          `.
//
// So each ray turns towards the wider one of the columns on both sides, again and again. What a corner has too much
// spreads over the columns near it, as heat does along a rod. On smooth outlines a few times are enough to even out
// what is left of slips in the data. docs/decisions/0069
#include "layers/even_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angles.hpp"
#include "layers/corner_shifts.hpp"
#include "layers/short_faces.hpp"

namespace lamina::layers {

namespace {

/// How columns become even.
struct Evening {
    /// How often each ray turns. What is uneven spreads over twice the square root of this in columns.
    int rounds;
    /// Columns that are wider than this share of their height have no need of others' width.
    double wide_enough;
    /// Whether columns give no more than what they open by, so that their rays do not meet.
    bool stay_open;
    /// Columns take no more than what lets them open by this angle, in degrees.
    double most_opening_deg;
};
/// No column opens so far that more rays would stand on its edge.
constexpr double opening_without_rays_deg = 0.95 * max_jagged_ray_angle_deg;
constexpr Evening on_jagged{200, 0.15, false, HUGE_VAL}, below_thick_layers{3, 0.15, false, HUGE_VAL};
/// Layers that end at isotropy are about nine times as high as their columns are wide. Narrower columns are beside corners
/// and where the data slip, and wider ones need what they have.
constexpr Evening below_isotropy{3, 0.09, true, HUGE_VAL};
/// On jagged outlines no column needs more than its neighbours: the tops of wedges would be divided down to those beside
/// them.
constexpr Evening below_isotropy_on_jagged{80, 1, false, opening_without_rays_deg};

/// Returns how columns of this outline become even below layers of this growth.
const Evening& evening_on(OutlineKind kind, const LayerGrowth& growth) {
    const bool isotropic = growth.least_heights.empty() && !growth.layers;
    if (kind == OutlineKind::jagged) return isotropic ? below_isotropy_on_jagged : on_jagged;
    return isotropic ? below_isotropy : below_thick_layers;
}

/// No ray leans by more than this for it, unless it did before.
constexpr double max_lean_to_even_deg = 40;

/// The column between a vertex and the next one.
struct Column {
    double edge;    ///< of the wall below
    double height;  ///< of the front
    double width;   ///< at the front; negative where rays would cross

    /// Returns the width that counts where columns are compared.
    double counted(const Evening& evening) const { return std::min(width, evening.wide_enough * height); }

    /// Returns the angle by which one of the rays may turn towards the other.
    double given(const Evening& evening) const {
        if (!evening.stay_open) return HUGE_VAL;
        return width > edge ? 0.5 * (width - edge) / height : 0;
    }

    /// Returns the angle by which one of the rays may turn away from the other.
    double taken(const Evening& evening) const {
        return 0.5 * std::max(core::radians(evening.most_opening_deg) - (width - edge) / height, 0.0);
    }
};

std::vector<Column> columns_of(std::span<const RayVertex> outline, std::span<const double> heights,
                               std::span<const WallVertex> vertices) {
    std::vector<Column> columns(outline.size());
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t next = (i + 1) % outline.size();
        const double edge = distance(outline[i].at, outline[next].at), height = std::max(heights[i], heights[next]);
        columns[i] = {edge, height, edge + height * angle_to_next(vertices[i], vertices[next])};
    }
    return columns;
}

/// Returns, for each vertex, whether its rays stay: those of fans, and on smooth outlines those of short faces, whose
/// columns have been opened as far as the room there allows.
std::vector<char> rays_that_stay(std::span<const RayVertex> outline, OutlineKind kind,
                                 std::span<const WallVertex> vertices) {
    const std::size_t n = outline.size();
    std::vector<char> stay(n);
    for (std::size_t i = 0; i < n; ++i) stay[i] = vertices[i].fan;
    if (kind != OutlineKind::smooth) return stay;
    const std::vector<double> openings = openings_on_short_faces(outline, vertices);
    for (std::size_t i = 0; i < n; ++i)
        if (openings[i] > 0) stay[i] = stay[(i + 1) % n] = 1;
    return stay;
}

/// Returns the largest angle by which the one ray of a vertex may lean to either side, in radians. `between_edges` is
/// that at which the first height above both edges can be kept.
double largest_lean(const WallVertex& vertex, double between_edges) {
    const double from_normals = core::radians(max_lean_from_normals_deg) - 0.5 * std::abs(vertex.turning);
    return std::max(std::min({core::radians(max_lean_to_even_deg), from_normals, between_edges}),
                    std::abs(vertex.tilt[0]));
}

/// Returns the angle by which the ray between two columns turns in one round, counter-clockwise, in radians.
double turn_between(const Column& before, const Column& after, const Evening& evening, double tilt, double largest) {
    const double heights = before.height + after.height;
    if (!(heights > 0)) return 0;
    const double even = 0.5 * (after.counted(evening) - before.counted(evening)) / heights;
    const double turn = std::clamp(even, -std::min(before.given(evening), after.taken(evening)),
                                   std::min(after.given(evening), before.taken(evening)));
    return std::clamp(tilt + turn, -largest, largest) - tilt;
}

}  // namespace

void even_columns(std::span<const RayVertex> outline, OutlineKind kind, std::span<const double> heights,
                  const LayerGrowth& growth, std::vector<WallVertex>& vertices) {
    const std::size_t n = outline.size();
    std::vector<Column> columns = columns_of(outline, heights, vertices);
    const auto before = [&](std::size_t i) -> const Column& { return columns[(i + n - 1) % n]; };
    std::vector<double> largest(n), turns(n, 0.0);
    const std::vector<char> fixed = rays_that_stay(outline, kind, vertices);
    for (std::size_t i = 0; i < n; ++i) {
        const double shorter_edge = std::min(before(i).edge, columns[i].edge);
        largest[i] = largest_lean(vertices[i],
                                  max_tilt_between_edges(vertices[i].turning, kind, growth.first_height, shorter_edge));
    }
    const Evening& evening = evening_on(kind, growth);
    for (int round = 0; round < evening.rounds; ++round) {
        // All turn at once, so that both directions of the wall are treated alike.
        for (std::size_t i = 0; i < n; ++i)
            if (!fixed[i]) turns[i] = turn_between(before(i), columns[i], evening, vertices[i].tilt[0], largest[i]);
        for (std::size_t i = 0; i < n; ++i) {
            columns[i].width += columns[i].height * (turns[(i + 1) % n] - turns[i]);
            for (double& tilt : vertices[i].tilt) tilt += turns[i];
        }
    }
}

}  // namespace lamina::layers
