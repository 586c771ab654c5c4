// check_piece() and PiecewiseCheck: the same findings as check_mesh(), and every damage to what is handed over is
// found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <lamina/predicates.hpp>

#include "core/edge_links.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/piecewise_check.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using core::EdgeLink;
using mesh::LinkedPiece;
using mesh::PiecewiseCheck;

/// A piece that owns its arrays.
struct OwnedPiece {
    std::vector<Point> border, inner;
    std::vector<VertexId> ids;
    std::vector<Triangle> triangles;
    core::EdgeLinks links;
};

/// A mesh without a layer in two parts: the triangles on both sides of the vertical line x = `cut`. Shared vertices
/// come first in the mesh.
struct CutMesh {
    std::vector<Point> shared;
    std::vector<OwnedPiece> pieces;
    std::vector<Marker> markers;
    std::vector<Segment> constraints;
};

/// Links triangles by a map of their edges.
core::EdgeLinks links_by_map(const std::vector<Triangle>& triangles) {
    std::map<Segment, EdgeLink> edges;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (unsigned i = 0; i < 3; ++i)
            edges[{triangles[t].v[i], triangles[t].v[(i + 1) % 3]}] = core::edge_link(t, i);
    core::EdgeLinks links(3 * triangles.size(), core::no_link);
    for (const auto& [ends, edge] : edges)
        if (const auto twin = edges.find({ends.b, ends.a}); twin != edges.end())
            links[3 * core::triangle_of(edge) + core::edge_of(edge)] = twin->second;
    return links;
}

/// Cuts a mesh of triangles. Vertices on its boundary, on markers and on the cut are shared. So is every `dangling`-th
/// vertex, as on lines of a border that dangle in a piece; 0: none.
CutMesh cut_mesh(const Mesh& mesh, double cut, std::size_t dangling = 0) {
    const std::size_t parts = 2;
    const auto part_of = [&](const Triangle& t) {
        double x = 0;
        for (const VertexId v : t.v) x += mesh.points[v.index()].x / 3;
        return x < cut ? 0u : 1u;
    };
    std::vector<unsigned> users(mesh.points.size(), 0);
    for (const Triangle& t : mesh.triangles)
        for (const VertexId v : t.v) users[v.index()] |= 1u << part_of(t);
    for (const Marker& marker : mesh.markers)
        for (const Segment& edge : marker.edges) users[edge.a.index()] = users[edge.b.index()] = 3;
    if (dangling > 0)
        for (std::size_t v = 0; v < users.size(); v += dangling) users[v] = 3;
    CutMesh result;
    std::vector<VertexId> shared_id(mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (users[v] != 3) continue;
        shared_id[v] = VertexId{result.shared.size()};
        result.shared.push_back(mesh.points[v]);
    }
    for (unsigned part = 0; part < parts; ++part) {
        OwnedPiece piece;
        std::vector<VertexId> local(mesh.points.size());
        std::vector<bool> used(mesh.points.size(), false);
        for (const Triangle& t : mesh.triangles)
            if (part_of(t) == part)
                for (const VertexId v : t.v) used[v.index()] = true;
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            if (!used[v] || !shared_id[v].valid()) continue;
            local[v] = VertexId{piece.border.size()};
            piece.border.push_back(mesh.points[v]);
            piece.ids.push_back(shared_id[v]);
        }
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            if (!used[v] || shared_id[v].valid()) continue;
            local[v] = VertexId{piece.border.size() + piece.inner.size()};
            piece.inner.push_back(mesh.points[v]);
        }
        for (const Triangle& t : mesh.triangles)
            if (part_of(t) == part)
                piece.triangles.push_back({{local[t.v[0].index()], local[t.v[1].index()], local[t.v[2].index()]}});
        piece.links = links_by_map(piece.triangles);
        result.pieces.push_back(std::move(piece));
    }
    result.markers = mesh.markers;
    for (Marker& marker : result.markers)
        for (Segment& edge : marker.edges) edge = {shared_id[edge.a.index()], shared_id[edge.b.index()]};
    return result;
}

