// Meshes to morph, and shapes to morph them to.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/morph.hpp>
#include <lamina/pipeline.hpp>

#include "core/random.hpp"

namespace lamina::test {

/// Options of a small mesh with a layer.
inline CaseOptions options_to_morph(LayerTopology topology = LayerTopology::layered) {
    CaseOptions options;
    options.layer = {.first_height = 1e-4, .layers = 20, .topology = topology};
    options.far_field.size = 10;
    return options;
}

inline Mesh mesh_to_morph(const std::vector<std::string>& inputs = {"naca:0012:100"},
                          LayerTopology topology = LayerTopology::layered) {
    return generate_mesh(inputs, options_to_morph(topology)).mesh;
}

/// Returns the mesh of two sections, of which the second one begins below the tail of the first one.
inline Mesh mesh_with_slot() {
    Element flap = naca_airfoil("0012", 60);
    for (Point& p : flap.points) p = {1.01 + 0.3 * p.x, -0.03 + 0.3 * p.y};
    return generate_mesh(make_geometry({naca_airfoil("0012", 60), flap}, {.names = {"main", "flap"}}),
                         options_to_morph())
        .mesh;
}

/// Returns the mesh of a section above ground that the flow slips along.
inline Mesh mesh_over_ground() {
    CaseOptions options = options_to_morph();
    options.far_field.ground = 0.3;
    return generate_mesh({"naca:0012:60"}, options).mesh;
}

/// Returns the wall points, each moved by a function of its place.
template <class Move>
std::vector<Point> moved_walls(const MorphMap& map, Move&& move) {
    std::vector<Point> wall = map.wall_points();
    for (Point& p : wall) p = move(p);
    return wall;
}

/// Returns the walls with thickness and camber changed, as a section of unit chord has them.
inline std::vector<Point> deformed_walls(const MorphMap& map, double thickness, double camber) {
    return moved_walls(map, [&](Point p) { return Point{p.x, thickness * p.y + 4 * camber * p.x * (1 - p.x)}; });
}

/// Expects a valid mesh at these points.
inline void expect_valid(const MorphMap& map, const std::vector<Point>& points) {
    Mesh mesh = map.reference();
    mesh.points = points;
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.valid()) << (check.defects.empty() ? "" : check.defects[0].description);
}

}  // namespace lamina::test
