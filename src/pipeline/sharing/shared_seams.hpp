// The borders between pieces that several processes have made: each process matches some of the edges, and nobody all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/connected_ranks.hpp"
#include "core/packing.hpp"
#include "mesh/seams.hpp"
#include "pipeline/sharing/seam_owners.hpp"
#include "pipeline/sharing/shared_pieces.hpp"

namespace lamina::pipeline {

/// Returns a hash of the ids and places of the ends of an edge. That of the opposite edge is its negative, so that the
/// sum over all borders is the sum over the edges of one side: the others have the same places on both sides, whoever
/// has divided their lines.
std::uint64_t hash_of_places(Segment edge, std::span<const Point> points);
/// Returns the sum of these hashes.
std::uint64_t sum_of_places(std::span<const Segment> edges, std::span<const Point> points);

/// The edges that this process matches, on all ranks from one call to the next:
/// collect(), then ask() with a ratio that rank 0 knows, then findings().
class SharedSeams {
public:
    SharedSeams(SharedDecoupling& shared, const HeldPieces& held, core::ConnectedRanks& ranks);

    /// Collective: gives all border edges of the held pieces to those who match them, and pairs those of this process.
    void collect();
    /// Returns the edges along the border of the layer, which are for the check of rank 0 to match, with the vertices
    /// of pieces in the layer.
    const std::vector<mesh::PieceBorderEdge>& along_layer() const { return along_layer_; }
    const std::vector<VertexId>& vertices_in_layer() const { return vertices_in_layer_; }
    /// Returns the least ratios of areas that are possible.
    mesh::QualityCollector least_ratios() const;
    /// Collective: learns from those who hold the pieces what lies behind edges, where ratios of areas up to this one
    /// need not be known. `check` is that of rank 0, which asks for edges along the layer; null elsewhere.
    void ask(double even_ratio, mesh::PiecewiseCheck* check);
    /// Returns what this process has found out.
    mesh::SeamFindings findings() const;
    /// Returns the sum of hash_of_places() over the borders of the held pieces, without the edges along the layer that
    /// this process has been told of.
    std::uint64_t places() const;

private:
    /// The process and the piece that an edge comes from, and the number of the edge there.
    struct Source {
        std::uint32_t rank = 0, piece = 0, edge = 0;  ///< the edge is numbered in border_chain()
        bool outer = false;                           ///< whether it is expected to be on the boundary
    };
    std::vector<std::string> pack_borders() const;
    const HeldPiece& held(std::size_t piece) const;
    void take_vertices(VertexId first, std::size_t n);
    void take_borders(std::uint32_t rank, const std::string& told);
    std::string answer(const std::string& questions) const;
    bool has_source_here(std::size_t edge) const;

    SharedDecoupling& shared_;
    const HeldPieces& held_;
    core::ConnectedRanks& ranks_;
    SeamOwners owners_;
    std::vector<mesh::PieceBorderEdge> along_layer_;
    std::vector<Source> sources_along_layer_, sources_;  ///< the latter of the edges of seams_
    std::vector<VertexId> vertices_in_layer_;
    std::vector<std::uint8_t> used_;  ///< per vertex of this process beyond the layer
    std::vector<bool> is_far_field_;  ///< per line
    mesh::Seams seams_;
};

/// SharedFindings hold what processes have found out about seams, with the sum of SharedSeams::places().
struct SharedFindings {
    mesh::SeamFindings seams;
    std::uint64_t places = 0;
};
std::string pack_findings(const SharedFindings& findings);
SharedFindings unpack_findings(std::string_view bytes);
/// Returns the findings of both.
std::string join_findings(std::string_view one, std::string_view other);

}  // namespace lamina::pipeline
