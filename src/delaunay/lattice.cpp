// Large smooth regions need no refinement: an equilateral lattice is the best Delaunay mesh there is. The region is
// sorted into levels of edge length, each level gets its own lattice, and only the seams between the patches and the
// border are left to refinement.
//
//      border  ------------------------------
//               seam (refined)
//              /\/\/\/\/\/\/\/\/\/\/\/\    patch of level l, rows of bits:
//              \/\/\/\/\/\/\/\/\/\/\/\/    row j + 1   . 1 1 1 1 .
//               seam                       row j       1 1 1 1 1 .
//              /_\_/_\_/_\_/_\_/_\_/_\_    patch of level l + 1
//
// Odd rows are shifted by half an edge. All set operations on vertices (erosion, triangles) work on 64 at a time.
// Source of the idea: lattice interiors with refined seams, as in W. Bossen, P. Heckbert, A pliant method for
// anisotropic mesh generation, 5th Int. Meshing Roundtable (1996), and the figures in docs/decisions/0002.
#include "delaunay/lattice.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lamina::delaunay {

namespace {

/// Patches keep this distance from border and other patches, in lattice edges.
constexpr double seam_margin = 0.75;
constexpr double row_height = 0.86602540378443865;  // sqrt(3) / 2

using Word = std::uint64_t;
using Row = std::int64_t;

/// The vertices of one level's lattice: bits in rows.
struct Level {
    double edge = 0;
    Point origin;
    Box box;  ///< what the rows cover
    Row rows = 0;
    std::size_t words = 0;  ///< a row
    std::vector<Word> bits;

