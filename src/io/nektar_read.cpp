// Reads plane meshes of Nektar++ from XML that is not compressed: vertices, edges, triangles and quadrilaterals made of
// edges, curves of edges and cells, and composites. Source: Nektar++ user guide, "XML session file, Geometry"; Nektar++
// 5, library/SpatialDomains, MeshGraphIOXml.cpp, TriGeom.cpp and QuadGeom.cpp.
//
// Composites of edges become markers, and composites of cells become regions where all cells are in one of the name
// of a region. Curves have one order, and are evenly spaced or Gauss and Lobatto's. What has no curve is straight; a
// cell that has none is between the curves of its edges.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "core/marker_names.hpp"
#include "io/curved_lists.hpp"
#include "io/file_numbers.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/nektar_nodes.hpp"
#include "io/number_text.hpp"
#include "io/vtk_tags.hpp"
#include "mesh/cell_lattice.hpp"

namespace lamina::io {

namespace {

/// The points of a curve as the file has them.
struct NektarCurve {
    std::string_view type;
    std::vector<Point> points;
};

/// A cell as the file has it.
struct NektarCell {
    std::size_t corners;
    std::array<std::size_t, 4> edges;  ///< their numbers in the file, then their positions
};

/// A composite as the file has it.
struct NektarComposite {
    std::string name;
    char kind;                                                ///< V, E, T or Q
    std::vector<std::pair<std::size_t, std::size_t>> ranges;  ///< of numbers, the last ones included
};

/// What a file lists, by the numbers in it.
struct NektarLists {
    FileNumbers vertices{0}, edges{0}, cells{0};
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 2>> ends;
    std::vector<NektarCell> cells_of_edges;
    std::map<std::size_t, NektarCurve> curves_of_edges, curves_of_cells;
    std::vector<NektarComposite> composites;
};

// ---- the file --------------------------------------------------------------------------------------------------------

class NektarFile {
public:
    NektarFile(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)), tags_(bytes) {}

    NektarLists read() {
        VtkTag tag;
        do {
            if (!tags_.next(tag)) fail("no <GEOMETRY>");
        } while (tag.name != "GEOMETRY");
        if (tag.value("DIM") != "2") fail("meshes of DIM=\"2\" are read");
        while (next_of("GEOMETRY", tag)) {
            const std::string_view section = tag.name;
            if (const std::string_view how = tag.value("COMPRESSED"); !how.empty())
                fail(fmt::format("{} is compressed ({}): NekMesh OLD.xml NEW.xml:xml:uncompress", printable(section),
                                 printable(how)));
            if (section == "VERTEX")
                read_vertices(tag);
            else if (section == "EDGE")
                for_each_element(section, "E", [&](const VtkTag& element, std::string_view text) {
                    lists_.edges.add(number(element, "ID"));
                    lists_.ends.push_back(whole_numbers<2>(text));
                });
            else if (section == "ELEMENT")
                for_each_element(section, "TQ",
                                 [&](const VtkTag& element, std::string_view text) { add_cell(element, text); });
            else if (section == "CURVED")
                for_each_element(section, "EF",
                                 [&](const VtkTag& element, std::string_view text) { add_curve(element, text); });
            else if (section == "COMPOSITE")
                for_each_element(section, "C",
                                 [&](const VtkTag& element, std::string_view text) { add_composite(element, text); });
            else
                skip(section);
        }
        if (!lists_.vertices.sort() || !lists_.edges.sort() || !lists_.cells.sort())
            fail("two vertices, edges or cells have the same ID");
        return std::move(lists_);
    }

    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError({file_, line_at(bytes_, tags_.position()), {}}, reason);
    }

private:
    static std::string printable(std::string_view text) {
        std::string shown(text.substr(0, 30));
        for (char& c : shown)
            if (static_cast<unsigned char>(c) < ' ') c = '?';
        return shown;
    }
    /// Reads the next tag. Returns false for the one that ends a section.
    bool next_of(std::string_view section, VtkTag& tag) {
        if (!tags_.next(tag)) fail(fmt::format("the file ends without </{}>", printable(section)));
        return tag.name.empty() || tag.name.front() != '/' || tag.name.substr(1) != section;
    }
    void skip(std::string_view section) {
        VtkTag tag;
        while (next_of(section, tag)) continue;
    }
    /// Calls f(tag, text) for the elements of a section, whose names are one of these letters.
    template <class F>
    void for_each_element(std::string_view section, std::string_view letters, F&& f) {
        VtkTag tag;
        while (next_of(section, tag)) {
            if (tag.name.size() != 1 || letters.find(tag.name) == std::string_view::npos)
                fail(fmt::format("<{}> in <{}>", printable(tag.name), printable(section)));
            const std::size_t begin = tags_.position(), end = std::min(bytes_.find('<', begin), bytes_.size());
            f(tag, bytes_.substr(begin, end - begin));
            if (VtkTag closing; next_of(tag.name, closing))
                fail(fmt::format("</{}> expected, found <{}>", tag.name, printable(closing.name)));
        }
    }

