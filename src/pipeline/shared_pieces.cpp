// Processes take pieces. At the end rank 0 adds up what they tell of them (piece_records.hpp), and all of them match
// their borders (shared_seams.hpp).
#include "pipeline/shared_pieces.hpp"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

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
        AllPieces all = add_up(
            records, shared.borders.size(),
            {shared.decoupling.points.size(), layer.triangles.size(), layer.quads.size(), layer.triangles.size()},
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
    pack_findings(seams.findings(), findings);
    for (const std::string& of_rank : ranks.gather(findings.take())) {
        Unpacker told(of_rank);
        if (check) check->add_seams(unpack_findings(told));
    }
    return counted;
}

}  // namespace lamina::pipeline
