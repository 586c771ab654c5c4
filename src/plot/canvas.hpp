// Drawing on a Cairo surface.
#pragma once

#include <cairo.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <lamina/point.hpp>

#include "plot/color.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

/// Draws cells and lines. Coordinates are those of the mesh, widths are in pixels. Everything is clipped to the window
/// and a few pixels round it beforehand, because the numbers of Cairo end at 2^23 pixels.
class Canvas {
public:
    Canvas(cairo_surface_t* surface, const PictureView& view);

    /// Fills the whole picture.
    void paint(Color color);
    /// Fills a box, without antialiasing as well.
    void fill(const Box& box, Color color, double alpha);
    /// Fills a circle of this radius in pixels.
    void dot(Point at, double radius, Color color);
    /// Puts an image over the whole picture.
    void put(cairo_surface_t* image);
    /// Fills a cell, without antialiasing: neighbouring cells would otherwise leave pale seams where both cover a pixel
    /// in part.
    void fill(std::vector<Point> polygon, Color color);
    void stroke(Point a, Point b, Color color, double alpha, double width);
    /// Writes text of this height in pixels. The point is where its vertical middle meets its left end, its middle or
    /// its right end, as `anchor` is 0, 0.5 or 1.
    void write(Point at, const std::string& text, double height, Color color, double anchor);
    /// Clips what is stroked from now on to a box.
    void restrict_to(const Box& bounds) { bounds_ = bounds; }

private:
    void set_color(Color color, double alpha);
    bool clip_segment(Point& a, Point& b) const;

    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cr_;
    PictureView view_;
    Box bounds_;  ///< the window and a few pixels round it
};

/// Lets `draw` draw on an image of its own, which is put over the whole picture, or on the canvas itself where memory
/// is lacking. Of vector graphics many small parts become one image so.
void draw_on_image(Canvas& canvas, const PictureView& view, const std::function<void(Canvas&)>& draw);

}  // namespace lamina::plot
