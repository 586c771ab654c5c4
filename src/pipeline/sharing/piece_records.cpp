#include "pipeline/sharing/piece_records.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/exact_sum.hpp"
#include "core/packing.hpp"
#include "pipeline/sharing/parts.hpp"

namespace lamina::pipeline {

namespace {

using core::ExactSum;
using core::Packer;
using core::Unpacker;

/// The extremes over several pieces.
struct PieceExtremes {
    double min_angle = 180, max_angle = 0, max_aspect = 0, max_area_ratio = 0;

    void add(const PieceExtremes& other) {
        min_angle = std::min(min_angle, other.min_angle);
        max_angle = std::max(max_angle, other.max_angle);
        max_aspect = std::max(max_aspect, other.max_aspect);
        max_area_ratio = std::max(max_area_ratio, other.max_area_ratio);
    }
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

/// A narrow triangle, and a defect, of a piece.
struct NarrowInPiece {
    std::size_t piece = 0;
    mesh::NarrowTriangle triangle;
};
struct DefectInPiece {
    std::size_t piece = 0;
    MeshDefect defect;
};

/// What several pieces come to.
struct PiecesRecord {
    mesh::HashOfParts hash;
    std::size_t triangles = 0, inner_vertices = 0, inner_edges = 0, delaunay_edges = 0, delaunay_violations = 0;
    std::size_t defect_count = 0, measured = 0, below_bound = 0, good_estimates = 0, pieces = 0;
    std::array<std::size_t, 18> angle_histogram{};
    RefineStats stats;
    std::size_t largest = 0;
    ExactSum area, min_angles, max_angles, mean_ratios, edge_over_size;
    PieceExtremes extremes;
    WorstOfPieces widest, narrowest, oversized;
    mesh::QualityCollector area_ratios{0};  ///< their histogram alone
    std::vector<NarrowInPiece> narrow;      ///< by their pieces, as the defects
    std::vector<DefectInPiece> defects;     ///< the first ones

