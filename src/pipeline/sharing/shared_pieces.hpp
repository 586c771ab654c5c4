// The pieces of a mesh that several processes make together (docs/decisions/0045).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include <lamina/mesh_sink.hpp>

#include "core/connected_ranks.hpp"
#include "decoupling/cut_region.hpp"
#include "layers/layer.hpp"
#include "mesh/hash.hpp"
#include "pipeline/sharing/border_chain.hpp"
#include "pipeline/sharing/checked_pieces.hpp"
#include "pipeline/sharing/piece_deal.hpp"
#include "pipeline/sharing/piece_store.hpp"

namespace lamina::pipeline {

/// A decoupling of which all processes know the borders.
struct SharedDecoupling {
    decoupling::CutRegion cut;
    SizeField size;
    RefineOptions refine;
    PieceDeal deal{};
    std::uint64_t outer_places = 0;  ///< on rank 0: sum of hash_of_places() over the far field

    SharedDecoupling(decoupling::CutRegion cut, const SizeField& size, const RefineOptions& refine);

    std::size_t pieces() const { return cut.borders.size(); }
    /// Returns the number of vertices that no line of the decoupling has added.
    std::size_t layer_vertices() const { return cut.lines.vertices() - cut.separator_vertices; }
    /// Returns an array of the vertices of the decoupling by their ids. Only those of the layer, of subdomains that
    /// were made and of lines that were divided have their places in it.
    std::span<const Point> points() const { return cut.lines.gathered(); }
    /// Returns the border_chain() of a piece.
    BorderChain chain(std::size_t piece) const { return border_chain(cut.border(piece), cut.lines); }
    /// Divides the lines that these vertices are on, so that they have their places.
    void place(std::size_t begin, std::size_t end);
    /// Does so with the ends of these edges.
    void place(std::span<const Segment> edges);
};

/// A piece that this process has made, with what it leaves behind once it is stored.
struct HeldPiece {
    std::size_t piece = 0;
    std::size_t place = 0;                    ///< in the store
    PieceFacts facts;                         ///< without the border and without the histogram of area ratios
    std::vector<Point> apexes;                ///< behind the edges of border_chain()
    std::vector<std::uint8_t> shape_classes;  ///< of the triangles there
    std::uint64_t places = 0;                 ///< sum of hash_of_places() over these edges
};

/// All pieces that this process has made.
struct HeldPieces {
    std::vector<HeldPiece> pieces;          ///< in ascending order, once take_and_refine() has ended
    mesh::QualityCollector area_ratios{0};  ///< the histogram of all of them
    mesh::HashOfParts hash;                 ///< of their triangles
};

/// Makes the pieces of a process. Several threads may do so at the same time.
class PieceMaker {
public:
    /// Throws IoError about the file beside which pieces are stored. The rules must outlive this object.
    PieceMaker(const PieceRules& rules, const std::optional<std::filesystem::path>& beside)
        : rules_(rules), store_(std::make_unique<PieceStore>(beside)) {}

    /// Refines and checks a piece, whose border_chain() has these edges, and stores it. `points` holds their ends.
    void make(std::size_t piece, decoupling::Subdomain subdomain, std::span<const Segment> chain,
              std::span<const Point> points, core::BusyTimes& times);
    /// Gives the pieces so far, which are those of trapezoids by their numbers, the numbers that they have among these.
    /// Returns the latter.
    std::unordered_set<std::size_t> number_trapezoids(std::span<const decoupling::EstimatedBorder> borders,
                                                      unsigned process);
    /// Return all that was made.
    HeldPieces take_held() { return std::move(held_); }
    std::unique_ptr<PieceStore> take_store() { return std::move(store_); }

private:
    const PieceRules& rules_;
    std::unique_ptr<PieceStore> store_;
    std::mutex mutex_;
    HeldPieces held_;
};

/// Collective: sets the counter for pieces that all share to 0, cuts the region and deals its pieces. The processes
/// divide the work among themselves, and make pieces while they would wait for each other. They call `before_pieces`
/// once they have waited for each other, and before they make any.
std::unique_ptr<SharedDecoupling> cut_and_deal(const decoupling::OuterRegion& region, const RefineOptions& refine,
                                               PieceMaker& maker, core::ConnectedRanks& ranks,
                                               const std::function<void()>& before_pieces);

/// Makes the pieces that this process gets: its own ones, then those that whoever is free takes from a counter that all
/// share. Where a piece fails, all processes end soon. Returns all pieces of the maker.
HeldPieces take_and_refine(SharedDecoupling& shared, PieceMaker& maker, core::BusyTimes& times,
                           core::ConnectedRanks& ranks);

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
CountedMesh count_and_check(SharedDecoupling& shared, HeldPieces& held, const layers::LayerCells& layer,
                            double min_angle_deg, core::ConnectedRanks& ranks, mesh::PiecewiseCheck* check);

}  // namespace lamina::pipeline