    std::size_t number(const VtkTag& tag, std::string_view attribute) const {
        const std::optional<std::size_t> value = parse_whole<std::size_t>(tag.value(attribute));
        if (!value) fail(fmt::format("{}=\"{}\": a whole number expected", attribute, printable(tag.value(attribute))));
        return *value;
    }
    static std::string_view next_word(std::string_view& text) {
        while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
        std::size_t end = 0;
        while (end < text.size() && !is_blank(text[end])) ++end;
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(end);
        return word;
    }
    template <std::size_t count>
    std::array<std::size_t, count> whole_numbers(std::string_view text) const {
        std::array<std::size_t, count> numbers{};
        for (std::size_t& n : numbers) {
            const std::string_view word = next_word(text);
            const std::optional<std::size_t> value = parse_whole<std::size_t>(word);
            if (!value) fail(fmt::format("a whole number expected, found '{}'", printable(word)));
            n = *value;
        }
        if (!next_word(text).empty()) fail(fmt::format("more than {} numbers", count));
        return numbers;
    }
    double coordinate(std::string_view word) const {
        if (!word.empty() && word.front() == '+') word.remove_prefix(1);
        const std::optional<double> value = parse_whole<double>(word);
        if (!value || !std::isfinite(*value)) fail(fmt::format("a number expected, found '{}'", printable(word)));
        return *value;
    }
    /// Reads points of three coordinates each, of which the third one is the same everywhere.
    std::vector<Point> points_of(std::string_view text) {
        std::vector<Point> points;
        for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
            const double x = coordinate(word), y = coordinate(next_word(text)), z = coordinate(next_word(text));
            if (!height_) height_ = z;
            if (z != *height_) fail(fmt::format("the mesh is not plane: z = {} beside {}", z, *height_));
            points.push_back({scale_.x * x + move_.x, scale_.y * y + move_.y});
        }
        return points;
    }

    void read_vertices(const VtkTag& section) {
        const auto factor = [&](std::string_view name, double otherwise) {
            const std::string_view word = section.value(name);
            return word.empty() ? otherwise : coordinate(word);
        };
        if (!lists_.curves_of_edges.empty() || !lists_.curves_of_cells.empty()) fail("<CURVED> before <VERTEX>");
        scale_ = {factor("XSCALE", 1), factor("YSCALE", 1)};
        move_ = {factor("XMOVE", 0), factor("YMOVE", 0)};
        for_each_element("VERTEX", "V", [&](const VtkTag& element, std::string_view text) {
            lists_.vertices.add(number(element, "ID"));
            const std::vector<Point> points = points_of(text);
            if (points.size() != 1) fail("a vertex has three coordinates");
            lists_.points.push_back(points[0]);
        });
    }
    void add_cell(const VtkTag& element, std::string_view text) {
        lists_.cells.add(number(element, "ID"));
        NektarCell& cell = lists_.cells_of_edges.emplace_back();
        cell.corners = element.name == "T" ? 3 : 4;
        if (cell.corners == 4) {
            cell.edges = whole_numbers<4>(text);
        } else {
            const auto edges = whole_numbers<3>(text);
            std::copy(edges.begin(), edges.end(), cell.edges.begin());
        }
    }
    void add_curve(const VtkTag& element, std::string_view text) {
        const bool is_edge = element.name == "E";
        NektarCurve curve{element.value("TYPE"), points_of(text)};
        if (curve.points.size() != number(element, "NUMPOINTS"))
            fail(fmt::format("a curve of {} points has NUMPOINTS=\"{}\"", curve.points.size(),
                             printable(element.value("NUMPOINTS"))));
        auto& curves = is_edge ? lists_.curves_of_edges : lists_.curves_of_cells;
        const std::size_t of = number(element, is_edge ? "EDGEID" : "FACEID");
        if (!curves.emplace(of, std::move(curve)).second)
            fail(fmt::format("a second curve of {} {}", is_edge ? "edge" : "cell", of));
    }
    /// Reads a list such as "E[0-9,12]".
    void add_composite(const VtkTag& element, std::string_view text) {
        NektarComposite composite{std::string(element.value("NAME")), 0, {}};
        if (composite.name.empty()) composite.name = fmt::format("C{}", number(element, "ID"));
        std::string list;
        for (const char c : text)
            if (!is_blank(c)) list += c;
        if (list.size() < 3 || list[1] != '[' || list.back() != ']' || list.find(']') + 1 != list.size() ||
            std::string_view("VETQ").find(list[0]) == std::string_view::npos)
            fail(fmt::format("composite '{}': V, E, T or Q and a list in brackets expected", printable(list)));
        composite.kind = list[0];
        std::string_view rest = std::string_view(list).substr(2, list.size() - 3);
        while (!rest.empty()) {
            const std::string_view range = rest.substr(0, rest.find(','));
            rest.remove_prefix(std::min(range.size() + 1, rest.size()));
            const std::size_t dash = range.find('-');
            const std::optional<std::size_t> first = parse_whole<std::size_t>(range.substr(0, dash)),
                                             last = dash == std::string_view::npos
                                                        ? first
                                                        : parse_whole<std::size_t>(range.substr(dash + 1));
            if (!first || !last || *last < *first)
                fail(fmt::format("composite '{}': '{}' is no range of numbers", printable(composite.name),
                                 printable(range)));
            composite.ranges.emplace_back(*first, *last);
        }
        lists_.composites.push_back(std::move(composite));
    }

    std::string_view bytes_;
    std::string file_;
    VtkTagReader tags_;
    NektarLists lists_;
    std::optional<double> height_;  ///< the third coordinate of all points
    Point scale_{1, 1}, move_{0, 0};
};

