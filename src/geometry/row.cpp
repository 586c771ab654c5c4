#include "geometry/row.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/rounding.hpp"

namespace lamina::geometry {

std::size_t Channel::narrowest() const {
    std::size_t narrowest = 0;
    for (std::size_t k = 0; k < low.size(); ++k)
        if (high[k] - low[k] < high[narrowest] - low[narrowest]) narrowest = k;
    return narrowest;
}

namespace {

std::size_t column_of(const Channel& channel, double x) {
    const double column = std::floor((x - channel.left) / channel.width);
    return static_cast<std::size_t>(std::clamp(column, 0.0, static_cast<double>(channel.low.size() - 1)));
}

/// Returns the ordinates of an edge where it enters and where it leaves the abscissas [begin, end]; a.x <= b.x.
std::pair<double, double> ordinates_between(Point a, Point b, double begin, double end) {
    if (a.x == b.x) return {a.y, b.y};
    const auto y_at = [&](double x) {
        if (x <= a.x) return a.y;
        return x >= b.x ? b.y : a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
    };
    return {y_at(begin), y_at(end)};
}

/// Narrows the columns of a channel below an edge, and above the same edge one pitch below.
void narrow(Channel& channel, Point a, Point b, double pitch) {
    if (a.x > b.x) std::swap(a, b);
    for (std::size_t k = column_of(channel, a.x), last = column_of(channel, b.x); k <= last; ++k) {
        const double begin = channel.left + static_cast<double>(k) * channel.width;
        const auto [first, second] = ordinates_between(a, b, begin, begin + channel.width);
        channel.low[k] = std::max(channel.low[k], std::max(first, second) - pitch);
        channel.high[k] = std::min(channel.high[k], std::min(first, second));
    }
}

}  // namespace

Channel channel_below(std::span<const std::vector<Point>> outlines, double pitch, std::size_t columns) {
    Box box;
    for (const std::vector<Point>& outline : outlines)
        for (const Point p : outline) box.include(p);
    Channel channel{box.lower.x, box.width() / static_cast<double>(columns), {}, {}};
    channel.low.assign(columns, -HUGE_VAL);
    channel.high.assign(columns, HUGE_VAL);
    for (const std::vector<Point>& outline : outlines)
        for (std::size_t i = 0; i < outline.size(); ++i)
            narrow(channel, outline[i], outline[(i + 1) % outline.size()], pitch);
    return channel;
}

std::vector<double> shifts_in_row(const Geometry& geometry) {
    std::vector<double> shifts;
    if (!geometry.pitch) return shifts;
    const double heights = bounding_box(geometry).height() / *geometry.pitch;
    const int last = geometry.elements.size() > 1 ? 1 + static_cast<int>(heights) : 1;
    for (int k = 1; k <= last; ++k)
        for (const int sign : {-1, 1}) shifts.push_back(sign * k * *geometry.pitch);
    return shifts;
}

}  // namespace lamina::geometry

namespace lamina {

Geometry blade_row(Geometry geometry, double pitch, double stagger_deg) {
    constexpr double most_pitches = 4000;  // 2^12 of them have 53 bits with a step of 2^-41 (core::border_step)
    constexpr std::size_t columns = 2048;
    constexpr double least_gap = 1e-3;  // of the pitch
    if (stagger_deg != 0) {
        if (!geometry.unturned_box) geometry.unturned_box = reference_box(geometry);
        geometry = transformed(std::move(geometry), std::vector{Transformation{"all", Rotation{stagger_deg, {}}}});
    }
    geometry.pitch = core::rounded_to_multiple(pitch, core::border_step(pitch));
    const Box box = bounding_box(geometry);
    if (!(std::max(std::abs(box.lower.y), std::abs(box.upper.y)) < most_pitches * pitch))
        throw OptionError("periodic",
                          fmt::format("the configuration is more than {} pitches away from y = 0, or as high: "
                                      "raise the pitch, or shift it with --transform",
                                      most_pitches));
    std::vector<std::vector<Point>> outlines;
    for (const Element& element : geometry.elements) outlines.push_back(element.points);
    const geometry::Channel channel = geometry::channel_below(outlines, *geometry.pitch, columns);
    const std::size_t k = channel.narrowest();
    const double gap = channel.high[k] - channel.low[k];
    if (!(gap > least_gap * pitch))
        throw OptionError("periodic",
                          fmt::format("blades are {:.4g} high along y at x = {:.4g}, and the pitch is {:.4g}, "
                                      "so neighbours {}: raise the pitch, or change the stagger angle",
                                      pitch - gap, channel.middle(k), pitch, gap > 0 ? "touch each other" : "overlap"));
    return geometry;
}

}  // namespace lamina
