// Recursive bisection of the region between layers and far field by estimated work.
//
//      box   o-----------o-----------o        Lines that fall on a border at right angles are tried all round the
//      piece;
//            |           :           |        the best one halves the work, is short and square to what it meets.
//            |     1     :     2     |        Pieces round the ends of a body become wedges, which are then cut across.
//     layer  o~~~~~~~~~~~o~~~~~~~~~~~o
#include "decoupling/cut.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "decoupling/piece_triangulation.hpp"
#include "decoupling/separators.hpp"

namespace lamina::decoupling {

namespace {

/// A piece of up to this multiple of the target is left whole: halves of it would be smaller than need be.
constexpr double keep_whole = 1.5;
/// Cosine of the sharpest angle between a line and the borders it meets: 60 degrees.
constexpr double sharpest = 0.5;
/// Neither side of a cut holds less than this share of the piece.
constexpr double least_share = 0.15;
constexpr std::size_t fewest_segments = 4;
/// A line that joins two loops is longer: narrow gaps are left alone.
constexpr std::size_t fewest_joining = 8;
/// Corners that lines are tried from, and lines that are looked at closely.
constexpr std::size_t most_origins = 64, most_tried = 32;
/// Largest ratio of a line's first segment to the border's edges beside it.
constexpr double largest_ratio = 1.6;
/// Vertices of a line keep this share of their distance from each other away from the border.
constexpr double clearance = 0.7;

/// A straight line between two corners, better the lower its cost.
struct Line {
    Corner from, to;
    double cost;
};

/// What becomes of a piece: a cut with the points inside its line, or none.
struct Verdict {
    double triangles = 0;
    bool lattice = true;
    struct Cut {
        Corner from, to;
        std::vector<Point> interior;
    };
    std::optional<Cut> cut = {};
};

class Search {
public:
    Search(std::span<const Point> points, const Piece& piece, const Separation& separation)
        : piece_(points, piece, separation.size), separation_(separation), size_(separation.size) {}

    Verdict run(double pieces_target) {
        Verdict verdict{piece_.triangles(), piece_.lattice()};
        if (verdict.triangles <= keep_whole * pieces_target) return verdict;
        std::vector<Line> lines = candidates();
        const std::size_t tried = std::min(lines.size(), most_tried);
        std::partial_sort(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(tried), lines.end(), better);
        if (tried == 0) return verdict;
        find_border();
        for (std::size_t i = 0; i < tried && !verdict.cut; ++i)
            if (auto interior = divide(lines[i])) verdict.cut = {lines[i].from, lines[i].to, *std::move(interior)};
        return verdict;
    }

private:
    PieceTriangulation piece_;
    const Separation& separation_;
    const SizeField& size_;
    std::vector<Corner> border_;     ///< whose edges to the next corner are the items of border_tree_
    core::BoxTree border_tree_{{}};  ///< of the boxes round the edges' diametral circles

    static bool better(const Line& a, const Line& b) {
        if (a.cost != b.cost) return a.cost < b.cost;
        const auto places = [](const Line& l) { return std::array{l.from.loop, l.from.place, l.to.loop, l.to.place}; };
        return places(a) < places(b);
    }

    /// Largest cosine between a direction from a corner and the edges beside it; 1 where it does not leave inwards.
    double lean(Corner c, Point direction) const {
        const Point p = piece_.point(c), a = piece_.point(piece_.next(c)), b = piece_.point(piece_.previous(c));
        if (!core::inside_wedge(p, a, b, p + direction)) return 1;
        const double l = length(direction);
        return std::max(dot(direction, a - p) / (l * distance(p, a)), dot(direction, b - p) / (l * distance(p, b)));
    }

    /// The direction that halves the angle at a corner.
    Point inward(Corner c) const {
        const Point p = piece_.point(c), a = piece_.point(piece_.next(c)), b = piece_.point(piece_.previous(c));
        return unit(perpendicular(unit(a - p) - unit(b - p)));
    }

