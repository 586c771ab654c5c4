// Processes take pieces. At the end rank 0 adds up what they tell of them (piece_records.hpp), and all of them match
// their borders (shared_seams.hpp).
#include "pipeline/shared_pieces.hpp"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "pipeline/border_chain.hpp"
#include "pipeline/parts.hpp"
#include "pipeline/piece_records.hpp"
#include "pipeline/shared_seams.hpp"

namespace lamina::pipeline {

namespace {

using core::Packer;
using core::Unpacker;

/// Returns what the others need to know of the border of a piece.
HeldPiece describe_border(const SharedDecoupling& shared, std::size_t number, mesh::PieceFindings& findings) {
    HeldPiece held;
    held.piece = number;
    held.apexes = apexes_of(*shared.subdomains[number], findings);
    const std::span<const Point> points = shared.points();
    const std::vector<Segment> chain = shared.chain(number).edges;
    held.shape_classes.reserve(chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const Point a = points[chain[i].a.index()], b = points[chain[i].b.index()];
        held.shape_classes.push_back(mesh::shape_class_behind(a, b, held.apexes[i]));
        held.places += hash_of_places(chain[i], points);
    }
    return held;
}

/// Throws MeshError where the edges of two sides do not lie at the same places on both of them.
void require_same_places(SharedDecoupling& shared, std::uint64_t places, std::span<const Segment> one_sided) {
    shared.place(one_sided);
    for (const Segment& edge : one_sided) places -= hash_of_places(edge, shared.points());
    if (places != 0)
        throw MeshError(
            "processes have divided a line between pieces in different ways: all must run the same program on "
            "the same kind of machine");
}

}  // namespace

SharedDecoupling::SharedDecoupling(decoupling::CutRegion cut_region, const SizeField& of_region,
                                   SeparatorRule of_separators, const RefineOptions& options)
    : cut(std::move(cut_region)),
      size(of_region),
      rule(of_separators),
      refine(options),
      subdomains(cut.borders.size()) {
    cut.lines.gather_points();
}

void SharedDecoupling::place(std::size_t begin, std::size_t end) {
    cut.lines.divide_between(VertexId{begin}, VertexId{end}, {size, rule});
}

void SharedDecoupling::place(std::span<const Segment> edges) {
    for (const Segment& edge : edges)
        for (const VertexId end : {edge.a, edge.b}) place(end.index(), end.index() + 1);
}

const Subdomain& SharedDecoupling::make_subdomain(std::size_t i) {
    subdomains[i] = std::make_unique<Subdomain>(decoupling::make_subdomain(cut, i, {size, rule}, refine));
    return *subdomains[i];
}

HeldPieces take_and_refine(SharedDecoupling& shared, double min_angle_deg, core::BusyTimes& times, PieceWork work,
                           Ranks& ranks, PieceStore& store) {
    HeldPieces held;
    const PieceDeal& deal = shared.deal;
    std::mutex mutex;
    std::atomic<bool> failed = false;
    std::atomic<std::size_t> next_own = 0;
    const auto make_piece = [&](std::size_t number) {
        const Subdomain& subdomain = shared.make_subdomain(number);
        CheckedPiece made =
            refine_and_check_piece(subdomain, shared.points(), shared.pieces(), min_angle_deg, times, work);
        mesh::PieceFindings& findings = made.facts.findings;
        HeldPiece piece = describe_border(shared, number, findings);
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
        piece.facts = std::move(made.facts);
        held.pieces.push_back(std::move(piece));
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
    std::sort(held.pieces.begin(), held.pieces.end(),
              [](const HeldPiece& a, const HeldPiece& b) { return a.piece < b.piece; });
    return held;
}

CountedMesh count_and_check(SharedDecoupling& shared, HeldPieces& held, const LayerCells& layer, double min_angle_deg,
                            Ranks& ranks, mesh::PiecewiseCheck* check) {
    SharedSeams seams(shared, held, ranks);
    seams.collect();
    Packer record;
    record.put_counts(seams.least_ratios());
    const std::vector<std::string> least_ratios = ranks.gather(record.take());
    const std::vector<std::string> records = ranks.gather(pack_pieces(held));
    for (HeldPiece& piece : held.pieces) piece.facts = PieceFacts();

    CountedMesh of_mesh;
    std::vector<std::string> to_ranks;
    if (check) {
        AllPieces all =
            add_up(records, shared.pieces(),
                   {shared.cut.lines.vertices(), layer.triangles.size(), layer.quads.size(), layer.triangles.size()},
                   min_angle_deg);
        of_mesh = {.counts = all.counts, .layer_pieces = layer.pieces(), .summary = all.summary, .hash = all.hash};
        all.findings.border = seams.along_layer();
        all.findings.border_vertices = seams.vertices_in_layer();
        check->match_elsewhere(seams.first_elsewhere());
        check->add_piece(std::move(all.findings));
        mesh::QualityCollector ratios = check->least_ratios();
        for (const std::string& of_rank : least_ratios) ratios.append_area_ratios(Unpacker(of_rank).get_counts());
        for (const std::vector<PieceNumbers>& numbers : all.numbers_of) {
            Packer packer;
            packer.put(of_mesh.counts);
            packer.put_short(of_mesh.layer_pieces);
            packer.put(mesh::even_ratio(ratios));
            packer.put_all<PieceNumbers>(numbers);
            to_ranks.push_back(packer.take());
        }
    }
    const std::string answer = ranks.scatter(to_ranks);
    Unpacker unpacker(answer);
    CountedMesh counted = std::move(of_mesh);
    counted.counts = unpacker.get<MeshCounts>();
    counted.layer_pieces = unpacker.get_short();
    const auto even_ratio = unpacker.get<double>();
    counted.numbers = unpacker.get_all<PieceNumbers>();
    seams.ask(even_ratio, check);
    Packer findings;
    findings.put(seams.places());
    pack_findings(seams.findings(), findings);
    const std::vector<std::string> of_ranks = ranks.gather(findings.take());
    if (!check) return counted;
    std::uint64_t places = 0;
    std::vector<Segment> one_sided;
    for (const std::string& of_rank : of_ranks) {
        Unpacker told(of_rank);
        places += told.get<std::uint64_t>();
        const mesh::SeamFindings found = unpack_findings(told);
        one_sided.insert(one_sided.end(), found.one_sided.begin(), found.one_sided.end());
        check->add_seams(found);
    }
    require_same_places(shared, places, one_sided);
    return counted;
}

}  // namespace lamina::pipeline
