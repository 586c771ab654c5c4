// Background size field: the lower envelope of graded cones over segments, sampled on a graded quadtree.
// Source: P.-O. Persson, Mesh size functions for implicit geometries and PDE-based gradient limiting, Engineering with
// Computers 22 (2006): in a convex domain the gradient-limited size is h(x) = min_i (h_i + gradation |x - x_i|).
// Sources that cannot matter in a cell are dropped on the way down (branch and bound).
//
// Why the error is bounded. The envelope f is Lipschitz with constant g (the gradation), so in a cell of side s the
// bilinear interpolant of its corners is off by at most g s / sqrt 2. Where a cell keeps half a side's distance from
// every source that counts in it, f is a minimum of smooth functions: it bends upwards by at most g s^2 / (8 distance)
// and otherwise has concave ridges only, whose error anywhere is a small multiple of that at the five sample points.
// Inside a box or a disc that nothing undercuts f is constant.

#include "sizing/size_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "sizing/source_groups.hpp"

namespace lamina::sizing {

namespace {

constexpr double sqrt_half = 0.70710678118654752;
// Share of h that the Lipschitz bound may take; and relative error at the sample points of smooth cells.
constexpr double lipschitz_tolerance = 0.047;
constexpr double sample_tolerance = 0.01;
// Bounds are loosened by this share, so that rounding never makes them wrong.
constexpr double rounding = 1e-9;
// The smallest cell's side is that of the root / 2^max_level.
constexpr int max_level = 40;

double distance(const Box& a, const Box& b) {
    const double x = std::max({a.lower.x - b.upper.x, b.lower.x - a.upper.x, 0.0});
    const double y = std::max({a.lower.y - b.upper.y, b.lower.y - a.upper.y, 0.0});
    return std::sqrt(x * x + y * y);
}

// A square of the quadtree under construction.
struct Cell {
    Point lower;
    double side;
    int level;
    std::array<double, 4> h;  // exact, in the order of Leaf

    Box box() const { return {lower, {lower.x + side, lower.y + side}}; }
    double smallest() const { return std::min({h[0], h[1], h[2], h[3]}); }
    double largest() const { return std::max({h[0], h[1], h[2], h[3]}); }
};

// Exact h at the middles of a cell's edges and at its centre.
struct Samples {
    double south, west, center, east, north;
};

// The groups that may decide h somewhere in a cell: a range of Builder::candidates_; a lower bound of their distance
// from the cell; and whether one of them covers the cell and is undercut by none.
struct Candidates {
    std::size_t begin, end;
    double nearest;
    bool constant = false;
};

class Builder {
public:
    Builder(const sizing::SourceTree& sources, const SizeFieldOptions& options, double unit)
        : gradation_(options.gradation),
          inverse_gradation_(1 / std::max(options.gradation, 1e-300)),
          max_size_(options.max_size),
          unit_(unit),
          groups_(sources.groups),
          cones_(sources.cones) {}

    // A cell whose node is still to be made, and where the node is entered.
    struct Task {
        Cell cell;
        std::vector<std::uint32_t> candidates;
        Samples samples;
        std::uint32_t parent, slot;
    };

    Task root(Point lower, double side) {
        if (!groups_.empty()) candidates_.push_back(0);
        const Candidates all{0, candidates_.size(), 0};
        Cell root{lower, side, 0, {}};
        for (int i = 0; i < 4; ++i)
            root.h[i] = evaluate({lower.x + (i & 1) * side, lower.y + (i >> 1) * side}, all, max_size_);
        const Samples samples = sample(root, all);
        return {root, std::move(candidates_), samples, 0, 0};
    }

    // Makes the node of one cell; its quarters that need nodes of their own become tasks.
    void expand(const Task& task, std::vector<Task>& tasks) {
        candidates_ = task.candidates;
        make_node(task.cell, {0, candidates_.size(), 0}, task.samples,
                  [&](std::uint32_t node, int slot, const Cell& quarter, const Candidates& in, const Samples& s) {
                      const auto from = candidates_.begin() + static_cast<std::ptrdiff_t>(in.begin);
                      const auto to = candidates_.begin() + static_cast<std::ptrdiff_t>(in.end);
                      tasks.push_back({quarter, {from, to}, s, node, static_cast<std::uint32_t>(slot)});
                  });
    }

