#include "flow/euler/wall_flow.hpp"

#include <algorithm>
#include <cstddef>

#include "core/reproducible_math.hpp"
#include "flow/euler/gas.hpp"

namespace lamina::flow::euler {

namespace {

/// Returns the smallest Mach number from point k on over a distance along a side.
double slowest_within(const std::vector<CompressibleWallPoint>& side, std::size_t k, double reach) {
    double slowest = side[k].mach, way = 0;
    for (std::size_t i = k + 1; i < side.size(); ++i) {
        way += distance(side[i - 1].at, side[i].at);
        if (way > reach) break;
        slowest = std::min(slowest, side[i].mach);
    }
    return slowest;
}

/// Returns the largest Mach number before point k over a distance along a side.
double fastest_before(const std::vector<CompressibleWallPoint>& side, std::size_t k, double reach) {
    double fastest = side[k].mach, way = 0;
    for (std::size_t i = k; i-- > 0;) {
        way += distance(side[i + 1].at, side[i].at);
        if (way > reach) break;
        fastest = std::max(fastest, side[i].mach);
    }
    return fastest;
}

}  // namespace

std::size_t find_stagnation(std::span<const WallState> outline, std::size_t sides_end) {
    const std::size_t end = std::min(sides_end, outline.size() - 1);
    // The speed along the outline at its vertex k, which is counted in the direction of the outline.
    const auto along = [&](std::size_t k) {
        return dot(outline[k].velocity, outline[(k + 1) % outline.size()].at - outline[k - 1].at);
    };
    std::size_t highest = 1, parting = 0;
    for (std::size_t k = 1; k < end; ++k) {
        if (outline[k].pressure > outline[highest].pressure) highest = k;
        if (k + 1 == end || along(k) > 0 || along(k + 1) < 0) continue;
        const std::size_t next = outline[k].pressure > outline[k + 1].pressure ? k : k + 1;
        if (parting == 0 || outline[next].pressure > outline[parting].pressure) parting = next;
    }
    return parting == 0 ? highest : parting;
}

std::vector<WallShock> find_shocks(const std::vector<CompressibleWallPoint>& side, double from, double extent) {
    constexpr double least_mach = 1.05;  // ahead of a shock
    constexpr double reach = 0.04,
                     least_jump = 0.06;  // the Mach number falls by this much from `reach` ahead to behind
    constexpr double end = 0.005;        // shocks at the trailing edge are not those of the side
    std::vector<WallShock> shocks;
    double fastest = 0;
    for (std::size_t k = 0; k + 1 < side.size(); ++k) {
        const CompressibleWallPoint &a = side[k], &b = side[k + 1];
        fastest = std::max(fastest, a.mach);
        if (!(a.mach > 1 && b.mach <= 1)) continue;
        const double share = (a.mach - 1) / (a.mach - b.mach);
        const Point at = a.at + share * (b.at - a.at);
        const double behind = slowest_within(side, k + 1, reach * extent);
        const double jump = fastest_before(side, k, reach * extent) - behind;
        if (fastest > least_mach && jump > least_jump && distance(at, side.back().at) > end * extent)
            shocks.push_back({at, (at.x - from) / extent, fastest, behind, {}});
        fastest = 0;
    }
    return shocks;
}

std::vector<CompressibleElement> wall_flows(const EulerMesh& mesh, const EulerSolution& solution,
                                            const EulerOptions& options) {
    std::vector<CompressibleElement> flows;
    const double dynamic = 0.5 * options.mach * options.mach;
    for (std::size_t w = 0; w < mesh.walls.size(); ++w) {
        const EulerWall& wall = mesh.walls[w];
        Box box;
        std::vector<WallState> states;
        for (const VertexId v : wall.outline) {
            box.include(mesh.points[v.index()]);
            states.push_back({mesh.points[v.index()], solution.velocities[v.index()], solution.pressures[v.index()]});
        }
        const auto point = [&](std::size_t k) {
            const std::size_t v = wall.outline[k % wall.outline.size()].index();
            CompressibleWallPoint p{mesh.points[v], (solution.pressures[v] - 1 / heat_ratio) / dynamic,
                                    mach_at(solution, v)};
            if (!solution.layers.empty()) {
                const WallLayer& layer = solution.layers[w].layers[k];
                p.momentum = layer.momentum * options.chord;
                p.displacement = layer.shape * p.momentum;
                p.skin_friction = layer.friction;
            }
            return p;
        };
        CompressibleElement& element = flows.emplace_back();
        const std::size_t stagnation = find_stagnation(states, wall.sides_end);
        for (std::size_t k = stagnation + 1; k-- > 0;) element.upper.points.push_back(point(k));
        for (std::size_t k = stagnation; k <= wall.sides_end; ++k) element.lower.points.push_back(point(k));
        for (CompressibleSide* side : {&element.upper, &element.lower})
            side->shocks = find_shocks(side->points, box.lower.x, box.width());
    }
    return flows;
}

double viscous_drag(const EulerSolution& solution) {
    double drag = 0;
    for (const WallLayers& wall : solution.layers)
        drag += 2 * wall.wake_momentum * wall.wake_density *
                core::pow_reproducible(wall.wake_speed, 0.5 * (wall.wake_shape + 5));
    return drag;
}

}  // namespace lamina::flow::euler
