// Single sources are compared with several cells or points at once, without branches. Walks down the binary tree of
// source groups serve the groups of several.
#include "sizing/lower_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/box_tree.hpp"

namespace lamina::sizing {

namespace {

/// Returns the distances of a box from quadrants.
Quadrants::Numbers distances(const Box& box, const Quadrants& quadrants) {
    Quadrants::Numbers apart;
    for (std::size_t q = 0; q < Quadrants::count; ++q) {
        const double x = larger(larger(box.lower.x - quadrants.upper_x[q], quadrants.lower_x[q] - box.upper.x), 0.0);
        const double y = larger(larger(box.lower.y - quadrants.upper_y[q], quadrants.lower_y[q] - box.upper.y), 0.0);
        apart[q] = std::sqrt(x * x + y * y);
    }
    return apart;
}

/// Returns the quadrants where the values do not exceed the bound, as bits.
std::uint32_t quadrants_below(const Quadrants& quadrants, const Quadrants::Numbers& values) {
    std::uint32_t bits = 0;
    for (std::size_t q = 0; q < Quadrants::count; ++q)
        bits |= static_cast<std::uint32_t>(values[q] <= quadrants.max_value[q]) << q;
    return bits;
}

/// Lowers the bounds to those of a candidate with these distances and lowest values, where it is one.
void lower_bounds(const Quadrants& quadrants, const Quadrants::Numbers& apart, const Quadrants::Numbers& values,
                  Quadrants::Numbers& nearest, Quadrants::Numbers& lowest) {
    for (std::size_t q = 0; q < Quadrants::count; ++q) {
        const double counted = values[q] <= quadrants.max_value[q] ? apart[q] : HUGE_VAL;
        nearest[q] = smaller(nearest[q], counted);
        lowest[q] = smaller(lowest[q], values[q]);
    }
}

}  // namespace

Candidates LowerEnvelope::push_copy(const std::vector<std::uint32_t>& candidates) {
    stack_ = candidates;
    const auto groups = std::partition_point(stack_.begin(), stack_.end(),
                                             [&](std::uint32_t index) { return groups_[index].is_single(); });
    return {0, static_cast<std::size_t>(groups - stack_.begin()), stack_.size(), 0};
}

/// Finds the quadrants that a single source is a candidate of.
void LowerEnvelope::find_source(std::uint32_t index, const Quadrants& quadrants, QuadrantBounds& bounds) {
    const SourceGroup& source = groups_[index];
    const SourceShape& shape = shapes_[source.shape];
    const double shape_radius = shape.radius, cell_radius = sqrt_half * quadrants.side;
    const double size = source.min_size, gradation = gradation_;
    Quadrants::Numbers x, y, apart, values;
    for (std::size_t q = 0; q < Quadrants::count; ++q) {
        x[q] = 0.5 * (quadrants.lower_x[q] + quadrants.upper_x[q]);
        y[q] = 0.5 * (quadrants.lower_y[q] + quadrants.upper_y[q]);
    }
    const Quadrants::Numbers from_box = distances(source.box, quadrants), squared = squared_distances(shape, x, y);
    for (std::size_t q = 0; q < Quadrants::count; ++q) {
        apart[q] = larger(from_box[q], larger(std::sqrt(squared[q]) - shape_radius, 0.0) - cell_radius);
        values[q] = size + gradation * apart[q];
    }
    const std::uint32_t below = quadrants_below(quadrants, values);
    if (below == 0) return;
    lower_bounds(quadrants, apart, values, bounds.nearest, bounds.lowest);
    sources_found_.push_back({index, below});
    if (!has_inside(shape)) return;
    for (std::size_t q = 0; q < Quadrants::count; ++q)
        if ((below >> q & 1) != 0 && apart[q] <= 0 && size < bounds.covering[q] && covers(shape, quadrants.box(q)))
            bounds.covering[q] = size;
}

/// Finds the quadrants that a group, or the groups and sources below it, are candidates of.
void LowerEnvelope::find_in_group(std::uint32_t index, const Quadrants& quadrants, QuadrantBounds& bounds) {
    const double gradation = gradation_;
    for (;;) {
        const SourceGroup& group = groups_[index];
        const Quadrants::Numbers apart = distances(group.box, quadrants);
        Quadrants::Numbers values;
        for (std::size_t q = 0; q < Quadrants::count; ++q) values[q] = group.min_size + gradation * apart[q];
        const std::uint32_t below = quadrants_below(quadrants, values);
        if (below != 0) {
            if (group.is_single()) {
                find_source(index, quadrants, bounds);
            } else if (group.extent() > 0.5 * quadrants.side) {
                pending_.push_back(group.right);
                ++index;
                continue;
            } else {
                lower_bounds(quadrants, apart, values, bounds.nearest, bounds.lowest);
                for (std::size_t q = 0; q < Quadrants::count; ++q)
                    if ((below >> q & 1) != 0 && values[q] < bounds.lowest_of_groups[q]) {
                        bounds.lowest_of_groups[q] = values[q];
                        bounds.lowest_group[q] = groups_found_.size();
                    }
                groups_found_.push_back({index, below});
            }
        }
        if (pending_.empty()) return;
        index = pending_.back();
        pending_.pop_back();
    }
}

std::array<Candidates, Quadrants::count> LowerEnvelope::push(const Quadrants& quadrants, const Candidates& parent) {
    QuadrantBounds bounds;
    for (auto* numbers : {&bounds.nearest, &bounds.lowest, &bounds.covering, &bounds.lowest_of_groups})
        numbers->fill(HUGE_VAL);
    bounds.lowest_group.fill(0);
    sources_found_.clear();
    groups_found_.clear();
    for (std::size_t i = parent.begin; i < parent.groups; ++i) find_source(stack_[i], quadrants, bounds);
    for (std::size_t i = parent.groups; i < parent.end; ++i) find_in_group(stack_[i], quadrants, bounds);

    std::array<Candidates, Quadrants::count> result;
    std::size_t end = stack_.size();
    stack_.resize(end + Quadrants::count * (sources_found_.size() + groups_found_.size()));
    const auto keep = [&](Found found, std::size_t q) {
        stack_[end] = found.group;  // the next one takes its place where it is no candidate
        end += found.quadrants >> q & 1;
    };
    for (std::size_t q = 0; q < Quadrants::count; ++q) {
        const std::size_t begin = end;
        for (const Found found : sources_found_) keep(found, q);
        const std::size_t groups = end;
        std::size_t lowest = end;
        for (std::size_t k = 0; k < groups_found_.size(); ++k) {
            if (k == bounds.lowest_group[q]) lowest = end;
            keep(groups_found_[k], q);
        }
        // evaluate() looks at this group first and then skips most others.
        if (end > groups) std::swap(stack_[groups], stack_[lowest]);
        result[q] = {begin, groups, end, bounds.nearest[q], bounds.covering[q] <= bounds.lowest[q]};
    }
    stack_.resize(end);
    return result;
}

/// Returns the lower one of `best` and the values of a group's sources at a point. Looks first at the groups whose
/// sources may have the lowest values: where the gradation is small, these are often not the nearest ones.
double LowerEnvelope::evaluate_group(std::uint32_t index, Point p, double best) {
    const auto bound = [&](std::uint32_t group) {
        const SourceGroup& bounded = groups_[group];
        return BoundedGroup{group, bounded.min_size + gradation_ * std::sqrt(core::squared_distance(bounded.box, p))};
    };
    BoundedGroup at = bound(index);
    for (;;) {
        const SourceGroup& group = groups_[at.index];
        if (at.lowest < best) {
            if (!group.is_single()) {
                BoundedGroup low = bound(at.index + 1), high = bound(group.right);
                if (high.lowest < low.lowest) std::swap(low, high);
                if (high.lowest < best) pending_at_point_.push_back(high);
                at = low;
                continue;
            }
            best = smaller(best, group.min_size + gradation_ * distance_to(shapes_[group.shape], p));
        }
        if (pending_at_point_.empty()) return best;
        at = pending_at_point_.back();
        pending_at_point_.pop_back();
    }
}

template <std::size_t N>
void LowerEnvelope::evaluate(const Candidates& candidates, CellPoints<N>& points) {
    for (std::size_t i = candidates.begin; i < candidates.groups; ++i) {
        const SourceGroup& source = groups_[stack_[i]];
        const SourceShape& shape = shapes_[source.shape];
        const double radius = shape.radius, size = source.min_size, gradation = gradation_;
        const std::array<double, N> squared = squared_distances(shape, points.x, points.y);
        for (std::size_t k = 0; k < N; ++k)
            points.h[k] = smaller(points.h[k], size + gradation * larger(std::sqrt(squared[k]) - radius, 0.0));
    }
    for (std::size_t i = candidates.groups; i < candidates.end; ++i)
        for (std::size_t k = 0; k < N; ++k)
            points.h[k] = evaluate_group(stack_[i], {points.x[k], points.y[k]}, points.h[k]);
}

template void LowerEnvelope::evaluate(const Candidates& candidates, CellPoints<4>& points);
template void LowerEnvelope::evaluate(const Candidates& candidates, CellPoints<6>& points);

}  // namespace lamina::sizing
