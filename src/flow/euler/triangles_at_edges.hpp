// The triangles at both sides of each edge of a triangulation.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <lamina/ids.hpp>

namespace lamina::flow::euler {

/// The triangles at both sides of each edge of a triangulation.
class TrianglesAtEdges {
public:
    explicit TrianglesAtEdges(std::span<const Triangle> triangles) {
        sides_.reserve(3 * triangles.size());
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                sides_.push_back({sorted(triangles[t].v[k].value, triangles[t].v[(k + 1) % 3].value),
                                  static_cast<std::uint32_t>(t)});
        std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
            return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
        });
    }

    /// Returns the triangle at the edge between two vertices that is not `other`, if there is one.
    std::optional<std::uint32_t> beside(std::uint32_t a, std::uint32_t b,
                                        std::optional<std::uint32_t> other = std::nullopt) const {
        const std::array<std::uint32_t, 2> edge = sorted(a, b);
        auto side = std::lower_bound(sides_.begin(), sides_.end(), edge,
                                     [](const Side& s, const auto& e) { return s.edge < e; });
        for (; side != sides_.end() && side->edge == edge; ++side)
            if (side->triangle != other) return side->triangle;
        return std::nullopt;
    }

private:
    struct Side {
        std::array<std::uint32_t, 2> edge;
        std::uint32_t triangle;
    };
    static std::array<std::uint32_t, 2> sorted(std::uint32_t a, std::uint32_t b) {
        return {std::min(a, b), std::max(a, b)};
    }

    std::vector<Side> sides_;
};

}  // namespace lamina::flow::euler
