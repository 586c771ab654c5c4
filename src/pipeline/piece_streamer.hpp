// Numbers the pieces of a mesh in their order and hands them to a sink, while threads make them in any order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/layers.hpp>
#include <lamina/mesh_sink.hpp>

#include "core/in_order.hpp"
#include "mesh/hash.hpp"

namespace lamina::pipeline {

/// Takes the cells of the layer, then the pieces of all subdomains, and numbers them as assemble() does. A piece is
/// numbered as soon as the sizes of all before it are known, and forgotten once it is formatted.
class PieceStreamer {
public:
    /// Hands the vertices of the decoupling and the triangles of the layer to the sink. All arguments must outlive this
    /// object.
    PieceStreamer(const Decoupling& decoupling, const LayerCells& cells, MeshSink& sink);

    /// Waits until no more than a few pieces before this one are unfinished, so that threads do not run ahead of a slow
    /// one. Throws MeshError where another thread has failed.
    void begin(std::size_t piece);
    /// Takes the refinement of a subdomain.
    void take(std::size_t piece, Refinement refinement);
    /// Wakes the threads that wait, after a failure.
    void fail();
    /// Ends the mesh, after the last piece, with the quadrilaterals of the layer.
    void finish(std::span<const Marker> markers, std::span<const Segment> constraints);

    const MeshCounts& counts() const { return counts_; }
    /// Returns the hash of the mesh, after finish().
    std::string hash() const { return hash_.text(); }
    /// Returns the numbers of the first triangles of all pieces, after the last one.
    std::vector<std::size_t> take_first_triangles() { return std::move(first_triangle_); }

private:
    /// A piece that knows its numbers.
    struct NumberedPiece {
        std::size_t number = 0, first_vertex = 0, first_triangle = 0;
        Refinement refinement;
    };

    const Decoupling& decoupling_;
    const LayerCells& cells_;
    MeshSink& sink_;
    std::size_t window_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::size_t, Refinement> waiting_;  ///< pieces whose numbers are not known yet
    std::size_t next_ = 0;                       ///< the first piece that is not numbered yet
    std::size_t written_ = 0;                    ///< number of pieces that the sink has taken
    bool failed_ = false;
    MeshCounts counts_;
    std::vector<std::size_t> first_triangle_;
    mesh::HashOfParts hash_;
    core::InOrder<MeshSink::Bytes> in_order_;

    std::vector<NumberedPiece> number(std::size_t piece, Refinement refinement);
    void hand_on(NumberedPiece piece);
};

}  // namespace lamina::pipeline