    // Makes all nodes below a cell; its own is the first.
    void finish(const Task& task) {
        candidates_ = task.candidates;
        split_twice(task.cell, {0, candidates_.size(), 0}, task.samples);
    }

    SizeTree part;

private:
    // The exact field at p, given an upper bound.
    double evaluate(Point p, const Candidates& in, double bound) {
        double best = std::min(bound, max_size_);
        for (std::size_t i = in.begin; i < in.end; ++i) {
            std::uint32_t index = candidates_[i];
            for (;;) {
                const sizing::SourceGroup& group = groups_[index];
                // Only what is nearer than this can lower the best value so far.
                const double reach = std::max((best - group.smallest) * inverse_gradation_, 0.0);
                if (group.single()) {
                    const sizing::Cone& cone = cones_[group.cone];
                    const double squared = cone.squared_distance_to(p), far = reach + cone.radius;
                    if (squared < far * far)
                        best = std::min(best,
                                        group.smallest + gradation_ * std::max(std::sqrt(squared) - cone.radius, 0.0));
                } else if (core::squared_distance(group.box, p) < reach * reach) {
                    std::uint32_t near = index + 1, far = group.right;
                    if (core::squared_distance(groups_[far].box, p) < core::squared_distance(groups_[near].box, p))
                        std::swap(near, far);
                    pending_.push_back(far);
                    index = near;
                    continue;
                }
                if (pending_.empty()) break;
                index = pending_.back();
                pending_.pop_back();
            }
        }
        return best;
    }

    Samples sample(const Cell& c, const Candidates& in) {
        const double x0 = c.lower.x, x1 = x0 + 0.5 * c.side, x2 = x0 + c.side;
        const double y0 = c.lower.y, y1 = y0 + 0.5 * c.side, y2 = y0 + c.side;
        // The field cannot exceed a neighbour's by more than this.
        const auto bound = [&](double a, double b) {
            return (std::min(a, b) + 0.5 * gradation_ * c.side) * (1 + rounding);
        };
        Samples s;
        s.south = evaluate({x1, y0}, in, bound(c.h[0], c.h[1]));
        s.west = evaluate({x0, y1}, in, bound(c.h[0], c.h[2]));
        s.center = evaluate({x1, y1}, in, bound(s.south, s.west));
        s.east = evaluate({x2, y1}, in, bound(c.h[1], c.h[3]));
        s.north = evaluate({x1, y2}, in, bound(c.h[2], c.h[3]));
        return s;
    }

    // The parent's candidates without those that another source undercuts all over the cell. Appended to candidates_.
    Candidates prune(const Cell& c, const Candidates& parent) {
        const double radius = sqrt_half * c.side;
        const double highest = std::min(c.largest() + gradation_ * radius, c.smallest() + 2 * gradation_ * radius);
        const Box box = c.box();
        Candidates result{candidates_.size(), 0, HUGE_VAL};
        double lowest = HUGE_VAL, covering = HUGE_VAL;
        for (std::size_t i = parent.begin; i < parent.end; ++i) {
            std::uint32_t index = candidates_[i];
            for (;;) {
                const sizing::SourceGroup& group = groups_[index];
                double apart = distance(group.box, box);
                if (group.single()) apart = std::max(apart, cones_[group.cone].distance_to(box.center()) - radius);
                const double low = group.smallest + gradation_ * apart;
                if (low <= highest && !group.single() && group.extent() > 0.5 * c.side) {
                    pending_.push_back(group.right);
                    ++index;
                    continue;
                }
                if (low <= highest) {
                    if (group.single() && group.smallest < covering && cones_[group.cone].covers(box))
                        covering = group.smallest;
                    candidates_.push_back(index);
                    result.nearest = std::min(result.nearest, apart);
                    if (low < lowest) {  // the likeliest first: evaluation then skips most others
                        lowest = low;
                        std::swap(candidates_[result.begin], candidates_.back());
                    }
                }
                if (pending_.empty()) break;
                index = pending_.back();
                pending_.pop_back();
            }
        }
        result.end = candidates_.size();
        result.constant = covering <= lowest;
        return result;
    }