    bool is_empty() const { return box.lower.x > box.upper.x; }
    void include(const Box& b) {
        box.include(b.lower);
        box.include(b.upper);
    }
    void allocate() {
        rows = static_cast<Row>(box.height() / (edge * row_height)) + 2;
        words = static_cast<std::size_t>(box.width() / edge / 64) + 2;
        bits.assign(static_cast<std::size_t>(rows) * words, 0);
        origin = box.lower;
    }
    double shift(Row j) const { return (j & 1) != 0 ? 0.5 : 0.0; }
    Point point(Row j, std::size_t i) const {
        return {origin.x + edge * (static_cast<double>(i) + shift(j)),
                origin.y + (edge * row_height) * static_cast<double>(j)};
    }
    double row_y(Row j) const { return origin.y + (edge * row_height) * static_cast<double>(j); }
    /// Rows with y in [low, high], as a half-open range.
    std::pair<Row, Row> rows_between(double low, double high) const {
        const double step = edge * row_height;
        const double first = std::ceil((low - origin.y) / step), last = std::floor((high - origin.y) / step) + 1;
        return {static_cast<Row>(std::clamp(first, 0.0, static_cast<double>(rows))),
                static_cast<Row>(std::clamp(last, 0.0, static_cast<double>(rows)))};
    }
    /// Columns of row j with x in [low, high], as a half-open range.
    std::pair<std::size_t, std::size_t> columns_between(Row j, double low, double high) const {
        const auto count = static_cast<double>(64 * words);
        const double first = std::ceil((low - origin.x) / edge - shift(j));
        const double last = std::floor((high - origin.x) / edge - shift(j)) + 1;
        return {static_cast<std::size_t>(std::clamp(first, 0.0, count)),
                static_cast<std::size_t>(std::clamp(last, 0.0, count))};
    }
    Word* row(Row j) { return bits.data() + static_cast<std::size_t>(j) * words; }
    const Word* row(Row j) const { return bits.data() + static_cast<std::size_t>(j) * words; }
};

std::size_t count(const std::vector<Word>& bits) {
    std::size_t n = 0;
    for (Word w : bits) n += static_cast<std::size_t>(std::popcount(w));
    return n;
}

/// Applies f(word, mask) to the words of columns [first, last).
template <class F>
void for_columns(std::size_t first, std::size_t last, F&& f) {
    while (first < last) {
        const std::size_t word = first / 64, from = first % 64;
        const std::size_t to = std::min<std::size_t>(64, from + (last - first));
        const Word mask = (to == 64 ? ~Word{0} : (Word{1} << to) - 1) & ~((Word{1} << from) - 1);
        f(word, mask);
        first += to - from;
    }
}

/// Part of the region's box, the sizes in it, and the levels that they belong to.
struct Block {
    Box box;
    SizeCount count;
    int first, last;
};

/// The region's box in blocks: those fit for a patch, and how many triangles lie in them and in all (about).
struct Blocks {
    std::vector<Block> smooth;
    double triangles_in_smooth = 0, triangles = 0;
};

/// Halves blocks until they belong to one level or are too small for a patch.
Blocks find_smooth_blocks(const Box& region, const SizeField& size, const std::vector<double>& edges) {
    Blocks blocks;
    std::vector<Box> open{region};
    while (!open.empty()) {
        const Box box = open.back();
        open.pop_back();
        const auto [low, high] = size.range(box, level_ratio * level_ratio);
        const int first_level = level_of(low, edges), last_level = level_of(high, edges);
        const double extent = std::max(box.width(), box.height());
        bool divisible = first_level != last_level && extent > 2 * smallest_block * low;
        if (!divisible && high > level_ratio * level_ratio * low)
            divisible = extent > 2 * smallest_block * size.range(box).low;
        if (divisible) {
            const Point c = box.center();
            Box first = box, second = box;
            if (box.width() > box.height())
                first.upper.x = second.lower.x = c.x;
            else
                first.upper.y = second.lower.y = c.y;
            open.push_back(second);
            open.push_back(first);
            continue;
        }
        const double triangles = box.width() * box.height() / (0.5 * row_height * low * high);
        blocks.triangles += triangles;
        if (high > level_ratio * low) continue;
        blocks.triangles_in_smooth += triangles;
        blocks.smooth.push_back({box, {low, high, triangles}, first_level, last_level});
    }
    return blocks;
}

/// Levels for the sizes of the blocks, which are told theirs.
std::vector<double> choose_levels(double low, double high, std::vector<Block>& blocks) {
    std::vector<SizeCount> counts;
    for (const Block& block : blocks) counts.push_back(block.count);
    std::vector<double> edges = level_edges(low, high, std::move(counts));
    for (Block& block : blocks) {
        block.first = level_of(block.count.low, edges);
        block.last = level_of(block.count.high, edges);
    }
    return edges;
}

/// Sets the vertices inside the block whose size belongs to the level.
void set_block(Level& level, const Block& block, const SizeField& size, double low, double high) {
    const bool all = block.first == block.last;
    const auto [first_row, last_row] = level.rows_between(block.box.lower.y, block.box.upper.y);
    for (Row j = first_row; j < last_row; ++j) {
        const auto [first, last] = level.columns_between(j, block.box.lower.x, block.box.upper.x);
        Word* row = level.row(j);
        if (all) {
            for_columns(first, last, [&](std::size_t w, Word mask) { row[w] |= mask; });
            continue;
        }
        for (std::size_t i = first; i < last; ++i) {
            const double h = size(level.point(j, i));
            if (h >= low && h < high) row[i / 64] |= Word{1} << (i % 64);
        }
    }
}

/// Clears every vertex that is not inside the region, by the crossings of each row with the segments.
void clear_outside(Level& level, std::span<const Point> points, std::span<const Segment> segments) {
    std::vector<std::pair<Row, double>> crossings;
    for (const Segment& s : segments) {
        Point a = points[s.a.index()], b = points[s.b.index()];
        if (a.y > b.y) std::swap(a, b);
        // Rows with a.y < y <= b.y: a vertex on a row counts for one of its two edges.
        auto [first, last] = level.rows_between(a.y, b.y);
        for (Row j = first; j < last; ++j) {
            const double y = level.row_y(j);
            if (y <= a.y || y > b.y) continue;
            crossings.emplace_back(j, a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t k = 0;
    const auto clear = [&](Row j, std::size_t first, std::size_t last) {
        Word* row = level.row(j);
        for_columns(first, last, [&](std::size_t w, Word mask) { row[w] &= ~mask; });
    };
    for (Row j = 0; j < level.rows; ++j) {
        std::size_t outside_from = 0;
        for (; k + 1 < crossings.size() && crossings[k].first == j; k += 2) {
            const auto [first, last] = level.columns_between(j, crossings[k].second, crossings[k + 1].second);
            clear(j, outside_from, first);
            outside_from = std::max(outside_from, last);
        }
        clear(j, outside_from, 64 * level.words);
    }
}

/// Clears the vertices within the seam margin of the straight line a-b.
void clear_near(Level& level, Point a, Point b) {
    const double margin = seam_margin * level.edge;
    Box box;
    box.include(a);
    box.include(b);
    box.lower = box.lower - Point{margin, margin};
    box.upper = box.upper + Point{margin, margin};
    if (!box.overlaps(level.box)) return;
    const auto [first_row, last_row] = level.rows_between(box.lower.y, box.upper.y);
    const Point low = a.y <= b.y ? a : b, high = a.y <= b.y ? b : a;
    for (Row j = first_row; j < last_row; ++j) {
        const double y = level.row_y(j);
        // Extent in x of the part of the line within the margin of this row, widened by the margin: a little more than
        // the exact neighbourhood.
        const double height = high.y - low.y;
        const auto x_at = [&](double at) {
            return height > 0 ? low.x + std::clamp((at - low.y) / height, 0.0, 1.0) * (high.x - low.x) : low.x;
        };
        double x0 = x_at(y - margin), x1 = x_at(y + margin);
        if (height == 0) x1 = high.x;
        const double off = std::max({0.0, low.y - y, y - high.y});
        const double reach = std::sqrt(std::max(0.0, margin * margin - off * off));
        const auto [first, last] = level.columns_between(j, std::min(x0, x1) - reach, std::max(x0, x1) + reach);
        Word* row = level.row(j);
        for_columns(first, last, [&](std::size_t w, Word mask) { row[w] &= ~mask; });
    }
}

/// Row j of the bits moved so that bit i holds what was at column i + 1 (or i - 1).
Word from_right(const Word* row, std::size_t w, std::size_t words) {
    return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
}
Word from_left(const Word* row, std::size_t w) { return row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0); }

/// No bit in the word of three rows, nor in the columns beside it: most words of a narrow level in a wide box.
bool is_far_from_all(const Word* here, const Word* below, const Word* above, std::size_t w, std::size_t words) {
    Word near = here[w] | below[w] | above[w];
    if (w > 0) near |= (here[w - 1] | below[w - 1] | above[w - 1]) >> 63;
    if (w + 1 < words) near |= (here[w + 1] | below[w + 1] | above[w + 1]) << 63;
    return near == 0;
}

/// Columns of the two neighbours in the rows above and below: i - 1 and i for even rows, i and i + 1 for odd ones.
enum class Combine { all, any };
template <Combine combine>
std::vector<Word> with_neighbours(const Level& level, const std::vector<Word>& bits) {
    std::vector<Word> result(bits.size(), 0);
    const std::size_t words = level.words;
    const std::vector<Word> none(words, 0);
    for (Row j = 0; j < level.rows; ++j) {
        const Word* here = bits.data() + static_cast<std::size_t>(j) * words;
        const Word* below = j > 0 ? here - words : none.data();
        const Word* above = j + 1 < level.rows ? here + words : none.data();
        const bool odd = (j & 1) != 0;
        for (std::size_t w = 0; w < words; ++w) {
            if (combine == Combine::all ? here[w] == 0 : is_far_from_all(here, below, above, w, words)) continue;
            const Word n[6] = {from_left(here, w), from_right(here, w, words),
                               below[w],           odd ? from_right(below, w, words) : from_left(below, w),
                               above[w],           odd ? from_right(above, w, words) : from_left(above, w)};
            Word r = here[w];
            for (Word x : n) r = combine == Combine::all ? r & x : r | x;
            result[static_cast<std::size_t>(j) * words + w] = r;
        }
    }
    return result;
}

/// The vertices of a level's patch, from the inside out.
struct Rings {
    std::vector<Word> centres;  ///< all six triangles belong to the patch
    std::vector<Word> patch;    ///< centres and their neighbours: the vertices of the patch
};

/// Opens the level's vertices by hexagons two rows wide (no thin fingers, no crumbs) and peels the collar off.
Rings open(Level& level) {
    Rings rings;
    rings.centres = with_neighbours<Combine::all>(level, with_neighbours<Combine::all>(level, level.bits));
    rings.patch = with_neighbours<Combine::any>(level, rings.centres);
    level.bits = with_neighbours<Combine::any>(level, rings.patch);
    return rings;
}

/// A run of vertices in a row, by its end points.
struct Run {
    Point first, last;
};

std::vector<Run> runs_of(const Level& level) {
    std::vector<Run> runs;
    for (Row j = 0; j < level.rows; ++j) {
        const Word* row = level.row(j);
        std::size_t start = 0;
        bool in_run = false;
        for (std::size_t w = 0; w < level.words; ++w) {
            // What ends the present state: a bit that is set outside a run, or clear inside one.
            for (Word change = in_run ? ~row[w] : row[w]; change != 0;) {
                const auto bit = static_cast<unsigned>(std::countr_zero(change));
                const std::size_t column = 64 * w + bit;
                if (in_run)
                    runs.push_back({level.point(j, start), level.point(j, column - 1)});
                else
                    start = column;
                in_run = !in_run;
                change = (in_run ? ~row[w] : row[w]) & ~((Word{1} << bit) - 1);
            }
        }
        if (in_run) runs.push_back({level.point(j, start), level.point(j, 64 * level.words - 1)});
    }
    return runs;
}

/// Triangles of the patch by their horizontal edge (i, i + 1) of row j: `up` with the apex in row j + 1, `down` with
/// the apex in row j - 1. A triangle belongs to the patch if one of its corners is a centre.
struct TriangleBits {
    std::vector<Word> up, down;
};

TriangleBits triangle_bits(const Level& level, const Rings& rings) {
    const std::size_t words = level.words;
    TriangleBits bits{std::vector<Word>(level.bits.size(), 0), std::vector<Word>(level.bits.size(), 0)};
    const std::vector<Word> none(words, 0);
    for (Row j = 0; j < level.rows; ++j) {
        const std::size_t base = static_cast<std::size_t>(j) * words;
        const bool odd = (j & 1) != 0;
        const auto apex = [&](const Word* row, std::size_t w) { return odd ? from_right(row, w, words) : row[w]; };
        const Word* here = rings.centres.data() + base;
        const Word* above = j + 1 < level.rows ? here + words : none.data();
        const Word* below = j > 0 ? here - words : none.data();
        for (std::size_t w = 0; w < words; ++w) {
            if (is_far_from_all(here, below, above, w, words)) continue;
            const Word edge = here[w] | from_right(here, w, words);
            bits.up[base + w] = edge | apex(above, w);
            bits.down[base + w] = edge | apex(below, w);
        }
    }
    return bits;
}

template <class F>
void for_bits(Word bits, std::size_t w, F&& f) {
    for (; bits != 0; bits &= bits - 1) f(64 * w + static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Appends the vertices of row j and notes their numbers by column.
void emit_row(const Level& level, const Rings& rings, Row j, std::vector<std::uint32_t>& ids, LatticePatches& patches) {
    const std::size_t base = static_cast<std::size_t>(j) * level.words;
    const double y = level.row_y(j), shift = level.shift(j);
    for (std::size_t w = 0; w < level.words; ++w) {
        for_bits(level.bits[base + w], w, [&](std::size_t i) {
            ids[i] = static_cast<std::uint32_t>(patches.points.size());
            patches.points.push_back({level.origin.x + level.edge * (static_cast<double>(i) + shift), y});
        });
        for_bits(level.bits[base + w] & ~rings.patch[base + w], w,
                 [&](std::size_t i) { patches.collar.push_back(VertexId{ids[i]}); });
    }
}

/// Appends the triangles between rows j and j + 1, and the edges of theirs across which there is no triangle of the
/// patch, directed with the seam on the left: against the triangle.
///
///          c ------- d          up (i):   a, b, c with c = i (i + 1 in odd rows) of row j + 1;
///        /   \     /            down (k): d, c, b with b = k + 1 (k in even rows' terms: see `apex`)
///       a --- b --
void emit_strip(const Level& level, const TriangleBits& bits, Row j, const std::vector<std::uint32_t>& here,
                const std::vector<std::uint32_t>& above, LatticePatches& patches) {
    const std::size_t words = level.words, base = static_cast<std::size_t>(j) * words;
    const std::size_t odd = (j & 1) != 0 ? 1 : 0;
    const Word* up = bits.up.data() + base;
    const Word* down_here = bits.down.data() + base;
    const Word* down = bits.down.data() + base + words;
    const Word* up_above = bits.up.data() + base + words;
    const auto vertex = [](const std::vector<std::uint32_t>& ids, std::size_t i) {
        return VertexId{std::size_t{ids[i]}};
    };
    const auto rim = [&](VertexId a, VertexId b) { patches.rim.push_back({b, a}); };
    for (std::size_t w = 0; w < words; ++w) {
        if ((up[w] | down[w]) == 0) continue;
        // As a strip: every triangle beside the one before. The apex of a down triangle of an even row lies in an odd
        // one, and the other way round.
        const auto add_up = [&](std::size_t i) {
            patches.triangles.push_back({{vertex(here, i), vertex(here, i + 1), vertex(above, i + odd)}});
        };
        const auto add_down = [&](std::size_t i) {
            patches.triangles.push_back({{vertex(above, i + 1), vertex(above, i), vertex(here, i + 1 - odd)}});
        };
        for_bits(up[w] | down[w], w, [&](std::size_t i) {
            const Word bit = Word{1} << (i % 64);
            if (odd != 0 && (down[w] & bit) != 0) add_down(i);
            if ((up[w] & bit) != 0) add_up(i);
            if (odd == 0 && (down[w] & bit) != 0) add_down(i);
        });
        for_bits(up[w] & ~down_here[w], w, [&](std::size_t i) { rim(vertex(here, i), vertex(here, i + 1)); });
        for_bits(down[w] & ~up_above[w], w, [&](std::size_t i) { rim(vertex(above, i + 1), vertex(above, i)); });
        // Right of up (i) lies down (i + odd), left of it down (i + odd - 1).
        const Word right_of_up = odd != 0 ? from_right(down, w, words) : down[w];
        const Word left_of_up = odd != 0 ? down[w] : from_left(down, w);
        for_bits(up[w] & ~right_of_up, w, [&](std::size_t i) { rim(vertex(here, i + 1), vertex(above, i + odd)); });
        for_bits(up[w] & ~left_of_up, w, [&](std::size_t i) { rim(vertex(above, i + odd), vertex(here, i)); });
        // Left of down (i) lies up (i - odd), right of it up (i + 1 - odd).
        const Word left_of_down = odd != 0 ? from_left(up, w) : up[w];
        const Word right_of_down = odd != 0 ? up[w] : from_right(up, w, words);
        for_bits(down[w] & ~left_of_down, w, [&](std::size_t i) { rim(vertex(above, i), vertex(here, i + 1 - odd)); });
        for_bits(down[w] & ~right_of_down, w,
                 [&](std::size_t i) { rim(vertex(here, i + 1 - odd), vertex(above, i + 1)); });
    }
}

/// Appends the level's vertices, triangles, rim and collar.
void emit(const Level& level, const Rings& rings, LatticePatches& patches) {
    const TriangleBits bits = triangle_bits(level, rings);
    std::vector<std::uint32_t> here(64 * level.words + 1, 0), above(here);
    emit_row(level, rings, 0, here, patches);
    for (Row j = 0; j + 1 < level.rows; ++j) {
        emit_row(level, rings, j + 1, above, patches);
        emit_strip(level, bits, j, here, above, patches);
        std::swap(here, above);
    }
}

}  // namespace

std::vector<double> level_edges(double low, double high, std::vector<SizeCount> counts) {
    // Of single precision, as the size field is; of one size is what differs by less.
    constexpr double rounding = 1e-6, alike = 1e-3;
    std::erase_if(counts, [](const SizeCount& c) { return c.high > (1 + alike) * c.low; });
    std::sort(counts.begin(), counts.end(), [](const SizeCount& a, const SizeCount& b) {
        return a.low != b.low ? a.low < b.low : a.triangles < b.triangles;
    });
    double foot = low, most = 0;
    for (std::size_t i = 0; i < counts.size();) {
        const double first = counts[i].low;
        double triangles = 0;
        for (; i < counts.size() && counts[i].low <= (1 + alike) * first; ++i) triangles += counts[i].triangles;
        if (triangles <= most) continue;
        most = triangles;
        foot = (1 - rounding) * first;
    }
    while (foot > low) foot /= level_ratio;
    std::vector<double> edges{lattice_share * foot};
    while (edges.back() <= lattice_share * high) edges.push_back(edges.back() * level_ratio);
    return edges;
}

int level_of(double size, const std::vector<double>& edges) {
    return static_cast<int>(std::upper_bound(edges.begin(), edges.end(), lattice_share * size) - edges.begin()) - 1;
}

LatticePatches fill_with_lattice(std::span<const Point> points, std::span<const Segment> segments,
                                 const SizeField& size, std::size_t max_points) {
    LatticePatches patches;
    Box region;
    for (const Segment& s : segments) region.include(points[s.a.index()]);
    const auto [low, high] = size.range(region);
    Blocks blocks = find_smooth_blocks(region, size, level_edges(low, high, {}));
    constexpr double worthwhile_share = 0.4;
    if (blocks.triangles_in_smooth < worthwhile_share * blocks.triangles) return patches;

    const std::vector<double> edges = choose_levels(low, high, blocks.smooth);
    std::vector<Level> levels(edges.size() - 1);
    for (std::size_t l = 0; l < levels.size(); ++l) levels[l].edge = edges[l];
    for (const Block& b : blocks.smooth)
        for (int l = b.first; l <= b.last; ++l) levels[l].include(b.box);
    // Narrow bands in a wide box waste their bits; so does a region that fills little of its box.
    double bits = 0;
    for (const Level& level : levels)
        if (!level.is_empty()) bits += level.box.width() * level.box.height() / (level.edge * level.edge);
    if (bits > 1e6 + 64 * blocks.triangles_in_smooth || bits > 64 * static_cast<double>(max_points)) return patches;
    for (Level& level : levels)
        if (!level.is_empty()) level.allocate();
    for (const Block& b : blocks.smooth)
        for (int l = b.first; l <= b.last; ++l)
            set_block(levels[l], b, size, edges[l] / lattice_share, edges[l + 1] / lattice_share);

    std::erase_if(levels, [](const Level& level) { return level.is_empty(); });
    std::vector<Rings> rings;
    std::vector<std::vector<Run>> runs;
    std::size_t vertices = 0;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        Level& level = levels[l];
        clear_outside(level, points, segments);
        for (const Segment& s : segments) clear_near(level, points[s.a.index()], points[s.b.index()]);
        for (std::size_t finer = 0; finer < l; ++finer)
            if (levels[finer].box.overlaps(level.box))
                for (const Run& run : runs[finer]) clear_near(level, run.first, run.last);
        rings.push_back(open(level));
        runs.push_back(runs_of(level));
        vertices += count(level.bits);
    }
    // With room for what the seam will add behind.
    patches.points.reserve(vertices + vertices / 2);
    patches.triangles.reserve(3 * vertices);
    runs = {};
    for (std::size_t l = 0; l < levels.size(); ++l) {
        emit(levels[l], rings[l], patches);
        levels[l] = {};
        rings[l] = {};
    }
    // A point of rim or collar costs about as much as two triangles of a patch save.
    if (patches.triangles.size() < 3 * (patches.rim.size() + patches.collar.size())) return {};
    return patches;
}

}  // namespace lamina::delaunay
