// The trapezoids of rings, whose borders follow from their numbers: nobody has to trace or to hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decoupling/line_border.hpp"
#include "decoupling/lines.hpp"

namespace lamina::decoupling {

/// Successive lines of a process.
struct LineRun {
    std::uint32_t begin = 0, end = 0;
    unsigned process = 0;
};

/// All trapezoids between successive boxes, ring by ring from inside and counter-clockwise in each. Boxes consist of
/// lines in counter-clockwise order, and lines lead outwards between the trapezoids of a ring.
class RingRegions {
public:
    /// The lines of a ring by their numbers. Each trapezoid has as many lines on a box as any other.
    struct RingLines {
        std::uint32_t first_inner = 0, inner_per_trapezoid = 1;  ///< on the box inside
        std::uint32_t first_outer = 0, outer_per_trapezoid = 1;  ///< on the box outside
        std::uint32_t first_radial = 0;                          ///< line i is between trapezoids i - 1 and i
        std::uint32_t trapezoids = 0;
    };

    void add(const RingLines& ring) {
        rings_.push_back(ring);
        end_.push_back(size() + ring.trapezoids);
    }
    /// Says which process has which trapezoids: those from the i-th of these numbers to the next one.
    void share(const std::vector<std::size_t>& shares);
    /// Returns whose the lines round the trapezoids are, in ascending order, once they are shared: a line belongs to
    /// the process of the first trapezoid beside it, or one round the bodies to a process that has no trapezoids.
    std::span<const LineRun> runs() const { return runs_; }
    /// Returns the number of all trapezoids.
    std::size_t size() const { return end_.empty() ? 0 : end_.back(); }

    /// Returns the border of a trapezoid. It begins as a loop would that was traced from the edge with the lowest
    /// number.
    LAMINA_EXPORT LineBorder border(std::size_t trapezoid, const Lines& lines) const;
    /// Calls f for the lines round a trapezoid.
    template <class F>
    void for_lines(std::size_t trapezoid, F&& f) const {
        const auto [ring, j] = find(trapezoid);
        for (std::uint32_t i = 0; i < ring.inner_per_trapezoid; ++i)
            f(ring.first_inner + j * ring.inner_per_trapezoid + i);
        f(ring.first_radial + j);
        for (std::uint32_t i = 0; i < ring.outer_per_trapezoid; ++i)
            f(ring.first_outer + j * ring.outer_per_trapezoid + i);
        f(ring.first_radial + (j + 1 < ring.trapezoids ? j + 1 : 0));
    }
    /// Returns the number of vertices of a trapezoid's border.
    std::size_t vertices(std::size_t trapezoid, const Lines& lines) const {
        std::size_t sum = 0;
        for_lines(trapezoid, [&](std::uint32_t line) { sum += lines.segments(line); });
        return sum;
    }

private:
    struct Place {
        const RingLines& ring;
        std::uint32_t j;  ///< number of the trapezoid in its ring
    };
    Place find(std::size_t trapezoid) const;

    std::vector<RingLines> rings_;
    std::vector<std::size_t> end_;  ///< per ring: the number behind those of its trapezoids
    std::vector<LineRun> runs_;
};

}  // namespace lamina::decoupling
