// Who matches the borders between pieces that several processes have made: nobody matches all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <lamina/ids.hpp>

#include "decoupling/cut_region.hpp"
#include "decoupling/lines.hpp"

namespace lamina::pipeline {

/// Says which process matches which edges and counts which vertices. A line belongs to the process that has searched the
/// first piece beside it: that one holds the piece, unless another process was idle. The layer belongs to rank 0, and a
/// vertex where lines meet to the process of the first line that begins there.
class SeamOwners {
public:
    /// `layer_vertices` is the number of vertices that no line of the decoupling has added; `self` is the process whose
    /// places are asked for.
    SeamOwners(const decoupling::CutRegion& cut, std::size_t layer_vertices, unsigned self);

    /// Returns the first vertex beyond the layer.
    VertexId first() const { return VertexId{layer_}; }
    bool is_in_layer(VertexId v) const { return v.index() < layer_; }
    /// Returns the process that the edges of a line belong to.
    unsigned owner(std::uint32_t line) const { return of_line_[line]; }
    unsigned owner(const decoupling::LineVertex& v) const {
        if (v.line != decoupling::LineVertex::no_line) return of_line_[v.line];
        return is_in_layer(v.id) ? 0u : of_junction_[v.id.index() - layer_];
    }
    /// Returns the number of the vertices that belong to this process, and the place of one beyond the layer among them.
    std::size_t own_vertices() const { return own_vertices_; }
    std::size_t place(const decoupling::LineVertex& v) const {
        if (v.line == decoupling::LineVertex::no_line) return first_place_of_junction_[v.id.index() - layer_];
        return first_place_[v.line] + (v.id.index() - first_id_[v.line]);
    }

private:
    std::size_t layer_;
    std::vector<std::uint32_t> of_line_, of_junction_;
    std::vector<std::uint32_t> first_id_;     ///< per line
    std::vector<std::uint32_t> first_place_;  ///< per line of this process
    std::vector<std::uint32_t> first_place_of_junction_;
    std::size_t own_vertices_ = 0;
};

}  // namespace lamina::pipeline
