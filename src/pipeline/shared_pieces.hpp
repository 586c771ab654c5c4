// The pieces of a mesh that several processes make together (docs/decisions/0047).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/ranks.hpp>

#include "decoupling/cut_region.hpp"
#include "mesh/hash.hpp"
#include "pipeline/border_chain.hpp"
#include "pipeline/checked_pieces.hpp"
#include "pipeline/piece_deal.hpp"
#include "pipeline/piece_store.hpp"

namespace lamina::pipeline {

/// A decoupling of which all processes know the borders. Each makes those subdomains that it refines.
struct SharedDecoupling {
    decoupling::CutRegion cut;
    SizeField size;
    SeparatorRule rule;
    RefineOptions refine;
    std::vector<std::unique_ptr<Subdomain>> subdomains;  ///< null until they are made
    PieceDeal deal{};
    std::uint64_t outer_places = 0;  ///< on rank 0: sum of hash_of_places() over the far field

    SharedDecoupling(decoupling::CutRegion cut, const SizeField& size, SeparatorRule rule, const RefineOptions& refine);

    std::size_t pieces() const { return cut.borders.size(); }
    /// Returns the number of vertices that no line of the decoupling has added.
    std::size_t layer_vertices() const { return cut.lines.vertices() - cut.separator_vertices; }
    /// Returns an array of the vertices of the decoupling by their ids. Only those of the layer, of subdomains that were
    /// made and of lines that were divided have their places in it.
    std::span<const Point> points() const { return cut.lines.gathered(); }
    /// Returns the border_chain() of a piece.
    BorderChain chain(std::size_t piece) const { return border_chain(cut.border(piece), cut.lines); }
    /// Divides the lines that these vertices are on, so that they have their places.
    void place(std::size_t begin, std::size_t end);
    /// Does so with the ends of these edges.
    void place(std::span<const Segment> edges);
    /// Makes a subdomain. May be called for several of them at the same time.
    const Subdomain& make_subdomain(std::size_t i);
};

/// A piece that this process has made, with what it leaves behind once it is stored.
struct HeldPiece {
    std::size_t piece = 0;
    PieceFacts facts;                         ///< without the border and without the histogram of area ratios
    std::vector<Point> apexes;                ///< behind the edges of border_chain()
    std::vector<std::uint8_t> shape_classes;  ///< of the triangles there
    std::uint64_t places = 0;                 ///< sum of hash_of_places() over these edges
};

/// All pieces that this process has made.
struct HeldPieces {
    std::vector<HeldPiece> pieces;          ///< in ascending order
    mesh::QualityCollector area_ratios{0};  ///< the histogram of all of them
    mesh::HashOfParts hash;                 ///< of their triangles
};

/// Refines and checks the pieces that this process gets: its own ones, then those that whoever is free takes from a
/// counter that all share. Each piece goes to the store. Where a piece fails, all processes end soon.
HeldPieces take_and_refine(SharedDecoupling& shared, double min_angle_deg, core::BusyTimes& times, PieceWork work,
                           Ranks& ranks, PieceStore& store);

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
CountedMesh count_and_check(SharedDecoupling& shared, HeldPieces& held, const LayerCells& layer, double min_angle_deg,
                            Ranks& ranks, mesh::PiecewiseCheck* check);

}  // namespace lamina::pipeline