// ---- the mesh --------------------------------------------------------------------------------------------------------

/// Makes the mesh of what the file lists.
class NektarMesh {
public:
    NektarMesh(NektarLists lists, std::string file) : lists_(std::move(lists)), file_(std::move(file)) {}

    CurvedMesh make() {
        mesh_.points = lists_.points;
        find_edges();
        find_cells();
        find_order();
        if (nodes_.order > 1) {
            place_edges();
            place_cells();
        }
        find_groups();
        return {std::move(mesh_), std::move(nodes_)};
    }

private:
    [[noreturn]] void fail(const std::string& reason) const { throw InputError({file_, 0, {}}, reason); }

    void find_edges() {
        if (lists_.points.size() >= VertexId{}.value) fail("more than 2^32 vertices");
        for (const auto& ends : lists_.ends) {
            const auto a = lists_.vertices.find(ends[0]), b = lists_.vertices.find(ends[1]);
            if (!a || !b) fail(fmt::format("an edge from vertex {} to {}: not in <VERTEX>", ends[0], ends[1]));
            edges_.push_back({VertexId(*a), VertexId(*b)});
        }
    }
    /// Corner i + 1 of a cell is where its edges i and i + 1 meet.
    void find_cells() {
        const auto meeting = [](const Segment& a, const Segment& b) -> std::optional<VertexId> {
            const bool first = a.a == b.a || a.a == b.b, second = a.b == b.a || a.b == b.b;
            if (first == second) return {};
            return first ? a.a : a.b;
        };
        for (NektarCell& cell : lists_.cells_of_edges) {
            for (std::size_t i = 0; i < cell.corners; ++i) {
                const std::optional<std::size_t> edge = lists_.edges.find(cell.edges[i]);
                if (!edge) fail(fmt::format("edge {} of a cell is not in <EDGE>", cell.edges[i]));
                cell.edges[i] = *edge;
            }
            std::array<VertexId, 4> corners{};
            bool is_ring = true;
            for (std::size_t i = 0; i < cell.corners; ++i) {
                const std::optional<VertexId> corner =
                    meeting(edges_[cell.edges[i]], edges_[cell.edges[(i + 1) % cell.corners]]);
                is_ring = is_ring && corner;
                corners[(i + 1) % cell.corners] = corner.value_or(VertexId{0u});
            }
            for (std::size_t i = 0; i < cell.corners; ++i)
                is_ring = is_ring && corners[i] != corners[(i + 1) % cell.corners];
            if (!is_ring) fail("the edges of a cell do not follow each other");
            if (cell.corners == 3)
                mesh_.triangles.push_back({{corners[0], corners[1], corners[2]}});
            else
                mesh_.quads.push_back({{corners[0], corners[1], corners[2], corners[3]}});
        }
    }

