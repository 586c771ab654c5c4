// The images of bodies in flat walls that the flow does not cross, and their copies in a row of blades.
//
//      body
//   ---------- wall      a mirrored body of opposite circulation makes the wall a streamline
//      image
//
// Source: J. Katz, A. Plotkin, Low-Speed Aerodynamics, 2nd ed. (2001), section 4.9 and 5.5 (method of images).
#pragma once

#include <vector>

#include <lamina/flow.hpp>

namespace lamina::flow {

/// An image of all bodies. What it gives at a point is what the bodies give at another one.
struct Image {
    bool is_mirrored;
    double shift;
    double share;         ///< of the image's strength that counts
    double source_share;  ///< the same of sources, which images do not turn round
    bool in_row = false;  ///< whether it is a copy in a row

    /// Returns the image of sources alone.
    Image of_sources() const {
        Image image = *this;
        image.share = source_share;
        return image;
    }

    /// Returns the point that lies to the bodies as p lies to the image.
    Point seen_from(Point p) const { return {p.x, (is_mirrored ? -p.y : p.y) + shift}; }
    /// Returns the factor of the stream function of the bodies.
    double stream_function_factor() const { return is_mirrored ? -share : share; }
    /// Returns the velocity that the image induces where the bodies induce this one at seen_from().
    Point velocity(Point of_bodies) const {
        return share * Point{of_bodies.x, is_mirrored ? -of_bodies.y : of_bodies.y};
    }
};

/// Returns the share of the last two images that stands for all beyond, x^2 (1 / x^2 + 1 / (x + 1)^2 + ...), where what
/// two of them at x and -x periods give falls as 1 / x^2. What is left falls as 1 / x^3, and with the fourth power of
/// the distance over the period. By the Euler-Maclaurin formula.
constexpr double share_of_last(double x) { return x + 0.5 + 1 / (6 * x); }

/// Returns the copies in an endless row.
inline std::vector<Image> copies_in_row(double pitch) {
    constexpr int last = 12;
    std::vector<Image> images;
    for (int k = 1; k <= last; ++k)
        for (const int sign : {-1, 1}) {
            const double share = k < last ? 1 : share_of_last(last);
            images.push_back({false, sign * k * pitch, share, share, true});
        }
    return images;
}

/// Returns the images in these walls, or the copies in a row. Those in two walls have images themselves, without end,
/// of alternating circulation: their sum ends with half of a term, so that it is in the middle of its last two values.
/// Sources do not alternate, and their last images stand for all beyond; those on bases, which displace little, count as
/// the sheets that they belong to.
inline std::vector<Image> images_in(const FlowWalls& walls) {
    if (walls.pitch) return copies_in_row(*walls.pitch);
    if (!walls.below && !walls.above) return {};
    if (!walls.below || !walls.above) return {{true, 2 * (walls.below ? *walls.below : *walls.above), 1, 1}};
    constexpr int last = 4;
    const double period = 2 * (*walls.above - *walls.below);
    std::vector<Image> images;
    for (int k = 1; k <= last; ++k) {
        const bool is_last = k == last;
        // Mirrored ones lie half a period nearer, on both sides of the middle of the tunnel.
        const double source_share = is_last ? share_of_last(last - 0.5) : 1;
        for (const int n : {1 - k, k}) images.push_back({true, 2 * *walls.below + n * period, 1, source_share});
        for (const int sign : {-1, 1})
            images.push_back({false, sign * k * period, is_last ? 0.5 : 1, is_last ? share_of_last(last) : 1});
    }
    return images;
}

/// Returns the bodies themselves, as an image that is not mirrored, and after them their images.
inline std::vector<Image> bodies_and_images(const FlowWalls& walls) {
    std::vector<Image> all{{false, 0, 1, 1}};
    for (const Image& image : images_in(walls)) all.push_back(image);
    return all;
}

}  // namespace lamina::flow
