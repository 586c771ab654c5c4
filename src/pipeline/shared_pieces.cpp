// All that goes from one process to another stands here: one record for each piece, with half a byte for each border edge,
// and what lies behind the few edges that rank 0 then asks for. Rank 0 puts it together.
#include "pipeline/shared_pieces.hpp"

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "pipeline/border_chain.hpp"
#include "pipeline/parts.hpp"

namespace lamina::pipeline {

namespace {

using core::Packer;
using core::Unpacker;

/// The measures of a piece.
struct PieceMeasures {
    double area = 0, estimated_triangles = 0, edge_over_size = 0;
    double min_angle = 0, max_angle = 0, min_angle_sum = 0, max_angle_sum = 0, mean_ratio_sum = 0, max_aspect = 0,
           max_area_ratio = 0;
    mesh::WorstCell widest, narrowest;
};

/// Calls f for all counts of a piece, to put them or to get them.
template <class Findings, class Stats, class Totals, class F>
void for_counts(Findings& findings, Stats& stats, Totals& totals, F&& f) {
    f(findings.triangles);
    f(findings.inner_vertices);
    f(findings.inner_edges);
    f(findings.cells.delaunay.edges);
    f(findings.cells.delaunay.violations);
    f(findings.cells.defects.count);
    f(stats.refused);
    f(stats.below_bound);
    f(stats.exempt);
    f(stats.oversized);
    f(totals.cells);
    f(totals.below_bound);
    for (auto& count : totals.angle_histogram) f(count);
}

/// Puts two classes into each byte.
void pack_classes(std::span<const std::uint8_t> classes, Packer& packer) {
    packer.put_short(classes.size());
    for (std::size_t i = 0; i < classes.size(); i += 2) {
        const unsigned second = i + 1 < classes.size() ? classes[i + 1] : 0u;
        packer.put(static_cast<std::uint8_t>(classes[i] | second << 4));
    }
}

std::vector<std::uint8_t> unpack_classes(Unpacker& unpacker) {
    std::vector<std::uint8_t> classes(unpacker.get_short());
    for (std::size_t i = 0; i < classes.size(); i += 2) {
        const auto both = unpacker.get<std::uint8_t>();
        classes[i] = both & 15u;
        if (i + 1 < classes.size()) classes[i + 1] = both >> 4;
    }
    return classes;
}

void pack_piece(const HeldPiece& held, Packer& packer) {
    const mesh::PieceFindings& findings = held.facts.findings;
    const mesh::QualityTotals& totals = findings.cells.isotropic.totals();
    packer.put_short(held.piece);
    for_counts(findings, held.facts.stats, totals, [&](std::size_t count) { packer.put_short(count); });
    packer.put(PieceMeasures{findings.cells.area, held.facts.estimated_triangles, held.facts.edge_over_size,
                             totals.min_angle, totals.max_angle, totals.min_angle_sum, totals.max_angle_sum,
                             totals.mean_ratio_sum, totals.max_aspect, totals.max_area_ratio, findings.widest,
                             findings.narrowest});
    if (held.facts.stats.oversized > 0) packer.put(held.facts.oversized);
    packer.put_all<mesh::NarrowTriangle>(findings.narrow);
    const std::vector<MeshDefect>& defects = findings.cells.defects.kept;
    packer.put_short(defects.size());
    for (const MeshDefect& defect : defects) {
        packer.put_text(defect.description);
        packer.put(defect.at);
    }
    pack_classes(held.shape_classes, packer);
}

/// A piece of any process, as rank 0 knows it.
struct ToldPiece {
    std::size_t rank = 0;
    PieceFacts facts;
    std::vector<std::uint8_t> shape_classes;
};

/// Takes what pack_piece() has put there. Returns the number of the piece.
std::size_t unpack_piece(Unpacker& unpacker, double min_angle_deg, ToldPiece& told) {
    const std::size_t piece = unpacker.get_short();
    told.facts.findings = mesh::PieceFindings(min_angle_deg);
    mesh::PieceFindings& findings = told.facts.findings;
    mesh::QualityTotals totals;
    for_counts(findings, told.facts.stats, totals, [&](std::size_t& count) { count = unpacker.get_short(); });
    const auto measures = unpacker.get<PieceMeasures>();
    findings.cells.area = measures.area;
    told.facts.estimated_triangles = measures.estimated_triangles;
    told.facts.edge_over_size = measures.edge_over_size;
    totals.min_angle = measures.min_angle;
    totals.max_angle = measures.max_angle;
    totals.min_angle_sum = measures.min_angle_sum;
    totals.max_angle_sum = measures.max_angle_sum;
    totals.mean_ratio_sum = measures.mean_ratio_sum;
    totals.max_aspect = measures.max_aspect;
    totals.max_area_ratio = measures.max_area_ratio;
    findings.cells.isotropic.append(totals);
    findings.widest = measures.widest;
    findings.narrowest = measures.narrowest;
    if (told.facts.stats.oversized > 0) told.facts.oversized = unpacker.get<mesh::WorstCell>();
    findings.narrow = unpacker.get_all<mesh::NarrowTriangle>();
    const std::size_t kept = unpacker.get_short();
    for (std::size_t i = 0; i < kept; ++i) {
        std::string description = unpacker.get_text();
        findings.cells.defects.kept.push_back({std::move(description), unpacker.get<Point>()});
    }
    told.shape_classes = unpack_classes(unpacker);
    return piece;
}

std::string pack_held(const HeldPieces& held) {
    Packer packer;
    packer.put(held.hash);
    std::span<const std::uint32_t> ratios = held.area_ratios.area_ratios();
    while (!ratios.empty() && ratios.back() == 0) ratios = ratios.first(ratios.size() - 1);
    packer.put_short(ratios.size());
    for (const std::uint32_t count : ratios) packer.put_short(count);
    for (const HeldPiece& piece : held.pieces) pack_piece(piece, packer);
    return packer.take();
}

using Wanted = mesh::PiecewiseCheck::Wanted;

/// Puts a question of rank 0 for border edges of a piece, numbered in its border_chain().
void pack_question(std::size_t piece, std::span<const Wanted> wanted, Packer& packer) {
    packer.put_short(piece);
    packer.put_short(wanted.size());
    std::size_t last = 0;
    for (const auto [edge, apex] : wanted) packer.put_short(2 * (edge - std::exchange(last, edge)) + (apex ? 1 : 0));
}

/// Returns what lies behind the border edges of the held pieces that rank 0 asks for, in its order.
std::string pack_answers(const SharedDecoupling& shared, const HeldPieces& held, Unpacker& questions) {
    const std::vector<Point>& points = shared.decoupling.points;
    Packer packer;
    while (!questions.at_end()) {
        const std::size_t number = questions.get_short();
        const auto piece = std::lower_bound(held.pieces.begin(), held.pieces.end(), number,
                                            [](const HeldPiece& one, std::size_t n) { return one.piece < n; });
        const std::vector<Segment> chain = border_chain(shared.borders[number].border);
        std::size_t edge = 0;
        for (std::size_t left = questions.get_short(); left > 0; --left) {
            const std::size_t question = questions.get_short();
            edge += question / 2;
            const Point apex = piece->apexes[edge];
            if (question % 2 == 1)
                packer.put(apex);
            else
                packer.put(mesh::area_over(points[chain[edge].a.index()], points[chain[edge].b.index()], apex));
        }
    }
    return packer.take();
}

/// What rank 0 puts together.
class Assembly {
public:
    Assembly(std::span<const decoupling::EstimatedBorder> borders, mesh::PiecewiseCheck& check)
        : borders_(borders), check_(check) {}

