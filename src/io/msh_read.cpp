// Reads Gmsh's MSH format, versions 2.0 to 2.2 and 4.1, ASCII and binary: plane meshes of lines, triangles and
// quadrilaterals of one order from 1 to 4, and those whose copies in z are joined by prisms and hexahedra. Points
// (element type 15) and unknown sections are skipped. Source: Gmsh reference manual, "Gmsh mesh file formats".
//
// The lines of a physical curve become a marker with the name of the group; lines without a group are left out. Where
// every cell is in a physical surface 'layer' or 'isotropic', these become regions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <lamina/error.hpp>

#include "core/marker_names.hpp"
#include "io/byte_reader.hpp"
#include "io/curved_lists.hpp"
#include "io/file_numbers.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/msh_elements.hpp"
#include "io/plane_of_extrusion.hpp"
#include "io/sizes.hpp"

namespace lamina::io {

namespace {

class MshReader {
public:
    MshReader(const std::string& bytes, const std::filesystem::path& file) : in_(bytes, file.string()), file_(file) {}

    CurvedMesh read_curved() {
        read_header();
        for (std::string_view name; !(name = in_.word()).empty();) {
            if (name.front() != '$') in_.fail(fmt::format("section expected, found '{}'", name.substr(0, 30)));
            in_.rest_of_line();
            if (name == "$PhysicalNames")
                read_names();
            else if (name == "$Entities" && version_4_)
                read_entities();
            else if (name == "$Nodes")
                version_4_ ? read_nodes_4() : read_nodes_2();
            else if (name == "$Elements")
                version_4_ ? read_elements_4() : read_elements_2();
            else if (name == "$NodeData")
                read_node_data();
            else if (name == "$PartitionedEntities")
                in_.fail("partitioned meshes cannot be read");
            else
                in_.skip_behind("$End" + std::string(name.substr(1)));
        }
        if (!has_nodes_ || !has_elements_) in_.fail("the file ends without $Nodes or $Elements");
        finish();
        return {std::move(mesh_), std::move(curved_)};
    }
    /// Reads a mesh whose cells are straight.
    Mesh read() {
        CurvedMesh mesh = read_curved();
        if (order_ > 1) in_.fail(curved_cells_refused(order_));
        return std::move(mesh.mesh);
    }
    /// Returns the sizes that the file holds. Precondition: read() was called.
    std::vector<double> sizes() {
        if (!space_.volumes.empty()) in_.fail("sizes are read of plane meshes alone");
        std::vector<std::string> names;
        for (const auto& [name, values] : node_data_) names.emplace_back(name);
        return std::move(node_data_.find(size_array(names, file_))->second);
    }

private:
    using EntityKey = std::pair<int, int>;  ///< dimension and number

    void read_header() {
        in_.expect("$MeshFormat");
        const std::string_view version = in_.word();
        version_4_ = version == "4.1";
        if (!version_4_ && version != "2" && version != "2.0" && version != "2.1" && version != "2.2")
            in_.fail(fmt::format("MSH version '{}': 2.2 and 4.1 can be read", version.substr(0, 30)));
        const auto binary = in_.ascii_number<int>("file type");
        if (in_.ascii_number<int>("data size") != 8 || binary < 0 || binary > 1)
            in_.fail("the header must say 0 or 1, and a data size of 8");
        in_.rest_of_line();
        if (binary == 1) {
            in_.set_binary(ByteOrder::little);
            if (in_.number<std::int32_t>("the number 1") != 1)
                in_.fail("binary data in the byte order of another machine cannot be read");
        }
        in_.expect("$EndMeshFormat");
    }

    void read_names() {
        const auto n = in_.ascii_number<std::size_t>("number of physical names");
        for (std::size_t i = 0; i < n; ++i) {
            const auto dimension = in_.ascii_number<int>("dimension");
            const auto number = in_.ascii_number<int>("physical group");
            const std::string_view quoted = in_.rest_of_line();
            if (quoted.size() < 3 || quoted.front() != '"' || quoted.back() != '"')
                in_.fail("name in quotation marks expected");
            names_[{dimension, number}] = quoted.substr(1, quoted.size() - 2);
        }
        in_.expect("$EndPhysicalNames");
    }

