// The exact size field (lower_envelope.hpp) sampled on a graded quadtree.
//
// Why the error is bounded. The envelope f is Lipschitz with constant g (the gradation), so in a cell of side s the
// bilinear interpolant of its corners is off by at most g s / sqrt 2. Where a cell keeps half a side's distance from
// every source that counts in it, f is a minimum of smooth functions: it bends upwards by at most g s^2 / (8 distance)
// and otherwise has concave ridges only, whose error anywhere is a small multiple of that at the five sample points.
// Inside a box or a disc that no other source undercuts f is constant.
#include "sizing/size_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "sizing/lower_envelope.hpp"
#include "sizing/source_groups.hpp"

namespace lamina::sizing {

namespace {

/// The share of h that the Lipschitz bound of the error may take.
constexpr double lipschitz_tolerance = 0.047;
/// The largest relative error at the sample points of smooth cells.
constexpr double sample_tolerance = 0.01;
/// Upper bounds are raised by this share, so that rounding never makes them wrong.
constexpr double rounding = 1e-9;
/// The side of the smallest cell is that of the root / 2^max_level.
constexpr int max_level = 40;

/// A square of the quadtree.
struct TreeCell {
    Point lower;  ///< lower left corner
    double side;
    int level;                ///< 0 for the root
    std::array<double, 4> h;  ///< exact field at the corners, in the order of Leaf

    Box box() const { return {lower, {lower.x + side, lower.y + side}}; }
    double min_h() const { return std::min({h[0], h[1], h[2], h[3]}); }
    double max_h() const { return std::max({h[0], h[1], h[2], h[3]}); }
};

/// The exact field at the middles of a cell's edges and at its centre.
struct CellSamples {
    double south, west, center, east, north;
};

/// The samples of a cell that its neighbours below and on the left have taken already.
struct KnownSamples {
    std::optional<double> south, west;
};

/// Builds a part of the tree.
class TreeBuilder {
public:
    TreeBuilder(const SourceTree& sources, const SizeFieldOptions& options, double root_side)
        : envelope_(sources, options), gradation_(options.gradation), root_side_(root_side) {}

    /// A cell whose node is still to be made, and the slot that will lead to the node.
    struct Task {
        TreeCell cell;
        std::vector<std::uint32_t> candidates;  ///< as LowerEnvelope::copy() returns them
        CellSamples samples;
        std::uint32_t parent, slot;
    };

    /// Returns the task of the root.
    Task root(Point lower, double side) {
        const Candidates all = envelope_.push_all();
        TreeCell root{lower, side, 0, {}};
        root.h.fill(envelope_.max_size());
        CellPoints<4> corners{{lower.x, lower.x + side, lower.x, lower.x + side},
                              {lower.y, lower.y, lower.y + side, lower.y + side},
                              root.h};
        envelope_.evaluate(all, corners);
        root.h = corners.h;
        const CellSamples samples = sample(root, all);
        return {root, envelope_.copy(all), samples, 0, 0};
    }

    /// Makes the node of one cell. Its quarters that need nodes of their own become tasks.
    void expand(const Task& task, std::vector<Task>& tasks) {
        make_node(task.cell, envelope_.push_copy(task.candidates), task.samples,
                  [&](std::uint32_t node, int slot, const TreeCell& quarter, const Candidates& candidates,
                      const CellSamples& s) {
                      tasks.push_back({quarter, envelope_.copy(candidates), s, node, static_cast<std::uint32_t>(slot)});
                  });
    }

    /// Makes all nodes below a cell. The cell's own node is the first.
    void finish(const Task& task) { make_nodes(task.cell, envelope_.push_copy(task.candidates), task.samples); }

    SizeTree part;  ///< the nodes and leaves made so far

private:
    /// Returns an upper bound of the field in a cell.
    double upper_bound(const TreeCell& c) const {
        const double radius = sqrt_half * c.side;
        return std::min(c.max_h() + gradation_ * radius, c.min_h() + 2 * gradation_ * radius);
    }

    /// Returns an upper bound of the field at a distance from where it has been evaluated.
    double bound_beside(double h, double apart) const {
        return std::min((h + gradation_ * apart) * (1 + rounding), envelope_.max_size());
    }

