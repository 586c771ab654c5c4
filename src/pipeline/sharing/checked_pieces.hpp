// Refinement of all subdomains, each checked by the thread that has refined it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/busy_times.hpp"
#include "core/exact_sum.hpp"
#include "decoupling/subdomain.hpp"
#include "mesh/piecewise_check.hpp"

namespace lamina::pipeline {

/// The facts about all pieces that neither the mesh nor its check tells.
struct PiecesSummary {
    std::size_t pieces = 0, largest = 0;  ///< number of pieces, and triangles of the largest
    std::size_t good_estimates = 0;       ///< number of pieces whose estimate was within 15 % of the truth
    RefineStats stats;
    core::ExactSum edge_over_size;  ///< over pieces: mean edge over h, times triangles
    std::size_t triangles = 0;
    mesh::WorstCell oversized;  ///< by the area over h squared; sought where stats.oversized > 0

    /// Returns the mean of the lengths of isotropic edges over h at their middles; 0 where there are none.
    double mean_edge_over_size() const {
        return triangles > 0 ? edge_over_size.value() / static_cast<double>(triangles) : 0.0;
    }
};

/// The kinds of work of refine_and_check(), as BusyTimes counts them.
struct PieceWork {
    std::size_t refining, checking;
};

/// A receiver takes the pieces. All its functions run on several threads at once.
struct PieceKeeper {
    /// Called before the work on a subdomain begins.
    std::function<void(std::size_t subdomain)> begin;
    /// Takes the refinement of a subdomain.
    std::function<void(std::size_t subdomain, Refinement)> keep;
    /// Called where the work on a subdomain has thrown, so that no other thread waits for it.
    std::function<void()> fail;
};

/// The facts about one piece.
struct PieceFacts {
    mesh::PieceFindings findings;
    RefineStats stats;
    double estimated_triangles = 0;
    double edge_over_size = 0;  ///< mean
    mesh::WorstCell oversized;
};

/// A piece, and the facts about it.
struct CheckedPiece {
    Refinement refinement;
    PieceFacts facts;
};

/// How pieces are checked and counted, whoever makes them.
struct PieceRules {
    double min_angle_deg = 0;
    double expected_triangles = 0;  ///< in all pieces together, about
    PieceWork work{};
};

/// Refines a subdomain and checks the piece. `points` holds its border vertices by their ids in the mesh.
CheckedPiece refine_and_check_piece(const decoupling::Subdomain& subdomain, std::span<const Point> points,
                                    const PieceRules& rules, core::BusyTimes& times);

/// Returns whether the number of triangles of a piece was estimated within 15 %.
bool is_good_estimate(double estimated, std::size_t made);

/// Adds the facts about the next piece to the summary and to the check.
void add_piece(PieceFacts facts, PiecesSummary& summary, mesh::PiecewiseCheck& check);

/// Refines all subdomains in parallel in this order. Each piece is checked while it lies in the cache of the thread
/// that has made it, its findings are added to the check in the order of the subdomains, and the piece is handed to the
/// keeper. The result depends neither on this order nor on the number of threads.
PiecesSummary refine_and_check(const decoupling::Decoupling& decoupling, std::span<const std::size_t> order,
                               const PieceRules& rules, core::BusyTimes& times, mesh::PiecewiseCheck& check,
                               const PieceKeeper& keeper);

}  // namespace lamina::pipeline
