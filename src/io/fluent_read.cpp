// Reads plane meshes in Ansys Fluent's mesh format, ASCII and binary, from files with the mesh alone and from cases.
// fluent.hpp describes the format.
//
// A zone of faces becomes a marker unless it is of type `interior`, in the order in which they begin in the file. Every
// marker needs the section that names its zone. Cells are turned counter-clockwise, since not all programs follow the
// rule which cell of a face stands first. Sections of other numbers are skipped.
#include "io/fluent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "core/file_name.hpp"
#include "core/marker_names.hpp"
#include "core/text.hpp"
#include "io/binary_output.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/number_text.hpp"

namespace lamina::io {

namespace {

/// The parentheses, words and numbers of a file.
class FluentBytes {
public:
    /// The bytes must outlive this object.
    FluentBytes(const std::string& bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

    std::size_t size() const { return bytes_.size(); }
    bool at_end() {
        skip_blanks();
        return at_ == bytes_.size();
    }
    /// Returns whether the next character that is no blank is this one.
    bool next_is(char c) {
        skip_blanks();
        return at_ < bytes_.size() && bytes_[at_] == c;
    }
    void expect(char c) {
        if (!next_is(c)) fail(fmt::format("'{}' expected", c));
        ++at_;
    }
    /// Reads what stands before the next blank or parenthesis.
    std::string_view word() {
        skip_blanks();
        const std::size_t first = at_;
        while (at_ < bytes_.size() && !is_blank(bytes_[at_]) && bytes_[at_] != '(' && bytes_[at_] != ')') ++at_;
        return std::string_view(bytes_).substr(first, at_ - first);
    }
    std::size_t integer(const char* meaning, int base) {
        const std::string_view text = word();
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
        if (text.empty() || error != std::errc{} || end != text.data() + text.size())
            fail(fmt::format("{} expected", meaning));
        return value;
    }
    double coordinate() {
        std::string_view text = word();
        if (text.starts_with('+')) text.remove_prefix(1);
        const std::optional<double> value = parse_whole<double>(text);
        if (!value) fail("coordinate expected");
        return *value;
    }
    /// Reads a number that is stored as it lies in memory.
    template <class T>
    T stored(ByteOrder order) {
        if (bytes_.size() - at_ < sizeof(T)) fail("the file ends within a list");
        at_ += sizeof(T);
        return load<T>(bytes_.data() + at_ - sizeof(T), order);
    }
    /// Goes behind the parenthesis that closes `open` others.
    void close(std::size_t open) {
        for (bool quoted = false; open > 0; ++at_) {
            if (at_ == bytes_.size()) fail("the file ends within a section");
            const char c = bytes_[at_];
            if (c == '\\')
                at_ = std::min(at_ + 1, bytes_.size() - 1);
            else if (c == '"')
                quoted = !quoted;
            else if (!quoted && c == '(')
                ++open;
            else if (!quoted && c == ')')
                --open;
        }
    }
    /// Goes behind the end of a binary section.
    void skip_binary(std::size_t section) {
        constexpr std::string_view end = "End of Binary Section";
        for (;;) {
            at_ = bytes_.find(end, at_);
            if (at_ == std::string::npos) {
                at_ = bytes_.size();
                fail("the file ends within a binary section");
            }
            at_ += end.size();
            skip_blanks();
            const std::string number = fmt::format("{})", section);
            if (bytes_.compare(at_, number.size(), number) == 0) {
                at_ += number.size();
                return;
            }
        }
    }
    /// From here on errors name no line.
    void name_no_line() { names_line_ = false; }
    /// Throws InputError with the file and the line.
    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError({file_, names_line_ ? line_at(bytes_, std::min(at_, bytes_.size())) : 0, {}}, reason);
    }

private:
    void skip_blanks() {
        while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
    }

    const std::string& bytes_;
    std::string file_;
    std::size_t at_ = 0;
    bool names_line_ = true;
};

/// A face between two cells, or between a cell and the outside. Cells are numbered from 1; 0 is the outside.
struct FluentFace {
    std::array<std::size_t, 2> node, cell;
};

struct FluentFaceZone {
    std::size_t zone = 0, type = 0;
    std::vector<FluentFace> faces{};
};

/// The sides of a cell, with the cell on the left.
struct CellSides {
    std::array<Segment, 4> sides;
    std::size_t count = 0;
};

class FluentReader {
public:
    FluentReader(const std::string& bytes, const std::filesystem::path& file) : in_(bytes, file.string()) {}