MeshCheck check_pieces(const CutMesh& cut) {
    PiecewiseCheck check(cut.shared, {});
    std::vector<std::size_t> first;
    std::size_t next = 0;
    for (const OwnedPiece& piece : cut.pieces) {
        check.add_piece(mesh::check_piece(
            {piece.border, piece.ids, piece.inner, piece.triangles, piece.links, cut.shared}, proved_min_angle_deg));
        first.push_back(next);
        next += piece.triangles.size();
    }
    return check.finish(cut.markers, cut.constraints, first);
}

/// Returns a square with a hole, with vertices moved off the grid.
Mesh uneven_box(std::size_t n = 21) {
    Mesh mesh = test::box_with_hole(n);
    for (Point& p : mesh.points) {
        const bool inside = p.x > 0 && p.y > 0 && p.x < static_cast<double>(n) && p.y < static_cast<double>(n);
        if (inside && std::abs(p.x - static_cast<double>(n) / 2) > 1)
            p = {p.x + 0.2 * std::sin(3 * p.x + 5 * p.y), p.y + 0.2 * std::sin(7 * p.x - 2 * p.y)};
    }
    return mesh;
}

/// Checks the pieces without what lies behind their border edges, but for what is asked for.
MeshCheck check_pieces_elsewhere(const CutMesh& cut, std::size_t& told, std::size_t& border_edges) {
    PiecewiseCheck check(cut.shared, {});
    std::vector<std::size_t> first;
    std::vector<mesh::PieceBorderEdge> border;
    std::size_t next = 0;
    for (const OwnedPiece& piece : cut.pieces) {
        mesh::PieceFindings findings = mesh::check_piece(
            {piece.border, piece.ids, piece.inner, piece.triangles, piece.links, cut.shared}, proved_min_angle_deg);
        border.insert(border.end(), findings.border.begin(), findings.border.end());
        for (mesh::PieceBorderEdge& edge : findings.border) {
            edge.shape_class =
                mesh::shape_class_behind(cut.shared[edge.a.index()], cut.shared[edge.b.index()], edge.apex);
            edge.apex = mesh::unknown_apex;
        }
        check.add_piece(std::move(findings));
        first.push_back(next);
        next += piece.triangles.size();
    }
    for (const auto [e, apex] : check.wanted()) {
        const Point a = cut.shared[border[e].a.index()], b = cut.shared[border[e].b.index()];
        if (apex)
            check.set_apex(e, border[e].apex);
        else
            check.set_area(e, mesh::area_over(a, b, border[e].apex));
        ++told;
    }
    border_edges = border.size();
    return check.finish(cut.markers, cut.constraints, first);
}

TEST(PieceCheck, NeedsFewTrianglesBehindBorders) {
    for (const std::size_t n : {21u, 61u}) {
        const CutMesh pieces = cut_mesh(uneven_box(n), 10.5);
        const MeshCheck expected = check_pieces(pieces);
        ASSERT_TRUE(expected.valid());
        std::size_t told = 0, border_edges = 0;
        const MeshCheck check = check_pieces_elsewhere(pieces, told, border_edges);
        ASSERT_TRUE(check.valid());
        EXPECT_EQ(check.euler_characteristic, expected.euler_characteristic);
        EXPECT_EQ(check.interior_edges, expected.interior_edges);
        EXPECT_EQ(check.delaunay_violations, expected.delaunay_violations);
        EXPECT_EQ(check.isotropic.max_neighbour_area_ratio, expected.isotropic.max_neighbour_area_ratio);
        EXPECT_EQ(check.isotropic.p999_neighbour_area_ratio, expected.isotropic.p999_neighbour_area_ratio);
        EXPECT_LT(told, border_edges);
    }
}