    std::vector<Line> candidates() const {
        std::size_t corners = 0;
        for (std::size_t l = 0; l < piece_.loops(); ++l) corners += piece_.corners(l);
        const std::size_t stride = std::max<std::size_t>(1, corners / most_origins);
        std::vector<Corner> origins;
        for (std::size_t l = 0; l < piece_.loops(); ++l)
            for (std::size_t i = 0; i < piece_.corners(l); i += stride) origins.push_back({l, i});
        std::vector<Line> lines;
        const auto lines_of = [&](std::size_t begin, std::size_t end) {
            std::vector<Line> found;
            for (std::size_t i = begin; i < end; ++i) add_lines_from(origins[i], found);
            return found;
        };
        for (const std::vector<Line>& found : core::parallel_blocks(origins.size(), 4, lines_of))
            lines.insert(lines.end(), found.begin(), found.end());
        return lines;
    }

    void add_lines_from(Corner from, std::vector<Line>& lines) const {
        const Point straight = inward(from), across = perpendicular(straight);
        if (lean(from, straight) > sharpest) return;
        for (double turn : {0.0, 0.35, -0.35}) {  // up to 20 degrees to either side
            const Point direction = straight + turn * across;
            if (lean(from, direction) > sharpest) continue;
            const auto hit = piece_.shoot(from, direction);
            if (!hit) continue;
            const Corner behind = piece_.next(hit->corner);
            for (Corner to : {piece_.previous(hit->corner), hit->corner, behind, piece_.next(behind)})
                if (const std::optional<Line> line = judge(from, to, hit->triangles_left)) lines.push_back(*line);
        }
    }

    /// A line with about so many triangles on its left, if it may be good.
    std::optional<Line> judge(Corner from, Corner to, double triangles_left) const {
        const bool joins = from.loop != to.loop;
        if (!joins && piece_.loops() > 1) return std::nullopt;
        const double share = triangles_left / piece_.triangles();
        if (!joins && (share < least_share || share > 1 - least_share)) return std::nullopt;
        const Point p = piece_.point(from), q = piece_.point(to);
        const double angle = std::max(lean(from, q - p), lean(to, p - q));
        if (angle > sharpest) return std::nullopt;
        const double h_from = size_(p), h_to = size_(q);
        // From where the border is finest to where it is coarse: to the outer border rather than to another body.
        if (joins) return Line{from, to, angle + std::min(h_from, h_to) / std::max(h_from, h_to)};
        const double segments = distance(p, q) / (frozen_share * std::sqrt(h_from * h_to));
        return Line{from, to, std::abs(2 * share - 1) + 0.5 * angle + 0.2 * segments / std::sqrt(piece_.triangles())};
    }

    void find_border() {
        std::vector<Box> boxes;
        for (std::size_t l = 0; l < piece_.loops(); ++l)
            for (std::size_t i = 0; i < piece_.corners(l); ++i) {
                const Corner c{l, i};
                border_.push_back(c);
                boxes.push_back(circle_box(piece_.point(c), piece_.point(piece_.next(c)), 0.5));
            }
        border_tree_ = core::BoxTree(std::move(boxes));
    }

    /// The box round the circle about the middle of a-b with a radius of `share` x its length.
    static Box circle_box(Point a, Point b, double share) {
        const double r = share * distance(a, b);
        return {midpoint(a, b) - Point{r, r}, midpoint(a, b) + Point{r, r}};
    }

    /// The points inside the line, if the line may be drawn.
    std::optional<std::vector<Point>> divide(const Line& line) const {
        if (!piece_.sees(line.from, line.to)) return std::nullopt;
        const Point p = piece_.point(line.from), q = piece_.point(line.to);
        std::vector<Point> interior = separate(p, q, separation_);
        if (interior.size() + 1 < (line.from.loop != line.to.loop ? fewest_joining : fewest_segments))
            return std::nullopt;
        if (!alike(line.from, distance(p, interior.front())) || !alike(line.to, distance(q, interior.back())))
            return std::nullopt;
        std::vector<Point> chain{p};
        chain.insert(chain.end(), interior.begin(), interior.end());
        chain.push_back(q);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            if (!is_clear(chain[i], chain[i + 1], p, q)) return std::nullopt;
        return interior;
    }

