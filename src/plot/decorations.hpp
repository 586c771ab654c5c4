// Decorations stand in and beside pictures of meshes: axes, and bars that explain lengths and colours.
#pragma once

#include "plot/canvas.hpp"
#include "plot/color_scale.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

/// Covers what lies beside the area of the view, and writes coordinates there.
void draw_axes(Canvas& canvas, const PictureView& view, double text_height);

/// Draws a bar of a round length in the lower right corner of the area.
void draw_scale_bar(Canvas& canvas, const PictureView& view, double text_height);

/// Draws the scale of the colours in the upper right corner of the area, where they stand for numbers.
void draw_color_bar(Canvas& canvas, const PictureView& view, const CellColors& colors, double text_height);

}  // namespace lamina::plot
