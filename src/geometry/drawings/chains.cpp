#include "geometry/drawings/chains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

namespace lamina::geometry {

namespace {

/// The places where curves end: ends within the tolerance of the first one found there, and of their own, are one place.
class Places {
public:
    /// `tolerance` is the largest of all; `origin` is one of the places, roughly.
    Places(double tolerance, Point origin) : tolerance_(tolerance), origin_(origin) {}

    std::size_t find_or_add(Point p, double tolerance) {
        const Point steps = (1 / tolerance_) * (p - origin_);
        const double column = std::floor(steps.x), row = std::floor(steps.y);
        for (double i = -1; i <= 1; ++i) {
            for (double j = -1; j <= 1; ++j) {
                const auto [first, last] = by_cell_.equal_range(key(column + i, row + j));
                for (auto at = first; at != last; ++at)
                    if (distance(places_[at->second].at, p) <= std::min(tolerance, places_[at->second].tolerance))
                        return at->second;
            }
        }
        by_cell_.emplace(key(column, row), places_.size());
        places_.push_back({p, tolerance});
        return places_.size() - 1;
    }
    std::size_t size() const { return places_.size(); }
    Point operator[](std::size_t i) const { return places_[i].at; }

private:
    struct Place {
        Point at;
        double tolerance;
    };
    double tolerance_;
    Point origin_;
    std::vector<Place> places_;
    std::unordered_multimap<std::uint64_t, std::size_t> by_cell_;

    static std::uint64_t key(double column, double row) {
        const auto whole = [](double x) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(x)); };
        return whole(column) * 0x9E3779B97F4A7C15ull + whole(row);
    }
};

/// A curve between two places.
struct Edge {
    std::size_t from, to;
    bool is_straight;
    bool is_left = true;  ///< whether it is part of a chain still to be made
};

/// Returns what two curves have in common that are the same, in whatever direction: their ends, least first, and their
/// middle, in steps of the tolerance.
using Likeness = std::array<double, 6>;
Likeness likeness_of(const PlaneCurve& curve, double tolerance) {
    Point a = at(curve, curve.first), b = at(curve, curve.last);
    if (lexicographically_less(b, a)) std::swap(a, b);
    const Point middle = at(curve, 0.5 * (curve.first + curve.last));
    Likeness likeness{a.x, a.y, b.x, b.y, middle.x, middle.y};
    for (double& x : likeness) x = std::floor(x / tolerance + 0.5);
    return likeness;
}

double size_of(const PlaneCurve& curve) {
    double size = 0;
    for (const Point p : curve.control) size = std::max(size, distance(p, curve.control[0]));
    return size;
}

/// The curves as the edges of a graph.
class Graph {
public:
    Graph(std::span<const FlatCurve> curves, double share, double size, const std::string& file)
        : curves_(curves), file_(file), places_(share * size, curves.empty() ? Point{} : curves[0].curve.control[0]) {
        constexpr double least_share = 1e-6, own_factor = 10;  // of sizes of curves
        std::set<Likeness> known;
        for (std::size_t i = 0; i < curves.size(); ++i) {
            const PlaneCurve& curve = curves[i].curve;
            edges_.push_back({0, 0, curve.is_straight() && curve.control.size() == 2, false});
            const double own = size_of(curve), tolerance = share * std::min(size, own_factor * own);
            if (own <= least_share * size) continue;
            if (!known.insert(likeness_of(curve, least_share * size)).second) {
                ++repeated_;
                continue;
            }
            edges_[i].from = places_.find_or_add(at(curve, curve.first), tolerance);
            edges_[i].to = places_.find_or_add(at(curve, curve.last), tolerance);
            edges_[i].is_left = true;
        }
        ends_.resize(places_.size());
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            if (!edges_[i].is_left || is_loop(i)) continue;
            ends_[edges_[i].from].push_back(i);
            ends_[edges_[i].to].push_back(i);
        }
        for (const std::vector<std::size_t>& ends : ends_)
            if (ends.size() > most_ends) refuse(ends);
    }

    std::size_t repeated() const { return repeated_; }

    /// Leaves out construction lines where more than two curves meet. Returns how many.
    std::size_t prune() {
        std::size_t pruned = 0;
        for (const bool straight_only : {true, false}) pruned += prune_paths(straight_only);
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const Edge& e = edges_[i];
            if (!e.is_left || is_loop(i) || !e.is_straight || ends_[e.from].size() < 3 || ends_[e.to].size() < 3)
                continue;
            remove(i);
            ++pruned;
        }
        return pruned;
    }

    std::vector<Chain> chains() {
        for (const std::vector<std::size_t>& ends : ends_)
            if (ends.size() > 2) refuse(ends);
        std::vector<Chain> chains;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            if (edges_[i].is_left && is_loop(i)) {
                edges_[i].is_left = false;
                chains.push_back({{{i, false}}, true});
            }
        // Open chains begin at places where a single curve ends, all others anywhere.
        for (const bool is_open : {true, false})
            for (std::size_t i = 0; i < edges_.size(); ++i) {
                const Edge& e = edges_[i];
                if (!e.is_left) continue;
                const bool starts = ends_[e.from].size() == 1, finishes = ends_[e.to].size() == 1;
                if (is_open && !starts && !finishes) continue;
                chains.push_back(walk(i, is_open && !starts));
            }
        return chains;
    }

