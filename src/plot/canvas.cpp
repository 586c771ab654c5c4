#include "plot/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lamina::plot {

namespace {

/// Clips a convex polygon to the half-plane where inside(p) >= 0. Source: I. Sutherland, G. Hodgman, CACM 17 (1974).
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

}  // namespace

Canvas::Canvas(cairo_surface_t* surface, const PictureView& view)
    : cr_(cairo_create(surface), cairo_destroy), view_(view) {
    constexpr double margin_px = 8;
    const double margin = margin_px / view.scale;
    bounds_ = {view.window.lower - Point{margin, margin}, view.window.upper + Point{margin, margin}};
    cairo_set_line_cap(cr_.get(), CAIRO_LINE_CAP_ROUND);
}

void Canvas::paint(Color color) {
    set_color(color, 1);
    cairo_paint(cr_.get());
}

void Canvas::fill(const Box& box, Color color, double alpha) {
    const Box seen = box.intersection(bounds_);
    cairo_rectangle(cr_.get(), view_.x(seen.lower), view_.y(seen.upper), seen.width() * view_.scale,
                    seen.height() * view_.scale);
    set_color(color, alpha);
    cairo_set_antialias(cr_.get(), CAIRO_ANTIALIAS_NONE);
    cairo_fill(cr_.get());
}

void Canvas::dot(Point at, double radius, Color color) {
    if (!bounds_.contains(at)) return;
    cairo_arc(cr_.get(), view_.x(at), view_.y(at), radius, 0, 2 * std::numbers::pi);
    set_color(color, 1);
    cairo_set_antialias(cr_.get(), CAIRO_ANTIALIAS_DEFAULT);
    cairo_fill(cr_.get());
}

void Canvas::put(cairo_surface_t* image) {
    cairo_set_source_surface(cr_.get(), image, 0, 0);
    cairo_paint(cr_.get());
}

void Canvas::fill(std::vector<Point> polygon, Color color) {
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
    set_color(color, 1);
    cairo_set_antialias(cr_.get(), CAIRO_ANTIALIAS_NONE);
    cairo_fill(cr_.get());
}

void Canvas::stroke(Point a, Point b, Color color, double alpha, double width) {
    if (!clip_segment(a, b)) return;
    cairo_move_to(cr_.get(), view_.x(a), view_.y(a));
    cairo_line_to(cr_.get(), view_.x(b), view_.y(b));
    set_color(color, alpha);
    cairo_set_line_width(cr_.get(), width);
    cairo_set_antialias(cr_.get(), CAIRO_ANTIALIAS_DEFAULT);
    cairo_stroke(cr_.get());
}

void Canvas::write(Point at, const std::string& text, double height, Color color, double anchor) {
    cairo_select_font_face(cr_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr_.get(), height);
    cairo_text_extents_t extents;
    cairo_text_extents(cr_.get(), text.c_str(), &extents);
    // Capitals and digits are about 0.7 of the size of a font high.
    cairo_move_to(cr_.get(), view_.x(at) - anchor * extents.x_advance, view_.y(at) + 0.35 * height);
    set_color(color, 1);
    cairo_show_text(cr_.get(), text.c_str());
}

void Canvas::set_color(Color color, double alpha) {
    cairo_set_source_rgba(cr_.get(), color.r, color.g, color.b, alpha);
}

/// Clips a segment to the bounds. Returns false where nothing is left of it. Source: Y.-D. Liang, B. Barsky, ACM Trans.
/// Graph. 3 (1984).
bool Canvas::clip_segment(Point& a, Point& b) const {
    const Point d = b - a;
    double from = 0, to = 1;
    // Keeps the parameters t with t step <= room.
    const auto cut = [&](double step, double room) {
        if (step == 0) return room >= 0;
        (step > 0 ? to : from) = step > 0 ? std::min(to, room / step) : std::max(from, room / step);
        return from <= to;
    };
    if (!cut(-d.x, a.x - bounds_.lower.x) || !cut(d.x, bounds_.upper.x - a.x) || !cut(-d.y, a.y - bounds_.lower.y) ||
        !cut(d.y, bounds_.upper.y - a.y))
        return false;
    const Point start = a;
    if (to < 1) b = start + to * d;
    if (from > 0) a = start + from * d;
    return true;
}

void draw_on_image(Canvas& canvas, const PictureView& view, const std::function<void(Canvas&)>& draw) {
    constexpr double image_resolution = 2;     // pixels of the image per pixel of the picture
    constexpr double max_image_pixels = 4096;  // of its longer side
    const double resolution = std::min(image_resolution, max_image_pixels / std::max(view.width, view.height));
    using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
    const Surface image{
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(std::ceil(view.width * resolution)),
                                   static_cast<int>(std::ceil(view.height * resolution))),
        cairo_surface_destroy};
    if (cairo_surface_status(image.get()) != CAIRO_STATUS_SUCCESS) return draw(canvas);
    cairo_surface_set_device_scale(image.get(), resolution, resolution);
    {
        Canvas on_image(image.get(), view);
        draw(on_image);
    }
    cairo_surface_flush(image.get());
    canvas.put(image.get());
}

}  // namespace lamina::plot