    /// Takes the records of all ranks. `counted` knows the layer.
    void count(const std::vector<std::string>& of_ranks, double min_angle_deg, CountedMesh& counted) {
        std::vector<ToldPiece> told(borders_.size());
        std::vector<unsigned> made(told.size(), 0);
        mesh::QualityCollector ratios(min_angle_deg);
        pieces_of_.resize(of_ranks.size());
        for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
            Unpacker unpacker(of_ranks[rank]);
            counted.hash.add(unpacker.get<mesh::HashOfParts>());
            std::vector<std::uint32_t> counts(unpacker.get_short());
            for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(unpacker.get_short());
            ratios.append_area_ratios(counts);
            while (!unpacker.at_end()) {
                ToldPiece piece;
                piece.rank = rank;
                const std::size_t number = unpack_piece(unpacker, min_angle_deg, piece);
                made[number] += 1;
                told[number] = std::move(piece);
                pieces_of_[rank].push_back(number);
            }
        }
        for (std::size_t piece = 0; piece < told.size(); ++piece)
            if (made[piece] != 1) throw MeshError(fmt::format("piece {} was made {} times", piece, made[piece]));
        if (!told.empty()) told.front().facts.findings.cells.isotropic.append_area_ratios(ratios.area_ratios());
        for (std::size_t piece = 0; piece < told.size(); ++piece) {
            numbers_.push_back({counted.counts.vertices, counted.counts.triangles});
            counted.first_triangle.push_back(counted.counts.triangles);
            counted.counts.vertices += told[piece].facts.findings.inner_vertices;
            counted.counts.triangles += told[piece].facts.findings.triangles;
            require_numbered(counted.counts.vertices);
            rank_of_.push_back(static_cast<std::uint32_t>(told[piece].rank));
            take_piece(piece, std::move(told[piece]), counted.summary);
        }
    }

