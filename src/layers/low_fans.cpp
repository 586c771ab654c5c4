// A fan has as many rays as the angle between neighbours asks for. Where a wall stands in front, a fan ends so low that
// its columns are far narrower there than those on the edges beside it. Triangles outside begin as small as the
// narrowest of them, and edges of the wall in front are divided as finely:
//
//     ////////////////////           ////////////////////      the wall in front
//     -+-+++|||||||+++-+-+           ---+-----+-----+----
//        _ _\\|||//_ _                   _ _\  |  /_ _         its front, and that of the fan
//       ______\|/______                 ______\|/______
//             / \                             / \              left: all rays; right: as many as there is room for
//
// docs/layer.md
#include "layers/low_fans.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angles.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Columns of a fan are at least this share as wide at their limits as the narrower one of the two beside the fan.
constexpr double least_share_of_width = 0.25;

/// The columns of a fan, or none at a vertex with one ray.
struct Fan {
    std::size_t first;        ///< the first ray at the vertex
    std::size_t columns = 0;  ///< between it and the last one
};

/// A search through the fans of one element.
class FanSearch {
public:
    /// begin, end: the rays of the element.
    FanSearch(const Rays& rays, std::size_t begin, std::size_t end)
        : set_(rays.set), asked_(rays.asked), front_(rays.front), begin_(begin), end_(end) {}

    /// Returns the fan of the vertex at which a ray is the first.
    Fan fan_from(std::size_t ray) const {
        Fan fan{ray};
        while (ray + fan.columns + 1 < end_ && set_.lines[ray + fan.columns + 1].origin == set_.lines[ray].origin)
            ++fan.columns;
        return fan;
    }

    /// Returns the number of columns that a fan has room for, at most as many as it has.
    std::size_t columns_with_room(const Fan& fan) const {
        const std::size_t last = fan.first + fan.columns;
        if (fan.columns < 2 || !is_cut_short(fan.first, last)) return fan.columns;
        double width = 0, widest_angle = 0;
        for (std::size_t i = fan.first; i < last; ++i) {
            width += width_at_front(i, i + 1);
            const double angle = core::angle_between(set_.lines[i].direction, set_.lines[i + 1].direction);
            widest_angle = std::max(widest_angle, std::abs(angle));
        }
        const double beside = std::min(width_at_front(fan.first > begin_ ? fan.first - 1 : end_ - 1, fan.first),
                                       width_at_front(last, last + 1 < end_ ? last + 1 : begin_));
        const double all = static_cast<double>(fan.columns), wanted = least_share_of_width * beside;
        if (!(width < all * wanted)) return fan.columns;
        constexpr double angle_rounding = 1e-9;
        const double together = std::floor(core::radians(max_low_fan_angle_deg) / widest_angle + angle_rounding);
        const double fitting = std::max(std::floor(width / wanted), std::ceil(all / std::max(together, 1.0)));
        const auto kept = static_cast<std::size_t>(std::max(fitting, 1.0));
        // An odd number of columns cannot become an even one symmetrically.
        return fan.columns % 2 == 1 && kept % 2 == 0 ? kept + 1 : kept;
    }

private:
    const RaySet& set_;
    std::span<const double> asked_, front_;
    std::size_t begin_, end_;

    bool is_cut_short(std::size_t first, std::size_t last) const {
        for (std::size_t i = first; i <= last; ++i)
            if (front_[i] < asked_[i]) return true;
        return false;
    }
    Point at_front(std::size_t ray) const {
        const RayLine& line = set_.lines[ray];
        return line.origin + front_[ray] * line.direction;
    }
    double width_at_front(std::size_t a, std::size_t b) const { return distance(at_front(a), at_front(b)); }
};

/// Returns the k-th of the rays that stay where a fan of `columns` keeps `kept` columns, as evenly as can be. It is
/// counted from the nearer side, so that mirrored input keeps mirrored rays.
std::size_t ray_that_stays(std::size_t k, std::size_t kept, std::size_t columns) {
    if (kept == 0) return 0;
    const auto evenly = [&](std::size_t part) { return (2 * part * columns + kept) / (2 * kept); };
    return 2 * k <= kept ? evenly(k) : columns - evenly(kept - k);
}

}  // namespace

RaySet leave_out_rays_of_low_fans(const Rays& rays) {
    const RaySet& set = rays.set;
    RaySet result;
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const FanSearch search(rays, set.begin[e], set.begin[e + 1]);
        for (std::size_t i = set.begin[e]; i < set.begin[e + 1];) {
            const Fan fan = search.fan_from(i);
            const std::size_t kept = rays.jagged[e] ? search.columns_with_room(fan) : fan.columns;
            for (std::size_t k = 0; k <= kept; ++k)
                result.lines.push_back(set.lines[i + ray_that_stays(k, kept, fan.columns)]);
            i += fan.columns + 1;
        }
        result.begin.push_back(result.lines.size());
    }
    return result;
}

}  // namespace lamina::layers
