// The part of the plane that a picture shows, and the cells in it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/plot.hpp>

namespace lamina::plot {

/// Maps a window of the plane to the pixels of the picture, whose y runs downwards.
struct PictureView {
    Box window;
    double scale = 1;              ///< pixels per unit of length
    double width = 0, height = 0;  ///< of the picture, in pixels
    Box area{};                    ///< the part of the window beside which axes stand; without axes the whole window

    double x(Point p) const { return (p.x - window.lower.x) * scale; }
    double y(Point p) const { return (window.upper.y - p.y) * scale; }
};

/// The height of text in a picture whose longer side has this many pixels.
double text_height(int width_px);

/// Returns the view of the window of the options, or of the whole mesh with a margin of 1 %. Throws UsageError for
/// places that the mesh does not have.
PictureView make_view(const Mesh& mesh, const PlotOptions& options);

/// A cell that overlaps the window.
struct VisibleCell {
    std::size_t cell;     ///< its number: triangles, then quads
    std::size_t corners;  ///< 3 or 4
    std::array<VertexId, 4> vertex;
    std::array<Point, 4> corner;

    double area() const;
    /// Returns area over longest edge: half the distance between two opposite edges of a thin cell.
    double thickness() const;
};

/// Returns the cells whose boxes overlap the window, with their nodes where they are curved.
std::vector<VisibleCell> visible_cells(const Mesh& mesh, const Box& window, const CurvedNodes& nodes = {});

}  // namespace lamina::plot