    void read_entities() {
        std::size_t counts[4];
        for (std::size_t& n : counts) n = in_.number<std::size_t>("number of entities");
        for (int dimension = 0; dimension < 4; ++dimension) {
            in_.checked_count(counts[dimension], 36, "number of entities");
            for (std::size_t i = 0; i < counts[dimension]; ++i) read_entity(dimension);
        }
        in_.expect("$EndEntities");
    }
    /// Keeps the first physical group of the entity, without its sign.
    void read_entity(int dimension) {
        const auto entity = in_.number<int>("entity");
        for (int k = dimension == 0 ? 3 : 0; k < 6; ++k) in_.number<double>("bound");
        const std::size_t groups = in_.checked_count(in_.number<std::size_t>("number of groups"), 4, "groups");
        for (std::size_t k = 0; k < groups; ++k) {
            const int group = std::abs(in_.number<int>("physical group"));
            if (k == 0) group_of_entity_[{dimension, entity}] = group;
        }
        if (dimension == 0) return;
        const std::size_t borders = in_.checked_count(in_.number<std::size_t>("number of borders"), 4, "borders");
        for (std::size_t k = 0; k < borders; ++k) in_.number<int>("border");
    }

    void read_nodes_2() {
        begin_nodes();
        const std::size_t n =
            in_.checked_count(in_.ascii_number<std::size_t>("number of nodes"), 28, "number of nodes");
        in_.rest_of_line();
        mesh_.points.reserve(n);
        for (std::size_t i = 0; i < n; ++i) {
            nodes_.add(static_cast<std::size_t>(in_.number<int>("node number")));
            read_point();
        }
        end_nodes();
    }
    void read_nodes_4() {
        begin_nodes();
        const auto blocks = in_.number<std::size_t>("number of blocks of nodes");
        for (int k = 0; k < 3; ++k) in_.number<std::size_t>("number of nodes");
        for (std::size_t b = 0; b < blocks; ++b) {
            for (int k = 0; k < 2; ++k) in_.number<int>("entity");
            if (in_.number<int>("0") != 0) in_.fail("parametric nodes cannot be read");
            const std::size_t n = in_.checked_count(in_.number<std::size_t>("number of nodes"), 32, "number of nodes");
            for (std::size_t i = 0; i < n; ++i) nodes_.add(in_.number<std::size_t>("node number"));
            for (std::size_t i = 0; i < n; ++i) read_point();
        }
        end_nodes();
    }
    void begin_nodes() {
        if (std::exchange(has_nodes_, true)) in_.fail("a second $Nodes");
    }
    void read_point() {
        const auto x = in_.number<double>("coordinate"), y = in_.number<double>("coordinate"),
                   z = in_.number<double>("coordinate");
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) in_.fail("coordinate is not a finite number");
        mesh_.points.push_back({x, y});
        space_.heights.push_back(z);
    }
    void end_nodes() {
        in_.expect("$EndNodes");
        if (!nodes_.sort()) in_.fail("two nodes have the same number");
    }

