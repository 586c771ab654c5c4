// Large smooth regions need no refinement: an equilateral lattice is the best Delaunay mesh there is. The region is
// divided into levels of edge length, each level gets its own lattice, and only the seams between the patches and the
// border are left to refinement.
//
//      border  ------------------------------
//               seam (refined)
//              /\/\/\/\/\/\/\/\/\/\/\/\    patch of level l
//              \/\/\/\/\/\/\/\/\/\/\/\/
//               seam
//              /_\_/_\_/_\_/_\_/_\_/_\_    patch of level l + 1
//
// Source: lattice interiors with refined seams, as in W. Bossen, P. Heckbert, A pliant method for anisotropic mesh
// generation, 5th Int. Meshing Roundtable (1996).
#include "delaunay/refine/lattice.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/bounding_box.hpp"
#include "delaunay/refine/lattice_grid.hpp"
#include "delaunay/refine/lattice_levels.hpp"

namespace lamina::delaunay {

namespace {

/// Patches keep this distance from the border and from other patches, in lattice edges.
constexpr double seam_margin = 0.75;
/// No lattice is made where smooth blocks hold less than this share of the triangles.
constexpr double min_smooth_share = 0.4;

/// Rounding leaves 1e-16 of an edge where a coordinate of a lattice should vanish. Lattices of smaller sizes would have
/// coordinates below the range of exact arithmetic (docs/decisions/0001).
constexpr double min_lattice_size = 1e-40;

/// A part of the region's box, the sizes in it, and the levels that serve them.
struct LatticeBlock {
    Box box;
    SizeBin sizes;
    int first_level, last_level;
};

/// The blocks of the region's box that suit a patch, and about how many triangles lie in them and in the whole box.
struct SmoothBlocks {
    std::vector<LatticeBlock> blocks;
    double triangles_in_blocks = 0, triangles = 0;
};

/// Halves the region's box until blocks belong to one level or are too small for a patch.
SmoothBlocks find_smooth_blocks(const Box& region, const SizeField& size, const LatticeLevels& levels) {
    SmoothBlocks found;
    std::vector<Box> pending{region};
    while (!pending.empty()) {
        const Box box = pending.back();
        pending.pop_back();
        const auto [low, high] = size.range(box, level_ratio * level_ratio);
        const int first_level = levels.level_of(low), last_level = levels.level_of(high);
        const double extent = core::longer_side(box);
        bool divisible = first_level != last_level && extent > 2 * min_block_edges * low;
        if (!divisible && high > level_ratio * level_ratio * low)
            divisible = extent > 2 * min_block_edges * size.range(box).low;
        if (divisible) {
            const Point c = box.center();
            Box first = box, second = box;
            if (box.width() > box.height())
                first.upper.x = second.lower.x = c.x;
            else
                first.upper.y = second.lower.y = c.y;
            pending.push_back(second);
            pending.push_back(first);
            continue;
        }
        const double triangles = box.width() * box.height() / (0.5 * lattice_row_height * low * high);
        found.triangles += triangles;
        if (high > level_ratio * low) continue;
        found.triangles_in_blocks += triangles;
        found.blocks.push_back({box, {low, high, triangles}, first_level, last_level});
    }
    return found;
}

/// Returns levels that suit the sizes of the blocks, and sets the levels of each block.
LatticeLevels choose_levels(double low, double high, double max_area_ratio, std::vector<LatticeBlock>& blocks) {
    std::vector<SizeBin> bins;
    bins.reserve(blocks.size());
    for (const LatticeBlock& block : blocks) bins.push_back(block.sizes);
    LatticeLevels levels = lattice_levels(low, high, max_area_ratio, std::move(bins));
    for (LatticeBlock& block : blocks) {
        block.first_level = levels.level_of(block.sizes.low);
        block.last_level = levels.level_of(block.sizes.high);
    }
    return levels;
}

/// Adds the vertices inside the block whose size is in [low, high), the sizes of the grid's level.
void set_block(LatticeGrid& grid, const LatticeBlock& block, const SizeField& size, double low, double high) {
    const bool has_one_level = block.first_level == block.last_level;
    const auto [first_row, last_row] = grid.rows_between(block.box.lower.y, block.box.upper.y);
    for (LatticeRow j = first_row; j < last_row; ++j) {
        const auto [first, last] = grid.columns_between(j, block.box.lower.x, block.box.upper.x);
        LatticeWord* row = grid.row(j);
        if (has_one_level) {
            for_columns(first, last, [&](std::size_t w, LatticeWord mask) { row[w] |= mask; });
            continue;
        }
        for (std::size_t i = first; i < last; ++i) {
            const double h = size(grid.point(j, i));
            if (h >= low && h < high) row[i / 64] |= LatticeWord{1} << (i % 64);
        }
    }
}

/// Returns one grid for each level, from the finest to the coarsest, whose box holds the blocks of the level. No memory
/// is allocated for vertices yet.
std::vector<LatticeGrid> make_grids(const std::vector<LatticeBlock>& blocks, const LatticeLevels& levels) {
    std::vector<LatticeGrid> grids(levels.edges.size() - 1);
    for (std::size_t l = 0; l < grids.size(); ++l) grids[l].edge = levels.edges[l];
    for (const LatticeBlock& block : blocks)
        for (int l = block.first_level; l <= block.last_level; ++l) grids[l].include(block.box);
    return grids;
}

/// Returns the number of vertices that the boxes of all grids have room for, about: one bit of memory each.
double grid_capacity(const std::vector<LatticeGrid>& grids) {
    double bits = 0;
    for (const LatticeGrid& grid : grids)
        if (!grid.is_empty()) bits += grid.box.width() * grid.box.height() / (grid.edge * grid.edge);
    return bits;
}

/// Allocates the grids, adds the vertices of the blocks to them, and drops the grids of levels without blocks.
void fill_grids(std::vector<LatticeGrid>& grids, const std::vector<LatticeBlock>& blocks, const LatticeLevels& levels,
                const SizeField& size) {
    for (LatticeGrid& grid : grids)
        if (!grid.is_empty()) grid.allocate();
    for (const LatticeBlock& block : blocks)
        for (int l = block.first_level; l <= block.last_level; ++l)
            set_block(grids[l], block, size, levels.smallest_size(l), levels.smallest_size(l + 1));
    std::erase_if(grids, [](const LatticeGrid& grid) { return grid.is_empty(); });
}

/// Removes the vertices outside the region, near its border, near points and obstacles and near the patches of finer
/// levels, and what is too narrow for a patch. Returns the vertices of each level's patch.
std::vector<PatchVertices> cut_out_patches(std::vector<LatticeGrid>& grids, std::span<const Point> points,
                                           std::span<const Segment> segments,
                                           std::span<const LatticeObstacle> obstacles) {
    std::vector<PatchVertices> patches;
    std::vector<std::vector<LatticeRun>> runs;
    for (LatticeGrid& grid : grids) {
        const double margin = seam_margin * grid.edge;
        clear_outside(grid, points, segments);
        for (const Segment& s : segments) clear_near(grid, points[s.a.index()], points[s.b.index()], margin);
        for (const Point p : points) clear_near(grid, p, p, margin);
        for (const LatticeObstacle& o : obstacles) clear_near(grid, o.at, o.at, std::max(margin, o.radius));
        for (std::size_t finer = 0; finer < runs.size(); ++finer) {
            if (!grids[finer].box.overlaps(grid.box)) continue;
            for (const LatticeRun& run : runs[finer]) clear_near(grid, run.first, run.last, margin);
        }
        patches.push_back(open_patch(grid));
        runs.push_back(runs_of(grid));
    }
    return patches;
}

/// Joins the patches of all levels. Frees the memory of each level once it is copied.
LatticePatches join_patches(std::vector<LatticeGrid> grids, std::vector<PatchVertices> patches, bool linked) {
    std::size_t vertices = 0;
    for (const LatticeGrid& grid : grids) vertices += count_vertices(grid);
    LatticePatches joined;
    joined.linked = linked;
    joined.points.reserve(vertices + vertices / 2);  // refine() appends the Steiner points of the seam
    joined.triangles.reserve(3 * vertices);
    if (linked) joined.links.reserve(9 * vertices);
    for (std::size_t l = 0; l < grids.size(); ++l) {
        append_patch(grids[l], patches[l], joined);
        grids[l] = {};
        patches[l] = {};
    }
    return joined;
}

}  // namespace

LatticePatches fill_with_lattice(std::span<const Point> points, std::span<const Segment> segments,
                                 const SizeField& size, const RefineOptions& options,
                                 std::span<const LatticeObstacle> obstacles, bool linked) {
    Box region;
    for (const Segment& s : segments) region.include(points[s.a.index()]);
    const auto [low, high] = size.range(region);
    if (low < min_lattice_size) return {};
    SmoothBlocks smooth = find_smooth_blocks(region, size, lattice_levels(low, high, options.max_area_ratio, {}));
    if (smooth.triangles_in_blocks < min_smooth_share * smooth.triangles) return {};

    const LatticeLevels levels = choose_levels(low, high, options.max_area_ratio, smooth.blocks);
    std::vector<LatticeGrid> grids = make_grids(smooth.blocks, levels);
    // Narrow bands in a wide box waste their bits; so does a region that fills little of its box.
    const double bits = grid_capacity(grids);
    if (bits > 1e6 + 64 * smooth.triangles_in_blocks || bits > 64 * static_cast<double>(options.max_points)) return {};
    fill_grids(grids, smooth.blocks, levels, size);
    std::vector<PatchVertices> vertices = cut_out_patches(grids, points, segments, obstacles);
    LatticePatches patches = join_patches(std::move(grids), std::move(vertices), linked);
    // A point on the boundary or in the collar costs about as much as two triangles of a patch save.
    if (patches.triangles.size() < 3 * (patches.boundary.size() + patches.collar.size())) return {};
    return patches;
}

}  // namespace lamina::delaunay
