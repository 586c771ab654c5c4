// The pieces of a mesh that several processes make together (docs/decisions/0047).
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/ranks.hpp>

#include "decoupling/cut_region.hpp"
#include "mesh/hash.hpp"
#include "pipeline/checked_pieces.hpp"
#include "pipeline/piece_store.hpp"

namespace lamina::pipeline {

/// A decoupling of which all processes know the borders. Each makes those subdomains that it refines.
struct SharedDecoupling {
    Decoupling decoupling;  ///< the subdomains hold their estimates alone until they are made
    std::vector<decoupling::EstimatedBorder> borders;
    SizeField size;
    RefineOptions refine;

    SharedDecoupling(decoupling::CutRegion cut, const SizeField& size, const RefineOptions& refine);

    /// Makes a subdomain. May be called for several of them at the same time.
    void make_subdomain(std::size_t i);
};

/// A piece that this process has made, with what it leaves behind once it is stored.
struct HeldPiece {
    std::size_t piece = 0;
    PieceFacts facts;                         ///< without the border and without the histogram of area ratios
    std::vector<Point> apexes;                ///< behind the edges of border_chain()
    std::vector<std::uint8_t> shape_classes;  ///< of the triangles there
};

/// All pieces that this process has made.
struct HeldPieces {
    std::vector<HeldPiece> pieces;          ///< in ascending order
    mesh::QualityCollector area_ratios{0};  ///< the histogram of all of them
    mesh::HashOfParts hash;                 ///< of their triangles
};

/// Refines and checks the pieces that this process gets: whoever is free takes the next one of the order from a counter
/// that all share. Each piece goes to the store. Where a piece fails, all processes end soon.
HeldPieces take_and_refine(SharedDecoupling& shared, std::span<const std::size_t> order, double min_angle_deg,
                           core::BusyTimes& times, PieceWork work, Ranks& ranks, PieceStore& store);

/// Where the vertices and triangles of a piece begin in the mesh.
struct PieceNumbers {
    std::uint64_t first_vertex = 0, first_triangle = 0;
};

/// What the processes know of the whole mesh once they have counted it together.
struct CountedMesh {
    MeshCounts counts;
    std::size_t layer_pieces = 0;
    std::vector<PieceNumbers> numbers{};  ///< of the held pieces
    PiecesSummary summary{};              ///< on rank 0
    mesh::HashOfParts hash{};             ///< of all pieces; on rank 0
};

/// Collective: numbers all pieces in their order, behind the triangles of the layer, matches their borders, and adds
/// both to the check, whose pieces become one with the numbers of triangles that it has in the mesh. `check` is that of
/// rank 0, which has its layer; null elsewhere. Nor does the layer count elsewhere.
CountedMesh count_and_check(const SharedDecoupling& shared, HeldPieces& held, const LayerCells& layer,
                            double min_angle_deg, Ranks& ranks, mesh::PiecewiseCheck* check);

}  // namespace lamina::pipeline
