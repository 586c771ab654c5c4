// The triangles that are too large, and the front between them and those that are not.
//
// A large triangle waits until its shortest edge, its base, is part of the front: until it is a border, or the triangle
// across it is no longer large. The oldest part of the front moves first, so rows of triangles grow evenly from the
// border inwards.
//
//      \           /           o   vertices placed
//       \  large  /            a-b part of the front; it is the base of the large triangle a-b-w, whose apex w lies far
//        \       /                 away, on the other side of what is not yet filled
//      ---a-----b---o---  front
//        / \   / \ / \ .
//       o---o-o---o---o-  rows of triangles that are done
//
// Source: frontal Delaunay refinement: S. Rebay, J. Comput. Phys. 106 (1993); D. Engwirda, D. Ivers, Computer-Aided
// Design 72 (2016).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/refine/angle_queue.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// A queue of triangles, first in, first out.
class TriangleFifo {
public:
    void push(QueuedTriangle entry) { entries_.push_back(entry); }
    bool empty() const { return head_ == entries_.size(); }
    /// Takes the oldest entry out. Returns false if the queue is empty.
    bool pop(QueuedTriangle& entry) {
        if (empty()) return false;
        entry = entries_[head_++];
        if (head_ >= min_purge_size && 2 * head_ >= entries_.size()) {
            entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(head_));
            head_ = 0;
        }
        return true;
    }

private:
    static constexpr std::size_t min_purge_size = 4096;
    std::vector<QueuedTriangle> entries_;
    std::size_t head_ = 0;  ///< entries before this one were taken out
};

/// Knows of each triangle whether it is large and, if so, which edge is its base.
class AdvancingFront {
public:
    /// Forgets everything, and makes room for as many triangles, none of them large.
    void reset(std::size_t triangles) { bases_.assign(triangles, Base::none); }
    /// Makes room for more triangles, which are not large.
    void resize(std::size_t triangles) {
        if (bases_.size() < triangles) bases_.resize(triangles + triangles / 2, Base::none);
    }
    void set_large(Index t, unsigned base) { bases_[t] = static_cast<Base>(large_bit | base); }
    void set_done(Index t) { bases_[t] = Base::none; }
    bool is_large(Index t) const { return bases_[t] != Base::none; }
    /// Returns the base. Precondition: the triangle is large.
    unsigned base(Index t) const { return static_cast<unsigned>(bases_[t]) & 3u; }
    /// Returns whether edge e is the base of the triangle, which is large.
    bool has_base(Index t, unsigned e) const { return bases_[t] == static_cast<Base>(large_bit | e); }
    /// Returns whether nothing large lies across this edge of a triangle.
    bool is_done_across(Link link) const { return link.is_constrained() || !is_large(link.triangle()); }

    TriangleFifo ready;  ///< large triangles whose bases were on the front when they were queued
    TriangleFifo met;    ///< those among them whose new vertex would have been too near to another front

private:
    /// The base of a triangle and large_bit, or none where it is not large. Unlike a plain byte it aliases nothing
    /// else, so compilers keep other values in registers.
    enum class Base : std::uint8_t { none = 0 };
    static constexpr unsigned large_bit = 4;
    std::vector<Base> bases_;
};

}  // namespace lamina::delaunay
