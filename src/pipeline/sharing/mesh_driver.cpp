#include "pipeline/sharing/mesh_driver.hpp"

#include <utility>

#include <lamina/error.hpp>

#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "decoupling/refine_all.hpp"
#include "layers/cells/fill.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/sharing/part_takers.hpp"
#include "pipeline/sharing/piece_streamer.hpp"
#include "pipeline/sharing/shared_seams.hpp"

namespace lamina::pipeline {

namespace {

PieceRules piece_rules(const RefineOptions& refine, double expected_triangles) {
    return {refine.min_angle_deg, expected_triangles, {refinement_work, check_work}};
}

/// Gives all processes this array of rank 0.
template <class Value>
void tell_all(core::ConnectedRanks& ranks, std::vector<Value>& values) {
    core::Packer packer;
    packer.put_all<Value>(values);
    const std::string packed = ranks.broadcast(packer.take());
    core::Unpacker unpacker(packed);
    values = unpacker.get_all<Value>();
}

}  // namespace

layers::LayerCells PiecesWork::fill_layer() const { return layers::fill(layer, topology, decomposition, &times); }

Mesh PiecesWork::check_layer(const layers::LayerCells& cells) const {
    Mesh mesh = layer_mesh(layer, cells);
    if (!mesh.triangles.empty() || !mesh.quads.empty()) check.add_layer(mesh, layer.edges.interfaces);
    return mesh;
}

DecoupledBorders LocalDriver::decouple(const decoupling::OuterRegion& region, const RefineOptions& refine,
                                       double expected_triangles) {
    rules_ = piece_rules(refine, expected_triangles);
    decoupling_ = decoupling::decouple(region, refine);
    return {decoupling_.points, decoupling_.far_field, decoupling_.inner_edges};
}

MadePieces LocalDriver::make_for(PartTaker& taker, bool with_hash, const PiecesWork& work) {
    MadePieces made;
    PieceStreamer streamer(decoupling_, taker, with_hash);
    const auto fill_layer = [&] {
        made.cells = work.fill_layer();
        streamer.start(made.cells);
    };
    const PieceKeeper keeper{.begin = [&](std::size_t piece) { streamer.begin(piece); },
                             .keep = [&](std::size_t piece, Refinement r) { streamer.take(piece, std::move(r)); },
                             .fail = [&] { streamer.fail(); }};
    const auto refine = [&] {
        made.summary = refine_and_check(decoupling_, streamer.order(), rules_, work.times, work.check, keeper);
    };
    // Each of the first cuts of the layer occupies one thread, so the others refine meanwhile if that is not in vain
    // (thesis 6.6).
    if (streamer.holds_all()) {
        core::parallel_invoke(fill_layer, refine);
    } else {
        fill_layer();
        refine();
    }
    streamer.finish(work.markers);
    made.first_triangle = streamer.take_first_triangles();
    made.counts = streamer.counts();
    made.hash = streamer.hash();
    made.layer = work.check_layer(made.cells);
    return made;
}

MadePieces KeepingDriver::make(const PiecesWork& work) {
    Mesh mesh;
    MeshTaker taker(decoupling_, mesh);
    MadePieces made = make_for(taker, false, work);
    made.mesh = std::move(mesh);
    return made;
}

MadePieces StreamingDriver::make(const PiecesWork& work) {
    std::unique_ptr<MeshSink> sink = open_sink_();
    SinkTaker taker(*sink);
    MadePieces made = make_for(taker, true, work);
    sink->finish(made.counts, work.markers, work.layer.edges.interfaces);
    made.sink = std::move(sink);
    return made;
}

void SharingDriver::lead(const std::function<void()>& work) {
    if (ranks_.rank() == 0) work();
}

DecoupledBorders SharingDriver::decouple(const decoupling::OuterRegion& region, const RefineOptions& refine,
                                         double expected_triangles) {
    validate(region.options);
    validate(refine);
    rules_ = piece_rules(refine, 0);
    // The others do not need what rank 0 expects before they wait for each other.
    const auto before_pieces = [&] {
        std::vector<double> expected{expected_triangles};
        tell_all(ranks_, expected);
        rules_.expected_triangles = expected.front();
    };
    shared_ = cut_and_deal(region, refine, maker_.emplace(rules_, beside_), ranks_, before_pieces);
    return {shared_->points(), shared_->cut.far_field, {}};
}

MadePieces SharingDriver::make(const PiecesWork& work) {
    MadePieces made;
    HeldPieces held;
    mesh::HashOfParts hash;
    // All that rank 0 can do before the pieces are made keeps the others from waiting for it once they are. It makes
    // fewer pieces meanwhile.
    const auto fill_layer = [&] {
        shared_->place(shared_->cut.far_field);
        shared_->outer_places = sum_of_places(shared_->cut.far_field, shared_->points());
        made.cells = work.fill_layer();
        made.layer = work.check_layer(made.cells);
        work.check.expect_boundary(work.markers, shared_->cut.far_field);
        hash.add(shared_->points(), std::span<const Triangle>(made.cells.triangles));
        hash.add(shared_->points(), std::span<const Quad>(made.cells.quads));
        hash.add(shared_->points(), work.markers);
    };
    core::parallel_invoke([&] { lead(fill_layer); },
                          [&] { held = take_and_refine(*shared_, *maker_, work.times, ranks_); });
    work.clock.begin("numbering");
    CountedMesh counted = count_and_check(*shared_, held, made.cells, rules_.min_angle_deg, ranks_,
                                          ranks_.rank() == 0 ? &work.check : nullptr);
    held_ = {maker_->take_store(), {}, {}, std::move(counted.numbers), counted.layer_pieces};
    for (const HeldPiece& piece : held.pieces) {
        held_.pieces.push_back(piece.piece);
        held_.places.push_back(piece.place);
    }
    made.summary = counted.summary;
    made.first_triangle = {0};
    made.counts = counted.counts;
    lead([&] {
        hash.add(counted.hash);
        made.hash = hash.text();
    });
    return made;
}

void SharingDriver::tell_narrow(std::vector<mesh::NarrowTriangle>& narrow) { tell_all(ranks_, narrow); }

void SharingDriver::keep_parts(MadePieces& pieces) {
    pieces.parts = std::make_unique<HeldParts>(std::move(shared_), std::move(pieces.cells), std::move(held_),
                                               pieces.counts, ranks_);
}

void SharingDriver::fail(const Error& error) {
    try {
        ranks_.fail(error.exit_code(), error.what());
    } catch (const RankFailure&) {
        // All of them know it now.
    }
}

}  // namespace lamina::pipeline
