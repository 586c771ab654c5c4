// Splitting of the borders between parts, before the parts are refined against them.
#pragma once

#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "delaunay/constrained_parts.hpp"

namespace lamina::delaunay {

/// Splits subsegments, and marks the parts beside them as stale. Source: J. Ruppert, J. Algorithms 18 (1995), section 3
/// and "corner lopping".
class BorderSplitter {
public:
    /// Keeps a reference to the parts.
    explicit BorderSplitter(ConstrainedParts& parts);

    /// Splits subsegments until none is too long for the sizes on it.
    void split_by_size();

    /// Splits the subsegments of stale parts, once each, that a vertex of an adjacent triangle encroaches upon. If any
    /// visible vertex lies in the diametral circle of a subsegment, a vertex of an adjacent triangle does. Returns
    /// whether any was split.
    bool split_encroached();

    /// Splits each of these subsegments once. Returns whether any was long enough to be split.
    bool split_all(std::span<const std::vector<Subsegment>> found);

private:
    double size_at(const PartBorder& border, Point p) const;
    Point division_point(Index a, Index b) const;
    bool split(const Subsegment& s);
    std::vector<Subsegment> find_encroached(const ConstrainedPart& part) const;

    Point point(Index v) const { return parts_.points[v]; }
    bool is_acute_at(Index v) const { return v < parts_.acute.size() && parts_.acute[v]; }

    ConstrainedParts& parts_;
    double min_length_;  ///< no subsegment becomes shorter
};

}  // namespace lamina::delaunay
