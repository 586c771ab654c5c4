// Lines through segments divide the plane (line_partition.hpp). A triangle belongs to the smallest part that holds it,
// and the segments of a part change its triangles alone, and those of parts inside it, once these are done. What leaves
// a part is left to the next larger one.
//
//        part 1        |        part 2           Triangles across the line belong to part 0, so none of part 1 has an
//      ---- . ---------|-- . -------- . ----     edge in common with one of part 2. A vertex on the line, such as the
//           |  \    0  | / | \   2   /           hub of many segments, keeps triangles from belonging to a side only
//        1  |    \     . 0 |   \    /            where two vertices of the triangle lie on the line.
//
// Why threads do not meet: a triangle t within one part and a triangle u within another, unrelated one cannot have an
// edge in common. Of the ends of this edge one at least lies inside the part of t, because only one vertex of t may lie
// on the line of a larger part. It does not lie inside the part of u, nor on the line of a part round it, so u belongs
// to a part round both. Segments only change what triangles a part consists of, and not its border.
#include "delaunay/pieces/insert_in_parts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/bounding_box.hpp"
#include "core/parallel.hpp"
#include "delaunay/pieces/line_partition.hpp"

namespace lamina::delaunay::pieces {

namespace {

constexpr std::size_t part_grain = 20'000;

/// Returns about how many triangles segments cross, for all segments from a sample of them, if vertices lie evenly.
double estimated_crossings(std::span<const Point> points, std::span<const Index> which,
                           const std::vector<Segment>& sample) {
    double sum = 0;
    Box box;
    for (const Segment& s : sample) {
        const Point a = points[s.a.index()], b = points[s.b.index()];
        sum += distance(a, b);
        box.include(a);
        box.include(b);
    }
    const double area = box.width() * box.height();
    if (area <= 0) return 0;
    return sum / static_cast<double>(sample.size()) * static_cast<double>(which.size()) *
           std::sqrt(static_cast<double>(points.size()) / area);
}

/// Returns some of the segments, evenly chosen.
std::vector<Segment> sample_of(std::span<const Segment> segments, std::span<const Index> which) {
    constexpr std::size_t largest_sample = 1024;
    std::vector<Segment> sample(std::min(which.size(), largest_sample));
    for (std::size_t i = 0; i < sample.size(); ++i) sample[i] = segments[which[i * which.size() / sample.size()]];
    return sample;
}

/// Inserts segments part by part.
class PartwiseInserter {
public:
    PartwiseInserter(std::span<const Point> points, std::span<const Segment> segments, const LinePartition& partition,
                     Tris& tris, std::vector<Index>& at_vertex)
        : points_(points),
          segments_(segments),
          partition_(partition),
          tris_(tris),
          at_vertex_(at_vertex),
          of_vertex_(points.size()),
          of_triangle_(tris.size()),
          segments_of_(partition.size()) {}

    InsertedInParts run(std::span<const Index> which) {
        find_parts();
        deal(which);
        share_vertices_on_lines();
        InsertedInParts result;
        result.pieces.resize(partition_.size());
        std::vector<char> crossed(partition_.size(), 0);
        insert(0, result.pieces, crossed);
        result.crossed = std::find(crossed.begin(), crossed.end(), 1) != crossed.end();
        return result;
    }

private:
    Part part_of_vertex(Index v) const { return v == ghost_vertex ? Part{0} : of_vertex_[v]; }

    void find_parts() {
        core::parallel_for(points_.size(), part_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) of_vertex_[v] = partition_.of_point(points_[v]);
        });
        core::parallel_for(tris_.size(), part_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                const Index* v = tris_[t].v;
                of_triangle_[t] =
                    partition_.of_triangle(part_of_vertex(v[0]), part_of_vertex(v[1]), part_of_vertex(v[2]));
            }
        });
    }

    void deal(std::span<const Index> which) {
        for (const Index i : which) {
            const Segment& s = segments_[i];
            segments_of_[partition_.of_segment(of_vertex_[s.a.index()], of_vertex_[s.b.index()])].push_back(i);
        }
    }

    /// Gives vertices on lines to the largest part of the triangles round them, and one of the triangles of that part:
    /// smaller parts do not change it.
    void share_vertices_on_lines() {
        const auto on_lines =
            core::parallel_blocks(points_.size(), part_grain, [&](std::size_t begin, std::size_t end) {
                std::vector<Index> found;
                for (std::size_t v = begin; v < end; ++v)
                    if (partition_.is_divided(of_vertex_[v])) found.push_back(static_cast<Index>(v));
                return found;
            });
        for (const std::vector<Index>& block : on_lines)
            for (const Index v : block) {
                const Index first = at_vertex_[v];
                for (Index t = first;;) {
                    assert(has_corner(tris_[t], v));
                    if (of_triangle_[t] < of_triangle_[at_vertex_[v]]) at_vertex_[v] = t;
                    t = tris_[t].n[next(corner_of(tris_[t], v))].triangle();
                    if (t == first) break;
                }
                of_vertex_[v] = of_triangle_[at_vertex_[v]];
                shared_.add(v);
            }
    }

    /// Inserts the segments of a part. Returns those that leave it.
    std::vector<Index> insert(Part part, std::vector<std::vector<SegmentPiece>>& pieces, std::vector<char>& crossed) {
        std::vector<Index>& mine = segments_of_[part];
        if (partition_.is_divided(part)) {
            std::vector<Index> low, high;
            core::parallel_invoke([&] { low = insert(partition_.low(part), pieces, crossed); },
                                  [&] { high = insert(partition_.high(part), pieces, crossed); });
            mine.insert(mine.end(), low.begin(), low.end());
            mine.insert(mine.end(), high.begin(), high.end());
            std::sort(mine.begin(), mine.end());
        }
        const Reach reach = part == 0 ? Reach()
                                      : Reach(of_triangle_.data(), of_vertex_.data(), shared_, part,
                                              static_cast<Part>(partition_.end(part) - part));
        UncrossedSegments inserted = insert_uncrossed_segments(points_, segments_, mine, reach, tris_, at_vertex_);
        pieces[part] = std::move(inserted.pieces);
        crossed[part] = !inserted.crossing.empty();
        return std::move(inserted.beyond);
    }

    std::span<const Point> points_;
    std::span<const Segment> segments_;
    const LinePartition& partition_;
    Tris& tris_;
    std::vector<Index>& at_vertex_;
    std::vector<Part> of_vertex_, of_triangle_;
    std::vector<std::vector<Index>> segments_of_;  ///< for each part, in ascending order
    VertexFilter shared_;                          ///< vertices on lines
};

}  // namespace

InsertedInParts insert_in_parts(std::span<const Point> points, std::span<const Segment> segments,
                                std::span<const Index> which, Tris& tris, std::vector<Index>& at_vertex) {
    const std::vector<Segment> sample = sample_of(segments, which);
    // Finding the parts takes as long as crossing some of the triangles.
    const double many_crossings = 0.25 * static_cast<double>(points.size());
    if (!sample.empty() && estimated_crossings(points, which, sample) >= many_crossings) {
        const LinePartition partition(points, sample);
        if (partition.size() > 1) return PartwiseInserter(points, segments, partition, tris, at_vertex).run(which);
    }
    InsertedInParts result;
    UncrossedSegments all = insert_uncrossed_segments(points, segments, which, Reach(), tris, at_vertex);
    result.pieces.push_back(std::move(all.pieces));
    result.crossed = !all.crossing.empty();
    return result;
}

}  // namespace lamina::delaunay::pieces