/// Checks the pieces where edges that end at vertices from `from` on are matched by themselves, as by another process.
/// `damage` may change what that process gets. It looks for the outer edges, if they are given.
MeshCheck check_pieces_with_seams_elsewhere(const CutMesh& cut, VertexId from,
                                            const std::function<void(std::vector<mesh::PieceBorderEdge>&)>& damage = {},
                                            const std::optional<std::vector<Segment>>& outer = {}) {
    PiecewiseCheck check(cut.shared, {}, from);
    if (outer) check.expect_boundary(cut.markers, *outer);
    std::vector<mesh::PieceBorderEdge> elsewhere;
    std::set<VertexId> vertices;
    std::vector<std::size_t> first;
    std::size_t next = 0;
    const auto is_elsewhere = [&](VertexId v) { return !(v < from); };
    for (const OwnedPiece& piece : cut.pieces) {
        mesh::PieceFindings findings = mesh::check_piece(
            {piece.border, piece.ids, piece.inner, piece.triangles, piece.links, cut.shared}, proved_min_angle_deg);
        const auto goes = [&](const mesh::PieceBorderEdge& edge) { return is_elsewhere(std::max(edge.a, edge.b)); };
        std::copy_if(findings.border.begin(), findings.border.end(), std::back_inserter(elsewhere), goes);
        std::erase_if(findings.border, goes);
        std::copy_if(findings.border_vertices.begin(), findings.border_vertices.end(),
                     std::inserter(vertices, vertices.end()), is_elsewhere);
        std::erase_if(findings.border_vertices, is_elsewhere);
        check.add_piece(std::move(findings));
        first.push_back(next);
        next += piece.triangles.size();
    }
    if (damage) damage(elsewhere);
    mesh::Seams seams(cut.shared);
    seams.add(elsewhere);
    seams.match();
    mesh::SeamFindings found;
    found.edges = seams.pairs().edges;
    found.vertices = vertices.size();
    found.measures = seams.measure([](Segment) { return false; });
    for (const std::uint32_t e : seams.pairs().boundary) {
        const Segment edge = seams.edges()[e];
        if (outer && std::find(outer->begin(), outer->end(), edge) != outer->end())
            ++found.outer_edges;
        else
            found.one_sided.push_back(edge);
    }
    for (const std::uint32_t e : seams.pairs().overused) found.overused.push_back(seams.edges()[e]);
    check.add_seams(found);
    return check.finish(cut.markers, cut.constraints, first);
}

TEST(PieceCheck, TakesSeamsThatWereMatchedElsewhere) {
    const CutMesh pieces = cut_mesh(uneven_box(), 10.5);
    const MeshCheck expected = check_pieces(pieces);
    ASSERT_TRUE(expected.valid());
    for (const std::size_t from : {std::size_t{0}, pieces.shared.size() / 2, pieces.shared.size()}) {
        SCOPED_TRACE(from);
        const VertexId first{from};
        const MeshCheck check = check_pieces_with_seams_elsewhere(pieces, first);
        ASSERT_TRUE(check.valid()) << check.defects.front().description;
        EXPECT_EQ(check.euler_characteristic, expected.euler_characteristic);
        EXPECT_EQ(check.interior_edges, expected.interior_edges);
        EXPECT_EQ(check.delaunay_violations, expected.delaunay_violations);
        EXPECT_EQ(check.isotropic.max_neighbour_area_ratio, expected.isotropic.max_neighbour_area_ratio);
        EXPECT_EQ(check.isotropic.p999_neighbour_area_ratio, expected.isotropic.p999_neighbour_area_ratio);
        EXPECT_EQ(check.walls.edges, expected.walls.edges);
        if (from == pieces.shared.size()) continue;
        using Edges = std::vector<mesh::PieceBorderEdge>;
        EXPECT_FALSE(check_pieces_with_seams_elsewhere(pieces, first, [](Edges& edges) { edges.pop_back(); }).valid());
        EXPECT_FALSE(check_pieces_with_seams_elsewhere(pieces, first, [](Edges& edges) {
                         edges.push_back(edges.front());
                     }).valid());
        EXPECT_FALSE(check_pieces_with_seams_elsewhere(pieces, first, [](Edges& edges) {
                         std::swap(edges.front().a, edges.front().b);
                     }).valid());
    }
}

/// Returns the edges of all markers that end at vertices from this one on.
std::vector<Segment> marked_edges_from(VertexId from, const std::vector<Marker>& markers) {
    std::vector<Segment> edges;
    for (const Marker& marker : markers)
        for (const Segment& edge : marker.edges)
            if (!(std::max(edge.a, edge.b) < from)) edges.push_back(edge);
    return edges;
}