    void read_elements_2() {
        begin_elements();
        const std::size_t n =
            in_.checked_count(in_.ascii_number<std::size_t>("number of elements"), 8, "number of elements");
        in_.rest_of_line();
        // A binary file has one header for a block of elements; in ASCII each element has its own.
        for (std::size_t i = 0, block = 1; i < n; i += block) {
            if (!in_.binary()) in_.number<int>("element number");
            const int type = element_type(in_.number<int>("element type"));
            if (in_.binary()) block = static_cast<std::size_t>(in_.number<int>("number of elements"));
            const auto tags = in_.number<int>("number of tags");
            if (block == 0 || block > n - i) in_.fail("a block of elements is longer than the section, or empty");
            if (tags < 0 || tags > 1000) in_.fail(fmt::format("{} tags of an element", tags));
            for (std::size_t k = 0; k < block; ++k) {
                if (in_.binary()) in_.number<int>("element number");
                int group = 0;
                for (int t = 0; t < tags; ++t) {
                    const auto tag = in_.number<int>("tag");
                    if (t == 0) group = tag;
                }
                read_element<int>(type, group);
            }
        }
        in_.expect("$EndElements");
    }
    void read_elements_4() {
        begin_elements();
        const auto blocks = in_.number<std::size_t>("number of blocks of elements");
        for (int k = 0; k < 3; ++k) in_.number<std::size_t>("number of elements");
        for (std::size_t b = 0; b < blocks; ++b) {
            const auto dimension = in_.number<int>("dimension");
            const auto entity = in_.number<int>("entity");
            const int type = element_type(in_.number<int>("element type"));
            const std::size_t n =
                in_.checked_count(in_.number<std::size_t>("number of elements"), 16, "number of elements");
            const auto group = group_of_entity_.find({dimension, entity});
            for (std::size_t i = 0; i < n; ++i) {
                in_.number<std::size_t>("element number");
                read_element<std::size_t>(type, group == group_of_entity_.end() ? 0 : group->second);
            }
        }
        in_.expect("$EndElements");
    }
    void begin_elements() {
        if (!has_nodes_) in_.fail("$Elements before $Nodes");
        if (std::exchange(has_elements_, true)) in_.fail("a second $Elements");
    }
    int element_type(int type) const {
        if (find_msh_element(type) == nullptr && type != msh_point && !is_volume(type))
            in_.fail(
                fmt::format("element type {}: only points (15), lines, triangles and quadrilaterals of orders 1 to 4 "
                            "(1, 2, 3 at order 1), prisms (6) and hexahedra (5) can be read",
                            type));
        return type;
    }
    static bool is_volume(int type) { return type == msh_prism || type == msh_hexahedron; }
    template <class Number>
    VertexId find_node(Number number) const {
        const auto found = nodes_.find(static_cast<std::size_t>(number));
        if (!found) in_.fail(fmt::format("node {} is not in $Nodes", number));
        return VertexId(*found);
    }
    template <class Number>
    void read_volume(int type, int group) {
        SpaceMesh::Volume& volume = space_.volumes.emplace_back();
        volume.corners = type == msh_prism ? 3 : 4;
        for (std::size_t k = 0; k < 2 * volume.corners; ++k)
            volume.nodes[k] = static_cast<std::uint32_t>(find_node(in_.number<Number>("node number")).index());
        volume_groups_.push_back(group);
    }
    template <class Number>
    void read_element(int type, int group) {
        if (is_volume(type)) return read_volume<Number>(type, group);
        const MshElement* const element = find_msh_element(type);
        const std::size_t nodes = element == nullptr ? 1 : element->nodes;
        std::array<VertexId, 25> v;
        for (std::size_t k = 0; k < nodes; ++k) v[k] = find_node(in_.number<Number>("node number"));
        if (element == nullptr) return;
        if (order_ != 0 && element->order != order_) in_.fail("elements of several orders");
        order_ = element->order;
        const std::span<const VertexId> beside = std::span(v).subspan(element->corners, nodes - element->corners);
        const auto keep = [&](std::vector<VertexId>& list) { list.insert(list.end(), beside.begin(), beside.end()); };
        if (element->corners == 2 && group != 0) {
            edges_[group].push_back({v[0], v[1]});
            keep(edge_nodes_[group]);
        } else if (element->corners == 3) {
            mesh_.triangles.push_back({{v[0], v[1], v[2]}});
            triangle_groups_.push_back(group);
            keep(curved_.triangle_nodes);
        } else if (element->corners == 4) {
            mesh_.quads.push_back({{v[0], v[1], v[2], v[3]}});
            quad_groups_.push_back(group);
            keep(curved_.quad_nodes);
        }
    }

    /// Keeps data of one component. Where there are several steps in time, the last one counts.
    void read_node_data() {
        if (!has_nodes_) in_.fail("$NodeData before $Nodes");
        const NodeDataTags tags = read_node_data_tags();
        if (tags.components != 1) return in_.skip_behind("$EndNodeData");

        std::vector<double> values(mesh_.points.size(), std::nan(""));
        const std::size_t n = in_.checked_count(tags.values, 12, "number of values");
        for (std::size_t i = 0; i < n; ++i) {
            const VertexId node = find_node(in_.number<int>("node number"));
            values[node.index()] = in_.number<double>("value");
        }
        in_.expect("$EndNodeData");
        node_data_[std::string(tags.name)] = std::move(values);
    }
    struct NodeDataTags {
        std::string_view name;
        std::size_t components = 0, values = 0;
    };
    /// Reads the tags, which are ASCII in binary files, too.
    NodeDataTags read_node_data_tags() {
        NodeDataTags tags;
        const auto strings = in_.ascii_number<std::size_t>("number of string tags");
        in_.rest_of_line();
        for (std::size_t i = 0; i < strings; ++i) {
            const std::string_view line = in_.rest_of_line();
            if (line.empty()) in_.fail("string tag expected");
            if (i == 0) tags.name = line;
        }
        if (tags.name.size() >= 2 && tags.name.front() == '"' && tags.name.back() == '"')
            tags.name = tags.name.substr(1, tags.name.size() - 2);
        const auto reals = in_.ascii_number<std::size_t>("number of real tags");
        for (std::size_t i = 0; i < reals; ++i) in_.ascii_number<double>("real tag");
        const auto integers = in_.ascii_number<std::size_t>("number of integer tags");
        if (integers < 3) in_.fail("$NodeData has three integer tags or more");
        in_.ascii_number<std::size_t>("integer tag");  // the step in time
        tags.components = in_.ascii_number<std::size_t>("integer tag");
        tags.values = in_.ascii_number<std::size_t>("integer tag");
        for (std::size_t i = 3; i < integers; ++i) in_.ascii_number<std::size_t>("integer tag");
        in_.rest_of_line();
        return tags;
    }

