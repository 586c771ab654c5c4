#include "pipeline/piece_records.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/packing.hpp"
#include "pipeline/parts.hpp"

namespace lamina::pipeline {

namespace {

using core::Packer;
using core::Unpacker;

/// The sums over the triangles of a piece whose last bits depend on the order in which pieces are added.
struct PieceSums {
    double area = 0, edge_over_size = 0, min_angle_sum = 0, max_angle_sum = 0, mean_ratio_sum = 0;
};

/// The extremes over several pieces.
struct PieceExtremes {
    double min_angle = 180, max_angle = 0, max_aspect = 0, max_area_ratio = 0;
};

/// The worst cell of several pieces: the first one of those that are equally bad.
struct WorstOfPieces {
    mesh::WorstCell cell;
    std::size_t piece = 0;

    void add(const WorstOfPieces& other) {
        if (other.cell.badness > cell.badness || (other.cell.badness == cell.badness && other.piece < piece))
            *this = other;
    }
};

/// What does not depend on the order of the pieces.
struct UnorderedSums {
    mesh::PieceFindings findings;  ///< counts alone
    RefineStats stats;
    mesh::QualityTotals totals;  ///< counts alone
    std::size_t good_estimates = 0, largest = 0;
    PieceExtremes extremes;
    WorstOfPieces widest, narrowest, oversized;

    void add(const HeldPiece& held);
};

/// Calls f for all counts, to add, put or get them.
template <class Sums, class F>
void for_counts(Sums& sums, F&& f) {
    f(sums.findings.inner_edges);
    f(sums.findings.cells.delaunay.edges);
    f(sums.findings.cells.delaunay.violations);
    f(sums.findings.cells.defects.count);
    f(sums.stats.refused);
    f(sums.stats.below_bound);
    f(sums.stats.exempt);
    f(sums.stats.oversized);
    f(sums.totals.cells);
    f(sums.totals.below_bound);
    for (auto& count : sums.totals.angle_histogram) f(count);
    f(sums.good_estimates);
}

void UnorderedSums::add(const HeldPiece& held) {
    const mesh::PieceFindings& of_piece = held.facts.findings;
    const mesh::QualityTotals& shapes = of_piece.cells.isotropic.totals();
    findings.inner_edges += of_piece.inner_edges;
    findings.cells.delaunay.edges += of_piece.cells.delaunay.edges;
    findings.cells.delaunay.violations += of_piece.cells.delaunay.violations;
    findings.cells.defects.count += of_piece.cells.defects.count;
    stats += held.facts.stats;
    totals.cells += shapes.cells;
    totals.below_bound += shapes.below_bound;
    for (std::size_t i = 0; i < shapes.angle_histogram.size(); ++i)
        totals.angle_histogram[i] += shapes.angle_histogram[i];
    good_estimates += is_good_estimate(held.facts.estimated_triangles, of_piece.triangles);
    largest = std::max(largest, of_piece.triangles);
    extremes = {std::min(extremes.min_angle, shapes.min_angle), std::max(extremes.max_angle, shapes.max_angle),
                std::max(extremes.max_aspect, shapes.max_aspect),
                std::max(extremes.max_area_ratio, shapes.max_area_ratio)};
    widest.add({of_piece.widest, held.piece});
    narrowest.add({of_piece.narrowest, held.piece});
    oversized.add({held.facts.oversized, held.piece});
}

/// A narrow triangle, and a defect, of a piece.
struct NarrowInPiece {
    std::size_t piece = 0;
    mesh::NarrowTriangle triangle;
};
struct DefectInPiece {
    std::size_t piece = 0;
    MeshDefect defect;
};

/// A piece of any process.
struct ToldPiece {
    std::uint32_t rank = 0, times_made = 0;
    std::size_t triangles = 0, inner_vertices = 0;
    PieceSums sums;
};

/// What rank 0 adds up.
class PieceSummation {
public:
    PieceSummation(std::size_t pieces, std::size_t ranks, double min_angle_deg)
        : told_(pieces), pieces_of_(ranks), all_(min_angle_deg), shapes_(min_angle_deg) {}