TEST(PieceCheck, FindsTheBoundaryThatWasExpected) {
    const CutMesh with_walls = cut_mesh(uneven_box(), 10.5);
    const MeshCheck expected = check_pieces(with_walls);
    ASSERT_TRUE(expected.valid());
    ASSERT_GT(expected.walls.edges, 0u);
    CutMesh without = with_walls;
    for (Marker& marker : without.markers) marker.kind = MarkerKind::far_field;
    for (const std::size_t from : {std::size_t{0}, with_walls.shared.size() / 2}) {
        SCOPED_TRACE(from);
        const VertexId first{from};
        std::vector<Segment> outer = marked_edges_from(first, with_walls.markers);
        // With walls among the outer edges, all is done at the end. Edges that are not looked for may be there.
        for (const bool all : {true, false})
            for (const CutMesh* pieces : std::initializer_list<const CutMesh*>{&with_walls, &without}) {
                if (!all) outer.resize(std::max<std::size_t>(1, outer.size() / 2));
                const MeshCheck check = check_pieces_with_seams_elsewhere(*pieces, first, {}, outer);
                ASSERT_TRUE(check.valid()) << check.defects.front().description;
                EXPECT_EQ(check.boundary_loops, expected.boundary_loops);
                EXPECT_EQ(check.area, expected.area);
                EXPECT_EQ(check.walls.edges, pieces == &with_walls ? expected.walls.edges : 0u);
            }
    }
}

TEST(PieceCheck, FindsDamageToABoundaryThatWasExpected) {
    CutMesh pieces = cut_mesh(uneven_box(), 10.5);
    for (Marker& marker : pieces.markers) marker.kind = MarkerKind::far_field;
    const VertexId first{pieces.shared.size() / 2};
    const std::vector<Segment> outer = marked_edges_from(first, pieces.markers);
    using Edges = std::vector<mesh::PieceBorderEdge>;
    const auto is_outer = [&](const mesh::PieceBorderEdge& edge) {
        return std::find(outer.begin(), outer.end(), Segment{edge.a, edge.b}) != outer.end();
    };
    const auto find_outer = [&](Edges& edges) { return std::find_if(edges.begin(), edges.end(), is_outer); };
    const std::pair<const char*, std::function<void(Edges&)>> damages[] = {
        {"lost", [&](Edges& edges) { edges.erase(find_outer(edges)); }},
        {"twice", [&](Edges& edges) { edges.push_back(*find_outer(edges)); }},
        {"turned", [&](Edges& edges) { std::swap(find_outer(edges)->a, find_outer(edges)->b); }},
        {"inner edge lost", [&](Edges& edges) { edges.erase(std::find_if_not(edges.begin(), edges.end(), is_outer)); }},
    };
    for (const auto& [what, damage] : damages)
        EXPECT_FALSE(check_pieces_with_seams_elsewhere(pieces, first, damage, outer).valid()) << what;
    const auto check_with = [&](const std::function<void(std::vector<Segment>&)>& change) {
        CutMesh damaged = pieces;
        for (Marker& marker : damaged.markers)
            if (marker.edges.size() > 1) change(marker.edges);
        return check_pieces_with_seams_elsewhere(damaged, first, {}, outer);
    };
    EXPECT_TRUE(check_with([](std::vector<Segment>&) {}).valid());
    EXPECT_FALSE(check_with([](std::vector<Segment>& edges) { edges.pop_back(); }).valid());
    EXPECT_FALSE(check_with([](std::vector<Segment>& edges) { edges.push_back(edges.front()); }).valid());
    EXPECT_FALSE(check_with([](std::vector<Segment>& edges) { std::swap(edges[0].a, edges[0].b); }).valid());
}

TEST(PieceCheck, CallsNoPairEvenThatIsNotDelaunay) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> x(-1.5, 2.5), y(0.01, 2);
    const Point a{0, 0}, b{1, 0};
    std::size_t even = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point above{x(random), y(random)}, below{x(random), -y(random)};
        const std::uint8_t one = mesh::shape_class_behind(a, b, above), other = mesh::shape_class_behind(b, a, below);
        const double ratio = std::max(above.y / -below.y, below.y / -above.y);
        EXPECT_GE(ratio, mesh::least_area_ratio(one, other));
        EXPECT_LT(ratio, mesh::largest_area_ratio(one, other));
        if (one == 0 || other == 0) continue;
        ++even;
        EXPECT_FALSE(incircle(a, b, above, below) > 0);
    }
    EXPECT_GT(even, 100u);
}