    /// Samples a cell, but for the edges whose middles a neighbour has sampled.
    CellSamples sample(const TreeCell& c, const Candidates& candidates, const KnownSamples& known = {}) {
        const double half = 0.5 * c.side;
        const double x0 = c.lower.x, x1 = x0 + half, x2 = x0 + c.side;
        const double y0 = c.lower.y, y1 = y0 + half, y2 = y0 + c.side;
        const auto between = [&](double a, double b) { return bound_beside(std::min(a, b), half); };
        const double south = between(c.h[0], c.h[1]), west = between(c.h[0], c.h[2]), east = between(c.h[1], c.h[3]),
                     north = between(c.h[2], c.h[3]), center = bound_beside(c.min_h(), sqrt_half * c.side);
        if (!known.south && !known.west) {
            CellPoints<6> points{
                {x1, x2, x1, x1, x0, x0}, {y1, y1, y2, y0, y1, y1}, {center, east, north, south, west, west}};
            envelope_.evaluate(candidates, points);
            return {points.h[3], points.h[4], points.h[0], points.h[1], points.h[2]};
        }
        const Point fourth = known.south ? Point{x0, y1} : Point{x1, y0};
        CellPoints<4> points{
            {x1, x2, x1, fourth.x}, {y1, y1, y2, fourth.y}, {center, east, north, known.south ? west : south}};
        envelope_.evaluate(candidates, points);
        return {known.south.value_or(points.h[3]), known.west.value_or(points.h[3]), points.h[0], points.h[1],
                points.h[2]};
    }

    std::array<Candidates, 4> push_candidates(const std::array<TreeCell, 4>& cells, const Candidates& parent) {
        Quadrants quadrants;
        quadrants.side = cells[0].side;
        for (std::size_t q = 0; q < 4; ++q) {
            const Box box = cells[q].box();
            quadrants.lower_x[q] = box.lower.x;
            quadrants.lower_y[q] = box.lower.y;
            quadrants.upper_x[q] = box.upper.x;
            quadrants.upper_y[q] = box.upper.y;
            quadrants.max_value[q] = upper_bound(cells[q]);
        }
        return envelope_.push(quadrants, parent);
    }

    /// Returns whether a cell is so small that no source can make it a bad leaf.
    bool is_small(const TreeCell& c) const {
        return c.level == max_level || sqrt_half * gradation_ * c.side <= lipschitz_tolerance * c.min_h();
    }

    /// Returns whether the samples show that bilinear interpolation is close enough. Samples count only away from the
    /// sources. Where ridges and bends might cancel out at the five samples, four more are taken.
    bool is_smooth(const TreeCell& c, const Candidates& candidates, const CellSamples& s) {
        const auto close = [](double interpolated, double exact) {
            return std::abs(interpolated - exact) <= sample_tolerance * exact;
        };
        const auto mean = [](double a, double b) { return 0.5 * (a + b); };
        const double west = mean(c.h[0], c.h[2]), east = mean(c.h[1], c.h[3]);
        if (!(candidates.nearest >= 0.5 * c.side && close(mean(c.h[0], c.h[1]), s.south) && close(west, s.west) &&
              close(east, s.east) && close(mean(c.h[2], c.h[3]), s.north) && close(mean(west, east), s.center)))
            return false;
        const double bend = gradation_ * c.side * c.side / (8 * candidates.nearest);
        if (candidates.is_one_source() || bend <= sample_tolerance * c.min_h()) return true;
        constexpr double near = 0.25, far = 0.75;
        const double x0 = c.lower.x + near * c.side, x1 = c.lower.x + far * c.side;
        const double y0 = c.lower.y + near * c.side, y1 = c.lower.y + far * c.side;
        CellPoints<4> points{{x0, x1, x0, x1}, {y0, y0, y1, y1}, {}};
        for (int q = 0; q < 4; ++q) points.h[q] = bound_beside(c.h[q], 0.5 * sqrt_half * c.side);
        envelope_.evaluate(candidates, points);
        for (int q = 0; q < 4; ++q) {
            const double u = (q & 1) != 0 ? far : near, v = (q >> 1) != 0 ? far : near;
            const double low = c.h[0] + u * (c.h[1] - c.h[0]), high = c.h[2] + u * (c.h[3] - c.h[2]);
            if (!close(low + v * (high - low), points.h[q])) return false;
        }
        return true;
    }

    static TreeCell quadrant(const TreeCell& c, const CellSamples& s, int q) {
        const std::array<double, 9> h{c.h[0], s.south, c.h[1], s.west, s.center, s.east, c.h[2], s.north, c.h[3]};
        const int i = q & 1, j = q >> 1, corner = 3 * j + i;
        const double half = 0.5 * c.side;
        return {{c.lower.x + i * half, c.lower.y + j * half},
                half,
                c.level + 1,
                {h[corner], h[corner + 1], h[corner + 3], h[corner + 4]}};
    }

    /// Adds a leaf and returns the entry that leads to it.
    std::uint32_t add_leaf(const TreeCell& c) {
        Leaf leaf;
        for (int i = 0; i < 4; ++i) leaf[i] = static_cast<float>(c.h[i] / root_side_);
        part.leaves.push_back(leaf);
        return leaf_bit | static_cast<std::uint32_t>(part.leaves.size() - 1);
    }