    bool needs_no_samples(const Cell& c, const Candidates& in) const {
        return in.begin == in.end || in.constant || c.level == max_level ||
               sqrt_half * gradation_ * c.side <= lipschitz_tolerance * c.smallest();
    }

    // Whether the samples say that bilinear interpolation will do. Their word is taken only away from the sources;
    // where ridges and bends might cancel out at the five samples, four more are asked.
    bool smooth(const Cell& c, const Candidates& in, const Samples& s) {
        const auto close = [](double interpolated, double exact) {
            return std::abs(interpolated - exact) <= sample_tolerance * exact;
        };
        const auto mean = [](double a, double b) { return 0.5 * (a + b); };
        const double west = mean(c.h[0], c.h[2]), east = mean(c.h[1], c.h[3]);
        if (!(in.nearest >= 0.5 * c.side && close(mean(c.h[0], c.h[1]), s.south) && close(west, s.west) &&
              close(east, s.east) && close(mean(c.h[2], c.h[3]), s.north) && close(mean(west, east), s.center)))
            return false;
        const bool one_cone = in.end - in.begin == 1 && groups_[candidates_[in.begin]].single();
        const double bend = gradation_ * c.side * c.side / (8 * in.nearest);
        if (one_cone || bend <= sample_tolerance * c.smallest()) return true;
        for (int q = 0; q < 4; ++q) {
            const double u = (q & 1) != 0 ? 0.75 : 0.25, v = (q >> 1) != 0 ? 0.75 : 0.25;
            const double low = c.h[0] + u * (c.h[1] - c.h[0]), high = c.h[2] + u * (c.h[3] - c.h[2]);
            const Point p{c.lower.x + u * c.side, c.lower.y + v * c.side};
            const double bound = (c.h[q] + 0.5 * sqrt_half * gradation_ * c.side) * (1 + rounding);
            if (!close(low + v * (high - low), evaluate(p, in, bound))) return false;
        }
        return true;
    }

    static Cell quadrant(const Cell& c, const Samples& s, int q) {
        const std::array<double, 9> h{c.h[0], s.south, c.h[1], s.west, s.center, s.east, c.h[2], s.north, c.h[3]};
        const int i = q & 1, j = q >> 1, corner = 3 * j + i;
        const double half = 0.5 * c.side;
        return {{c.lower.x + i * half, c.lower.y + j * half},
                half,
                c.level + 1,
                {h[corner], h[corner + 1], h[corner + 3], h[corner + 4]}};
    }

    std::uint32_t add_leaf(const Cell& c) {
        Leaf leaf;
        for (int i = 0; i < 4; ++i) leaf[i] = static_cast<float>(c.h[i] / unit_);
        part.leaves.push_back(leaf);
        return leaf_bit | static_cast<std::uint32_t>(part.leaves.size() - 1);
    }

    // Calls leaf(quadrant, its cell) or inner(quadrant, its cell, candidates, samples) for the four quadrants.
    template <class OnLeaf, class OnInner>
    void split(const Cell& parent, const Candidates& candidates, const Samples& samples, OnLeaf leaf, OnInner inner) {
        for (int q = 0; q < 4; ++q) {
            const Cell c = quadrant(parent, samples, q);
            const Candidates in = prune(c, candidates);
            if (needs_no_samples(c, in)) {
                leaf(q, c);
            } else {
                const Samples s = sample(c, in);
                if (smooth(c, in, s))
                    leaf(q, c);
                else
                    inner(q, c, in, s);
            }
            candidates_.resize(in.begin);
        }
    }