    void add(const HeldPiece& held, std::size_t first_triangle);
    void add(PiecesRecord&& other);
};

/// Calls f for all counts, to add, put or get them.
template <class Record, class F>
void for_counts(Record& record, F&& f) {
    for (auto* count : {&record.triangles, &record.inner_vertices, &record.inner_edges, &record.delaunay_edges,
                        &record.delaunay_violations, &record.defect_count, &record.measured, &record.below_bound,
                        &record.good_estimates, &record.pieces, &record.stats.refused, &record.stats.below_bound,
                        &record.stats.exempt, &record.stats.oversized})
        f(*count);
    for (auto& count : record.angle_histogram) f(count);
}

/// Calls f for all sums of numbers that are no counts.
template <class Record, class F>
void for_sums(Record& record, F&& f) {
    for (auto* sum :
         {&record.area, &record.min_angles, &record.max_angles, &record.mean_ratios, &record.edge_over_size})
        f(*sum);
}

void PiecesRecord::add(const HeldPiece& held, std::size_t first_triangle) {
    const mesh::PieceFindings& of_piece = held.facts.findings;
    const mesh::QualityTotals& shapes = of_piece.cells.isotropic.totals();
    ++pieces;
    triangles += of_piece.triangles;
    inner_vertices += of_piece.inner_vertices;
    inner_edges += of_piece.inner_edges;
    delaunay_edges += of_piece.cells.delaunay.edges;
    delaunay_violations += of_piece.cells.delaunay.violations;
    defect_count += of_piece.cells.defects.count;
    measured += shapes.cells;
    below_bound += shapes.below_bound;
    stats += held.facts.stats;
    for (std::size_t i = 0; i < angle_histogram.size(); ++i) angle_histogram[i] += shapes.angle_histogram[i];
    good_estimates += is_good_estimate(held.facts.estimated_triangles, of_piece.triangles);
    largest = std::max(largest, of_piece.triangles);
    area.add(of_piece.cells.area);
    min_angles.add(shapes.min_angle_sum);
    max_angles.add(shapes.max_angle_sum);
    mean_ratios.add(shapes.mean_ratio_sum);
    edge_over_size.add(static_cast<double>(of_piece.triangles) * held.facts.edge_over_size);
    extremes.add({shapes.min_angle, shapes.max_angle, shapes.max_aspect, shapes.max_area_ratio});
    widest.add({of_piece.widest, held.piece});
    narrowest.add({of_piece.narrowest, held.piece});
    oversized.add({held.facts.oversized, held.piece});
    for (mesh::NarrowTriangle triangle : of_piece.narrow) {
        triangle.cell += first_triangle;
        narrow.push_back({held.piece, triangle});
    }
    for (const MeshDefect& defect : of_piece.cells.defects.kept) defects.push_back({held.piece, defect});
}

/// Adds those of other pieces, in the order of the pieces.
template <class InPiece>
void merge(std::vector<InPiece>& all, std::vector<InPiece>&& others) {
    const auto middle = static_cast<std::ptrdiff_t>(all.size());
    std::move(others.begin(), others.end(), std::back_inserter(all));
    std::inplace_merge(all.begin(), all.begin() + middle, all.end(),
                       [](const InPiece& a, const InPiece& b) { return a.piece < b.piece; });
}

void PiecesRecord::add(PiecesRecord&& other) {
    hash.add(other.hash);
    std::vector<std::size_t> counts;
    for_counts(other, [&](std::size_t count) { counts.push_back(count); });
    std::size_t next = 0;
    for_counts(*this, [&](std::size_t& count) { count += counts[next++]; });
    largest = std::max(largest, other.largest);
    std::vector<const ExactSum*> sums;
    for_sums(other, [&](const ExactSum& sum) { sums.push_back(&sum); });
    next = 0;
    for_sums(*this, [&](ExactSum& sum) { sum.add(*sums[next++]); });
    extremes.add(other.extremes);
    widest.add(other.widest);
    narrowest.add(other.narrowest);
    oversized.add(other.oversized);
    area_ratios.append_area_ratios(other.area_ratios.area_ratios());
    merge(narrow, std::move(other.narrow));
    merge(defects, std::move(other.defects));
    if (defects.size() > mesh::DefectList::max_kept) defects.resize(mesh::DefectList::max_kept);
}

std::string pack(const PiecesRecord& record) {
    Packer packer;
    packer.put(record.hash);
    for_counts(record, [&](std::size_t count) { packer.put_short(count); });
    packer.put_short(record.largest);
    for_sums(record, [&](const ExactSum& sum) { sum.put(packer); });
    packer.put(record.extremes);
    for (const WorstOfPieces& worst : {record.widest, record.narrowest, record.oversized}) packer.put(worst);
    packer.put_counts(record.area_ratios.area_ratios());
    packer.put_short(record.narrow.size());
    for (const auto& [piece, triangle] : record.narrow) {
        packer.put_short(piece);
        packer.put(triangle);
    }
    packer.put_short(record.defects.size());
    for (const auto& [piece, defect] : record.defects) {
        packer.put_short(piece);
        packer.put_text(defect.description);
        packer.put(defect.at);
    }
    return packer.take();
}

PiecesRecord unpack(std::string_view bytes) {
    Unpacker unpacker(bytes);
    PiecesRecord record;
    record.hash = unpacker.get<mesh::HashOfParts>();
    for_counts(record, [&](std::size_t& count) { count = unpacker.get_short(); });
    record.largest = unpacker.get_short();
    for_sums(record, [&](ExactSum& sum) { sum = ExactSum::get(unpacker); });
    record.extremes = unpacker.get<PieceExtremes>();
    for (WorstOfPieces* worst : {&record.widest, &record.narrowest, &record.oversized})
        *worst = unpacker.get<WorstOfPieces>();
    record.area_ratios.append_area_ratios(unpacker.get_counts());
    for (std::size_t left = unpacker.get_short(); left > 0; --left) {
        const std::size_t piece = unpacker.get_short();
        record.narrow.push_back({piece, unpacker.get<mesh::NarrowTriangle>()});
    }
    for (std::size_t left = unpacker.get_short(); left > 0; --left) {
        const std::size_t piece = unpacker.get_short();
        std::string description = unpacker.get_text();
        record.defects.push_back({piece, {std::move(description), unpacker.get<Point>()}});
    }
    return record;
}

}  // namespace

std::string pack_pieces(const HeldPieces& held, std::span<const PieceNumbers> numbers) {
    PiecesRecord record;
    record.hash = held.hash;
    for (std::size_t i = 0; i < numbers.size(); ++i) record.add(held.pieces[i], numbers[i].first_triangle);
    record.area_ratios.append_area_ratios(held.area_ratios.area_ratios());
    return pack(record);
}

std::string join_records(std::string_view one, std::string_view other) {
    PiecesRecord record = unpack(one);
    record.add(unpack(other));
    return pack(record);
}

AllPieces add_up(std::string_view bytes, double min_angle_deg) {
    PiecesRecord record = unpack(bytes);
    AllPieces all(min_angle_deg);
    all.hash = record.hash;
    mesh::QualityTotals totals;
    totals.cells = record.measured;
    totals.below_bound = record.below_bound;
    totals.min_angle = record.extremes.min_angle;
    totals.max_angle = record.extremes.max_angle;
    totals.max_aspect = record.extremes.max_aspect;
    totals.max_area_ratio = record.extremes.max_area_ratio;
    totals.min_angle_sum = record.min_angles.value();
    totals.max_angle_sum = record.max_angles.value();
    totals.mean_ratio_sum = record.mean_ratios.value();
    totals.angle_histogram = record.angle_histogram;
    mesh::PieceFindings& findings = all.findings;
    findings.cells.isotropic.append(totals);
    findings.cells.isotropic.append_area_ratios(record.area_ratios.area_ratios());
    findings.triangles = record.triangles;
    findings.inner_vertices = record.inner_vertices;
    findings.inner_edges = record.inner_edges;
    findings.cells.area = record.area.value();
    findings.cells.delaunay = {record.delaunay_edges, record.delaunay_violations};
    findings.cells.defects.count = record.defect_count;
    for (DefectInPiece& defect : record.defects) findings.cells.defects.kept.push_back(std::move(defect.defect));
    findings.widest = record.widest.cell;
    findings.narrowest = record.narrowest.cell;
    for (const NarrowInPiece& narrow : record.narrow) findings.narrow.push_back(narrow.triangle);
    all.summary = {.pieces = record.pieces,
                   .largest = record.largest,
                   .good_estimates = record.good_estimates,
                   .stats = record.stats,
                   .edge_over_size = record.edge_over_size,
                   .triangles = record.triangles,
                   .oversized = record.oversized.cell};
    return all;
}

}  // namespace lamina::pipeline