    /// Takes what pack_pieces() returns on this rank.
    void take(std::size_t rank, std::string_view record) {
        Unpacker unpacker(record);
        all_.hash.add(unpacker.get<mesh::HashOfParts>());
        UnorderedSums sums;
        for_counts(sums, [&](std::size_t& count) { count = unpacker.get_short(); });
        sums.largest = unpacker.get_short();
        sums.extremes = unpacker.get<PieceExtremes>();
        for (WorstOfPieces* worst : {&sums.widest, &sums.narrowest, &sums.oversized})
            *worst = unpacker.get<WorstOfPieces>();
        add(sums);
        shapes_.append_area_ratios(unpacker.get_counts());
        for (std::size_t left = unpacker.get_short(); left > 0; --left) {
            const std::size_t piece = unpacker.get_short();
            narrow_.push_back({piece, unpacker.get<mesh::NarrowTriangle>()});
        }
        for (std::size_t left = unpacker.get_short(); left > 0; --left) {
            const std::size_t piece = unpacker.get_short();
            std::string description = unpacker.get_text();
            defects_.push_back({piece, {std::move(description), unpacker.get<Point>()}});
        }
        while (!unpacker.at_end()) {
            const std::size_t piece = unpacker.get_short();
            ToldPiece& told = told_[piece];
            told.rank = static_cast<std::uint32_t>(rank);
            ++told.times_made;
            told.triangles = unpacker.get_short();
            told.inner_vertices = unpacker.get_short();
            told.sums = unpacker.get<PieceSums>();
            pieces_of_[rank].push_back(piece);
        }
    }

    AllPieces finish(const MeshCounts& before) {
        const std::vector<PieceNumbers> numbers = number_pieces(before);
        for (const std::vector<std::size_t>& pieces : pieces_of_) {
            std::vector<PieceNumbers>& of_rank = all_.numbers_of.emplace_back();
            for (const std::size_t piece : pieces) of_rank.push_back(numbers[piece]);
        }
        mesh::PieceFindings& findings = all_.findings;
        shapes_.append(totals_);
        findings.cells.isotropic = std::move(shapes_);
        findings.widest = widest_.cell;
        findings.narrowest = narrowest_.cell;
        all_.summary.pieces = told_.size();
        all_.summary.oversized = oversized_.cell;
        const auto by_piece = [](const auto& a, const auto& b) { return a.piece < b.piece; };
        std::stable_sort(narrow_.begin(), narrow_.end(), by_piece);
        for (NarrowInPiece& narrow : narrow_) {
            narrow.triangle.cell += numbers[narrow.piece].first_triangle;
            findings.narrow.push_back(narrow.triangle);
        }
        std::stable_sort(defects_.begin(), defects_.end(), by_piece);
        for (DefectInPiece& defect : defects_)
            if (findings.cells.defects.kept.size() < mesh::DefectList::max_kept)
                findings.cells.defects.kept.push_back(std::move(defect.defect));
        return std::move(all_);
    }

private:
    std::vector<ToldPiece> told_;
    std::vector<std::vector<std::size_t>> pieces_of_;  ///< per rank, in its order
    AllPieces all_;
    mesh::QualityCollector shapes_;
    mesh::QualityTotals totals_;
    WorstOfPieces widest_, narrowest_, oversized_;
    std::vector<NarrowInPiece> narrow_;
    std::vector<DefectInPiece> defects_;

    void add(const UnorderedSums& sums) {
        all_.findings.inner_edges += sums.findings.inner_edges;
        all_.findings.cells.delaunay.edges += sums.findings.cells.delaunay.edges;
        all_.findings.cells.delaunay.violations += sums.findings.cells.delaunay.violations;
        all_.findings.cells.defects.count += sums.findings.cells.defects.count;
        all_.summary.stats += sums.stats;
        all_.summary.good_estimates += sums.good_estimates;
        all_.summary.largest = std::max(all_.summary.largest, sums.largest);
        totals_.cells += sums.totals.cells;
        totals_.below_bound += sums.totals.below_bound;
        for (std::size_t i = 0; i < totals_.angle_histogram.size(); ++i)
            totals_.angle_histogram[i] += sums.totals.angle_histogram[i];
        totals_.min_angle = std::min(totals_.min_angle, sums.extremes.min_angle);
        totals_.max_angle = std::max(totals_.max_angle, sums.extremes.max_angle);
        totals_.max_aspect = std::max(totals_.max_aspect, sums.extremes.max_aspect);
        totals_.max_area_ratio = std::max(totals_.max_area_ratio, sums.extremes.max_area_ratio);
        widest_.add(sums.widest);
        narrowest_.add(sums.narrowest);
        oversized_.add(sums.oversized);
    }