    /// Calls on_leaf(quadrant, its cell) or on_inner(quadrant, its cell, candidates, samples) for the four quadrants.
    template <class OnLeaf, class OnInner>
    void split(const TreeCell& parent, const Candidates& parent_candidates, const CellSamples& samples, OnLeaf on_leaf,
               OnInner on_inner) {
        const std::array<TreeCell, 4> quadrants{quadrant(parent, samples, 0), quadrant(parent, samples, 1),
                                                quadrant(parent, samples, 2), quadrant(parent, samples, 3)};
        if (std::all_of(quadrants.begin(), quadrants.end(), [&](const TreeCell& c) { return is_small(c); })) {
            for (int q = 0; q < 4; ++q) on_leaf(q, quadrants[q]);
            return;
        }
        const std::array<Candidates, 4> all_candidates = push_candidates(quadrants, parent_candidates);
        std::array<KnownSamples, 4> known;
        for (int q = 0; q < 4; ++q) {
            const TreeCell& c = quadrants[q];
            const Candidates& candidates = all_candidates[q];
            if (is_small(c) || candidates.empty() || candidates.constant) {
                on_leaf(q, c);
                continue;
            }
            const CellSamples s = sample(c, candidates, known[q]);
            if ((q & 1) == 0) known[q + 1].west = s.east;
            if (q < 2) known[q + 2].south = s.north;
            if (is_smooth(c, candidates, s))
                on_leaf(q, c);
            else
                on_inner(q, c, candidates, s);
        }
        envelope_.pop(all_candidates[0]);
    }

    /// Makes the wide node of a cell that needs one and returns its index. Calls on_inner(node, slot, quarter,
    /// candidates, samples) for the cell's quarters that need nodes, too.
    template <class OnInner>
    std::uint32_t make_node(const TreeCell& cell, const Candidates& candidates, const CellSamples& samples,
                            OnInner on_inner) {
        const auto node = static_cast<std::uint32_t>(part.nodes.size());
        part.nodes.emplace_back();
        const auto slot = [](int q, int r) { return 8 * (q >> 1) + 4 * (r >> 1) + 2 * (q & 1) + (r & 1); };
        split(
            cell, candidates, samples,
            [&](int q, const TreeCell& half) {
                const std::uint32_t leaf = add_leaf(half) | half_bit;
                for (int r = 0; r < 4; ++r) part.nodes[node][slot(q, r)] = leaf;
            },
            [&](int q, const TreeCell& half, const Candidates& half_candidates, const CellSamples& half_samples) {
                split(
                    half, half_candidates, half_samples,
                    [&](int r, const TreeCell& quarter) { part.nodes[node][slot(q, r)] = add_leaf(quarter); },
                    [&](int r, const TreeCell& quarter, const Candidates& quarter_candidates, const CellSamples& s) {
                        on_inner(node, slot(q, r), quarter, quarter_candidates, s);
                    });
            });
        return node;
    }

    /// Makes the wide node of a cell and all nodes below it, and returns its index. The recursion is at most max_level
    /// deep.
    std::uint32_t make_nodes(const TreeCell& cell, const Candidates& candidates, const CellSamples& samples) {
        return make_node(cell, candidates, samples,
                         [&](std::uint32_t node, int slot, const TreeCell& quarter,
                             const Candidates& quarter_candidates, const CellSamples& s) {
                             const std::uint32_t below = make_nodes(quarter, quarter_candidates, s);
                             part.nodes[node][slot] = below;
                         });
    }

    LowerEnvelope envelope_;
    double gradation_, root_side_;
};

/// A part of the tree that a task made, and the tasks that it left.
struct BuiltPart {
    SizeTree part;
    std::vector<TreeBuilder::Task> below;
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

SizeTree build_size_tree(std::span<const SizeSource> sources, const SizeFieldOptions& options, Point lower,
                         double side) {
    // The tree is built level by level until there are enough cells for all threads, then cell by cell: the part below
    // each cell at once.
    constexpr std::size_t enough_tasks = 64;
    const SourceTree groups = group_sources(sources);
    const auto build_parts = [&](const std::vector<TreeBuilder::Task>& tasks, bool finish) {
        return core::parallel_blocks(tasks.size(), 1, [&](std::size_t i, std::size_t) {
            TreeBuilder builder(groups, options, side);
            BuiltPart built;
            if (finish)
                builder.finish(tasks[i]);
            else
                builder.expand(tasks[i], built.below);
            built.part = std::move(builder.part);
            return built;
        });
    };
    std::vector<TreeBuilder::Task> tasks{TreeBuilder(groups, options, side).root(lower, side)};
    SizeTree tree;
    for (bool finish = false; !tasks.empty();) {
        std::vector<TreeBuilder::Task> next;
        std::vector<BuiltPart> parts = build_parts(tasks, finish);
        std::size_t nodes = tree.nodes.size(), leaves = tree.leaves.size();
        for (const BuiltPart& built : parts) {
            nodes += built.part.nodes.size();
            leaves += built.part.leaves.size();
        }
        tree.nodes.reserve(nodes);
        tree.leaves.reserve(leaves);
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            const std::uint32_t node = tree.append(parts[i].part);
            const bool is_root = node == 0;
            if (!is_root) tree.nodes[tasks[i].parent][tasks[i].slot] = node;
            for (TreeBuilder::Task& task : parts[i].below) {
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