    /// Finds the order and the distribution of all curves.
    void find_order() {
        std::optional<NodeDistribution> distribution;
        const auto add = [&](const NektarCurve& curve, unsigned corners, bool is_even, bool is_lobatto) {
            const unsigned order = order_of_cell(corners, curve.points.size());
            if (order == 0) fail(fmt::format("a curve of {} points: orders up to 4 are read", curve.points.size()));
            if (nodes_.order > 1 && order != nodes_.order) fail("curves of several orders");
            nodes_.order = order;
            if (!is_even && !is_lobatto) fail(fmt::format("curves of type '{:.30}' are not read", curve.type));
            const NodeDistribution own =
                is_even || order <= 2 ? NodeDistribution::equidistant : NodeDistribution::gauss_lobatto;
            if (distribution.value_or(own) != own) fail("curves with evenly spaced nodes beside others");
            distribution = own;
        };
        for (const auto& [number, curve] : lists_.curves_of_edges) {
            if (!lists_.edges.find(number)) fail(fmt::format("the curve of an edge {} that is not there", number));
            add(curve, 2, curve.type == "PolyEvenlySpaced", curve.type == "GaussLobattoLegendre");
        }
        for (const auto& [number, curve] : lists_.curves_of_cells) {
            const auto cell = lists_.cells.find(number);
            if (!cell) fail(fmt::format("the curve of a cell {} that is not there", number));
            if (lists_.cells_of_edges[*cell].corners == 3)
                add(curve, 3, curve.type == "NodalTriEvenlySpaced",
                    curve.type == "NodalTriElec" || curve.type == "NodalTriFekete");
            else
                add(curve, 4, curve.type == "PolyEvenlySpaced", curve.type == "GaussLobattoLegendre");
        }
        nodes_.distribution = distribution.value_or(NodeDistribution::equidistant);
    }

