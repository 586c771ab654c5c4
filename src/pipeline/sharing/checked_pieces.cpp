#include "pipeline/sharing/checked_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/in_order.hpp"
#include "core/parallel.hpp"
#include "delaunay/refine/refine_region.hpp"

namespace lamina::pipeline {

namespace {

/// Calls f(a, b, c) for the corners of every `stride`-th triangle.
template <class F>
void for_triangles(const decoupling::Subdomain& subdomain, const Refinement& refinement, std::size_t stride, F&& f) {
    const auto at = [&](VertexId v) {
        return v.index() < subdomain.points.size() ? subdomain.points[v.index()]
                                                   : refinement.steiner_points[v.index() - subdomain.points.size()];
    };
    for (std::size_t t = 0; t < refinement.triangles.size(); t += stride) {
        const VertexId* v = refinement.triangles[t].v;
        f(at(v[0]), at(v[1]), at(v[2]));
    }
}

/// Returns the mean length of edges over h at their middles, of `samples` evenly chosen triangles or a few more.
double mean_edge_over_size(const decoupling::Subdomain& subdomain, const Refinement& refinement, std::size_t samples) {
    double sum = 0, edges = 0;
    const auto add = [&](Point a, Point b) { sum += distance(a, b) / subdomain.size(midpoint(a, b)); };
    for_triangles(subdomain, refinement, 1 + refinement.triangles.size() / samples, [&](Point a, Point b, Point c) {
        add(a, b);
        add(b, c);
        add(c, a);
        edges += 3;
    });
    return edges > 0 ? sum / edges : 0.0;
}

mesh::WorstCell most_oversized(const decoupling::Subdomain& subdomain, const Refinement& refinement) {
    mesh::WorstCell worst;
    for_triangles(subdomain, refinement, 1, [&](Point a, Point b, Point c) {
        const Point middle = (1.0 / 3) * (a + b + c);
        const double h = subdomain.size(middle), relative = 0.5 * cross(b - a, c - a) / (h * h);
        if (relative > worst.badness) worst = {relative, middle};
    });
    return worst;
}

/// Returns how many triangles of a piece are measured: together enough for a mean that is known within 0.5 %. How many
/// pieces there are is not known yet where some are made before others are cut.
std::size_t samples_of(double triangles, double expected_in_all) {
    return 32 + static_cast<std::size_t>(4096 * std::min(1.0, triangles / std::max(expected_in_all, 1.0)));
}

PieceFacts facts_of(std::span<const Point> points, const decoupling::Subdomain& subdomain,
                    const delaunay::LinkedRefinement& linked, const PieceRules& rules) {
    const Refinement& refinement = linked.refinement;
    const std::size_t samples = samples_of(static_cast<double>(refinement.triangles.size()), rules.expected_triangles);
    PieceFacts facts;
    facts.findings = mesh::check_piece(
        {subdomain.points, subdomain.global, refinement.steiner_points, refinement.triangles, linked.links, points},
        rules.min_angle_deg);
    facts.stats = refinement.stats;
    facts.estimated_triangles = subdomain.estimated_triangles;
    facts.edge_over_size = mean_edge_over_size(subdomain, refinement, samples);
    if (refinement.stats.oversized > 0) facts.oversized = most_oversized(subdomain, refinement);
    return facts;
}

}  // namespace

CheckedPiece refine_and_check_piece(const decoupling::Subdomain& region, std::span<const Point> points,
                                    const PieceRules& rules, core::BusyTimes& times) {
    delaunay::LinkedRefinement linked;
    {
        const core::BusyTimes::Scope busy(&times, rules.work.refining);
        linked = delaunay::refine_linked(region.points, region.segments, region.size, region.refine);
    }
    const core::BusyTimes::Scope busy(&times, rules.work.checking);
    PieceFacts facts = facts_of(points, region, linked, rules);
    return {std::move(linked.refinement), std::move(facts)};
}

bool is_good_estimate(double estimated, std::size_t made) {
    const auto triangles = static_cast<double>(made);
    return std::abs(estimated - triangles) <= 0.15 * triangles;
}

void add_piece(PieceFacts facts, PiecesSummary& summary, mesh::PiecewiseCheck& check) {
    const std::size_t made = facts.findings.triangles;
    ++summary.pieces;
    summary.largest = std::max(summary.largest, made);
    summary.good_estimates += is_good_estimate(facts.estimated_triangles, made);
    summary.stats += facts.stats;
    summary.edge_over_size.add(static_cast<double>(made) * facts.edge_over_size);
    summary.triangles += made;
    if (facts.oversized.badness > summary.oversized.badness) summary.oversized = facts.oversized;
    check.add_piece(std::move(facts.findings));
}

PiecesSummary refine_and_check(const decoupling::Decoupling& decoupling, std::span<const std::size_t> order,
                               const PieceRules& rules, core::BusyTimes& times, mesh::PiecewiseCheck& check,
                               const PieceKeeper& keeper) {
    PiecesSummary summary;
    core::InOrder<PieceFacts> in_order([&](PieceFacts facts) { add_piece(std::move(facts), summary, check); });
    const auto make_piece = [&](std::size_t subdomain) {
        keeper.begin(subdomain);
        CheckedPiece piece = refine_and_check_piece(decoupling.subdomains[subdomain], decoupling.points, rules, times);
        in_order.put(subdomain, std::move(piece.facts));
        keeper.keep(subdomain, std::move(piece.refinement));
    };
    core::parallel_for(order.size(), 1, [&](std::size_t place, std::size_t) {
        try {
            make_piece(order[place]);
        } catch (...) {
            keeper.fail();
            throw;
        }
    });
    return summary;
}

}  // namespace lamina::pipeline
