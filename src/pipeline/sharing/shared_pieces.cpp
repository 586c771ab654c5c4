// Processes take pieces. At the end rank 0 adds up what they tell of them (piece_records.hpp), and all of them match
// their borders (shared_seams.hpp).
#include "pipeline/sharing/shared_pieces.hpp"

#include <algorithm>
#include <atomic>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "pipeline/sharing/border_chain.hpp"
#include "pipeline/sharing/parts.hpp"
#include "pipeline/sharing/piece_numbers.hpp"
#include "pipeline/sharing/piece_records.hpp"
#include "pipeline/sharing/shared_seams.hpp"

namespace lamina::pipeline {

namespace {

using core::Packer;
using core::Unpacker;

/// Returns what the others need to know of the border of a piece.
HeldPiece describe_border(std::size_t number, const decoupling::Subdomain& subdomain, std::span<const Segment> chain,
                          std::span<const Point> points, mesh::PieceFindings& findings) {
    HeldPiece held;
    held.piece = number;
    held.apexes = apexes_of(subdomain, findings);
    held.shape_classes.reserve(chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const Point a = points[chain[i].a.index()], b = points[chain[i].b.index()];
        held.shape_classes.push_back(mesh::shape_class_behind(a, b, held.apexes[i]));
        held.places += hash_of_places(chain[i], points);
    }
    return held;
}

std::string pack_ratios(const mesh::QualityCollector& ratios) {
    Packer packer;
    packer.put_counts(ratios.area_ratios());
    return packer.take();
}

std::string join_ratios(std::string_view one, std::string_view other) {
    mesh::QualityCollector ratios(0);
    for (const std::string_view told : {one, other}) ratios.append_area_ratios(Unpacker(told).get_counts());
    return pack_ratios(ratios);
}

/// Adds all pieces to the check, and returns what is known of them. Called on rank 0 with what all ranks have joined.
AllPieces count_all(const SharedSeams& seams, double min_angle_deg, const std::string& pieces,
                    mesh::PiecewiseCheck& check) {
    AllPieces all = add_up(pieces, min_angle_deg);
    all.findings.border = seams.along_layer();
    all.findings.border_vertices = seams.vertices_in_layer();
    check.add_piece(std::move(all.findings));
    return all;
}

/// Throws MeshError where the edges of two sides do not lie at the same places on both of them.
void require_same_places(SharedDecoupling& shared, const SharedFindings& found) {
    // Where edges of the far field are missing, the check tells so.
    if (found.seams.outer_edges != shared.cut.far_field.size()) return;
    shared.place(found.seams.one_sided);
    if (found.places != shared.outer_places + sum_of_places(found.seams.one_sided, shared.points()))
        throw MeshError(
            "processes have divided a line between pieces in different ways: all must run the same program on "
            "the same kind of machine");
}

}  // namespace

SharedDecoupling::SharedDecoupling(decoupling::CutRegion cut_region, const SizeField& of_region,
                                   const RefineOptions& options)
    : cut(std::move(cut_region)), size(of_region), refine(options) {
    cut.lines.gather_points();
}

void SharedDecoupling::place(std::size_t begin, std::size_t end) {
    cut.lines.divide_between(VertexId{begin}, VertexId{end}, size);
}

void SharedDecoupling::place(std::span<const Segment> edges) {
    for (const Segment& edge : edges)
        for (const VertexId end : {edge.a, edge.b}) place(end.index(), end.index() + 1);
}

void PieceMaker::make(std::size_t number, decoupling::Subdomain subdomain, std::span<const Segment> chain,
                      std::span<const Point> points, core::BusyTimes& times) {
    CheckedPiece made = refine_and_check_piece(subdomain, points, rules_, times);
    mesh::PieceFindings& findings = made.facts.findings;
    HeldPiece piece = describe_border(number, subdomain, chain, points, findings);
    findings.border = {};
    findings.border_vertices = {};
    mesh::QualityCollector totals(rules_.min_angle_deg);
    totals.append(findings.cells.isotropic.totals());
    const mesh::QualityCollector shapes = std::exchange(findings.cells.isotropic, std::move(totals));
    const mesh::HashOfParts hash = hash_of_piece(subdomain, made.refinement);
    piece.place = store_->put(std::move(subdomain), std::move(made.refinement));
    piece.facts = std::move(made.facts);
    const std::lock_guard lock(mutex_);
    held_.hash.add(hash);
    held_.area_ratios.append_area_ratios(shapes.area_ratios());
    held_.pieces.push_back(std::move(piece));
}

std::unordered_set<std::size_t> PieceMaker::number_trapezoids(std::span<const decoupling::EstimatedBorder> borders,
                                                              unsigned process) {
    std::unordered_set<std::size_t> made;
    if (held_.pieces.empty()) return made;
    std::unordered_map<std::size_t, std::size_t> numbers;
    for (std::size_t i = 0; i < borders.size(); ++i)
        if (borders[i].kept && borders[i].process == process) numbers.emplace(borders[i].trapezoid, i);
    for (HeldPiece& piece : held_.pieces) {
        piece.piece = numbers.at(piece.piece);
        made.insert(piece.piece);
    }
    return made;
}

std::unique_ptr<SharedDecoupling> cut_and_deal(const decoupling::OuterRegion& region, const RefineOptions& refine,
                                               PieceMaker& maker, core::ConnectedRanks& ranks,
                                               const std::function<void()>& before_pieces) {
    core::BusyTimes times;  // these pieces count as a part of the decoupling
    const auto once_numbered = [&] {
        ranks.reset_counter();
        before_pieces();
    };
    const auto make = [&](std::uint32_t trapezoid, const decoupling::LineBorder& border,
                          const decoupling::WorkEstimate& estimate, decoupling::Lines& lines) {
        decoupling::Subdomain subdomain = decoupling::make_subdomain(border, &estimate, lines, region.size, refine);
        maker.make(trapezoid, std::move(subdomain), border_chain(border, lines).edges, lines.gathered(), times);
    };
    auto shared = std::make_unique<SharedDecoupling>(decoupling::cut_region(region, &ranks, {once_numbered, make}),
                                                     region.size, refine);
    const std::unordered_set<std::size_t> made = maker.number_trapezoids(shared->cut.borders, ranks.rank());
    shared->deal = deal_pieces(shared->cut.borders, ranks.rank(), ranks.size());
    std::erase_if(shared->deal.own, [&](std::size_t piece) { return made.count(piece) != 0; });
    return shared;
}

HeldPieces take_and_refine(SharedDecoupling& shared, PieceMaker& maker, core::BusyTimes& times,
                           core::ConnectedRanks& ranks) {
    const PieceDeal& deal = shared.deal;
    decoupling::CutRegion& cut = shared.cut;
    std::atomic<bool> failed = false;
    std::atomic<std::size_t> next_own = 0;
    const auto make_piece = [&](std::size_t number) {
        decoupling::Subdomain subdomain = decoupling::make_subdomain(
            cut.border(number), cut.borders[number].estimate.get(), cut.lines, shared.size, shared.refine);
        maker.make(number, std::move(subdomain), shared.chain(number).edges, shared.points(), times);
    };
    core::parallel_for(thread_count(), 1, [&](std::size_t, std::size_t) {
        try {
            for (std::size_t place; !failed && (place = next_own++) < deal.own.size() && !ranks.has_failed();)
                make_piece(deal.own[place]);
            for (std::uint64_t place; !failed && (place = ranks.next_number()) < deal.shared.size();)
                make_piece(deal.shared[place]);
        } catch (...) {
            failed = true;
            throw;
        }
    });
    HeldPieces held = maker.take_held();
    std::sort(held.pieces.begin(), held.pieces.end(),
              [](const HeldPiece& a, const HeldPiece& b) { return a.piece < b.piece; });
    return held;
}

CountedMesh count_and_check(SharedDecoupling& shared, HeldPieces& held, const layers::LayerCells& layer,
                            double min_angle_deg, core::ConnectedRanks& ranks, mesh::PiecewiseCheck* check) {
    // Asked here and not after the cuts, so that nobody has waited for the others since then.
    decoupling::require_same_borders(shared.cut, ranks);
    SharedSeams seams(shared, held, ranks);
    seams.collect();
    NumberedPieces numbered = number_pieces(
        held, shared.pieces(),
        {shared.cut.lines.vertices(), layer.triangles.size(), layer.quads.size(), layer.triangles.size()}, ranks);
    const std::string least_ratios = ranks.reduce(pack_ratios(seams.least_ratios()), join_ratios);
    const std::string pieces = ranks.reduce(pack_pieces(held, numbered.numbers), join_records);
    for (HeldPiece& piece : held.pieces) piece.facts = PieceFacts();

    CountedMesh counted{.counts = numbered.counts, .numbers = std::move(numbered.numbers)};
    Packer to_all;
    if (check) {
        const AllPieces all = count_all(seams, min_angle_deg, pieces, *check);
        counted.summary = all.summary;
        counted.hash = all.hash;
        mesh::QualityCollector ratios = check->least_ratios();
        ratios.append_area_ratios(Unpacker(least_ratios).get_counts());
        to_all.put_short(layer.pieces());
        to_all.put(mesh::even_ratio(ratios));
    }
    const std::string answer = ranks.broadcast(to_all.take());
    Unpacker unpacker(answer);
    counted.layer_pieces = unpacker.get_short();
    const auto even_ratio = unpacker.get<double>();
    seams.ask(even_ratio, check);
    const std::string findings = ranks.reduce(pack_findings({seams.findings(), seams.places()}), join_findings);
    if (!check) return counted;
    const SharedFindings found = unpack_findings(findings);
    check->add_seams(found.seams);
    require_same_places(shared, found);
    return counted;
}

}  // namespace lamina::pipeline