    /// Makes the plane mesh of its copies: triangles and quadrilaterals are faces of the volumes.
    void gather_extrusion() {
        if (order_ > 1) in_.fail("curved elements beside prisms and hexahedra");
        std::map<int, std::size_t> markers;
        const auto add_faces = [&](std::size_t corners, const auto& cells, const std::vector<int>& groups) {
            for (std::size_t i = 0; i < cells.size(); ++i) {
                if (groups[i] == 0) continue;
                const std::size_t marker = markers.emplace(groups[i], markers.size()).first->second;
                SpaceMesh::Face& face = space_.faces.emplace_back(SpaceMesh::Face{corners, {}, marker});
                for (std::size_t k = 0; k < corners; ++k)
                    face.nodes[k] = static_cast<std::uint32_t>(cells[i].v[k].index());
            }
        };
        add_faces(3, mesh_.triangles, triangle_groups_);
        add_faces(4, mesh_.quads, quad_groups_);
        space_.points = std::exchange(mesh_.points, {});
        PlaneOfExtrusion plane = plane_of_extrusion(space_, markers.size(), file_);
        mesh_.points = std::move(plane.points);
        mesh_.triangles = std::move(plane.triangles);
        mesh_.quads = std::move(plane.quads);
        edges_.clear();  // lines of the file, if any, are edges of faces
        edge_nodes_.clear();
        for (const auto& [group, marker] : markers)
            if (!plane.edges[marker].empty()) edges_[group] = std::move(plane.edges[marker]);
        triangle_groups_.clear();
        quad_groups_.clear();
        for (const std::uint32_t volume : plane.volumes) triangle_groups_.push_back(volume_groups_[volume]);
    }
    void require_plane() const {
        for (std::size_t i = 0; i < space_.heights.size(); ++i)
            if (const double z = space_.heights[i], first = space_.heights.front(); z != first)
                throw InputError(
                    {file_.string(), 0, {}},
                    fmt::format("node {} of the file lies in the plane z = {}, the first one in z = {}: the "
                                "mesh is not plane, nor are there prisms or hexahedra",
                                i + 1, z, first));
    }

    void finish() {
        const bool in_space = !space_.volumes.empty();
        in_space ? gather_extrusion() : require_plane();
        for (auto& [group, edges] : edges_) {
            const auto named = names_.find({in_space ? 2 : 1, group});
            const std::string name = named != names_.end() ? std::string(named->second)
                                                           : fmt::format("{}{}", in_space ? "surface" : "curve", group);
            mesh_.markers.push_back({name, core::kind_of_name(name), std::move(edges)});
            const std::vector<VertexId>& nodes = edge_nodes_[group];
            curved_.marker_nodes.insert(curved_.marker_nodes.end(), nodes.begin(), nodes.end());
        }
        triangle_groups_.insert(triangle_groups_.end(), quad_groups_.begin(), quad_groups_.end());
        for (const int group : triangle_groups_) {
            const auto named = names_.find({in_space ? 3 : 2, group});
            Region region;
            if (named == names_.end() || !region_of_name(named->second, region)) {
                mesh_.region.clear();
                break;
            }
            mesh_.region.push_back(region);
        }
        if (order_ > 1) curved_.order = order_;
        CurvedMesh curved{std::move(mesh_), std::move(curved_)};
        if (!orient_and_separate(curved)) in_.fail("a node is the corner of one element and no corner of another one");
        mesh_ = std::move(curved.mesh);
        curved_ = std::move(curved.nodes);
    }

    ByteReader in_;
    std::filesystem::path file_;
    bool version_4_ = true, has_nodes_ = false, has_elements_ = false;
    SpaceMesh space_;                 ///< heights of all nodes, and the volumes
    std::vector<int> volume_groups_;  ///< per volume: its physical group, or 0
    FileNumbers nodes_{1};
    std::map<EntityKey, std::string_view> names_;  ///< of the physical groups
    std::map<EntityKey, int> group_of_entity_;
    std::map<int, std::vector<Segment>> edges_;        ///< lines by physical group
    std::map<int, std::vector<VertexId>> edge_nodes_;  ///< their nodes beside the ends
    std::vector<int> triangle_groups_, quad_groups_;   ///< per cell: its physical group, or 0
    std::map<std::string, std::vector<double>, std::less<>> node_data_;
    unsigned order_ = 0;  ///< of all lines and cells; 0 before the first one
    Mesh mesh_;
    CurvedNodes curved_;
};

}  // namespace

CurvedMesh read_curved_msh(const std::string& bytes, const std::filesystem::path& file) {
    return MshReader(bytes, file).read_curved();
}

Mesh read_msh(const std::string& bytes, const std::filesystem::path& file) { return MshReader(bytes, file).read(); }

PointValues read_msh_sizes(const std::string& bytes, const std::filesystem::path& file) {
    return read_point_values(MshReader(bytes, file));
}

}  // namespace lamina::io
