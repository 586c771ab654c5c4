// The table of the options of plot_mesh().
#include <lamina/plot.hpp>

#include <cmath>

#include "core/option_rows.hpp"
#include "core/text.hpp"

namespace lamina {

namespace {

PlotWindow parse_window(const std::string& text) {
    // A name begins with a letter, and no number of a window does.
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') return {.place = text};
    const std::vector<double> n = core::parse_numbers(text, ',');
    if (n.size() != 4) throw UsageError("'" + text + "' is neither x0,x1,y0,y1 nor a place such as nose or slot:2");
    if (!(n[0] < n[1] && n[2] < n[3])) throw UsageError("x0 must be below x1, and y0 below y1");
    if (!std::isfinite(n[1] - n[0]) || !std::isfinite(n[3] - n[2])) throw UsageError("the window is too large");
    return {.box = {n[0], n[1], n[2], n[3]}};
}

std::string window_text(const PlotWindow& window) {
    const auto& [x0, x1, y0, y1] = window.box;
    return window.place.empty() ? core::concat(x0, ",", x1, ",", y0, ",", y1) : window.place;
}

}  // namespace

template <>
OptionTable<PlotOptions> option_rows() {
    OptionTableBuilder<PlotOptions> table("Picture");
    table.choice("color", "quantity that the colours of the cells show",
                 Choices<PlotColor>{{"none", PlotColor::none},
                                    {"quality", PlotColor::quality},
                                    {"size", PlotColor::size},
                                    {"piece", PlotColor::piece},
                                    {"layer", PlotColor::layer}},
                 member_at(&PlotOptions::color));
    table.spec("window", "X0,X1,Y0,Y1|PLACE",
               "part of the plane to show, in units of the input, or a place: nose, tail, slot, walls, all; nose:2 is "
               "that of the second body; else the whole mesh",
               parse_window, window_text, member_at(&PlotOptions::window));
    table.count("repeat", "N", "copies of a periodic mesh to draw, one above the other", numbers_from_to(1, 100),
                member_at(&PlotOptions::repeat));
    table.flag("axes", "write coordinates beside the picture", true, member_at(&PlotOptions::axes));
    table.flag("scale-bar", "draw a bar of a round length", true, member_at(&PlotOptions::scale_bar));
    table.flag("color-bar", "draw a bar that explains the colours", true, member_at(&PlotOptions::color_bar));
    table.choice("format", "format of the picture; else its extension says it",
                 Choices<std::string>{{"png", "png"}, {"svg", "svg"}, {"pdf", "pdf"}}, member_at(&PlotOptions::format));
    constexpr int max_cairo_pixels = 32767;
    table.count("width", "PX", "longer side of the picture, in pixels", numbers_from_to(16, max_cairo_pixels),
                member_at(&PlotOptions::width_px));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<PlotOptions>& option_table();

void validate(const PlotOptions& options) { require_in_range(option_table<PlotOptions>(), options); }

}  // namespace lamina