TEST(PieceCheck, FindsWhatTheCheckOfTheMeshFinds) {
    const Mesh whole = uneven_box();
    const MeshCheck expected = check_mesh(whole);
    ASSERT_TRUE(expected.valid());
    ASSERT_GT(expected.delaunay_violations, 0u);
    for (const double cut : {-1.0, 3.0, 10.5, 17.2}) {
        CutMesh pieces = cut_mesh(whole, cut, cut > 10 ? 7 : 0);
        if (cut < 0) pieces.pieces.erase(pieces.pieces.begin());  // it is empty
        const MeshCheck check = check_pieces(pieces);
        ASSERT_TRUE(check.valid()) << check.defects.front().description;
        EXPECT_NEAR(check.area, expected.area, 1e-9 * expected.area);
        EXPECT_EQ(check.euler_characteristic, expected.euler_characteristic);
        EXPECT_EQ(check.boundary_loops, expected.boundary_loops);
        EXPECT_EQ(check.interior_edges, expected.interior_edges);
        EXPECT_EQ(check.delaunay_violations, expected.delaunay_violations);
        EXPECT_EQ(check.isotropic.cells, expected.isotropic.cells);
        EXPECT_EQ(check.isotropic.min_angle_deg, expected.isotropic.min_angle_deg);
        EXPECT_EQ(check.isotropic.max_angle_deg, expected.isotropic.max_angle_deg);
        EXPECT_NEAR(check.isotropic.mean_min_angle_deg, expected.isotropic.mean_min_angle_deg, 1e-10);
        EXPECT_NEAR(check.isotropic.mean_ratio, expected.isotropic.mean_ratio, 1e-12);
        EXPECT_EQ(check.isotropic.angle_histogram, expected.isotropic.angle_histogram);
        EXPECT_EQ(check.isotropic.angles_below_bound, expected.isotropic.angles_below_bound);
        EXPECT_NEAR(check.isotropic.max_neighbour_area_ratio, expected.isotropic.max_neighbour_area_ratio, 1e-9);
        EXPECT_EQ(check.walls.edges, expected.walls.edges);
    }
}

/// Expects that the damage is found.
void expect_found(const std::string& what, const std::function<void(CutMesh&)>& damage) {
    CutMesh pieces = cut_mesh(uneven_box(), 10.5);
    ASSERT_TRUE(check_pieces(pieces).valid());
    damage(pieces);
    const MeshCheck check = check_pieces(pieces);
    EXPECT_FALSE(check.valid()) << what << " was not found";
    EXPECT_GT(check.defect_count, 0u);
    EXPECT_FALSE(check.defects.empty());
}

TEST(PieceCheck, FindsDamagedLinks) {
    const std::size_t links = cut_mesh(uneven_box(), 10.5).pieces[0].links.size();
    for (std::size_t k = 0; k < links; k += 7) {
        expect_found("a link that was dropped", [&](CutMesh& cut) {
            EdgeLink& link = cut.pieces[0].links[k];
            if (link == core::no_link)
                link = core::edge_link(0, 0);
            else
                link = core::no_link;
        });
        expect_found("a link to another edge", [&](CutMesh& cut) {
            EdgeLink& link = cut.pieces[0].links[k];
            link = link == core::edge_link(1, 1) ? core::edge_link(2, 1) : core::edge_link(1, 1);
        });
        expect_found("a link to itself", [&](CutMesh& cut) {
            cut.pieces[0].links[k] = core::edge_link(k / 3, static_cast<unsigned>(k % 3));
        });
        expect_found("a link out of range", [&](CutMesh& cut) { cut.pieces[0].links[k] = 0xfffffff0u; });
        expect_found("a pair that both have dropped", [&](CutMesh& cut) {
            // Between two border vertices the edges would still be matched with those of other pieces.
            core::EdgeLinks& all = cut.pieces[0].links;
            const std::vector<Triangle>& triangles = cut.pieces[0].triangles;
            const auto is_inner = [&](std::size_t i) {
                return triangles[i / 3].v[i % 3].index() >= cut.pieces[0].border.size();
            };
            std::size_t at = k % (all.size() / 2);
            while (!is_inner(at)) ++at;
            const EdgeLink twin = std::exchange(all[at], core::no_link);
            all[3 * core::triangle_of(twin) + core::edge_of(twin)] = core::no_link;
        });
    }
    expect_found("links that are too few", [](CutMesh& cut) { cut.pieces[0].links.pop_back(); });
    expect_found("two pairs that were exchanged", [](CutMesh& cut) {
        core::EdgeLinks& all = cut.pieces[0].links;
        const auto inner = [&](std::size_t from) {
            while (all[from] == core::no_link) ++from;
            return from;
        };
        const std::size_t a = inner(0), b = inner(a + 30);
        const auto index = [](EdgeLink link) { return 3 * core::triangle_of(link) + core::edge_of(link); };
        const std::size_t a_twin = index(all[a]), b_twin = index(all[b]);
        std::swap(all[a], all[b]);
        std::swap(all[a_twin], all[b_twin]);
    });
}

