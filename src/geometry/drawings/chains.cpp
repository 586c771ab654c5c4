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

#include "core/text.hpp"

namespace lamina::geometry {

namespace {

/// The places where curves end: ends within the tolerance of the first one found there, and of their own, are one
/// place.
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

/// What two curves have in common that are the same.
using Likeness = std::array<double, 6>;

/// Returns the ends of a curve, least first, whatever its direction, and its middle, in steps of the tolerance.
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
        return pruned + prune_straight();
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

    bool joins_crossings(const Edge& e) const { return ends_[e.from].size() > 2 && ends_[e.to].size() > 2; }

    /// Removes straight lines between places where more than two curves meet. Beside a line inside of an outline, such
    /// as a spar, edges of the outline are such lines, too, but without these it would fall into parts: of the longest
    /// and the shortest ones first, what keeps it whole counts. Throws InputError where neither does.
    std::size_t prune_straight() {
        std::vector<std::size_t> candidates;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            if (edges_[i].is_left && !is_loop(i) && edges_[i].is_straight && joins_crossings(edges_[i]))
                candidates.push_back(i);
        if (candidates.empty()) return 0;
        std::stable_sort(candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) {
            return size_of(curves_[a].curve) > size_of(curves_[b].curve);
        });
        const std::size_t whole = components();
        const std::vector<std::vector<std::size_t>> ends = ends_;
        for (int attempt = 0; attempt < 2; ++attempt) {
            std::vector<std::size_t> removed;
            for (const std::size_t i : candidates) {
                if (!joins_crossings(edges_[i])) continue;
                remove(i);
                removed.push_back(i);
            }
            const bool has_crossings = std::any_of(candidates.begin(), candidates.end(), [&](std::size_t i) {
                return ends_[edges_[i].from].size() > 2 || ends_[edges_[i].to].size() > 2;
            });
            if (removed.size() == candidates.size() || (!has_crossings && components() == whole)) return removed.size();
            for (const std::size_t i : removed) edges_[i].is_left = true;
            ends_ = ends;
            std::reverse(candidates.begin(), candidates.end());
        }
        const std::size_t longest = candidates.front();
        throw InputError({file_, curves_[longest].line, places_[edges_[longest].from]},
                         "straight lines divide an outline so that it is not clear which of them are its edges: leave "
                         "those out of the drawing that are none");
    }

    /// Returns the number of parts of the graph that no curves join.
    std::size_t components() const {
        std::vector<bool> is_reached(ends_.size());
        std::vector<std::size_t> open;
        std::size_t count = 0;
        for (std::size_t start = 0; start < ends_.size(); ++start) {
            if (is_reached[start] || ends_[start].empty()) continue;
            ++count;
            is_reached[start] = true;
            open.push_back(start);
            while (!open.empty()) {
                const std::size_t place = open.back();
                open.pop_back();
                for (const std::size_t edge : ends_[place]) {
                    const std::size_t next = other_end(edge, place);
                    if (!is_reached[next]) open.push_back(next);
                    is_reached[next] = true;
                }
            }
        }
        return count;
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
    if (graph.repeated() > 0) notes.push_back(core::counted(graph.repeated(), "curve") + " drawn twice left out once");
    if (const std::size_t pruned = graph.prune(); pruned > 0)
        notes.push_back(core::counted(pruned, "construction line") + " left out: they end at outlines");
    return graph.chains();
}

}  // namespace lamina::geometry