    // Makes the wide node of a cell that needs one; inner(node, slot, quarter, candidates, samples) for its quarters
    // that need one, too.
    template <class OnInner>
    std::uint32_t make_node(const Cell& cell, const Candidates& candidates, const Samples& samples, OnInner inner) {
        const auto node = static_cast<std::uint32_t>(part.nodes.size());
        part.nodes.emplace_back();
        const auto slot = [](int q, int r) { return 8 * (q >> 1) + 4 * (r >> 1) + 2 * (q & 1) + (r & 1); };
        split(
            cell, candidates, samples,
            [&](int q, const Cell& half) {
                const std::uint32_t leaf = add_leaf(half) | half_bit;
                for (int r = 0; r < 4; ++r) part.nodes[node][slot(q, r)] = leaf;
            },
            [&](int q, const Cell& half, const Candidates& half_candidates, const Samples& half_samples) {
                split(
                    half, half_candidates, half_samples,
                    [&](int r, const Cell& quarter) { part.nodes[node][slot(q, r)] = add_leaf(quarter); },
                    [&](int r, const Cell& quarter, const Candidates& in, const Samples& s) {
                        inner(node, slot(q, r), quarter, in, s);
                    });
            });
        return node;
    }

    // The recursion is at most max_level deep.
    std::uint32_t split_twice(const Cell& cell, const Candidates& candidates, const Samples& samples) {
        return make_node(
            cell, candidates, samples,
            [&](std::uint32_t node, int slot, const Cell& quarter, const Candidates& in, const Samples& s) {
                const std::uint32_t next = split_twice(quarter, in, s);
                part.nodes[node][slot] = next;
            });
    }

    double gradation_, inverse_gradation_, max_size_, unit_;
    const std::vector<sizing::SourceGroup>& groups_;
    const std::vector<sizing::Cone>& cones_;
    std::vector<std::uint32_t> candidates_;  // of the cells on the way from the root to the present one
    std::vector<std::uint32_t> pending_;     // scratch
};

}  // namespace

std::uint32_t SizeTree::append(const SizeTree& other) {
    const auto first_node = static_cast<std::uint32_t>(nodes.size());
    const auto first_leaf = static_cast<std::uint32_t>(leaves.size());
    leaves.insert(leaves.end(), other.leaves.begin(), other.leaves.end());
    for (Slots slots : other.nodes) {
        for (std::uint32_t& entry : slots) entry += (entry & leaf_bit) != 0 ? first_leaf : first_node;
        nodes.push_back(slots);
    }
    return first_node;
}

// Level by level until there are enough cells for all threads, then the whole of what is below each: side by side.
SizeTree build_size_tree(std::span<const SizeSource> given, const SizeFieldOptions& options, Point lower, double side) {
    constexpr std::size_t enough_tasks = 64;
    const sizing::SourceTree sources = sizing::group_sources(given);
    struct Made {
        SizeTree part;
        std::vector<Builder::Task> below;
    };
    const auto make = [&](const std::vector<Builder::Task>& tasks, bool finish) {
        return core::parallel_blocks(tasks.size(), 1, [&](std::size_t i, std::size_t) {
            Builder builder(sources, options, side);
            Made made;
            if (finish)
                builder.finish(tasks[i]);
            else
                builder.expand(tasks[i], made.below);
            made.part = std::move(builder.part);
            return made;
        });
    };
    std::vector<Builder::Task> tasks{Builder(sources, options, side).root(lower, side)};
    SizeTree tree;
    for (bool finish = false; !tasks.empty();) {
        std::vector<Builder::Task> next;
        std::vector<Made> made = make(tasks, finish);
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            const std::uint32_t node = tree.append(made[i].part);
            if (node > 0) tree.nodes[tasks[i].parent][tasks[i].slot] = node;
            for (Builder::Task& task : made[i].below) {
                task.parent += node;
                next.push_back(std::move(task));
            }
        }
        tasks = std::move(next);
        finish = tasks.size() >= enough_tasks;
    }
    return tree;
}

}  // namespace lamina::sizing