    /// Returns for each rank the numbers of its pieces, and the border edges to tell of.
    std::vector<std::string> answers(const CountedMesh& counted) {
        std::vector<Packer> packers(pieces_of_.size());
        for (std::size_t rank = 0; rank < packers.size(); ++rank) {
            packers[rank].put(counted.counts);
            packers[rank].put_short(counted.layer_pieces);
            std::vector<PieceNumbers> numbers;
            for (const std::size_t piece : pieces_of_[rank]) numbers.push_back(numbers_[piece]);
            packers[rank].put_all<PieceNumbers>(numbers);
        }
        asked_.resize(packers.size());
        std::size_t piece = 0;
        std::vector<Wanted> of_piece;
        const auto ask = [&] {
            if (!of_piece.empty()) pack_question(piece, of_piece, packers[rank_of_[piece]]);
            of_piece.clear();
        };
        for (const Wanted& wanted : check_.wanted()) {
            const auto its_piece = static_cast<std::size_t>(
                std::upper_bound(first_edge_.begin(), first_edge_.end(), wanted.border_edge) - first_edge_.begin() - 1);
            if (its_piece != piece) ask();
            piece = its_piece;
            of_piece.push_back({wanted.border_edge - first_edge_[piece], wanted.apex});
            asked_[rank_of_[piece]].push_back(wanted);
        }
        ask();
        std::vector<std::string> texts;
        for (Packer& packer : packers) texts.push_back(packer.take());
        return texts;
    }

    /// Takes what pack_answers() returns on all ranks.
    void take_answers(const std::vector<std::string>& of_ranks) {
        for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
            Unpacker unpacker(of_ranks[rank]);
            for (const auto [edge, apex] : asked_[rank])
                if (apex)
                    check_.set_apex(edge, unpacker.get<Point>());
                else
                    check_.set_area(edge, unpacker.get<double>());
        }
    }

private:
    std::span<const decoupling::EstimatedBorder> borders_;
    mesh::PiecewiseCheck& check_;
    std::vector<std::vector<std::size_t>> pieces_of_;  ///< per rank, in its order
    std::vector<PieceNumbers> numbers_;                ///< per piece
    std::vector<std::uint32_t> rank_of_;               ///< per piece
    std::vector<std::size_t> first_edge_;              ///< per piece: of its border, in the numbers of the check
    std::size_t next_edge_ = 0;
    std::vector<std::vector<Wanted>> asked_;  ///< per rank: what it was asked for

    void take_piece(std::size_t piece, ToldPiece told, PiecesSummary& summary) {
        std::vector<mesh::PieceBorderEdge>& border = told.facts.findings.border;
        for (const Segment& edge : border_chain(borders_[piece].border)) {
            const std::size_t i = border.size();
            border.push_back({edge.a, edge.b, mesh::unknown_apex,
                              i < told.shape_classes.size() ? told.shape_classes[i] : std::uint8_t{0}});
        }
        first_edge_.push_back(next_edge_);
        next_edge_ += border.size();
        for (const std::vector<VertexId>& loop : borders_[piece].border.loops)
            told.facts.findings.border_vertices.insert(told.facts.findings.border_vertices.end(), loop.begin(),
                                                       loop.end());
        add_piece(std::move(told.facts), summary, check_);
    }
};

std::vector<std::uint8_t> classes_of(const SharedDecoupling& shared, std::size_t piece, std::span<const Point> apexes) {
    const std::vector<Point>& points = shared.decoupling.points;
    const std::vector<Segment> chain = border_chain(shared.borders[piece].border);
    std::vector<std::uint8_t> classes;
    for (std::size_t i = 0; i < chain.size(); ++i)
        classes.push_back(mesh::shape_class_behind(points[chain[i].a.index()], points[chain[i].b.index()], apexes[i]));
    return classes;
}

}  // namespace