    double on_edge(unsigned k) const { return mesh::place_on_edge(nodes_.order, k, nodes_.distribution); }
    Point at(VertexId v) const { return mesh_.points[v.index()]; }
    /// Fails where a point of a curve is not where the edge or the cell has it.
    void require_near(Point curve, Point expected) const {
        constexpr double same = 1e-8;  // kVertexTheSameDouble of Nektar++
        if (!(distance(curve, expected) <= same))
            fail(fmt::format("a curve goes through ({:.6g}, {:.6g}) where its edge has ({:.6g}, {:.6g})", curve.x,
                             curve.y, expected.x, expected.y));
    }
    void place_edges() {
        const unsigned p = nodes_.order;
        std::vector<const NektarCurve*> curves(edges_.size());
        for (const auto& [number, curve] : lists_.curves_of_edges) curves[*lists_.edges.find(number)] = &curve;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const Point a = at(edges_[e].a), b = at(edges_[e].b);
            if (curves[e] != nullptr) {
                require_near(curves[e]->points.front(), a);
                require_near(curves[e]->points.back(), b);
            }
            for (unsigned k = 1; k < p; ++k)
                nodes_.points.push_back(curves[e] != nullptr ? curves[e]->points[k] : a + on_edge(k) * (b - a));
        }
    }
    /// Returns node k, from 0 to p, of edge i of a cell.
    Point on_side(const NektarCell& cell, std::span<const VertexId> corners, std::size_t i, unsigned k) const {
        if (k == 0) return at(corners[i]);
        if (k == nodes_.order) return at(corners[(i + 1) % cell.corners]);
        return nodes_.points[of_side(cell, corners, i, k - 1)];
    }
    /// Returns the position of node k, from 0 to p - 2, within edge i of a cell.
    std::size_t of_side(const NektarCell& cell, std::span<const VertexId> corners, std::size_t i, unsigned k) const {
        const std::size_t edge = cell.edges[i];
        const unsigned within = nodes_.order - 1;
        return edge * within + (edges_[edge].a == corners[i] ? k : within - 1 - k);
    }

    void place_cells() {
        std::vector<const NektarCurve*> curves(lists_.cells_of_edges.size());
        for (const auto& [number, curve] : lists_.curves_of_cells) curves[*lists_.cells.find(number)] = &curve;
        std::array<std::size_t, 2> next{};
        for (std::size_t c = 0; c < lists_.cells_of_edges.size(); ++c) {
            const NektarCell& cell = lists_.cells_of_edges[c];
            const bool is_triangle = cell.corners == 3;
            const std::size_t i = next[is_triangle ? 0 : 1]++;
            place_cell(cell,
                       is_triangle ? std::span<const VertexId>(mesh_.triangles[i].v)
                                   : std::span<const VertexId>(mesh_.quads[i].v),
                       curves[c], is_triangle ? nodes_.triangle_nodes : nodes_.quad_nodes);
        }
    }
    /// Lists the nodes of a cell beside its corners, and places those within it.
    void place_cell(const NektarCell& cell, std::span<const VertexId> corners, const NektarCurve* curve,
                    std::vector<VertexId>& list) {
        const unsigned p = nodes_.order;
        const auto shape = static_cast<unsigned>(cell.corners);
        const std::size_t border = std::size_t{shape} * p, count = mesh::nodes_of_cell(shape, p);
        const auto id = [&](std::size_t node) { return VertexId(mesh_.points.size() + node); };
        for (std::size_t i = 0; i < cell.corners; ++i)
            for (unsigned k = 0; k + 1 < p; ++k) list.push_back(id(of_side(cell, corners, i, k)));
        std::vector<Point> places(count);
        for (std::size_t i = 0; i < cell.corners; ++i) {
            places[i] = at(corners[i]);
            for (unsigned k = 1; k < p; ++k) places[shape + i * (p - 1) + k - 1] = on_side(cell, corners, i, k);
        }
        if (curve != nullptr)
            take_places(*curve, shape, places);
        else
            for (std::size_t n = border; n < count; ++n)
                places[n] = shape == 4 ? within_quad(cell, corners, n) : within_triangle(cell, corners, n);
        for (std::size_t n = border; n < count; ++n) {
            list.push_back(id(nodes_.points.size()));
            nodes_.points.push_back(places[n]);
        }
    }
    /// Takes the nodes within a cell from its curve, whose border is known.
    void take_places(const NektarCurve& curve, unsigned corners, std::vector<Point>& places) const {
        const unsigned p = nodes_.order;
        const std::size_t border = std::size_t{corners} * p;
        const std::vector<std::size_t> order = rows_of_nodes(corners, p, corners == 3 ? border : 0);
        for (std::size_t k = 0; k < order.size(); ++k) {
            if (order[k] < border)
                require_near(curve.points[k], places[order[k]]);
            else
                places[order[k]] = curve.points[k];
        }
        if (corners == 3 && p == 4 && nodes_.distribution == NodeDistribution::gauss_lobatto)
            move_from_nektar_places(places,
                                    curve.type == "NodalTriElec" ? place_in_nodal_tri_elec : place_in_nodal_tri_fekete);
    }

    /// Returns a node within a quadrilateral by the curves of its edges, which the modes of Nektar++'s edges blend
    /// linearly: the transfinite interpolation.
    Point within_quad(const NektarCell& cell, std::span<const VertexId> corners, std::size_t node) const {
        const unsigned p = nodes_.order;
        const auto [i, j] = mesh::lattice_of_cell(4, p)[node];
        const auto [s, t] = mesh::places_of_nodes(4, p, nodes_.distribution)[node];
        const Point sides = (1 - t) * on_side(cell, corners, 0, i) + s * on_side(cell, corners, 1, j) +
                            t * on_side(cell, corners, 2, p - i) + (1 - s) * on_side(cell, corners, 3, p - j);
        const Point bilinear = (1 - s) * (1 - t) * at(corners[0]) + s * (1 - t) * at(corners[1]) +
                               s * t * at(corners[2]) + (1 - s) * t * at(corners[3]);
        return sides - bilinear;
    }
    /// Returns a node within a triangle by the curves of its edges and the modes of Nektar++'s edges. With barycentric
    /// coordinates l, a mode of edge 0 is l0 l1 r^k P_k((l1 - l0) / r) with r = l0 + l1, and one of the others l_i l2
    /// P_k(2 l2 - 1), where P_k are Jacobi's polynomials of exponents 1 and 1. Source: G. E. Karniadakis, S. J. Sherwin,
    /// Spectral/hp Element Methods for CFD (2005), section 3.2.3.
    Point within_triangle(const NektarCell& cell, std::span<const VertexId> corners, std::size_t node) const {
        const auto [s, t] = mesh::places_of_nodes(3, nodes_.order, nodes_.distribution)[node];
        const std::array<double, 3> l{1 - s - t, s, t};
        const Point straight = l[0] * at(corners[0]) + l[1] * at(corners[1]) + l[2] * at(corners[2]);
        // Edge 1 leads to corner 2 and edge 2 from there.
        return straight + l[0] * l[1] * modes_at(cell, corners, 0, (l[1] - l[0]) / (1 - t), 1 - t) +
               l[1] * l[2] * modes_at(cell, corners, 1, 2 * t - 1, 1) +
               l[2] * l[0] * modes_at(cell, corners, 2, 1 - 2 * t, 1);
    }
    /// Returns the sum of c_k r^k P_k(x) of an edge whose bend at u is u (1 - u) times the sum of c_k P_k(2 u - 1).
    Point modes_at(const NektarCell& cell, std::span<const VertexId> corners, std::size_t side, double x,
                   double r) const {
        const unsigned p = nodes_.order;
        const Point a = on_side(cell, corners, side, 0), b = on_side(cell, corners, side, p);
        const auto quotient = [&](unsigned k) {
            const double u = on_edge(k);
            return (1 / (u * (1 - u))) * (on_side(cell, corners, side, k) - (a + u * (b - a)));
        };
        // P_1 is odd, and the others are even: P_0 = 1, P_1 = 2 x, P_2 = (15 x^2 - 3) / 4.
        const Point low = quotient(1), high = quotient(p - 1);
        const double step = 2 * on_edge(p - 1) - 1;
        const Point c1 = (1 / (4 * step)) * (high - low);
        Point c0 = 0.5 * (low + high), c2{0, 0};
        if (p == 4) {
            const Point middle = quotient(2);
            c2 = (4 / (15 * step * step)) * (c0 - middle);
            c0 = middle + 0.75 * c2;
        }
        return c0 + (r * 2 * x) * c1 + (r * r * (15 * x * x - 3) / 4) * c2;
    }

    // ---- groups -----------------------------------------------------------------------------------------------------

    /// Calls f with the positions of what a composite lists.
    template <class F>
    void for_each_position(const NektarComposite& composite, const FileNumbers& numbers, F&& f) const {
        for (const auto& [first, last] : composite.ranges) {
            if (last - first >= numbers.size())
                fail(fmt::format("composite '{:.30}' is larger than the mesh", composite.name));
            for (std::size_t number = first; number <= last; ++number) {
                const auto found = numbers.find(number);
                if (!found) fail(fmt::format("{}[{}] of a composite is not there", composite.kind, number));
                f(*found);
            }
        }
    }
    void find_groups() {
        constexpr int none = -1;
        std::vector<int> regions(lists_.cells_of_edges.size(), none);
        std::vector<std::size_t> of_markers;
        for (const NektarComposite& composite : lists_.composites) {
            if (composite.kind == 'E')
                add_marker(composite, of_markers);
            else if (composite.kind != 'V')
                add_region(composite, regions);
        }
        orient_markers(mesh_);
        auto edge = of_markers.begin();
        for (const Marker& marker : mesh_.markers)
            for (const Segment& segment : marker.edges) {
                const unsigned within = nodes_.order - 1;
                const bool is_along = edges_[*edge].a == segment.a;
                for (unsigned k = 0; k < within; ++k)
                    nodes_.marker_nodes.emplace_back(mesh_.points.size() + *edge * within +
                                                     (is_along ? k : within - 1 - k));
                ++edge;
            }
        if (std::find(regions.begin(), regions.end(), none) != regions.end()) return;
        for (const std::size_t corners : {3, 4})
            for (std::size_t c = 0; c < regions.size(); ++c)
                if (lists_.cells_of_edges[c].corners == corners)
                    mesh_.region.push_back(static_cast<Region>(regions[c]));
    }
    void add_marker(const NektarComposite& composite, std::vector<std::size_t>& of_markers) {
        Marker& marker = mesh_.markers.emplace_back(Marker{composite.name, core::kind_of_name(composite.name), {}});
        for_each_position(composite, lists_.edges, [&](std::size_t edge) {
            marker.edges.push_back(edges_[edge]);
            of_markers.push_back(edge);
        });
    }
    void add_region(const NektarComposite& composite, std::vector<int>& regions) const {
        std::string_view name = composite.name;
        for (const std::string_view ending : {"_triangles", "_quads"})
            if (name.ends_with(ending)) name.remove_suffix(ending.size());
        Region region{};
        const bool is_region = region_of_name(name, region);
        for_each_position(composite, lists_.cells, [&](std::size_t cell) {
            if (lists_.cells_of_edges[cell].corners != (composite.kind == 'T' ? 3 : 4))
                fail(fmt::format("composite '{:.30}' has a cell of another shape", composite.name));
            if (is_region) regions[cell] = static_cast<int>(region);
        });
    }

    NektarLists lists_;
    std::string file_;
    std::vector<Segment> edges_;
    Mesh mesh_;
    CurvedNodes nodes_;
};

}  // namespace

CurvedMesh read_curved_nektar(const std::string& bytes, const std::filesystem::path& file) {
    return NektarMesh(NektarFile(bytes, file.string()).read(), file.string()).make();
}

Mesh read_nektar(const std::string& bytes, const std::filesystem::path& file) {
    CurvedMesh curved = read_curved_nektar(bytes, file);
    if (curved.nodes.order > 1) throw InputError({file.string(), 0, {}}, curved_cells_refused(curved.nodes.order));
    return std::move(curved.mesh);
}

}  // namespace lamina::io
