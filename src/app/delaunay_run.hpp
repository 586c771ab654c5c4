// One run of `lamina delaunay`: triangulates and refines the contents of Triangle's files.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/limits.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/triangle_files.hpp>
#include <lamina/warning.hpp>

namespace lamina::app {

struct DelaunaySettings {
    RefineOptions refine{.min_angle_deg = 0};
    double max_area = HUGE_VAL;              ///< largest area of a triangle, in squared units of the input
    bool keep_border = false;                ///< whether segments and boundary edges stay as they are
    bool keep_hull = false;                  ///< whether triangles outside the segments are kept
    double drop_flat = 0;                    ///< as ConstrainedOptions::drop_flat
    std::optional<double> merge_distance{};  ///< points at most this far apart are merged
    bool insert_crossings = false;           ///< whether crossing segments get a vertex instead of being refused
    WorkLimits limits{};                     ///< runs beyond them are refused
};

struct DelaunayResult {
    TriangleOutput output;
    RefineStats refinement;
    RunEstimate estimate;  ///< made before the refinement, or before the triangulation where there is none
    std::vector<Warning> warnings;
    std::size_t merged_points = 0;                                ///< points of the input that others stand for
    std::size_t dropped_triangles = 0;                            ///< flat triangles at the hull
    std::size_t zero_length_segments = 0, repeated_segments = 0;  ///< segments of the input that change nothing
    double triangulation_seconds = 0, refinement_seconds = 0;
    /// The pieces and the times of the threads, for points without segments.
    std::optional<DecompositionStats> decomposition{};
    std::vector<TriangulationThread> threads{};
};

/// Triangulates the input, and refines it where the settings or the regions of the input bound angles or areas. Points,
/// attributes and markers of the input are kept. New vertices get attributes 0 and the marker of their segment. Throws
/// the errors of triangulate() and refine(), with the name of the file, and LimitError before the work.
DelaunayResult run_delaunay(TriangleInput input, const DelaunaySettings& settings, const Progress& progress = {});

}  // namespace lamina::app