SharedDecoupling::SharedDecoupling(decoupling::CutRegion cut, const SizeField& of_region, const RefineOptions& options)
    : borders(std::move(cut.borders)), size(of_region), refine(options) {
    decoupling.points = std::move(cut.points);
    decoupling.far_field = std::move(cut.far_field);
    decoupling.separator_vertices = cut.separator_vertices;
    decoupling.subdomains.resize(borders.size());
    for (std::size_t i = 0; i < borders.size(); ++i)
        decoupling.subdomains[i].estimated_triangles = borders[i].estimate.triangles;
}

void SharedDecoupling::make_subdomain(std::size_t i) {
    decoupling.subdomains[i] = decoupling::make_subdomain(decoupling.points, borders[i], size, refine);
}

HeldPieces take_and_refine(SharedDecoupling& shared, std::span<const std::size_t> order, double min_angle_deg,
                           core::BusyTimes& times, PieceWork work, Ranks& ranks, PieceStore& store) {
    HeldPieces held;
    std::mutex mutex;
    std::atomic<bool> failed = false;
    const auto make_piece = [&](std::size_t number) {
        shared.make_subdomain(number);
        const Subdomain& subdomain = shared.decoupling.subdomains[number];
        CheckedPiece made = refine_and_check_piece(shared.decoupling, number, min_angle_deg, times, work);
        mesh::PieceFindings& findings = made.facts.findings;
        std::vector<Point> apexes = apexes_of(subdomain, findings);
        std::vector<std::uint8_t> classes = classes_of(shared, number, apexes);
        findings.border = {};
        findings.border_vertices = {};
        mesh::QualityCollector totals(min_angle_deg);
        totals.append(findings.cells.isotropic.totals());
        const mesh::QualityCollector shapes = std::exchange(findings.cells.isotropic, std::move(totals));
        const mesh::HashOfParts hash = hash_of_piece(subdomain, made.refinement);
        store.put(number, std::move(made.refinement));
        const std::lock_guard lock(mutex);
        held.hash.add(hash);
        held.area_ratios.append_area_ratios(shapes.area_ratios());
        held.pieces.push_back({number, std::move(made.facts), std::move(apexes), std::move(classes)});
    };
    core::parallel_for(thread_count(), 1, [&](std::size_t, std::size_t) {
        try {
            for (std::uint64_t place; !failed && (place = ranks.next_number()) < order.size();)
                make_piece(order[place]);
        } catch (...) {
            failed = true;
            throw;
        }
    });
    std::sort(held.pieces.begin(), held.pieces.end(),
              [](const HeldPiece& a, const HeldPiece& b) { return a.piece < b.piece; });
    return held;
}

CountedMesh count_and_check(const SharedDecoupling& shared, HeldPieces& held, const LayerCells& layer,
                            double min_angle_deg, Ranks& ranks, mesh::PiecewiseCheck* check) {
    const std::vector<std::string> records = ranks.gather(pack_held(held));
    for (HeldPiece& piece : held.pieces) piece.facts = PieceFacts();
    CountedMesh of_mesh;
    std::optional<Assembly> assembly;
    std::vector<std::string> to_ranks;
    if (check) {
        assembly.emplace(shared.borders, *check);
        of_mesh.layer_pieces = layer.pieces();
        of_mesh.counts = {shared.decoupling.points.size(), layer.triangles.size(), layer.quads.size(),
                          layer.triangles.size()};
        assembly->count(records, min_angle_deg, of_mesh);
        to_ranks = assembly->answers(of_mesh);
    }
    const std::string answer = ranks.scatter(to_ranks);
    Unpacker unpacker(answer);
    CountedMesh counted;
    counted.counts = unpacker.get<MeshCounts>();
    counted.layer_pieces = unpacker.get_short();
    counted.numbers = unpacker.get_all<PieceNumbers>();
    const std::vector<std::string> told = ranks.gather(pack_answers(shared, held, unpacker));
    if (!check) return counted;
    assembly->take_answers(told);
    of_mesh.numbers = std::move(counted.numbers);
    return of_mesh;
}

}  // namespace lamina::pipeline