TEST(PieceCheck, FindsDamagedPieces) {
    expect_found("a triangle that was turned over",
                 [](CutMesh& cut) { std::swap(cut.pieces[0].triangles[5].v[0], cut.pieces[0].triangles[5].v[1]); });
    expect_found("a triangle that is missing", [](CutMesh& cut) {
        cut.pieces[1].triangles.pop_back();
        cut.pieces[1].links = links_by_map(cut.pieces[1].triangles);
    });
    expect_found("a triangle that is there twice", [](CutMesh& cut) {
        cut.pieces[1].triangles.push_back(cut.pieces[1].triangles[3]);
        cut.pieces[1].links = links_by_map(cut.pieces[1].triangles);
    });
    expect_found("a vertex out of range", [](CutMesh& cut) { cut.pieces[0].triangles[2].v[0] = VertexId{99'999u}; });
    expect_found("a vertex of no triangle", [](CutMesh& cut) { cut.pieces[0].inner.push_back({3.5, 3.5}); });
    expect_found("a vertex that is no number", [](CutMesh& cut) { cut.pieces[0].inner[0].x = std::nan(""); });
    expect_found("a vertex that folds its triangles", [](CutMesh& cut) { cut.pieces[0].inner[0].x += 5; });
    expect_found("a border vertex at another place", [](CutMesh& cut) { cut.pieces[0].border[0].x -= 1e-9; });
    expect_found("a border vertex of another name",
                 [](CutMesh& cut) { std::swap(cut.pieces[0].ids[0], cut.pieces[0].ids[1]); });
    expect_found("a piece that is there twice", [](CutMesh& cut) { cut.pieces.push_back(cut.pieces[0]); });
    expect_found("a piece that is missing", [](CutMesh& cut) { cut.pieces.pop_back(); });
    expect_found("a shared vertex of no piece", [](CutMesh& cut) { cut.shared.push_back({100, 100}); });
    expect_found("a marker edge that is missing", [](CutMesh& cut) { cut.markers[0].edges.pop_back(); });
    expect_found("a constraint that is no edge", [](CutMesh& cut) {
        cut.constraints = {{VertexId{0u}, VertexId{cut.shared.size() - 1}}};
    });
}

/// Two covers of one square, the second by triangles with vertices of their own, whose links are right.
TEST(PieceCheck, FindsASecondCoverWithRightLinks) {
    expect_found("a square that is covered twice", [](CutMesh& cut) {
        OwnedPiece& piece = cut.pieces[0];
        const std::size_t vertices = piece.border.size() + piece.inner.size(), triangles = piece.triangles.size();
        for (const Point p : std::vector<Point>(piece.border)) piece.inner.push_back(p);
        for (const Point p : std::vector<Point>(piece.inner.begin(),
                                                piece.inner.begin() + std::ptrdiff_t(vertices - piece.border.size())))
            piece.inner.push_back(p);
        for (std::size_t t = 0; t < triangles; ++t) {
            Triangle copy = piece.triangles[t];
            for (VertexId& v : copy.v) v = VertexId{v.index() + vertices};
            piece.triangles.push_back(copy);
        }
        piece.links = links_by_map(piece.triangles);
    });
}

}  // namespace
}  // namespace lamina
