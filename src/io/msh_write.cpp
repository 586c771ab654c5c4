// Writes Gmsh's MSH format, versions 2.2 and 4.1, ASCII and binary.
// Source: Gmsh reference manual, "Gmsh mesh file formats".
//
// Each marker is a curve and each region a surface. Physical groups carry the names. A group has the number of its
// entity, which is unique across dimensions, since some readers keep one list of groups. Nodes are numbered from 1 on
// in the order of the mesh, and all belong to the first surface. Elements are numbered from 1 on: the edges of the
// markers, then the cells.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include <lamina/error.hpp>

#include "io/binary_output.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/msh_elements.hpp"
#include "io/text_output.hpp"
#include "mesh/periodic.hpp"

namespace lamina::io {

namespace {

/// The elements of one type on one entity.
struct ElementBlock {
    int dimension, entity;
    MshElement element;
    std::size_t count, first_number;
    const Marker* marker;                    ///< for lines, else null
    const CellBlock* cells;                  ///< for triangles and quadrilaterals, else null
    std::span<const VertexId> curved_nodes;  ///< of the lines of the marker, or of all cells of this shape

    /// Returns the number of node k of element i of the block.
    std::size_t node(const MeshView& mesh, std::size_t i, std::size_t k) const {
        if (k >= element.corners) {
            const std::size_t beside = element.nodes - element.corners, cell = cells != nullptr ? cells->cells[i] : i;
            return curved_nodes[cell * beside + k - element.corners].index() + 1;
        }
        if (marker != nullptr) return (k == 0 ? marker->edges[i].a : marker->edges[i].b).index() + 1;
        return cells->vertices(mesh, i)[k].index() + 1;
    }
    /// Returns the most bytes of a line of an element: its numbers, and room for its number, type and tags.
    std::size_t most_bytes() const {
        constexpr std::size_t bytes_of_index = 16, numbers_before = 4;
        return bytes_of_index * (numbers_before + element.nodes);
    }
};

/// An entity and the physical group of the same number.
struct PhysicalGroup {
    int dimension, entity;
    std::string name;
    Box box;  ///< bounds of the entity
};

class MshWriter {
public:
    MshWriter(const MeshView& mesh, const CurvedNodes& nodes, MshVariant variant, std::ostream& out)
        : mesh_(mesh), nodes_(nodes), variant_(variant), out_(out), cells_(cell_blocks(mesh)) {
        find_groups();
        find_elements();
    }

    void write() {
        write_header();
        write_names();
        if (variant_.version_4) write_entities();
        write_nodes();
        write_elements();
        write_periodic();
    }

private:
    void find_groups() {
        for (const Marker& marker : mesh_.markers) {
            PhysicalGroup group{1, static_cast<int>(groups_.size() + 1), marker.name, {}};
            for (const Segment& edge : marker.edges) {
                group.box.include(mesh_.points[edge.a.index()]);
                group.box.include(mesh_.points[edge.b.index()]);
            }
            groups_.push_back(std::move(group));
        }
        Box box;
        for (const Point p : mesh_.points) box.include(p);
        for (const CellBlock& block : cells_)
            if (surface_of(block) == 0)
                groups_.push_back({2, static_cast<int>(groups_.size() + 1), std::string(block.region), box});
    }
    /// Returns the number of the entity of a region; 0 where it has none yet.
    int surface_of(const CellBlock& block) const {
        for (const PhysicalGroup& group : groups_)
            if (group.dimension == 2 && group.name == block.region) return group.entity;
        return 0;
    }
    void find_elements() {
        std::size_t number = 1;
        const auto add = [&](ElementBlock block) {
            if (block.count == 0) return;
            block.first_number = number;
            number += block.count;
            elements_.push_back(block);
        };
        std::size_t edges = 0;
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) {
            const std::size_t count = mesh_.markers[m].edges.size(), within = nodes_.order - 1;
            add({1, groups_[m].entity, msh_element(2, nodes_.order), count, 0, &mesh_.markers[m], nullptr,
                 std::span(nodes_.marker_nodes).subspan(edges * within, count * within)});
            edges += count;
        }
        for (const CellBlock& block : cells_)
            add({2, surface_of(block), msh_element(block.corners, nodes_.order), block.cells.size(), 0, nullptr, &block,
                 block.corners == 3 ? nodes_.triangle_nodes : nodes_.quad_nodes});
        element_count_ = number - 1;
    }

