// Pictures of meshes through Cairo: PNG, SVG, PDF.
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <ostream>
#include <tuple>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/plot.hpp>

#include "core/atomic_file.hpp"
#include "core/text.hpp"
#include "mesh/quality.hpp"

namespace lamina::plot {

namespace fs = std::filesystem;

namespace {

struct Color {
    double r, g, b;
};

Color mix(Color a, Color b, double t) { return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)}; }

constexpr Color outside{0.88, 0.89, 0.90};
constexpr Color white{1, 1, 1};
constexpr Color layer_tint{0.86, 0.92, 0.99};
constexpr Color thin_edge{0.13, 0.16, 0.22};
constexpr Color wall_edge{0.72, 0.08, 0.12};
constexpr Color far_edge{0.13, 0.16, 0.22};

// In pixels.
constexpr double edge_width = 0.6;
constexpr double wall_width = 2.0;
constexpr double far_width = 1.2;
constexpr double finest_drawn = 0.5;  ///< cells thinner than this are filled instead of outlined

/// Dark blue, green, yellow: equal steps look equal, in grey and to the colour-blind as well.
/// Source: viridis, S. van der Walt and N. Smith, matplotlib (2015), nine of its entries.
Color viridis(double t) {
    static constexpr Color entries[] = {{0.267, 0.005, 0.329}, {0.279, 0.175, 0.483}, {0.230, 0.322, 0.546},
                                        {0.173, 0.449, 0.558}, {0.128, 0.567, 0.551}, {0.158, 0.684, 0.502},
                                        {0.369, 0.789, 0.383}, {0.678, 0.864, 0.190}, {0.993, 0.906, 0.144}};
    constexpr int last = static_cast<int>(std::size(entries)) - 1;
    const double at = std::clamp(t, 0.0, 1.0) * last;
    const int i = std::min(static_cast<int>(at), last - 1);
    return mix(entries[i], entries[i + 1], at - i);
}

/// Soft colours, those of successive numbers far apart: hues at multiples of the golden ratio.
Color distinct(std::uint32_t number) {
    const double hue = std::fmod(number * 0.6180339887498949, 1.0);
    const auto channel = [&](double shift) {
        const double distance = std::abs(std::fmod(hue + shift, 1.0) * 6 - 3) - 1;
        return 1 - 0.34 * (1 - std::clamp(distance, 0.0, 1.0));
    };
    return {channel(0), channel(2.0 / 3), channel(1.0 / 3)};
}

// --- What is drawn where

/// Maps the window to the picture, y upwards.
struct View {
    Box window;
    double scale = 1;  ///< pixels per unit of length
    double width = 0, height = 0;

    double x(Point p) const { return (p.x - window.lower.x) * scale; }
    double y(Point p) const { return (window.upper.y - p.y) * scale; }
};

View make_view(const Mesh& mesh, const PlotOptions& options) {
    View view;
    if (options.window) {
        const auto [x0, x1, y0, y1] = *options.window;
        if (!(x0 < x1) || !(y0 < y1) || !std::isfinite(x1 - x0) || !std::isfinite(y1 - y0))
            throw UsageError(fmt::format("window {},{},{},{}: x0 < x1 and y0 < y1 needed", x0, x1, y0, y1));
        view.window = {{x0, y0}, {x1, y1}};
    } else {
        for (const Point p : mesh.points) view.window.include(p);
        if (mesh.points.empty()) view.window = {{0, 0}, {1, 1}};
        const double margin = 0.01 * std::max(view.window.width(), view.window.height());
        view.window.lower = view.window.lower - Point{margin, margin};
        view.window.upper = view.window.upper + Point{margin, margin};
    }
    const double longer = std::max(view.window.width(), view.window.height());
    view.scale = options.width_px / longer;
    // At least one pixel, however slender the window.
    view.width = std::max(1.0, std::round(view.window.width() * view.scale));
    view.height = std::max(1.0, std::round(view.window.height() * view.scale));
    return view;
}

/// A cell that overlaps the window.
struct VisibleCell {
    std::size_t cell;
    std::size_t corners;
    std::array<VertexId, 4> vertex;
    std::array<Point, 4> corner;

