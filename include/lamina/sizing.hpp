// Stage 4, sizing: the target edge length h(x) of the isotropic region.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina {

/// An edge that asks for its own length: h(x) <= size + gradation x distance(x, a-b).
struct SizeSource {
    Point a, b;
    double size;
};

struct SizingOptions {
    double gradation = 0.1;      ///< dh/dx away from a source
    double max_size = HUGE_VAL;  ///< cap far away
};

/// h(x), evaluated in tens of nanoseconds from a graded quadtree whatever the number of sources; within
/// `relative_error` of the exact minimum over the sources. A cheap value: copies share the tree.
class SizeField {
public:
    /// The same size everywhere.
    explicit SizeField(double uniform_size);
    /// h(x) = min(max_size, min over sources (size + gradation x distance)) inside `domain`; points outside are clamped
    /// to it.
    SizeField(std::span<const SizeSource> sources, const SizingOptions& options, const Box& domain);

    double operator()(Point p) const;
    /// The same field, faster inside a box: evaluation starts at the smallest cell that holds it.
    SizeField restricted_to(const Box& box) const;
    std::size_t cells() const;

    static constexpr double relative_error = 0.05;

private:
    struct Tree;
    std::shared_ptr<const Tree> tree_;
    std::uint32_t root_ = 0;
    double uniform_ = 0;
};

}  // namespace lamina
