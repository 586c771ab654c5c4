// The table of the options of plot_mesh().
#include <lamina/plot.hpp>

#include <cmath>

#include <lamina/option_builders.hpp>

#include "core/text.hpp"

namespace lamina::plot {

namespace {

std::array<double, 4> parse_window(const std::string& text) {
    const std::vector<double> n = core::parse_numbers(text, ',');
    if (n.size() != 4) throw UsageError("'" + text + "' is not x0,x1,y0,y1");
    if (!(n[0] < n[1] && n[2] < n[3])) throw UsageError("x0 must be below x1, and y0 below y1");
    if (!std::isfinite(n[1] - n[0]) || !std::isfinite(n[3] - n[2])) throw UsageError("the window is too large");
    return {n[0], n[1], n[2], n[3]};
}

std::string window_text(const std::array<double, 4>& w) { return core::concat(w[0], ",", w[1], ",", w[2], ",", w[3]); }

OptionTable<PlotOptions> make_table() {
    OptionTableBuilder<PlotOptions> table("Picture");
    table.choice("color", "quantity that the colours of the cells show",
                 Choices<PlotColor>{{"none", PlotColor::none},
                                    {"quality", PlotColor::quality},
                                    {"size", PlotColor::size},
                                    {"piece", PlotColor::piece},
                                    {"layer", PlotColor::layer}},
                 member_at(&PlotOptions::color));
    table.spec("window", "X0,X1,Y0,Y1", "part of the plane to show, in units of the input; else the whole mesh",
               parse_window, window_text, member_at(&PlotOptions::window));
    table.choice("format", "format of the picture; else its extension says it",
                 Choices<std::string>{{"png", "png"}, {"svg", "svg"}, {"pdf", "pdf"}}, member_at(&PlotOptions::format));
    constexpr int max_cairo_pixels = 32767;
    table.count("width", "PX", "longer side of the picture, in pixels", numbers_from_to(16, max_cairo_pixels),
                member_at(&PlotOptions::width_px));
    return table.take();
}

}  // namespace

}  // namespace lamina::plot

namespace lamina {

const OptionTable<PlotOptions>& plot_option_table() {
    static const OptionTable<PlotOptions> table = plot::make_table();
    return table;
}

void validate(const PlotOptions& options) { require_in_range(plot_option_table(), options); }

}  // namespace lamina
