// Evaluation of a size field: walks down the tree that size_tree.cpp builds.
#include <lamina/sizing.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "sizing/background.hpp"
#include "sizing/shapes.hpp"
#include "sizing/size_tree.hpp"

namespace lamina::sizing {

namespace {

/// Throws OptionError where no field can be made of these arguments.
void require_valid(std::span<const SizeSource> sources, const SizeFieldOptions& options, const Box& domain) {
    if (!(options.gradation >= 0 && options.gradation < HUGE_VAL))
        throw OptionError("gradation", "must be finite and not negative");
    if (!(options.max_size > 0)) throw OptionError("max_size", "must be positive");
    if (sources.empty() && !(options.max_size < HUGE_VAL))
        throw OptionError("max_size", "must be given where there is no source of sizes");
    if (!(domain.width() >= 0 && domain.height() >= 0 && domain.width() + domain.height() > 0 &&
          domain.width() + domain.height() < HUGE_VAL))
        throw OptionError("domain", "is empty or infinite");
    for (const SizeSource& s : sources) {
        if (!(s.size > 0 && s.size < HUGE_VAL)) throw OptionError("sources", "a size must be positive and finite");
        if (!(s.radius >= 0 && s.radius < HUGE_VAL))
            throw OptionError("sources", "a radius must be finite and not negative");
        if (const char* const fault = shape_fault(s)) throw OptionError("sources", fault);
    }
}

}  // namespace

}  // namespace lamina::sizing

namespace lamina {

using namespace sizing;

struct SizeField::Tree {
    /// Fixed-point coordinates within the square of the root.
    struct Key {
        std::uint64_t x, y;
    };

    /// A node or leaf, by its entry, and the slot of side 2^shift that leads to it.
    struct Place {
        std::uint32_t entry;
        int shift;
    };
    static constexpr Place root{0, key_bits};

    /// The places of all cells of one size round the sources, where most points lie: walks down the tree begin there.
    struct Window {
        int shift = key_bits;                               ///< a cell has the side 2^shift
        std::uint64_t x = 0, y = 0, width = 0, height = 0;  ///< in cells
        std::vector<Place> places;                          ///< row by row
    };

    Box domain;
    double side = 0;             ///< of the root's square, whose lower left corner is that of the domain
    double keys_per_length = 0;  ///< number of keys per unit of length
    std::vector<Slots> nodes;
    std::vector<Leaf> leaves;
    Window window;

    /// Returns the key of a point, moved to the nearest point of the domain.
    Key key(Point p) const {
        constexpr std::uint64_t last = (std::uint64_t{1} << key_bits) - 1;
        const double x = (std::clamp(p.x, domain.lower.x, domain.upper.x) - domain.lower.x) * keys_per_length;
        const double y = (std::clamp(p.y, domain.lower.y, domain.upper.y) - domain.lower.y) * keys_per_length;
        // The hardware converts to signed integers only.
        return {std::min(static_cast<std::uint64_t>(static_cast<std::int64_t>(x)), last),
                std::min(static_cast<std::uint64_t>(static_cast<std::int64_t>(y)), last)};
    }

