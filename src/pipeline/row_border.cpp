#include "pipeline/row_border.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/marker_names.hpp"
#include "core/rounding.hpp"
#include "decoupling/separators.hpp"
#include "geometry/row.hpp"

namespace lamina::pipeline {

namespace {

constexpr std::size_t columns = 1024;
constexpr double kept_share = 0.35;  ///< of the channel, beside each of its sides

/// Fills columns without outlines, between elements that are one behind the other, with what is on both sides.
void fill_gaps(geometry::Channel& channel) {
    for (std::size_t k = 1; k + 1 < channel.low.size(); ++k) {
        if (std::isfinite(channel.low[k])) continue;
        std::size_t end = k;
        while (!std::isfinite(channel.low[end])) ++end;
        for (std::vector<double>* side : {&channel.low, &channel.high}) {
            const double before = (*side)[k - 1], step = ((*side)[end] - before) / static_cast<double>(end - k + 1);
            for (std::size_t i = k; i < end; ++i) (*side)[i] = before + static_cast<double>(i - k + 1) * step;
        }
        k = end;
    }
}

/// Returns the channel with all outlines wider by so much to both sides along x: the curve may rise steeply beside an
/// end, and is to keep its distance along x, too.
geometry::Channel with_wider_outlines(const geometry::Channel& channel, double by) {
    const auto added = static_cast<std::size_t>(std::ceil(by / channel.width));
    const std::size_t n = channel.low.size();
    geometry::Channel wider{channel.left - static_cast<double>(added) * channel.width, channel.width, {}, {}};
    for (std::size_t k = 0; k < n + 2 * added; ++k) {
        // Of the channel, the columns from k - 2 added to k are as near as that.
        const auto first = static_cast<std::ptrdiff_t>(k > 2 * added ? k - 2 * added : 0),
                   end = static_cast<std::ptrdiff_t>(std::min(k + 1, n));
        wider.low.push_back(*std::max_element(channel.low.begin() + first, channel.low.begin() + end));
        wider.high.push_back(*std::min_element(channel.high.begin() + first, channel.high.begin() + end));
    }
    return wider;
}

/// The part of the room between blades where the border may run, in columns; and so many ahead of them and behind,
/// where nothing is in the way.
struct Lane {
    std::vector<double> low, high;
    std::size_t run_out = 0;
};

Lane lane_in(const geometry::Channel& channel, double pitch) {
    const std::size_t n = channel.low.size();
    const double run = std::min(pitch, static_cast<double>(n) * channel.width);
    Lane lane;
    lane.run_out = static_cast<std::size_t>(std::ceil(run / channel.width));
    lane.low.assign(lane.run_out, -HUGE_VAL);
    lane.high.assign(lane.run_out, HUGE_VAL);
    for (std::size_t k = 0; k < n; ++k) {
        const double kept = kept_share * (channel.high[k] - channel.low[k]);
        lane.low.push_back(channel.low[k] + kept);
        lane.high.push_back(channel.high[k] - kept);
    }
    lane.low.resize(lane.low.size() + lane.run_out, -HUGE_VAL);
    lane.high.resize(lane.high.size() + lane.run_out, HUGE_VAL);
    return lane;
}

/// Returns y of a smooth curve along a lane, one per column. It begins as its middle, and as a line along x ahead and
/// behind.
std::vector<double> smooth_curve(const Lane& lane, double smoothed_columns) {
    const std::size_t n = lane.low.size();
    const auto middle = [&](std::size_t k) { return 0.5 * (lane.low[k] + lane.high[k]); };
    std::vector<double> y(n), next(n);
    for (std::size_t k = 0; k < n; ++k) y[k] = middle(std::clamp(k, lane.run_out, n - lane.run_out - 1));
    // Each round takes the mean of a column and of the mean of two others, which smooths over their distance times the
    // square root of half the number of rounds. Shorter distances take away what longer ones leave between columns: a
    // mean of the two alone would leave what changes its sign from column to column.
    for (const std::size_t apart : {8, 4, 2, 1}) {
        const double rounds = smoothed_columns / static_cast<double>(apart);
        const int count = apart == 8 ? static_cast<int>(2 * rounds * rounds) : 40;
        for (int round = 0; round < count; ++round) {
            for (std::size_t k = 0; k < n; ++k) {
                const double beside = 0.5 * (y[k > apart ? k - apart : 0] + y[std::min(k + apart, n - 1)]);
                next[k] = std::clamp(0.5 * (y[k] + beside), lane.low[k], lane.high[k]);
            }
            y.swap(next);
        }
    }
    return y;
}

/// Returns sizes along a border that has lines beside it: sizes that grow from layers do not know of these, and edges
/// as long as what is kept to both sides cut no corner of the curve that far.
std::vector<SizeSource> sources_along(const geometry::Channel& channel, const Lane& lane, std::span<const double> y) {
    constexpr std::size_t columns_apart = 8;
    std::vector<SizeSource> sources;
    const std::size_t n = channel.low.size();
    for (std::size_t first = 0; first < n; first += columns_apart) {
        const std::size_t last = std::min(first + columns_apart, n) - 1;
        double gap = HUGE_VAL;
        for (std::size_t k = first; k <= last; ++k) gap = std::min(gap, channel.high[k] - channel.low[k]);
        const auto at = [&](std::size_t k) { return Point{channel.middle(k), y[k + lane.run_out]}; };
        sources.push_back({.a = at(first), .b = at(last), .size = kept_share * gap});
    }
    return sources;
}

/// Adds the copies of items, moved by whole numbers of pitches, that may count in the domain; none outside a row.
template <class Item, class BoxOf, class Moved>
void add_copies(const decoupling::FarField& far_field, BoxOf&& box_of, Moved&& moved, std::vector<Item>& items) {
    if (!(far_field.pitch > 0)) return;
    const Box domain = far_field.box();
    const std::size_t n = items.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Box box = box_of(items[i]);
        const auto first = static_cast<int>(std::floor((domain.lower.y - box.upper.y) / far_field.pitch)),
                   last = static_cast<int>(std::ceil((domain.upper.y - box.lower.y) / far_field.pitch));
        for (int k = first; k <= last; ++k)
            if (k != 0) items.push_back(moved(Item(items[i]), k * far_field.pitch));
    }
}

bool is_open(const geometry::Channel& channel) {
    const std::size_t k = channel.narrowest();
    return channel.high[k] > channel.low[k];
}

/// Throws OptionError with this text, which holds x, where a channel is closed.
void require_open(const geometry::Channel& channel, const char* option, fmt::format_string<double> text) {
    if (!is_open(channel)) throw OptionError(option, fmt::format(text, channel.middle(channel.narrowest())));
}

}  // namespace