    double area() const {
        return 0.5 * std::abs(corners == 3 ? cross(corner[1] - corner[0], corner[2] - corner[0])
                                           : cross(corner[2] - corner[0], corner[3] - corner[1]));
    }
    /// Area over longest edge: half the room there is between two edges.
    double thickness() const {
        double longest = 0;
        for (std::size_t i = 0; i < corners; ++i)
            longest = std::max(longest, distance(corner[i], corner[(i + 1) % corners]));
        return longest > 0 ? area() / longest : 0;
    }
};

std::vector<VisibleCell> visible_cells(const Mesh& mesh, const Box& window) {
    std::vector<VisibleCell> visible;
    const auto look_at = [&](std::size_t cell, const auto& v) {
        VisibleCell seen{cell, std::size(v), {}, {}};
        Box box;
        for (std::size_t i = 0; i < seen.corners; ++i) {
            seen.vertex[i] = v[i];
            seen.corner[i] = mesh.points[v[i].index()];
            box.include(seen.corner[i]);
        }
        if (box.overlaps(window)) visible.push_back(seen);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) look_at(t, mesh.triangles[t].v);
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) look_at(mesh.triangles.size() + q, mesh.quads[q].v);
    return visible;
}

// --- Colours of cells

/// Logarithm of the side of a square of the cell's area: what "size" shows.
double log_size(const VisibleCell& c) { return 0.5 * std::log10(std::max(c.area(), 1e-300)); }

double smallest_angle_deg(const VisibleCell& c) {
    return c.corners == 3 ? core::measure_triangle(c.corner[0], c.corner[1], c.corner[2]).min_angle_deg
                          : mesh::measure_quad(c.corner[0], c.corner[1], c.corner[2], c.corner[3]).min_angle_deg;
}

/// Fill colours of the visible cells; the ranges of `size` and `layer` are those in view.
std::vector<Color> cell_colors(const Mesh& mesh, const std::vector<VisibleCell>& cells, PlotColor by) {
    std::vector<double> value(cells.size(), 0.0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (by == PlotColor::size) value[i] = log_size(cells[i]);
        if (by == PlotColor::layer && !mesh.layer.empty()) value[i] = mesh.layer[cells[i].cell];
        // Angles of isotropic triangles reach 60 degrees; of squares 90, which then look like 60.
        if (by == PlotColor::quality) value[i] = smallest_angle_deg(cells[i]) / 60;
    }
    if (by == PlotColor::size && !value.empty()) {
        const auto [low, high] = std::minmax_element(value.begin(), value.end());
        const double from = *low, range = std::max(*high - *low, 1e-9);
        for (double& v : value) v = (v - from) / range;
    }
    const double layers = value.empty() ? 1 : std::max(1.0, *std::max_element(value.begin(), value.end()));

    std::vector<Color> colors;
    colors.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::size_t cell = cells[i].cell;
        const bool in_layer = !mesh.region.empty() && mesh.region[cell] == Region::layer;
        switch (by) {
            case PlotColor::none:
                colors.push_back(in_layer ? layer_tint : white);
                break;
            case PlotColor::quality:
            case PlotColor::size:
                colors.push_back(viridis(value[i]));
                break;
            case PlotColor::piece:
                colors.push_back(mesh.piece.empty() ? white : distinct(mesh.piece[cell]));
                break;
            case PlotColor::layer:
                colors.push_back(value[i] == 0 ? white : viridis(value[i] / layers));
                break;
        }
    }
    return colors;
}

// --- Drawing

// Cairo's own numbers end at 2^23 pixels: whatever is drawn is cut to the window, and a little around it, before.