    Mesh read() {
        while (!in_.at_end()) read_section();
        in_.name_no_line();
        if (!dimension_ || !nodes_ || !cells_ || !faces_)
            in_.fail("the file ends without the dimension or without the numbers of nodes, cells and faces");
        require_complete();
        gather_cells();
        gather_markers();
        orient_markers(mesh_);
        return std::move(mesh_);
    }

private:
    /// The header of a section of nodes, cells or faces. Zone 0 is the declaration of how many there are.
    struct Header {
        std::size_t zone = 0, first = 0, last = 0, type = 0;
        std::optional<std::size_t> element{};  ///< dimension, shape of cells, or shape of faces

        std::size_t count() const { return last - first + 1; }
    };

    void read_section() {
        in_.expect('(');
        const std::size_t number = in_.integer("number of a section", 10);
        const std::size_t kind = number % 1000;
        binary_ = number >= fluent_floats;
        doubles_ = number >= fluent_doubles;
        if (binary_) in_.name_no_line();
        if (number == fluent_dimension) {
            dimension_ = in_.integer("dimension", 10);
            if (*dimension_ != 2) in_.fail(fmt::format("a mesh in {} dimensions: plane ones can be read", *dimension_));
            in_.expect(')');
        } else if (number == fluent_machine) {
            in_.expect('(');
            order_ = in_.integer("byte order", 10) == fluent_little_endian ? ByteOrder::little : ByteOrder::big;
            in_.close(2);
        } else if (kind == fluent_nodes && is_mesh_section(number)) {
            read_nodes(number);
        } else if (kind == fluent_cells && is_mesh_section(number)) {
            read_cells(number);
        } else if (kind == fluent_faces && is_mesh_section(number)) {
            read_faces(number);
        } else if (number == fluent_zone || number == fluent_zone_of_case) {
            read_zone();
        } else if (kind == fluent_cell_tree || kind == fluent_face_tree) {
            in_.fail("a mesh with hanging nodes cannot be read");
        } else if (binary_) {
            in_.skip_binary(number);
        } else {
            in_.close(1);
        }
    }
    static bool is_mesh_section(std::size_t number) {
        return number < 1000 || number / 1000 * 1000 == fluent_floats || number / 1000 * 1000 == fluent_doubles;
    }

    /// Reads a header, without what follows it. The last number, which counts nodes, cells or faces, is at most the
    /// number of bytes of the file.
    Header read_header() {
        Header header;
        in_.expect('(');
        header.zone = in_.integer("number of a zone", 16);
        header.first = in_.integer("first number", 16);
        header.last = in_.integer("last number", 16);
        if (!in_.next_is(')')) header.type = in_.integer("type", 16);
        if (!in_.next_is(')')) header.element = in_.integer("type of elements", 16);
        in_.expect(')');
        if (header.first == 0 || header.first > header.last + 1 || header.last > in_.size())
            in_.fail(fmt::format("numbers from {} to {}, which the file has no room for", header.first, header.last));
        return header;
    }
    void end_section(std::size_t number) {
        in_.expect(')');
        if (binary_)
            in_.skip_binary(number);
        else
            in_.expect(')');
    }
    std::size_t number(const char* meaning) {
        if (!binary_) return in_.integer(meaning, 16);
        const auto value = in_.stored<std::int32_t>(order_);
        if (value < 0) in_.fail(fmt::format("{} expected", meaning));
        return static_cast<std::size_t>(value);
    }
    double coordinate() {
        double value = 0;
        if (!binary_)
            value = in_.coordinate();
        else if (doubles_)
            value = in_.stored<double>(order_);
        else
            value = in_.stored<float>(order_);
        if (!std::isfinite(value)) in_.fail("coordinate is not a finite number");
        return value;
    }

    void read_nodes(std::size_t section) {
        const Header header = read_header();
        if (header.zone == 0) {
            nodes_ = header.last;
            return in_.close(1);
        }
        if (header.element.value_or(2) != 2) in_.fail("nodes with other than two coordinates");
        constexpr double missing = std::numeric_limits<double>::quiet_NaN();
        if (mesh_.points.size() < header.last) mesh_.points.resize(header.last, {missing, missing});
        in_.expect('(');
        for (std::size_t i = header.first; i <= header.last; ++i) {
            Point& point = mesh_.points[i - 1];
            if (!std::isnan(point.x)) in_.fail(fmt::format("node {} stands twice", i));
            point.x = coordinate();
            point.y = coordinate();
        }
        end_section(section);
    }

