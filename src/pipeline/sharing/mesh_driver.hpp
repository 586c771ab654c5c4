// Three ways to make the pieces of a mesh: keep them, stream them to a sink, or share them among processes. The stages
// of the pipeline call a driver, and do not ask which.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/stream.hpp>

#include "core/busy_times.hpp"
#include "core/connected_ranks.hpp"
#include "core/limits.hpp"
#include "decoupling/cut_region.hpp"
#include "layers/layer.hpp"
#include "mesh/piecewise_check.hpp"
#include "mesh/shared_parts.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/sharing/checked_pieces.hpp"
#include "pipeline/sharing/held_parts.hpp"
#include "pipeline/sharing/part_takers.hpp"
#include "pipeline/sharing/shared_pieces.hpp"
#include "pipeline/stage_clock.hpp"

namespace lamina::pipeline {

/// The vertices of the decoupling by their ids, and the edges of the far field.
struct DecoupledBorders {
    std::span<const Point> points;
    std::span<const Segment> far_field;
    std::span<const std::vector<Segment>> inner_edges;  ///< as in decoupling::Decoupling
};

/// What the pieces of a mesh are made of, and where their check and their times go.
struct PiecesWork {
    const layers::Layer& layer;
    LayerTopology topology;
    const DecompositionOptions& decomposition;
    std::span<const Marker> markers;
    mesh::PiecewiseCheck& check;
    core::BusyTimes& times;
    StageClock& clock;

    layers::LayerCells fill_layer() const;
    /// Makes the cells of the layer a part of the check. Returns them as a mesh.
    Mesh check_layer(const layers::LayerCells& cells) const;
};

/// All pieces of a mesh, and where its cells are: in the mesh, which has neither markers nor constraints, in a sink, or
/// in parts with the processes.
struct MadePieces {
    layers::LayerCells cells{};
    Mesh layer{};  ///< the cells as a mesh, which are part of the check
    PiecesSummary summary{};
    std::vector<std::size_t> first_triangle{};  ///< of the subdomains in the mesh
    MeshCounts counts{};
    std::string hash{};  ///< of the mesh, as mesh_hash() returns it, where it is not kept
    Mesh mesh{};
    std::unique_ptr<MeshSink> sink{};
    std::shared_ptr<const mesh::MeshParts> parts{};
};

class MeshDriver {
public:
    MeshDriver() = default;
    MeshDriver(const MeshDriver&) = delete;
    MeshDriver& operator=(const MeshDriver&) = delete;
    virtual ~MeshDriver() = default;

    /// Returns what a triangle costs.
    virtual WorkCost cost() const = 0;
    /// Does what one process does for all: estimates the run, completes the check, finds warnings.
    virtual void lead(const std::function<void()>& work) { work(); }
    /// Cuts the region beyond the layer into subdomains. `expected_triangles` is what the one that leads expects in all
    /// of them together. The result is valid until the next call.
    virtual DecoupledBorders decouple(const decoupling::OuterRegion& region, const RefineOptions& refine,
                                      double expected_triangles) = 0;
    /// Gives the vertices of the far field their places among those of decouple(), if they have none yet.
    virtual void place_far_field() {}
    /// Returns the first vertex that a separator has, if processes match the borders of pieces there themselves: that
    /// behind those of the region.
    virtual std::optional<VertexId> matched_elsewhere(std::size_t /*region_points*/) const { return {}; }
    /// Makes all pieces, and adds them and the layer to the check of the one that leads.
    virtual MadePieces make(const PiecesWork& work) = 0;
    /// Makes the narrow triangles that the one that leads has found known to all.
    virtual void tell_narrow(std::vector<mesh::NarrowTriangle>& /*narrow*/) {}
    /// Hands the pieces over where they stay with processes. Called once they are checked.
    virtual void keep_parts(MadePieces& /*pieces*/) {}
    /// Tells all other processes that this one has failed.
    virtual void fail(const Error& /*error*/) {}
};

/// Makes all pieces in this process.
class LocalDriver : public MeshDriver {
public:
    DecoupledBorders decouple(const decoupling::OuterRegion& region, const RefineOptions& refine,
                              double expected_triangles) override;

protected:
    /// Makes all pieces and hands them to the taker in the order of their numbers.
    MadePieces make_for(PartTaker& taker, bool with_hash, const PiecesWork& work);

    decoupling::Decoupling decoupling_;
    PieceRules rules_;
};

/// Keeps the pieces as one mesh.
class KeepingDriver final : public LocalDriver {
public:
    WorkCost cost() const override { return core::mesh_cost; }
    MadePieces make(const PiecesWork& work) override;
};

/// Hands the pieces to a sink, which it opens anew for each mesh.
class StreamingDriver final : public LocalDriver {
public:
    /// The function must outlive this object.
    explicit StreamingDriver(const OpenSink& open_sink) : open_sink_(open_sink) {}
    WorkCost cost() const override { return stream_cost; }
    MadePieces make(const PiecesWork& work) override;

private:
    const OpenSink& open_sink_;
};

/// Makes the pieces together with other processes; each keeps its own. Rank 0 leads, and has the layer.
class SharingDriver final : public MeshDriver {
public:
    /// Pieces are kept in memory, or on the disk of the file `beside`. The ranks must outlive this object.
    SharingDriver(core::ConnectedRanks& ranks, std::optional<std::filesystem::path> beside)
        : ranks_(ranks), beside_(std::move(beside)) {}

    WorkCost cost() const override { return shared_cost(ranks_.size(), !beside_); }
    void lead(const std::function<void()>& work) override;
    DecoupledBorders decouple(const decoupling::OuterRegion& region, const RefineOptions& refine,
                              double expected_triangles) override;
    void place_far_field() override { shared_->place(shared_->cut.far_field); }
    std::optional<VertexId> matched_elsewhere(std::size_t region_points) const override {
        return VertexId{region_points};
    }
    MadePieces make(const PiecesWork& work) override;
    void tell_narrow(std::vector<mesh::NarrowTriangle>& narrow) override;
    void keep_parts(MadePieces& pieces) override;
    void fail(const Error& error) override;

private:
    core::ConnectedRanks& ranks_;
    const std::optional<std::filesystem::path> beside_;
    PieceRules rules_;
    std::optional<PieceMaker> maker_;
    std::unique_ptr<SharedDecoupling> shared_;
    HeldNumbers held_;
};

}  // namespace lamina::pipeline