/// Cuts a convex polygon to the half plane where inside(p) >= 0 (I. Sutherland and G. Hodgman, CACM 17, 1974).
template <class F>
std::vector<Point> clip(const std::vector<Point>& polygon, F&& inside) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double at_p = inside(p), at_q = inside(q);
        if (at_p >= 0) kept.push_back(p);
        if ((at_p >= 0) != (at_q >= 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    return kept;
}

class Canvas {
public:
    Canvas(cairo_surface_t* surface, const View& view) : cr_(cairo_create(surface), cairo_destroy), view_(view) {
        const double margin = 8 / view.scale;
        bounds_ = {view.window.lower - Point{margin, margin}, view.window.upper + Point{margin, margin}};
        cairo_set_line_cap(cr_.get(), CAIRO_LINE_CAP_ROUND);
    }
    void paint(Color c) {
        set(c, 1);
        cairo_paint(cr_.get());
    }
    /// Neighbouring fills would leave pale seams where both cover a pixel in part: hence without smoothing.
    void fill(const VisibleCell& cell, Color c) {
        std::vector<Point> polygon(cell.corner.begin(), cell.corner.begin() + static_cast<long>(cell.corners));
        Box box;
        for (const Point p : polygon) box.include(p);
        if (!bounds_.contains(box.lower) || !bounds_.contains(box.upper)) {
            polygon = clip(polygon, [&](Point p) { return p.x - bounds_.lower.x; });
            polygon = clip(polygon, [&](Point p) { return bounds_.upper.x - p.x; });
            polygon = clip(polygon, [&](Point p) { return p.y - bounds_.lower.y; });
            polygon = clip(polygon, [&](Point p) { return bounds_.upper.y - p.y; });
        }
        if (polygon.size() < 3) return;
        for (const Point p : polygon) cairo_line_to(cr_.get(), view_.x(p), view_.y(p));
        cairo_close_path(cr_.get());
        set(c, 1);
        cairo_set_antialias(cr_.get(), CAIRO_ANTIALIAS_NONE);
        cairo_fill(cr_.get());
    }
    void stroke(Point a, Point b, Color c, double alpha, double width) {
        if (!clip_segment(a, b)) return;
        cairo_move_to(cr_.get(), view_.x(a), view_.y(a));
        cairo_line_to(cr_.get(), view_.x(b), view_.y(b));
        set(c, alpha);
        cairo_set_line_width(cr_.get(), width);
        cairo_set_antialias(cr_.get(), CAIRO_ANTIALIAS_DEFAULT);
        cairo_stroke(cr_.get());
    }

private:
    void set(Color c, double alpha) { cairo_set_source_rgba(cr_.get(), c.r, c.g, c.b, alpha); }

    /// Y.-D. Liang and B. Barsky, ACM Trans. Graph. 3 (1984).
    bool clip_segment(Point& a, Point& b) const {
        const Point d = b - a;
        double from = 0, to = 1;
        const auto cut = [&](double step, double room) {  // keeps t with t step <= room
            if (step == 0) return room >= 0;
            (step > 0 ? to : from) = step > 0 ? std::min(to, room / step) : std::max(from, room / step);
            return from <= to;
        };
        if (!cut(-d.x, a.x - bounds_.lower.x) || !cut(d.x, bounds_.upper.x - a.x) ||
            !cut(-d.y, a.y - bounds_.lower.y) || !cut(d.y, bounds_.upper.y - a.y))
            return false;
        const Point start = a;
        if (to < 1) b = start + to * d;
        if (from > 0) a = start + from * d;
        return true;
    }

    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cr_;
    View view_;
    Box bounds_;
};

/// Where lines would merge into a blot, cells are filled with the grey that fading lines come to.
void draw_cells(Canvas& canvas, const std::vector<VisibleCell>& cells, const std::vector<Color>& colors,
                const View& view, bool with_grey) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool too_fine = with_grey && cells[i].thickness() * view.scale < finest_drawn;
        canvas.fill(cells[i], too_fine ? mix(colors[i], thin_edge, 0.4) : colors[i]);
    }
}

