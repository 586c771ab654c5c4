// Erosion and dilation of vertices, and triangles: all of it works on the 64 bits of a word at a time.
#include "delaunay/refine/lattice_patch.hpp"

#include <bit>
#include <cassert>

#include "core/interruption_point.hpp"
#include "core/predicates.hpp"

namespace lamina::delaunay {

namespace {

using Word = LatticeWord;
using Row = LatticeRow;

/// Returns word w of a row moved so that bit i holds what was in column i + 1.
Word from_right(const Word* row, std::size_t w, std::size_t words) {
    return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
}
/// Returns word w of a row moved so that bit i holds what was in column i - 1.
Word from_left(const Word* row, std::size_t w) { return row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0); }

/// A row of bits with the rows below and above it. The neighbours of a vertex in these two rows stand in columns i - 1
/// and i if its row is even, in columns i and i + 1 if it is odd.
struct RowTriple {
    const Word *here, *below, *above;
    std::size_t words;
    bool odd;

    /// Returns whether there is no bit in word w of the three rows, nor in the columns beside it. This holds for most
    /// words of a narrow level in a wide box.
    bool is_empty_round(std::size_t w) const {
        Word near = here[w] | below[w] | above[w];
        if (w > 0) near |= (here[w - 1] | below[w - 1] | above[w - 1]) >> 63;
        if (w + 1 < words) near |= (here[w + 1] | below[w + 1] | above[w + 1]) << 63;
        return near == 0;
    }