    void write_header() {
        out_ << "$MeshFormat\n" << (variant_.version_4 ? "4.1 " : "2.2 ") << (variant_.binary ? "1 8\n" : "0 8\n");
        if (variant_.binary) {
            write_value(out_, std::int32_t{1});  // shows the byte order
            out_ << '\n';
        }
        out_ << "$EndMeshFormat\n";
    }
    void write_names() {
        out_ << "$PhysicalNames\n" << groups_.size() << '\n';
        for (const PhysicalGroup& group : groups_)
            out_ << fmt::format("{} {} \"{}\"\n", group.dimension, group.entity, group.name);
        out_ << "$EndPhysicalNames\n";
    }

    void write_entities() {
        std::size_t curves = 0;
        for (const PhysicalGroup& group : groups_) curves += group.dimension == 1;
        const std::size_t surfaces = groups_.size() - curves;
        out_ << "$Entities\n";
        if (variant_.binary) {
            for (const std::size_t n : {std::size_t{0}, curves, surfaces, std::size_t{0}}) write_value(out_, n);
            for (const PhysicalGroup& group : groups_) write_binary_entity(group);
            out_ << '\n';
        } else {
            out_ << fmt::format("0 {} {} 0\n", curves, surfaces);
            for (const PhysicalGroup& group : groups_)
                out_ << fmt::format("{0} {1} {2} 0 {3} {4} 0 1 {0} 0\n", group.entity, group.box.lower.x,
                                    group.box.lower.y, group.box.upper.x, group.box.upper.y);
        }
        out_ << "$EndEntities\n";
    }
    /// Writes an entity with one physical group and no borders.
    void write_binary_entity(const PhysicalGroup& group) {
        write_value(out_, group.entity);
        for (const double bound :
             {group.box.lower.x, group.box.lower.y, 0.0, group.box.upper.x, group.box.upper.y, 0.0})
            write_value(out_, bound);
        write_value(out_, std::size_t{1});
        write_value(out_, group.entity);
        write_value(out_, std::size_t{0});
    }

    void write_nodes() {
        out_ << "$Nodes\n";
        variant_.version_4 ? write_nodes_4() : write_nodes_2();
        out_ << (variant_.binary ? "\n$EndNodes\n" : "$EndNodes\n");
    }
    /// Writes one block of nodes: all their numbers, then all their coordinates.
    void write_nodes_4() {
        const std::size_t n = node_count();
        const int surface = groups_.back().dimension == 2 ? surface_of(cells_.front()) : 1;
        if (variant_.binary) {
            for (const std::size_t value : {std::size_t{1}, n, std::size_t{1}, n}) write_value(out_, value);
            for (const int value : {2, surface, 0}) write_value(out_, value);
            write_value(out_, n);
            write_records(out_, n, 8, [](char* p, std::size_t i) { store(p, i + 1); });
            write_records(out_, n, 24, [&](char* p, std::size_t i) { store_point(p, i); });
        } else {
            out_ << fmt::format("1 {0} 1 {0}\n2 {1} 0 {0}\n", n, surface);
            write_lines(out_, n, [](LineText& line, std::size_t i) { line << i + 1; });
            write_lines(out_, n, [&](LineText& line, std::size_t i) { line << node(i) << "0"; });
        }
    }
    void write_nodes_2() {
        const std::size_t n = node_count();
        out_ << n << '\n';
        if (variant_.binary)
            write_records(out_, n, 28,
                          [&](char* p, std::size_t i) { store_point(store(p, static_cast<std::int32_t>(i + 1)), i); });
        else
            write_lines(out_, n, [&](LineText& line, std::size_t i) { line << i + 1 << node(i) << "0"; });
    }
    std::size_t node_count() const { return mesh_.points.size() + nodes_.points.size(); }
    Point node(std::size_t i) const {
        return i < mesh_.points.size() ? mesh_.points[i] : nodes_.points[i - mesh_.points.size()];
    }
    void store_point(char* p, std::size_t i) const {
        p = store(p, node(i).x);
        p = store(p, node(i).y);
        store(p, 0.0);
    }