RowBorder border_below(std::vector<std::vector<Point>> fronts, std::span<const std::vector<Point>> lines,
                       const decoupling::FarField& far_field) {
    constexpr double smoothed_share = 0.2;  // of the pitch
    constexpr double most_smoothed = 0.3;   // of the columns
    // Of the pitch, beside the ends of outlines. 24 rows with lines and sheets: without it three have angles below the
    // bound (18.4 degrees), with 0.02 and 0.05 none, for as many triangles within 0.6 %.
    constexpr double kept_along = 0.02;
    const double pitch = far_field.pitch;
    geometry::Channel channel = geometry::channel_below(fronts, pitch, columns);
    fill_gaps(channel);
    require_open(
        channel, "periodic",
        "the layers of neighbouring blades close the channel between them at x = {:.4g}: raise the pitch, or ask "
        "for thinner layers");
    if (!lines.empty()) {
        fronts.insert(fronts.end(), lines.begin(), lines.end());
        channel = geometry::channel_below(fronts, pitch, columns);
        fill_gaps(channel);
        require_open(
            channel, "line",
            "with their copies, one pitch above and below, lines close the channel between blades at x = {:.4g}: "
            "leave a gap there, or move lines by a pitch");
    }
    if (geometry::Channel wider = with_wider_outlines(channel, kept_along * pitch); is_open(wider))
        channel = std::move(wider);
    const Lane lane = lane_in(channel, pitch);
    const std::vector<double> y =
        smooth_curve(lane, std::min(smoothed_share * pitch / channel.width, most_smoothed * columns));
    const Box domain = far_field.box();
    RowBorder border;
    std::vector<Point>& curve = border.curve;
    for (std::size_t k = 0; k < y.size(); ++k) {
        const double x =
            channel.left + (static_cast<double>(k) - static_cast<double>(lane.run_out) + 0.5) * channel.width;
        if (x > domain.lower.x + channel.width && x < domain.upper.x - channel.width) curve.push_back({x, y[k]});
    }
    curve.insert(curve.begin(), {domain.lower.x, curve.front().y});
    curve.push_back({domain.upper.x, curve.back().y});
    if (!lines.empty()) border.sources = sources_along(channel, lane, y);
    return border;
}

