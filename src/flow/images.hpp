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
    bool in_row = false;  ///< whether it is a copy in a row

    /// Returns the point that lies to the bodies as p lies to the image.
    Point seen_from(Point p) const { return {p.x, (is_mirrored ? -p.y : p.y) + shift}; }
    /// Returns the factor of the stream function of the bodies.
    double stream_function_factor() const { return is_mirrored ? -share : share; }
    /// Returns the velocity that the image induces where the bodies induce this one at seen_from().
    Point velocity(Point of_bodies) const {
        return share * Point{of_bodies.x, is_mirrored ? -of_bodies.y : of_bodies.y};
    }
};

/// Returns the copies in an endless row. The sum over those at k and -k pitches falls as 1 / k^2; the last two stand
/// for all beyond, so that what is left falls as 1 / k^3 and with the fourth power of the distance over the pitch.
inline std::vector<Image> copies_in_row(double pitch) {
    constexpr int last = 12;
    // k^2 (1 / k^2 + 1 / (k + 1)^2 + ...) for k = last, by the Euler-Maclaurin formula
    constexpr double share = last + 0.5 + 1 / (6.0 * last);
    std::vector<Image> images;
    for (int k = 1; k <= last; ++k)
        for (const int sign : {-1, 1}) images.push_back({false, sign * k * pitch, k < last ? 1 : share, true});
    return images;
}

/// Returns the images in these walls, or the copies in a row. Those in two walls have images themselves, without end,
/// of alternating circulation: their sum ends with half of a term, so that it is in the middle of its last two values.
/// Images of sources do not alternate: what wakes displace raises the speed in a tunnel by some 7 % too little.
inline std::vector<Image> images_in(const FlowWalls& walls) {
    if (walls.pitch) return copies_in_row(*walls.pitch);
    if (!walls.below && !walls.above) return {};
    if (!walls.below || !walls.above) return {{true, 2 * (walls.below ? *walls.below : *walls.above), 1}};
    constexpr int last = 4;
    const double period = 2 * (*walls.above - *walls.below);
    std::vector<Image> images;
    for (int k = 1 - last; k <= last; ++k) images.push_back({true, 2 * *walls.below + k * period, 1});
    for (int k = 1; k <= last; ++k)
        for (const int sign : {-1, 1}) images.push_back({false, sign * k * period, k < last ? 1 : 0.5});
    return images;
}

/// Returns the bodies themselves, as an image that is not mirrored, and after them their images.
inline std::vector<Image> bodies_and_images(const FlowWalls& walls) {
    std::vector<Image> all{{false, 0, 1}};
    for (const Image& image : images_in(walls)) all.push_back(image);
    return all;
}

}  // namespace lamina::flow