    void write_elements() {
        out_ << "$Elements\n";
        if (variant_.version_4) {
            if (variant_.binary)
                for (const std::size_t value : {elements_.size(), element_count_, std::size_t{1}, element_count_})
                    write_value(out_, value);
            else
                out_ << fmt::format("{0} {1} 1 {1}\n", elements_.size(), element_count_);
        } else {
            out_ << element_count_ << '\n';
        }
        for (const ElementBlock& block : elements_)
            if (variant_.version_4)
                write_block_4(block);
            else
                write_block_2(block);
        out_ << (variant_.binary ? "\n$EndElements\n" : "$EndElements\n");
    }
    void write_block_4(const ElementBlock& block) {
        if (variant_.binary) {
            for (const int value : {block.dimension, block.entity, block.element.type}) write_value(out_, value);
            write_value(out_, block.count);
            write_records(out_, block.count, 8 * (1 + block.element.nodes), [&](char* p, std::size_t i) {
                p = store(p, block.first_number + i);
                for (std::size_t k = 0; k < block.element.nodes; ++k) p = store(p, block.node(mesh_, i, k));
            });
        } else {
            out_ << fmt::format("{} {} {} {}\n", block.dimension, block.entity, block.element.type, block.count);
            write_lines(
                out_, block.count,
                [&](LineText& line, std::size_t i) {
                    line << block.first_number + i;
                    for (std::size_t k = 0; k < block.element.nodes; ++k) line << block.node(mesh_, i, k);
                },
                block.most_bytes());
        }
    }
    /// Each element has two tags: its physical group and its entity.
    void write_block_2(const ElementBlock& block) {
        if (variant_.binary) {
            for (const int value : {block.element.type, static_cast<int>(block.count), 2}) write_value(out_, value);
            write_records(out_, block.count, 4 * (3 + block.element.nodes), [&](char* p, std::size_t i) {
                p = store(p, static_cast<std::int32_t>(block.first_number + i));
                p = store(store(p, block.entity), block.entity);
                for (std::size_t k = 0; k < block.element.nodes; ++k)
                    p = store(p, static_cast<std::int32_t>(block.node(mesh_, i, k)));
            });
        } else {
            const std::string tags = fmt::format("{} 2 {} {}", block.element.type, block.entity, block.entity);
            write_lines(
                out_, block.count,
                [&](LineText& line, std::size_t i) {
                    line << block.first_number + i << tags;
                    for (std::size_t k = 0; k < block.element.nodes; ++k) line << block.node(mesh_, i, k);
                },
                block.most_bytes());
        }
    }

    /// Writes which nodes of one periodic border are those of the other, moved by an affine map.
    void write_periodic() {
        const auto pair = mesh::find_periodic_pair(mesh_.points, mesh_.markers).pair;
        if (!pair) return;
        const int slave = groups_[pair->second].entity, master = groups_[pair->first].entity;
        const Point t = pair->translation;
        const std::array<double, 16> affine{1, 0, 0, t.x, 0, 1, 0, t.y, 0, 0, 1, 0, 0, 0, 0, 1};
        out_ << "$Periodic\n";
        if (variant_.version_4 && variant_.binary) {
            write_value(out_, std::size_t{1});
            for (const int value : {1, slave, master}) write_value(out_, value);
            write_value(out_, affine.size());
            for (const double value : affine) write_value(out_, value);
            write_value(out_, pair->vertices.size());
            for (const auto& [first, second] : pair->vertices)
                for (const VertexId v : {second, first}) write_value(out_, v.index() + 1);
            out_ << '\n';
        } else {
            out_ << fmt::format("1\n1 {} {}\n{}{}\n{}\n", slave, master, variant_.version_4 ? "16 " : "Affine ",
                                fmt::join(affine, " "), pair->vertices.size());
            for (const auto& [first, second] : pair->vertices)
                out_ << fmt::format("{} {}\n", second.index() + 1, first.index() + 1);
        }
        out_ << "$EndPeriodic\n";
    }

    MeshView mesh_;
    const CurvedNodes& nodes_;
    MshVariant variant_;
    std::ostream& out_;
    std::vector<CellBlock> cells_;
    std::vector<PhysicalGroup> groups_;  ///< markers, then regions, numbered from 1 in this order
    std::vector<ElementBlock> elements_;
    std::size_t element_count_ = 0;
};

}  // namespace

void write_msh(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file, MshVariant variant,
               std::ostream& out) {
    require_marker_names(mesh.markers, file, "MSH", "\"", 127);
    constexpr std::size_t max_items = std::numeric_limits<std::int32_t>::max() / 2;
    const std::size_t items = mesh.points.size() + nodes.points.size() + mesh.triangles.size() + mesh.quads.size();
    if (!variant.version_4 && variant.binary && items > max_items)
        throw UsageError(fmt::format("{}: binary MSH 2.2 numbers no more than 2^31 nodes and elements", file.string()));
    MshWriter(mesh, nodes, variant, out).write();
}

}  // namespace lamina::io