    /// Reads the shapes of cells. Zones of one shape have no list.
    void read_cells(std::size_t section) {
        const Header header = read_header();
        if (header.zone == 0) {
            cells_ = header.last;
            return in_.close(1);
        }
        if (header.type == 0) in_.fail("a zone of dead cells");
        if (shapes_.size() < header.last) shapes_.resize(header.last, fluent_mixed);
        const std::size_t zone_shape = header.element.value_or(fluent_triangle);
        if (zone_shape == fluent_mixed) in_.expect('(');
        for (std::size_t i = header.first; i <= header.last; ++i) {
            const std::size_t shape = zone_shape == fluent_mixed ? number("shape of a cell") : zone_shape;
            if (shape != fluent_triangle && shape != fluent_quad)
                in_.fail(fmt::format("a cell of shape {}: triangles (1) and quadrilaterals (3) can be read", shape));
            if (shapes_[i - 1] != fluent_mixed) in_.fail(fmt::format("cell {} stands twice", i));
            shapes_[i - 1] = static_cast<std::uint8_t>(shape);
        }
        if (zone_shape == fluent_mixed) return end_section(section);
        if (binary_ && !in_.next_is(')')) return in_.skip_binary(section);
        in_.close(1);
    }

    void read_faces(std::size_t section) {
        const Header header = read_header();
        if (header.zone == 0) {
            faces_ = header.last;
            return in_.close(1);
        }
        const std::size_t shape = header.element.value_or(fluent_edge);
        constexpr std::size_t polygons = 5;
        FluentFaceZone& zone = find_zone(header.zone, header.type);
        in_.expect('(');
        for (std::size_t i = header.first; i <= header.last; ++i) {
            const bool says_nodes = shape == fluent_mixed || shape == polygons;
            if ((says_nodes ? number("number of nodes") : shape) != fluent_edge)
                in_.fail("a face of other than two nodes");
            FluentFace& face = zone.faces.emplace_back();
            for (std::size_t& node : face.node) node = number("node");
            for (std::size_t& cell : face.cell) cell = number("cell");
        }
        faces_read_ += header.count();
        end_section(section);
    }
    FluentFaceZone& find_zone(std::size_t number, std::size_t type) {
        const auto found =
            std::find_if(zones_.begin(), zones_.end(), [&](const FluentFaceZone& zone) { return zone.zone == number; });
        return found != zones_.end() ? *found : zones_.emplace_back(FluentFaceZone{number, type});
    }

    void read_zone() {
        in_.expect('(');
        const std::size_t zone = in_.integer("number of a zone", 10);
        const std::string_view type = in_.word(), name = in_.word();
        if (name.empty()) in_.fail("name of a zone expected");
        names_[zone] = {type, name};
        in_.close(2);
    }

    /// Throws where something is missing or more than was declared, so that a file that was cut short is noticed.
    void require_complete() const {
        const auto require = [&](const char* what, std::size_t declared, std::size_t read) {
            if (declared != read) in_.fail(fmt::format("{} {} are declared, but {} are there", declared, what, read));
        };
        require("nodes", *nodes_, mesh_.points.size());
        require("cells", *cells_, shapes_.size());
        require("faces", *faces_, faces_read_);
        for (std::size_t i = 0; i < mesh_.points.size(); ++i)
            if (std::isnan(mesh_.points[i].x)) in_.fail(fmt::format("node {} is missing", i + 1));
        for (std::size_t i = 0; i < shapes_.size(); ++i)
            if (shapes_[i] == fluent_mixed) in_.fail(fmt::format("cell {} is missing", i + 1));
        for (const FluentFaceZone& zone : zones_)
            for (const FluentFace& face : zone.faces) require_in_range(face);
    }
    void require_in_range(const FluentFace& face) const {
        for (const std::size_t node : face.node)
            if (node < 1 || node > mesh_.points.size())
                in_.fail(fmt::format("node {} where there are {}", node, mesh_.points.size()));
        for (const std::size_t cell : face.cell)
            if (cell > shapes_.size()) in_.fail(fmt::format("cell {} where there are {}", cell, shapes_.size()));
        if (face.cell[0] == 0 && face.cell[1] == 0)
            in_.fail(fmt::format("the face from node {} to node {} has no cell", face.node[0], face.node[1]));
    }