    /// A length is like those of the edges beside a corner.
    bool alike(Corner c, double length) const {
        for (Corner other : {piece_.next(c), piece_.previous(c)}) {
            const double edge = distance(piece_.point(c), piece_.point(other));
            if (length > largest_ratio * edge || edge > largest_ratio * length) return false;
        }
        return true;
    }

    /// Whether a segment of the line from p to q and the border keep out of each other's diametral circles, and its
    /// vertices away from the border's.
    bool is_clear(Point a, Point b, Point p, Point q) const {
        const auto encroaches = [](Point x, Point u, Point v) { return dot(u - x, v - x) <= 0; };
        const double near = clearance * clearance * squared_length(b - a);
        bool clear = true;
        border_tree_.overlaps(circle_box(a, b, 0.5 + clearance), [&](std::size_t item) {
            const Point u = piece_.point(border_[item]), v = piece_.point(piece_.next(border_[item]));
            if (!(u == p) && !(u == q) && encroaches(u, a, b)) clear = false;
            for (Point x : {a, b}) {
                if (x == p || x == q) continue;
                if (encroaches(x, u, v) || squared_length(u - x) < near) clear = false;
            }
        });
        return clear;
    }
};

/// Pieces that are being cut, and those that are done.
class Cutting {
public:
    Cutting(const Separation& separation, double pieces_target)
        : separation_(separation), pieces_target_(pieces_target) {}

    std::vector<Verdict> judge(std::span<const Point> points, std::span<const Piece> pieces) const {
        return core::parallel_blocks(pieces.size(), 1, [&](std::size_t i, std::size_t) {
            return Search(points, pieces[i], separation_).run(pieces_target_);
        });
    }

    /// Cuts the pieces as judged. Those that come of it.
    std::vector<Piece> cut(Skeleton& skeleton, std::vector<Piece> pieces, std::span<const Verdict> verdicts) {
        std::vector<Piece> next;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const auto& cut = verdicts[i].cut;
            if (!cut) {
                whole.push_back({std::move(pieces[i]), verdicts[i].triangles, verdicts[i].lattice});
                continue;
            }
            std::vector<VertexId> line;
            for (Point p : cut->interior) line.push_back(skeleton.add_point(p));
            if (cut->from.loop != cut->to.loop) {
                next.push_back(join(pieces[i], cut->from, cut->to, line));
            } else {
                auto [first, second] = split(pieces[i], cut->from.place, cut->to.place, line);
                next.push_back(std::move(first));
                next.push_back(std::move(second));
            }
        }
        return next;
    }

    /// Level by level: the search for cuts, which takes the time, runs on all pieces of a level at once; then they are
    /// cut in order.
    void cut_all(Skeleton& skeleton, std::vector<Piece> pieces) {
        while (!pieces.empty()) {
            const std::vector<Verdict> verdicts = judge(skeleton.points, pieces);
            pieces = cut(skeleton, std::move(pieces), verdicts);
        }
    }

    std::vector<SizedPiece> whole;

private:
    const Separation& separation_;
    double pieces_target_;
};

}  // namespace

std::vector<SizedPiece> cut_to_size(Skeleton& skeleton, std::vector<Piece> pieces, const Separation& separation,
                                    double pieces_target) {
    // The piece round the bodies, which is cut many times over, would occupy one thread at first: the others judge the
    // rest meanwhile, none of which has to wait for a vertex that is still to come.
    const auto rest =
        std::stable_partition(pieces.begin(), pieces.end(), [](const Piece& p) { return p.loops.size() > 1; });
    std::vector<Piece> others(std::make_move_iterator(rest), std::make_move_iterator(pieces.end()));
    pieces.erase(rest, pieces.end());
    const std::vector<Point> points = skeleton.points;  // cutting appends to the skeleton's
    Cutting cutting(separation, pieces_target);
    std::vector<Verdict> verdicts;
    core::parallel_invoke([&] { cutting.cut_all(skeleton, std::move(pieces)); },
                          [&] { verdicts = cutting.judge(points, others); });
    cutting.cut_all(skeleton, cutting.cut(skeleton, std::move(others), verdicts));
    return std::move(cutting.whole);
}

}  // namespace lamina::decoupling
