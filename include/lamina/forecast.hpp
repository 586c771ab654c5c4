// What a mesh will be, told before it is made: first heights, y+ along the walls, thickness, cells, memory and time.
//
// Guarantees:
//  1. Walls, first heights and rays are those that generate_mesh() begins with, by the same stages.
//  2. No cell is made and nothing is written.
// Limits:
//  1. Triangles beyond the layer are estimated: within 3 % on single sections. Lines inside the domain are left out.
//  2. Where layers are made thinner for angles beyond them (MeshResult::thinned_rays), those of the mesh end lower there.
//  3. y+ is that of the flow before the mesh, or of a flat plate without it; it ends where that flow is wrong.
// Example:
//     CaseOptions options;
//     options.layer = {.first_height = 1e-3, .layers = 8};  // chords
//     options.far_field.size = 10;
//     const MeshForecast forecast = forecast_mesh({"naca:0012"}, options);
//     assert(forecast.walls[0].first_height == 1e-3 && forecast.walls[0].thickness > 8e-3);
//     assert(forecast.layer_cells > 1000 && forecast.cells_beyond > 1000 && !forecast.walls[0].y_plus);
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/pipeline.hpp>

namespace lamina {

/// y+ of the first layer along a wall.
struct YPlusRange {
    double smallest = 0;  ///< beside the stagnation point, or where the flow is about to leave the wall
    double median = 0;    ///< by length along the wall
    double largest = 0;   ///< where friction is largest
};

/// The layer on the wall of one element.
struct WallForecast {
    std::string element;                 ///< its name
    double first_height = 0;             ///< in units of the input
    double thickness = 0;                ///< of the highest column, from the wall to its end, in units of the input
    std::optional<YPlusRange> y_plus{};  ///< empty without a Reynolds number, and where first heights follow a solution
};

/// A mesh before it is made.
struct MeshForecast {
    /// What is known: geometry, conditions, flow, decisions, first heights, coverage, the estimate of memory and time,
    /// and the seconds of the stages. Mesh and check are empty.
    MeshResult result;
    std::vector<WallForecast> walls;  ///< one per element; empty without layers
    double layer_cells = 0;           ///< number of cells in the layer
    double cells_beyond = 0;          ///< number of triangles beyond it, by estimate
    double vertices = 0;              ///< number of vertices, by estimate
};

/// Returns what generate_mesh() would make of these bodies. For CaseOptions::vertices and cells it finds the scale with
/// which a forecast has as many. Precondition: check_simple(geometry). Throws what generate_mesh() throws before it
/// makes cells.
LAMINA_EXPORT MeshForecast forecast_mesh(const Geometry& geometry, const CaseOptions& options = {},
                                         const Progress& progress = {});
/// Reads the inputs, and returns what generate_mesh() would make of them.
LAMINA_EXPORT MeshForecast forecast_mesh(const std::vector<std::string>& inputs, const CaseOptions& options = {},
                                         const Progress& progress = {});

}  // namespace lamina
