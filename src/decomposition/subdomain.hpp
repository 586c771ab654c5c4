// A part of a triangulation, and the line it is cut along.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "decomposition/sorted_points.hpp"

namespace lamina::decomposition {

/// An array whose entries start uninitialised: every one of them is written once by the cut that makes it.
class Order {
public:
    Order() = default;
    explicit Order(std::size_t room) : data_(std::make_unique_for_overwrite<Index[]>(room)), size_(room) {}
    explicit Order(std::span<const Index> entries) : Order(entries.size()) {
        std::copy(entries.begin(), entries.end(), data_.get());
    }

    std::size_t size() const { return size_; }
    void shrink(std::size_t size) {
        assert(size <= size_);
        size_ = size;
    }
    Index* data() { return data_.get(); }
    std::span<const Index> all() const { return {data_.get(), size_}; }
    Index operator[](std::size_t i) const { return data_[i]; }

private:
    std::unique_ptr<Index[]> data_;
    std::size_t size_ = 0;
};

/// Directed.
struct Edge {
    Index a, b;
};

/// A region bounded by edges of the triangulation to be, with all points inside it and on its border.
struct Subdomain {
    Order by_x, by_y;
    std::vector<Edge> border;  ///< the region on their left
    unsigned depth = 0;        ///< how many cuts made it

    std::size_t size() const { return by_x.size(); }
};

/// The coordinate that is the same all along a line.
enum class Axis { x, y };

/// Turns the plane so that a cut's line stands upright: x becomes the coordinate across it, y the one along it. Low
/// points, those before the cut in the order across, lie on its left.
struct Frame {
    Axis axis = Axis::x;
    Point operator()(Point p) const { return axis == Axis::x ? p : Point{p.y, -p.x}; }
};

/// The line through a point.
struct Cut {
    Axis axis = Axis::x;
    Index at = no_index;
};

}  // namespace lamina::decomposition