    void gather_cells() {
        std::vector<CellSides> cells(shapes_.size());
        for (const FluentFaceZone& zone : zones_)
            for (const FluentFace& face : zone.faces) {
                const VertexId a(face.node[0] - 1), b(face.node[1] - 1);
                if (face.cell[0] != 0) add_side(cells, face.cell[0], {a, b});
                if (face.cell[1] != 0) add_side(cells, face.cell[1], {b, a});
            }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            std::array<VertexId, 4> v = corners_of(cells[i], i);
            const auto at = [&](std::size_t k) { return mesh_.points[v[k].index()]; };
            const double twice_area = shapes_[i] == fluent_triangle ? cross(at(1) - at(0), at(2) - at(0))
                                                                    : cross(at(2) - at(0), at(3) - at(1));
            if (twice_area < 0) std::reverse(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(cells[i].count));
            if (shapes_[i] == fluent_triangle)
                mesh_.triangles.push_back({{v[0], v[1], v[2]}});
            else
                mesh_.quads.push_back({{v[0], v[1], v[2], v[3]}});
        }
    }
    std::size_t sides_of(std::size_t cell) const { return shapes_[cell] == fluent_triangle ? 3 : 4; }
    void add_side(std::vector<CellSides>& cells, std::size_t number, const Segment& side) const {
        CellSides& cell = cells[number - 1];
        if (cell.count == sides_of(number - 1)) in_.fail(fmt::format("cell {} has too many faces", number));
        cell.sides[cell.count++] = side;
    }
    /// Returns the corners in the order in which the sides follow each other.
    std::array<VertexId, 4> corners_of(const CellSides& cell, std::size_t index) const {
        std::array<VertexId, 4> corners;
        VertexId at = cell.sides[0].a;
        for (std::size_t k = 0; k < sides_of(index); ++k) {
            corners[k] = at;
            const auto* const end = cell.sides.begin() + cell.count;
            const auto* const side = std::find_if(cell.sides.begin(), end, [&](const Segment& s) { return s.a == at; });
            if (cell.count != sides_of(index) || side == end)
                in_.fail(fmt::format("the faces of cell {} are not closed", index + 1));
            at = side->b;
        }
        if (at != corners[0]) in_.fail(fmt::format("the faces of cell {} are not closed", index + 1));
        return corners;
    }

    void gather_markers() {
        for (const FluentFaceZone& zone : zones_) {
            const auto named = names_.find(zone.zone);
            if (zone.type == static_cast<std::size_t>(fluent_interior.code) ||
                (named != names_.end() && named->second.first == fluent_interior.name))
                continue;
            if (named == names_.end()) in_.fail(fmt::format("no section 45 or 39 names zone {}", zone.zone));
            Marker& marker = mesh_.markers.emplace_back();
            marker.name = named->second.second;
            marker.kind = kind_of(zone.type, named->second.first, marker.name);
            for (const FluentFace& face : zone.faces) {
                const VertexId a(face.node[0] - 1), b(face.node[1] - 1);
                marker.edges.push_back(face.cell[0] != 0 ? Segment{a, b} : Segment{b, a});
            }
        }
    }
    static MarkerKind kind_of(std::size_t code, std::string_view type, std::string_view name) {
        // What joins both borders of a row in Fluent is no type of a zone.
        if (core::kind_of_name(name) == MarkerKind::periodic) return MarkerKind::periodic;
        for (const FluentZoneType& known : fluent_zone_types)
            if (type == known.name || (type.empty() && code == static_cast<std::size_t>(known.code))) return known.kind;
        return core::kind_of_name(name);
    }

    FluentBytes in_;
    bool binary_ = false, doubles_ = false;  ///< of the section that is read
    ByteOrder order_ = ByteOrder::little;
    std::optional<std::size_t> dimension_, nodes_, cells_, faces_;  ///< as they are declared
    std::size_t faces_read_ = 0;
    std::vector<std::uint8_t> shapes_;  ///< per cell: a FluentShape; mixed where it was not read
    std::vector<FluentFaceZone> zones_;
    std::map<std::size_t, std::pair<std::string_view, std::string_view>> names_;  ///< by zone: its type and its name
    Mesh mesh_;
};

}  // namespace

Mesh read_fluent(const std::string& bytes, const std::filesystem::path& file) {
    return FluentReader(bytes, file).read();
}

bool holds_fluent_mesh(const std::filesystem::path& file) {
    std::error_code ignored;
    if (core::lower_case(core::extension_of(file)) != ".msh" || !std::filesystem::is_regular_file(file, ignored))
        return false;
    std::ifstream in(file, std::ios::binary);
    char first = 0;
    in >> first;
    return first == '(';
}

}  // namespace lamina::io