    /// Numbers the pieces and adds up what depends on their order.
    std::vector<PieceNumbers> number_pieces(const MeshCounts& before) {
        std::vector<PieceNumbers> numbers;
        numbers.reserve(told_.size());
        all_.counts = before;
        mesh::PieceFindings& findings = all_.findings;
        for (std::size_t piece = 0; piece < told_.size(); ++piece) {
            const ToldPiece& told = told_[piece];
            if (told.times_made != 1)
                throw MeshError(fmt::format("piece {} was made {} times", piece, told.times_made));
            numbers.push_back({all_.counts.vertices, all_.counts.triangles});
            all_.counts.vertices += told.inner_vertices;
            all_.counts.triangles += told.triangles;
            findings.triangles += told.triangles;
            findings.inner_vertices += told.inner_vertices;
            findings.cells.area += told.sums.area;
            totals_.min_angle_sum += told.sums.min_angle_sum;
            totals_.max_angle_sum += told.sums.max_angle_sum;
            totals_.mean_ratio_sum += told.sums.mean_ratio_sum;
            all_.summary.edge_over_size += static_cast<double>(told.triangles) * told.sums.edge_over_size;
            all_.summary.triangles += static_cast<double>(told.triangles);
        }
        require_numbered(all_.counts.vertices);
        return numbers;
    }
};

}  // namespace

std::string pack_pieces(const HeldPieces& held) {
    UnorderedSums sums;
    std::size_t narrow = 0, defects = 0;
    for (const HeldPiece& piece : held.pieces) {
        sums.add(piece);
        narrow += piece.facts.findings.narrow.size();
        defects += piece.facts.findings.cells.defects.kept.size();
    }
    Packer packer;
    packer.put(held.hash);
    for_counts(sums, [&](std::size_t count) { packer.put_short(count); });
    packer.put_short(sums.largest);
    packer.put(sums.extremes);
    for (const WorstOfPieces& worst : {sums.widest, sums.narrowest, sums.oversized}) packer.put(worst);
    packer.put_counts(held.area_ratios.area_ratios());
    packer.put_short(narrow);
    for (const HeldPiece& piece : held.pieces)
        for (const mesh::NarrowTriangle& triangle : piece.facts.findings.narrow) {
            packer.put_short(piece.piece);
            packer.put(triangle);
        }
    packer.put_short(defects);
    for (const HeldPiece& piece : held.pieces)
        for (const MeshDefect& defect : piece.facts.findings.cells.defects.kept) {
            packer.put_short(piece.piece);
            packer.put_text(defect.description);
            packer.put(defect.at);
        }
    for (const HeldPiece& piece : held.pieces) {
        const mesh::PieceFindings& findings = piece.facts.findings;
        const mesh::QualityTotals& totals = findings.cells.isotropic.totals();
        packer.put_short(piece.piece);
        packer.put_short(findings.triangles);
        packer.put_short(findings.inner_vertices);
        packer.put(PieceSums{findings.cells.area, piece.facts.edge_over_size, totals.min_angle_sum,
                             totals.max_angle_sum, totals.mean_ratio_sum});
    }
    return packer.take();
}

AllPieces add_up(const std::vector<std::string>& of_ranks, std::size_t pieces, const MeshCounts& before,
                 double min_angle_deg) {
    PieceSummation summation(pieces, of_ranks.size(), min_angle_deg);
    for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) summation.take(rank, of_ranks[rank]);
    return summation.finish(before);
}

}  // namespace lamina::pipeline
