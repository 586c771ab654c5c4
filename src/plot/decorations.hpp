// Decorations stand in and beside pictures of meshes: axes, and bars that explain lengths and colours.
#pragma once

#include "plot/canvas.hpp"
#include "plot/color_scale.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

/// Draws the decorations that the options ask for: axes, which cover what lies beside the area of the view; a bar of a
/// round length in the lower right corner of the area; and the scale of the colours in the upper right one, where they
/// stand for numbers.
void draw_decorations(Canvas& canvas, const PictureView& view, const CellColors& colors, const PlotOptions& options);

}  // namespace lamina::plot