    /// Returns, for each vertex of word w, the bit of the apex that the edge to its right neighbour has in `other`, the
    /// row above or below.
    Word apex(const Word* other, std::size_t w) const { return odd ? from_right(other, w, words) : other[w]; }
};

/// Calls f(j, rows) for each row j of the bits. Rows outside the grid are empty.
template <class F>
void for_row_triples(const LatticeGrid& grid, const std::vector<Word>& bits, F&& f) {
    const std::vector<Word> none(grid.words, 0);
    for (Row j = 0; j < grid.rows; ++j) {
        const Word* here = bits.data() + static_cast<std::size_t>(j) * grid.words;
        const Word* below = j > 0 ? here - grid.words : none.data();
        const Word* above = j + 1 < grid.rows ? here + grid.words : none.data();
        f(j, RowTriple{here, below, above, grid.words, (j & 1) != 0});
    }
}

/// Whether with_neighbours() demands all of a vertex and its six neighbours, or any of them.
enum class Combine { all, any };

template <Combine combine>
Word combine_neighbours(const RowTriple& rows, std::size_t w) {
    const auto& [here, below, above, words, odd] = rows;
    const Word neighbours[6] = {from_left(here, w), from_right(here, w, words),
                                below[w],           odd ? from_right(below, w, words) : from_left(below, w),
                                above[w],           odd ? from_right(above, w, words) : from_left(above, w)};
    Word result = here[w];
    for (Word bits : neighbours) result = combine == Combine::all ? result & bits : result | bits;
    return result;
}

/// Returns the vertices that are set together with all of their neighbours (erosion), or the vertices and all
/// neighbours of them (dilation).
template <Combine combine>
std::vector<Word> with_neighbours(const LatticeGrid& grid, const std::vector<Word>& bits) {
    std::vector<Word> result(bits.size(), 0);
    for_row_triples(grid, bits, [&](Row j, const RowTriple& rows) {
        Word* to = result.data() + static_cast<std::size_t>(j) * grid.words;
        for (std::size_t w = 0; w < grid.words; ++w) {
            const bool is_zero = combine == Combine::all ? rows.here[w] == 0 : rows.is_empty_round(w);
            if (!is_zero) to[w] = combine_neighbours<combine>(rows, w);
        }
    });
    return result;
}

/// The triangles of a patch by their horizontal edge (i, i + 1) of row j: `up` with the apex in row j + 1, `down` with
/// the apex in row j - 1. A triangle belongs to the patch if one of its corners is a centre.
struct TriangleBits {
    std::vector<Word> up, down;
};

TriangleBits triangle_bits(const LatticeGrid& grid, const PatchVertices& patch) {
    TriangleBits bits{std::vector<Word>(grid.bits.size(), 0), std::vector<Word>(grid.bits.size(), 0)};
    for_row_triples(grid, patch.centres, [&](Row j, const RowTriple& rows) {
        const std::size_t base = static_cast<std::size_t>(j) * grid.words;
        for (std::size_t w = 0; w < grid.words; ++w) {
            if (rows.is_empty_round(w)) continue;
            const Word edge = rows.here[w] | from_right(rows.here, w, grid.words);
            bits.up[base + w] = edge | rows.apex(rows.above, w);
            bits.down[base + w] = edge | rows.apex(rows.below, w);
        }
    });
    return bits;
}

/// Calls f(column) for each set bit of word w of a row.
template <class F>
void for_bits(Word bits, std::size_t w, F&& f) {
    for (; bits != 0; bits &= bits - 1) f(64 * w + static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Appends the vertices of row j and notes their numbers by column.
void append_row(const LatticeGrid& grid, const PatchVertices& patch, Row j, std::vector<std::uint32_t>& ids,
                LatticePatches& patches) {
    const std::size_t base = static_cast<std::size_t>(j) * grid.words;
    const double y = grid.row_y(j), shift = grid.shift(j);
    for (std::size_t w = 0; w < grid.words; ++w) {
        for_bits(grid.bits[base + w], w, [&](std::size_t i) {
            ids[i] = static_cast<std::uint32_t>(patches.points.size());
            patches.points.push_back({grid.origin.x + grid.edge * (static_cast<double>(i) + shift), y});
        });
        for_bits(grid.bits[base + w] & ~patch.all[base + w], w,
                 [&](std::size_t i) { patches.collar.push_back(VertexId{ids[i]}); });
    }
}

/// The triangles of a strip by the columns of their horizontal edges.
struct StripTriangles {
    std::vector<std::uint32_t> up, down;
};

/// Notes the neighbours of the triangles of a strip. They stand beside each other in the order in which they are added.
///
///         0               Edges 0 are horizontal. In this order edge 1 of up and edge 2 of down lead to the next
///       C---D      C      triangle, and edge 2 of up and edge 1 of down to the one before.
///      1 \ / 2   2 / \ 1
///         B      A---B
///                  0
class StripLinker {
public:
    /// `below` are the triangles of the strip below, `here` are to become those of this one.
    StripLinker(const StripTriangles& below, StripTriangles& here, LatticePatches& patches)
        : below_(below), here_(here), patches_(patches) {}

    /// Notes that the triangle up (i) was appended, which has a neighbour below if `linked_below`.
    void add_up(std::size_t i, std::size_t position, bool linked_below) {
        const std::size_t t = add(here_.up, i, position, 2);
        last_edge_ = 1;
        if (linked_below) connect(core::edge_link(t, 0), core::edge_link(below_.down[i], 0));
    }
    void add_down(std::size_t i, std::size_t position) {
        add(here_.down, i, position, 1);
        last_edge_ = 2;
    }

private:
    /// Notes the last triangle, and links its edge to the triangle before, if that stands beside it.
    std::size_t add(std::vector<std::uint32_t>& of_column, std::size_t i, std::size_t position, unsigned edge) {
        const std::size_t t = patches_.triangles.size() - 1;
        of_column[i] = static_cast<std::uint32_t>(t);
        patches_.links.insert(patches_.links.end(), 3, core::no_link);
        if (position == last_position_ + 1) connect(core::edge_link(t, edge), core::edge_link(t - 1, last_edge_));
        last_position_ = position;
        return t;
    }
    /// Returns the end of an edge of a triangle: its begin with `end` = 0, else 1.
    VertexId end_of(core::EdgeLink edge, unsigned end) const {
        return patches_.triangles[core::triangle_of(edge)].v[(core::edge_of(edge) + end) % 3];
    }
    void connect(core::EdgeLink a, core::EdgeLink b) {
        assert(end_of(a, 0) == end_of(b, 1) && end_of(a, 1) == end_of(b, 0));
        patches_.links[3 * core::triangle_of(a) + core::edge_of(a)] = b;
        patches_.links[3 * core::triangle_of(b) + core::edge_of(b)] = a;
    }

    const StripTriangles& below_;
    StripTriangles& here_;
    LatticePatches& patches_;
    std::size_t last_position_ = 0;  ///< positions begin at 2
    unsigned last_edge_ = 0;
};

/// The triangles between rows j (`here`) and j + 1 (`above`), and those of their edges across which the patch has no
/// triangle. Boundary edges are directed with the seam on their left, against the triangle. Where the patches are
/// linked, `own` takes the strip's triangles; `below` are those of the strip below.
///
///        C ------- D      row j + 1      The triangle up (i) has A = i and B = i + 1 in row j; its apex C is in
///       /  \      /                      column i of row j + 1, or i + 1 if row j is odd.
///      /    \    /                       The triangle down (i) has C = i and D = i + 1 in row j + 1; its apex B
///     A ----- B           row j          is in column i + 1 of row j, or i if row j is odd.
class Strip {
public:
    Strip(const LatticeGrid& grid, const TriangleBits& bits, Row j, const std::vector<std::uint32_t>& here,
          const std::vector<std::uint32_t>& above)
        : words_(grid.words),
          odd_((j & 1) != 0 ? 1 : 0),
          up_(bits.up.data() + static_cast<std::size_t>(j) * words_),
          down_here_(bits.down.data() + static_cast<std::size_t>(j) * words_),
          down_(down_here_ + words_),
          up_above_(up_ + words_),
          here_(here),
          above_(above) {}

    void append_triangles(const StripTriangles& below, StripTriangles& own, LatticePatches& patches) const {
        StripLinker linker(below, own, patches);
        for (std::size_t w = 0; w < words_; ++w) {
            const auto add_up = [&](std::size_t i) {
                patches.triangles.push_back({{here(i), here(i + 1), above(i + odd_)}});
                assert(is_counter_clockwise(patches.triangles.back(), patches.points));
                if (patches.linked) linker.add_up(i, 2 * i + 2 + odd_, (down_here_[w] >> (i % 64) & 1) != 0);
            };
            const auto add_down = [&](std::size_t i) {
                patches.triangles.push_back({{above(i + 1), above(i), here(i + 1 - odd_)}});
                assert(is_counter_clockwise(patches.triangles.back(), patches.points));
                if (patches.linked) linker.add_down(i, 2 * i + 3 - odd_);
            };
            // The triangles form a strip, each beside the one before.
            for_bits(up_[w] | down_[w], w, [&](std::size_t i) {
                const Word bit = Word{1} << (i % 64);
                if (odd_ != 0 && (down_[w] & bit) != 0) add_down(i);
                if ((up_[w] & bit) != 0) add_up(i);
                if (odd_ == 0 && (down_[w] & bit) != 0) add_down(i);
            });
        }
    }

    void append_boundary(const StripTriangles& own, LatticePatches& patches) const {
        // `edge` is the one of the triangle in column i of these triangles.
        const auto add = [&](VertexId a, VertexId b, const std::vector<std::uint32_t>& of_column, std::size_t i,
                             unsigned edge) {
            patches.boundary.push_back({b, a});
            assert(!patches.linked || (patches.triangles[of_column[i]].v[edge] == a &&
                                       patches.triangles[of_column[i]].v[(edge + 1) % 3] == b));
            if (patches.linked) patches.boundary_links.push_back(core::edge_link(of_column[i], edge));
        };
        for (std::size_t w = 0; w < words_; ++w) {
            if ((up_[w] | down_[w]) == 0) continue;
            for_bits(up_[w] & ~down_here_[w], w, [&](std::size_t i) { add(here(i), here(i + 1), own.up, i, 0); });
            for_bits(down_[w] & ~up_above_[w], w, [&](std::size_t i) { add(above(i + 1), above(i), own.down, i, 0); });
            // On the right of up (i) lies down (i + odd), on its left down (i + odd - 1).
            const Word right_of_up = odd_ != 0 ? from_right(down_, w, words_) : down_[w];
            const Word left_of_up = odd_ != 0 ? down_[w] : from_left(down_, w);
            for_bits(up_[w] & ~right_of_up, w, [&](std::size_t i) { add(here(i + 1), above(i + odd_), own.up, i, 1); });
            for_bits(up_[w] & ~left_of_up, w, [&](std::size_t i) { add(above(i + odd_), here(i), own.up, i, 2); });
            // On the left of down (i) lies up (i - odd), on its right up (i + 1 - odd).
            const Word left_of_down = odd_ != 0 ? from_left(up_, w) : up_[w];
            const Word right_of_down = odd_ != 0 ? up_[w] : from_right(up_, w, words_);
            for_bits(down_[w] & ~left_of_down, w,
                     [&](std::size_t i) { add(above(i), here(i + 1 - odd_), own.down, i, 1); });
            for_bits(down_[w] & ~right_of_down, w,
                     [&](std::size_t i) { add(here(i + 1 - odd_), above(i + 1), own.down, i, 2); });
        }
    }

private:
    std::size_t words_, odd_;
    const Word *up_, *down_here_, *down_, *up_above_;
    const std::vector<std::uint32_t>&here_, &above_;

    static bool is_counter_clockwise(const Triangle& t, const std::vector<Point>& points) {
        return core::inline_orient2d(points[t.v[0].index()], points[t.v[1].index()], points[t.v[2].index()]) > 0;
    }
    VertexId here(std::size_t i) const { return VertexId{std::size_t{here_[i]}}; }
    VertexId above(std::size_t i) const { return VertexId{std::size_t{above_[i]}}; }
};

}  // namespace

SharedPatchPoints append_shared_points(const LatticePatches& patches, std::vector<Point>& seam_points) {
    SharedPatchPoints shared;
    std::vector<VertexId> seam_id(patches.points.size());
    const auto seam_vertex = [&](VertexId v) {
        VertexId& id = seam_id[v.index()];
        if (!id.valid()) {
            id = VertexId{seam_points.size()};
            seam_points.push_back(patches.points[v.index()]);
            shared.patch_points.push_back(v);
        }
        return id;
    };
    for (const Segment& s : patches.boundary) shared.boundary.push_back({seam_vertex(s.a), seam_vertex(s.b)});
    shared.boundary_points = shared.patch_points.size();
    for (const VertexId v : patches.collar) seam_vertex(v);
    return shared;
}

PatchVertices open_patch(LatticeGrid& grid) {
    PatchVertices patch;
    patch.centres = with_neighbours<Combine::all>(grid, with_neighbours<Combine::all>(grid, grid.bits));
    patch.all = with_neighbours<Combine::any>(grid, patch.centres);
    grid.bits = with_neighbours<Combine::any>(grid, patch.all);
    return patch;
}

void append_patch(const LatticeGrid& grid, const PatchVertices& patch, LatticePatches& patches) {
    const TriangleBits bits = triangle_bits(grid, patch);
    std::vector<std::uint32_t> here(64 * grid.words + 1, 0), above(here);
    StripTriangles below, own;
    if (patches.linked) below = own = {here, here};
    append_row(grid, patch, 0, here, patches);
    for (Row j = 0; j + 1 < grid.rows; ++j) {
        core::check_interruption();
        append_row(grid, patch, j + 1, above, patches);
        const Strip strip(grid, bits, j, here, above);
        strip.append_triangles(below, own, patches);
        strip.append_boundary(own, patches);
        std::swap(here, above);
        std::swap(below, own);
    }
}

}  // namespace lamina::delaunay