std::vector<SizeSource> repeated_in_row(std::vector<SizeSource> sources, const decoupling::FarField& far_field) {
    add_copies(
        far_field, [](const SizeSource& source) { return bounding_box(source); },
        [](SizeSource source, double shift) {
            source.a = geometry::moved(source.a, shift);
            source.b = geometry::moved(source.b, shift);
            return source;
        },
        sources);
    return sources;
}

std::vector<std::vector<Point>> repeated_in_row(std::vector<std::vector<Point>> loops,
                                                const decoupling::FarField& far_field) {
    add_copies(
        far_field, [](const std::vector<Point>& loop) { return core::bounding_box(loop); },
        [](const std::vector<Point>& loop, double shift) { return geometry::moved(loop, shift); }, loops);
    return loops;
}

RegionBorders close_row(const layers::Layer& layer, std::span<const Point> below, const decoupling::FarField& far_field,
                        const SizeField& size) {
    const double pitch = far_field.pitch, step = core::border_step(pitch);
    std::vector<Point> lower{below.front()};
    for (const Point p : decoupling::divide_curve(below, size, {0, pitch}, decoupling::min_segments_of_side))
        lower.push_back(p);
    lower.push_back(below.back());
    for (Point& p : lower) p.y = core::rounded_to_multiple(p.y, step);

    RegionBorders result{layer.points, layer.borders, {}, {}, {}};
    const auto add = [&](Point p) {
        result.points.push_back(p);
        return VertexId(result.points.size() - 1);
    };
    std::vector<VertexId> lower_ids, upper_ids;
    for (const Point p : lower) lower_ids.push_back(add(p));
    for (const Point p : lower) upper_ids.push_back(add(geometry::moved(p, pitch)));
    // Returns the side from a vertex below to its twin above.
    const auto side = [&](VertexId from, VertexId to) {
        std::vector<VertexId> ids{from};
        for (const Point p : decoupling::divide_separator(result.points[from.index()], result.points[to.index()], size,
                                                          decoupling::min_segments_of_side))
            ids.push_back(add(p));
        ids.push_back(to);
        return ids;
    };
    const std::vector<VertexId> inlet = side(lower_ids.front(), upper_ids.front()),
                                outlet = side(lower_ids.back(), upper_ids.back());
    // From the lower right corner on, clockwise.
    std::vector<VertexId> loop(lower_ids.rbegin(), lower_ids.rend());
    loop.insert(loop.end(), inlet.begin() + 1, inlet.end());
    loop.insert(loop.end(), upper_ids.begin() + 1, upper_ids.end());
    loop.insert(loop.end(), outlet.rbegin() + 1, outlet.rend() - 1);
    result.borders.push_back(std::move(loop));

    const auto marker = [](std::string_view name, MarkerKind kind, const std::vector<VertexId>& ids, bool forward) {
        Marker edges{std::string(name), kind, {}};
        for (std::size_t i = 0; i + 1 < ids.size(); ++i)
            edges.edges.push_back(forward ? Segment{ids[i], ids[i + 1]} : Segment{ids[i + 1], ids[i]});
        return edges;
    };
    result.row = {marker("inlet", MarkerKind::far_field, inlet, false),
                  marker("outlet", MarkerKind::far_field, outlet, true),
                  marker(core::periodic_lower_name, MarkerKind::periodic, lower_ids, true),
                  marker(core::periodic_upper_name, MarkerKind::periodic, upper_ids, false)};
    return result;
}

}  // namespace lamina::pipeline
