// Numbers the pieces of a mesh in their order and hands them on, while threads make them in any order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "core/in_order.hpp"
#include "decoupling/subdomain.hpp"
#include "layers/layer.hpp"
#include "mesh/hash.hpp"
#include "pipeline/sharing/part_takers.hpp"

namespace lamina::pipeline {

/// Takes the cells of the layer and the pieces of all subdomains, and numbers them: the triangles of the layer come
/// first, then those of the subdomains, then the quadrilaterals of the layer. A piece is handed on as soon as the sizes
/// of all before it are known, and then forgotten.
class PieceStreamer {
public:
    /// Hands the parts to the taker. Both arguments must outlive this object.
    PieceStreamer(const decoupling::Decoupling& decoupling, PartTaker& taker, bool with_hash);

    /// Returns the subdomains in the order in which threads should make them: that of their numbers, so that few pieces
    /// wait for others. But the last ones come in descending order of their size, so that no thread is left with a
    /// large one at the end.
    std::vector<std::size_t> order() const;
    /// Returns whether so many pieces may wait that all can be made before start().
    bool holds_all() const { return decoupling_.subdomains.size() <= window_; }

    /// Hands on the vertices of the decoupling and the triangles of the layer, which must outlive this object. No piece
    /// is handed on before.
    void start(const layers::LayerCells& cells);
    /// Waits until no more than a few pieces before this one are unfinished, so that threads do not run ahead of a slow
    /// one. Throws MeshError where another thread has failed.
    void begin(std::size_t piece);
    /// Takes the refinement of a subdomain.
    void take(std::size_t piece, Refinement refinement);
    /// Wakes the threads that wait, after a failure.
    void fail();
    /// Hands on the quadrilaterals of the layer, after the last piece.
    void finish(std::span<const Marker> markers);

    const MeshCounts& counts() const { return counts_; }
    /// Returns the hash of the mesh, after finish(); an empty string without it.
    std::string hash() const { return with_hash_ ? hash_.text() : std::string(); }
    /// Returns the numbers of the first triangles of all pieces, after the last one.
    std::vector<std::size_t> take_first_triangles() { return std::move(first_triangle_); }

private:
    /// A piece that knows its numbers.
    struct NumberedPiece {
        std::size_t number = 0, first_vertex = 0, first_triangle = 0;
        Refinement refinement;
    };

    const decoupling::Decoupling& decoupling_;
    PartTaker& taker_;
    const bool with_hash_;
    const std::size_t window_;                   ///< how many pieces may be made while one before them is not
    const layers::LayerCells* cells_ = nullptr;  ///< once they are known
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::size_t, Refinement> waiting_;  ///< pieces whose numbers are not known yet
    std::size_t next_ = 0;                       ///< the first piece that is not numbered yet
    std::size_t written_ = 0;                    ///< number of pieces that were handed on
    bool failed_ = false;
    MeshCounts counts_;
    std::vector<std::size_t> first_triangle_;
    mesh::HashOfParts hash_;
    core::InOrder<PartTaker::Append> in_order_;

    std::vector<NumberedPiece> number_waiting();
    void hand_on(NumberedPiece piece);
};

}  // namespace lamina::pipeline