    /// Returns the field at a point of the leaf that `entry`, in a slot of side 2^shift, leads to.
    double value(std::uint32_t entry, int shift, Key key) const {
        const int bits = shift + ((entry & half_bit) != 0);
        const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
        const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - bits) << 52);  // 2^-bits
        const double u = static_cast<double>(static_cast<std::int64_t>(key.x & mask)) * scale;
        const double v = static_cast<double>(static_cast<std::int64_t>(key.y & mask)) * scale;
        const Leaf& h = leaves[entry & index_mask];
        const double south = h[0] + u * (static_cast<double>(h[1]) - h[0]);
        const double north = h[2] + u * (static_cast<double>(h[3]) - h[2]);
        return side * (south + v * (north - south));
    }

    /// Returns the slot that holds a point, in a node whose slots have the side 2^shift.
    static std::size_t slot(Key k, int shift) { return ((k.y >> shift) & 3) * 4 + ((k.x >> shift) & 3); }

    /// Returns where the walk to a point begins; null outside of the window.
    const Place* find_in_window(Key k) const {
        const std::uint64_t x = (k.x >> window.shift) - window.x, y = (k.y >> window.shift) - window.y;
        return x < window.width && y < window.height ? &window.places[y * window.width + x] : nullptr;
    }

    static bool is_leaf(Place place) { return (place.entry & leaf_bit) != 0; }
    /// Returns the place of a point in the node at a place.
    Place below(Place place, Key k) const {
        const int shift = place.shift - 2;
        return {nodes[place.entry][slot(k, shift)], shift};
    }

    /// Makes the window round a box.
    void open_window(const Box& box) {
        constexpr std::uint64_t most_places = 4096;
        const Key lower = key(box.lower), upper = key(box.upper);
        const auto cells = [](std::uint64_t from, std::uint64_t to, int shift) {
            return (to >> shift) - (from >> shift) + 1;
        };
        int shift = root_shift;
        while (shift >= 2 && cells(lower.x, upper.x, shift - 2) * cells(lower.y, upper.y, shift - 2) <= most_places)
            shift -= 2;
        window = {
            shift, lower.x >> shift, lower.y >> shift, cells(lower.x, upper.x, shift), cells(lower.y, upper.y, shift),
            {}};
        window.places.reserve(window.width * window.height);
        for (std::uint64_t y = 0; y < window.height; ++y)
            for (std::uint64_t x = 0; x < window.width; ++x) {
                const Key corner{(window.x + x) << shift, (window.y + y) << shift};
                Place place = root;
                while (!is_leaf(place) && place.shift > shift) place = below(place, corner);
                window.places.push_back(place);
            }
    }
};

SizeField::SizeField(double uniform_size) : uniform_(uniform_size) {
    if (!(uniform_size > 0 && uniform_size < HUGE_VAL)) throw OptionError("size", "must be positive and finite");
}

SizeField::SizeField(std::span<const SizeSource> sources, const SizeFieldOptions& options, const Box& domain) {
    require_valid(sources, options, domain);
    auto tree = std::make_shared<Tree>();
    tree->domain = domain;
    tree->side = core::longer_side(domain);
    tree->keys_per_length = static_cast<double>(std::uint64_t{1} << key_bits) / tree->side;
    SizeTree part = build_size_tree(sources, options, domain.lower, tree->side);
    tree->nodes = std::move(part.nodes);
    tree->leaves = std::move(part.leaves);
    Box box;
    for (const SizeSource& source : sources) {
        const Box round = bounding_box(source);
        box.include(round.lower);
        box.include(round.upper);
    }
    tree->open_window(sources.empty() ? domain : box);
    tree_ = std::move(tree);
    start_.shift = root_shift;
    gradation_ = options.gradation;
}

double SizeField::operator()(Point p) const {
    if (!tree_) return uniform_;
    const Tree& tree = *tree_;
    const Tree::Key key = tree.key(p);
    Tree::Place place{start_.node, start_.shift + 2};
    const bool outside_start = ((key.x ^ start_.x) | (key.y ^ start_.y)) >> place.shift != 0;
    if (outside_start || place.shift > tree.window.shift) {
        if (const Tree::Place* known = tree.find_in_window(key))
            place = *known;
        else if (outside_start)
            place = Tree::root;
    }
    while (!Tree::is_leaf(place)) place = tree.below(place, key);
    return tree.value(place.entry, place.shift, key);
}