private:
    std::span<const FlatCurve> curves_;
    const std::string& file_;
    Places places_;
    std::vector<Edge> edges_;
    std::vector<std::vector<std::size_t>> ends_;  ///< per place: the curves that end there
    std::size_t repeated_ = 0;

    static constexpr std::size_t most_ends = 64;  // of curves at one place, before construction lines are left out

    [[noreturn]] void refuse(const std::vector<std::size_t>& ends) const {
        const auto place = static_cast<std::size_t>(&ends - ends_.data());
        throw InputError(
            {file_, curves_[ends[2]].line, places_[place]},
            fmt::format("{} curves meet there: leave those out of the drawing that are no outlines", ends.size()));
    }

    bool is_loop(std::size_t edge) const { return edges_[edge].from == edges_[edge].to; }
    std::size_t other_end(std::size_t edge, std::size_t place) const {
        return edges_[edge].from == place ? edges_[edge].to : edges_[edge].from;
    }
    void remove(std::size_t edge) {
        edges_[edge].is_left = false;
        for (const std::size_t place : {edges_[edge].from, edges_[edge].to}) std::erase(ends_[place], edge);
    }

    /// Removes chains that begin at a free end and stop where more than two curves meet.
    std::size_t prune_paths(bool straight_only) {
        std::size_t pruned = 0;
        for (std::size_t start = 0; start < ends_.size(); ++start) {
            if (ends_[start].size() != 1) continue;
            std::vector<std::size_t> path;
            std::size_t place = start;
            do {
                const std::vector<std::size_t>& here = ends_[place];
                const std::size_t edge = !path.empty() && here[0] == path.back() ? here.back() : here[0];
                path.push_back(edge);
                place = other_end(edge, place);
            } while (ends_[place].size() == 2);
            if (ends_[place].size() < 3) continue;
            if (straight_only && (path.size() > 1 || !edges_[path[0]].is_straight)) continue;
            for (const std::size_t edge : path) remove(edge);
            pruned += path.size();
        }
        return pruned;
    }

    Chain walk(std::size_t edge, bool is_reversed) {
        Chain chain;
        const std::size_t start = is_reversed ? edges_[edge].to : edges_[edge].from;
        std::size_t place = start;
        while (true) {
            edges_[edge].is_left = false;
            chain.links.push_back({edge, edges_[edge].to == place});
            place = other_end(edge, place);
            if (place == start) break;
            const std::vector<std::size_t>& here = ends_[place];
            const auto next = std::find_if(here.begin(), here.end(), [&](std::size_t e) { return edges_[e].is_left; });
            if (next == here.end()) return chain;
            edge = *next;
        }
        chain.is_closed = true;
        return chain;
    }
};

}  // namespace

std::vector<Chain> join_curves(std::span<const FlatCurve> curves, double share, double size, const std::string& file,
                               std::vector<std::string>& notes) {
    Graph graph(curves, share, size, file);
    if (graph.repeated() > 0) notes.push_back(fmt::format("{} curves drawn twice left out once", graph.repeated()));
    if (const std::size_t pruned = graph.prune(); pruned > 0)
        notes.push_back(fmt::format("{} construction lines that end at outlines left out", pruned));
    return graph.chains();
}

}  // namespace lamina::geometry