/// Each edge once, fainter where there is little room beside it.
void draw_edges(Canvas& canvas, const Mesh& mesh, const std::vector<VisibleCell>& cells, const View& view,
                double strongest) {
    struct Edge {
        Segment ends;
        float room;  // thickness in pixels of the thinner of its cells
    };
    std::vector<Edge> edges;
    for (const VisibleCell& cell : cells) {
        const auto room = static_cast<float>(cell.thickness() * view.scale);
        if (room < finest_drawn) continue;
        for (std::size_t i = 0; i < cell.corners; ++i) {
            const VertexId a = cell.vertex[i], b = cell.vertex[(i + 1) % cell.corners];
            edges.push_back({{std::min(a, b), std::max(a, b)}, room});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& e, const Edge& f) { return std::tie(e.ends, e.room) < std::tie(f.ends, f.room); });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i > 0 && edges[i].ends == edges[i - 1].ends) continue;
        const auto [a, b] = edges[i].ends;
        const double alpha = strongest * std::min(1.0, 0.5 * edges[i].room / edge_width);
        canvas.stroke(mesh.points[a.index()], mesh.points[b.index()], thin_edge, alpha, edge_width);
    }
}

void draw_markers(Canvas& canvas, const Mesh& mesh) {
    for (const Marker& marker : mesh.markers) {
        const bool far = marker.kind == MarkerKind::far_field;
        for (const Segment& edge : marker.edges)
            canvas.stroke(mesh.points[edge.a.index()], mesh.points[edge.b.index()], far ? far_edge : wall_edge, 1,
                          far ? far_width : wall_width);
    }
}

void draw(cairo_surface_t* surface, const Mesh& mesh, const View& view, PlotColor by) {
    const std::vector<VisibleCell> cells = visible_cells(mesh, view.window);
    const bool colored = by != PlotColor::none;
    Canvas canvas(surface, view);
    canvas.paint(outside);
    draw_cells(canvas, cells, cell_colors(mesh, cells, by), view, !colored);
    draw_edges(canvas, mesh, cells, view, colored ? 0.45 : 1);
    draw_markers(canvas, mesh);
}

// --- Formats

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

cairo_status_t send(void* stream, const unsigned char* bytes, unsigned length) {
    std::ostream& out = *static_cast<std::ostream*>(stream);
    out.write(reinterpret_cast<const char*>(bytes), length);
    return out ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

Surface make_png(std::ostream&, const View& view) {
    return {cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(view.width), static_cast<int>(view.height)),
            cairo_surface_destroy};
}
Surface make_svg(std::ostream& out, const View& view) {
    return {cairo_svg_surface_create_for_stream(send, &out, view.width, view.height), cairo_surface_destroy};
}
Surface make_pdf(std::ostream& out, const View& view) {
    return {cairo_pdf_surface_create_for_stream(send, &out, view.width, view.height), cairo_surface_destroy};
}

struct PictureFormat {
    const char* extension;
    Surface (*make)(std::ostream&, const View&);
    bool is_image;  ///< sent to the stream at the end, not while drawing
};

constexpr PictureFormat picture_formats[] = {
    {".png", make_png, true}, {".svg", make_svg, false}, {".pdf", make_pdf, false}};

const PictureFormat& picture_format_of(const fs::path& file) {
    const std::string extension = core::extension_of(file);
    for (const PictureFormat& format : picture_formats)
        if (extension == format.extension) return format;
    throw UsageError(
        fmt::format("{}: pictures are written as .png, .svg or .pdf, not as '{}'", file.string(), extension));
}

}  // namespace

}  // namespace lamina::plot

namespace lamina {

using namespace plot;

void plot_mesh(const Mesh& mesh, const fs::path& file, const PlotOptions& options) {
    validate(options);
    if (options.width_px < 1 || options.width_px > 32767)  // Cairo's limit
        throw UsageError(fmt::format("picture of {} pixels: 1 to 32767 can be drawn", options.width_px));
    const PictureFormat& format = picture_format_of(file);
    const View view = make_view(mesh, options);
    check_folder_writable(file);
    core::write_stream_atomically(file, [&](std::ostream& out) {
        const Surface surface = format.make(out, view);
        draw(surface.get(), mesh, view, options.color);
        cairo_status_t status = CAIRO_STATUS_SUCCESS;
        if (format.is_image) status = cairo_surface_write_to_png_stream(surface.get(), send, &out);
        cairo_surface_finish(surface.get());
        if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
        if (status != CAIRO_STATUS_SUCCESS)
            throw IoError(file.string(), fmt::format("cannot draw: {}", cairo_status_to_string(status)));
    });
}

}  // namespace lamina