SizeField SizeField::restricted_to(const Box& box) const {
    SizeField result = *this;
    if (!tree_) return result;
    const Tree::Key lower = tree_->key(box.lower), upper = tree_->key(box.upper);
    Start start{.node = 0, .shift = root_shift, .x = lower.x, .y = lower.y};
    for (;;) {
        const std::size_t slot = Tree::slot(lower, start.shift);
        const std::uint32_t entry = tree_->nodes[start.node][slot];
        if (slot != Tree::slot(upper, start.shift) || (entry & leaf_bit) != 0) break;
        start.node = entry;
        start.shift -= 2;
    }
    result.start_ = start;
    return result;
}

SizeField::Range SizeField::range(const Box& box, double max_ratio) const {
    if (!tree_) return {uniform_, uniform_};
    const Tree& tree = *tree_;
    const Tree::Key lower = tree.key(box.lower), upper = tree.key(box.upper);
    struct KeyedNode {
        std::uint32_t node;
        int shift;           ///< a slot has the side 2^shift
        std::uint64_t x, y;  ///< key of the lower left corner
    };
    std::vector<KeyedNode> open{{0, root_shift, 0, 0}};
    Range range{HUGE_VAL, 0};
    while (!open.empty() && !(range.high > max_ratio * range.low)) {
        const KeyedNode parent = open.back();
        open.pop_back();
        for (std::uint64_t slot = 0; slot < 16; ++slot) {
            const std::uint64_t x = parent.x + ((slot & 3) << parent.shift),
                                y = parent.y + ((slot >> 2) << parent.shift);
            const std::uint64_t last = (std::uint64_t{1} << parent.shift) - 1;
            if (x > upper.x || x + last < lower.x || y > upper.y || y + last < lower.y) continue;
            const std::uint32_t entry = tree.nodes[parent.node][slot];
            if ((entry & leaf_bit) == 0) {
                open.push_back({entry, parent.shift - 2, x, y});
                continue;
            }
            // The extremes of a bilinear function over a rectangle are at its corners.
            for (const std::uint64_t at_x : {std::max(x, lower.x), std::min(x + last, upper.x)})
                for (const std::uint64_t at_y : {std::max(y, lower.y), std::min(y + last, upper.y)}) {
                    const double h = tree.value(entry, parent.shift, {at_x, at_y});
                    range = {std::min(range.low, h), std::max(range.high, h)};
                }
        }
    }
    return range;
}

double SizeField::inverse_square_integral() const {
    assert(tree_);
    const Tree& tree = *tree_;
    struct PlacedNode {
        std::uint32_t node;
        Point lower;       ///< lower left corner
        double slot_side;  ///< in units of length
    };
    const auto area_in_domain = [&](Point lower, double side) {
        const Box inside = Box{lower, lower + Point{side, side}}.intersection(tree.domain);
        return std::max(inside.width(), 0.0) * std::max(inside.height(), 0.0);
    };
    std::vector<PlacedNode> open{{0, tree.domain.lower, 0.25 * tree.side}};
    double sum = 0;
    while (!open.empty()) {
        const PlacedNode parent = open.back();
        open.pop_back();
        for (unsigned slot = 0; slot < 16; ++slot) {
            const Point lower = parent.lower + parent.slot_side * Point{double(slot & 3), double(slot >> 2)};
            const std::uint32_t entry = tree.nodes[parent.node][slot];
            if ((entry & leaf_bit) == 0) {
                open.push_back({entry, lower, 0.25 * parent.slot_side});
                continue;
            }
            // A leaf that fills four slots counts in each of them with the mean over its own corners.
            double mean = 0;
            for (const double h : tree.leaves[entry & index_mask]) mean += 0.25 / (tree.side * h * tree.side * h);
            sum += area_in_domain(lower, parent.slot_side) * mean;
        }
    }
    return sum;
}

std::size_t SizeField::cells() const { return tree_ ? tree_->leaves.size() : 1; }

SizeField size_field_of_mesh(const SizedMesh& mesh, const SizeFieldOptions& options, const Box& domain) {
    return SizeField(background_sources(mesh, options.gradation, domain), options, domain);
}

}  // namespace lamina
