// Who matches the borders between pieces that several processes have made: nobody matches all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/ids.hpp>

#include "decoupling/cut_region.hpp"
#include "decoupling/lines.hpp"

namespace lamina::pipeline {

/// Says which process matches which edges and counts which vertices. A line between trapezoids belongs to the process
/// that has divided it, any other line to the one that has searched the first piece beside it: these hold the pieces,
/// unless another process was idle. The layer belongs to rank 0, and a vertex where lines meet to the process of the
/// first line that begins there.
class SeamOwners {
public:
    /// `layer_vertices` is the number of vertices that no line of the decoupling has added; `self` is the process whose
    /// places are asked for. The region must outlive this object.
    SeamOwners(const decoupling::CutRegion& cut, std::size_t layer_vertices, unsigned self);

    bool is_in_layer(VertexId v) const { return v.index() < layer_; }
    /// Returns the process that the edges of a line belong to.
    unsigned owner(std::uint32_t line) const {
        return lines_.is_in_row(line) ? owner_in_rows(line) : of_other_line_[other_line(line)];
    }
    unsigned owner(const decoupling::LineVertex& v) const;
    /// Returns the number of the vertices that belong to this process, and the place among them of one that does,
    /// beyond the layer. Those that a line has added have successive places.
    std::size_t own_vertices() const {
        return own_.empty() ? 0 : own_.back().place + (own_.back().end - own_.back().begin);
    }
    std::size_t place(VertexId v) const;

private:
    /// Successive vertices of this process.
    struct OwnVertices {
        std::size_t begin = 0, end = 0;
        std::size_t place = 0;  ///< of the first one
    };

    /// Returns the number of a line among those in no row.
    std::size_t other_line(std::uint32_t line) const { return line < rows_begin_ ? line : line - lines_in_rows_; }
    unsigned owner_in_rows(std::uint32_t line) const;
    void find_owners_of_others(const decoupling::CutRegion& cut);
    void find_own_vertices(unsigned self);

    const decoupling::Lines& lines_;
    std::span<const decoupling::LineRun> runs_;  ///< of the lines in rows
    std::size_t layer_;
    std::uint32_t rows_begin_, lines_in_rows_;
    std::vector<std::uint32_t> of_other_line_;
    std::vector<OwnVertices> own_;  ///< in ascending order
};

}  // namespace lamina::pipeline
