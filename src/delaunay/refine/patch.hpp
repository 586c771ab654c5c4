// A patch: a small part of a triangulation, copied, so that changes of its connectivity can be tried and forgotten.
//
// Patches are judged by their distortion, the sum over their triangles of 1 / q - 1, where q is the mean ratio. That is
// 0 where all triangles are equilateral, whatever their sizes, and grows beyond bounds before a triangle turns over. As
// a function of the place of one vertex it is convex.
//
// Source: the inverse mean ratio: L. A. Freitag, P. M. Knupp, Int. J. Numer. Meth. Engng. 53 (2002).
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/point.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// A part of a triangulation with numbers of its own. Triangles that a change has removed stay in their places, with
/// no_index as their first vertex; vertices that one has removed stay without triangles.
struct Patch {
    std::vector<Point> points;
    std::vector<char> is_fixed;     ///< for each point: 1 where it may not move
    std::vector<unsigned> degrees;  ///< for each point the number of its triangles in the patch
    Tris tris;                      ///< edges where the patch ends are borders
    Index core = 0;                 ///< the first so many triangles are those in the middle

    bool is_removed(Index t) const { return tris[t].v[0] == no_index; }
};

/// A change of the connectivity: of edge e of triangle t, or of the vertex at corner e of it.
///
///        c            c             c              c
///       / \          /|\.          / \            /|\.        Split is the reverse of merge. The new vertex takes
///      a---b  flip  a | b         u---v   merge  | u |        `count` of the triangles round the old one, from t
///       \ /          \|/           \ /            \|/         on counter-clockwise.
///        d            d             d              d
struct Change {
    enum class Kind : unsigned char { flip, merge, split };
    Kind kind;
    Index t;
    unsigned e, count;
    int defect_change;  ///< how the sum over all free vertices of (degree - 6)^2 changes
};

/// Returns the changes in the middle of a patch that do not increase the sum over all free vertices of (degree - 6)^2,
/// those that decrease it most first.
std::vector<Change> find_changes(const Patch& patch);

/// Makes a change. Returns false, and leaves the patch in a state to be forgotten, if it is not possible or turns a
/// triangle over.
bool apply(Patch& patch, const Change& change);

/// Returns the triangles round a vertex, counter-clockwise from t on, whose corner it is, each with the corner of the
/// vertex as the edge of the link; nothing if a constrained edge ends at the vertex.
std::vector<Link> star_of(const Tris& tris, Index t, unsigned corner);

/// Lets patches settle. The same object serves for one patch after another.
class PatchSettler {
public:
    /// Moves vertices to where the distortion is least and flips edges until the patch is Delaunay, in turns. Returns
    /// the distortion, with a little more for each vertex, so that no vertices are added for next to nothing. Gives up,
    /// and returns infinity, where that is clearly going to be more than a bound. Precondition: no triangle is turned
    /// over.
    double settle(Patch& patch, double bound);

    /// Each vertex adds this much to what settle() returns. Without it 0.5 to 1 % more vertices are added than removed.
    static constexpr double vertex_cost = 0.02;

private:
    void find_rings(const Patch& patch);
    void move_all(Patch& patch) const;
    bool restore_delaunay(Patch& patch);

    struct FreeVertex {
        Index v;
        std::size_t ring_begin, ring_end;  ///< its neighbours in rings_, the first of them repeated at the end
    };
    struct QueuedEdge {
        Index t;
        unsigned e;
    };
    std::vector<Index> triangle_at_;
    std::vector<FreeVertex> free_;
    std::vector<Index> rings_;
    std::vector<QueuedEdge> pending_;
};

/// Returns the distortion of a patch, with PatchSettler::vertex_cost for each vertex.
double cost_of(const Patch& patch);

}  // namespace lamina::delaunay
