// The shapes of size sources: nothing else tells them apart. Each is an enumerator of SizeSource::Shape, a struct of
// functions here, a case of with_shape(), and a row of the texts in shapes.cpp. A shape is convex, and lies in the box
// that the points a and b of its source span.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include <lamina/sizing.hpp>

#include "core/box_tree.hpp"

namespace lamina::sizing {

/// The smaller and the larger one of two numbers. Unlike std::min() and std::max() they take numbers by value, and
/// compilers apply them to several pairs at once.
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }

/// The shape of a source, prepared for distances.
struct SourceShape {
    Point a, along;                 ///< along = b - a of SizeSource
    double inverse_squared_length;  ///< 1 / |along|^2; 0 for a point
    double radius;
    SizeSource::Shape shape;
};
SourceShape prepare_shape(const SizeSource& source);

/// What a source asks its size for in a domain.
struct Extent {
    double area = 0, border = 0;
};

/// A segment or point and, with a radius, all round it.
struct SegmentShape {
    static constexpr bool has_area = false;

    /// Returns the squared distance of a point from the shape without its radius.
    static double squared_distance(const SourceShape& shape, Point p) {
        const Point along = shape.along, ap = p - shape.a;
        const double t = smaller(larger(dot(ap, along) * shape.inverse_squared_length, 0.0), 1.0);
        return squared_length(ap - t * along);
    }
    /// Returns the part of a source that lies in a domain, about.
    static Extent extent_in(const Box& domain, const SizeSource& source);
    /// Returns why a source has no shape; null where it has one.
    static const char* fault(const SizeSource&) { return nullptr; }
};

/// A box with its lower left and its upper right corner.
struct BoxShape {
    static constexpr bool has_area = true;

    static double squared_distance(const SourceShape& shape, Point p) {
        return core::squared_distance(Box{shape.a, shape.a + shape.along}, p);
    }
    static Extent extent_in(const Box& domain, const SizeSource& source);
    static const char* fault(const SizeSource& source) {
        return source.a.x <= source.b.x && source.a.y <= source.b.y ? nullptr : "a box is empty";
    }
};

/// Returns f(the struct of the shape).
template <class F>
auto with_shape(SizeSource::Shape shape, F&& f) {
    switch (shape) {
        case SizeSource::Shape::segment:
            return f(SegmentShape{});
        case SizeSource::Shape::box:
            break;
    }
    return f(BoxShape{});
}

/// Returns the squared distances of points from the shape without its radius.
template <std::size_t N>
std::array<double, N> squared_distances(const SourceShape& shape, const std::array<double, N>& x,
                                        const std::array<double, N>& y) {
    // Compilers work on several points at once where nothing in the loop can change the shape.
    return with_shape(shape.shape, [&x, &y, own = shape](auto kind) {
        std::array<double, N> squared;
        for (std::size_t k = 0; k < N; ++k) squared[k] = kind.squared_distance(own, {x[k], y[k]});
        return squared;
    });
}

/// Returns the distance from p to the shape; 0 inside it.
inline double distance_to(const SourceShape& shape, Point p) {
    const double squared = with_shape(shape.shape, [&](auto kind) { return kind.squared_distance(shape, p); });
    return std::max(std::sqrt(squared) - shape.radius, 0.0);
}

inline bool has_inside(const SourceShape& shape) {
    return shape.radius > 0 || with_shape(shape.shape, [](auto kind) { return kind.has_area; });
}

/// Returns whether the box lies inside the shape.
bool covers(const SourceShape& shape, const Box& box);

/// Returns the part of a source that lies in a domain, about.
Extent extent_in(const Box& domain, const SizeSource& source);

/// Returns why a source has no shape; null where it has one.
const char* shape_fault(const SizeSource& source);

/// Reads "box:X0,Y0,X1,Y1,H", "circle:X,Y,R,H" or "line:X0,Y0,X1,Y1,H", where H is the size. Throws UsageError with the
/// bare reason.
LAMINA_EXPORT SizeSource parse_size_source(const std::string& text);
/// Returns the text that parse_size_source() reads back.
LAMINA_EXPORT std::string size_source_text(const SizeSource& source);

/// Returns the texts of all shapes in one line: "box:X0,Y0,X1,Y1,H, ... or line:X0,Y0,X1,Y1,H".
std::string source_forms();

}  // namespace lamina::sizing
