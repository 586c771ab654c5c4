// VTK XML unstructured grid with one piece, all arrays appended as raw bytes: [length, UInt64][bytes] each, offsets
// counted from behind the underscore.
// Source: VTK User's Guide, "VTK File Formats", XML.
//
// Beyond points and cells the files hold, so that a mesh comes back as it was:
//   cell data    region (0 layer, 1 isotropic), piece, layer, where the mesh has them; marker
//   cells        triangles, quads, then each marker's edges as lines: their `marker` is 1 for the first name, ...; 0 on
//                triangles and quads. Lines repeat nothing else: their region is 2, their piece and layer 0
//   field data   marker_names (UTF-8, a zero byte behind each: not every reader knows strings), marker_kinds (as
//   MarkerKind), constraints (pairs of points)
// Read back: little-endian files of one piece with raw appended, uncompressed arrays of any numeric type, of triangles
// (5), quads (9) and lines (3); z and other arrays are ignored; lines with marker 0 or without the array, too.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

#include <lamina/error.hpp>

#include "io/formats.hpp"

namespace lamina::detail {

namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

enum CellType : std::uint8_t { line_type = 3, triangle_type = 5, quad_type = 9 };

template <class T>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "UInt32";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "UInt16";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

// --- Writing

/// The header, and behind it the arrays it announces; they are made only when they are written.
class VtuWriter {
public:
    std::string xml;

    /// put(emit) calls emit(value) for each of the tuples x components values.
    template <class T, class Put>
    void array(const char* name, std::size_t tuples, std::size_t components, Put put, bool in_field_data = false) {
        announce(type_name<T>(), name, tuples, components, in_field_data);
        append(tuples * components * sizeof(T), [put = std::move(put)](std::ostream& out) {
            std::vector<T> buffer;
            buffer.reserve(1 << 15);
            const auto flush = [&] {
                out.write(reinterpret_cast<const char*>(buffer.data()),
                          static_cast<std::streamsize>(buffer.size() * sizeof(T)));
                buffer.clear();
            };
            put([&](auto value) {
                buffer.push_back(static_cast<T>(value));
                if (buffer.size() == buffer.capacity()) flush();
            });
            flush();
        });
    }
    void write(std::ostream& out) const {
        out << xml << "  <AppendedData encoding=\"raw\">\n_";
        for (const Appended& data : appended_) {
            const std::uint64_t size = data.bytes;
            out.write(reinterpret_cast<const char*>(&size), sizeof size);
            data.write(out);
        }
        out << "\n  </AppendedData>\n</VTKFile>\n";
    }

private:
    struct Appended {
        std::size_t bytes;
        std::function<void(std::ostream&)> write;
    };
    void announce(const char* type, const char* name, std::size_t tuples, std::size_t components, bool in_field_data) {
        xml += fmt::format("        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ", type, name,
                           components);
        if (in_field_data) xml += fmt::format("NumberOfTuples=\"{}\" ", tuples);
        xml += fmt::format("format=\"appended\" offset=\"{}\"/>\n", offset_);
    }
    void append(std::size_t bytes, std::function<void(std::ostream&)> write) {
        appended_.push_back({bytes, std::move(write)});
        offset_ += sizeof(std::uint64_t) + bytes;
    }

    std::vector<Appended> appended_;
    std::size_t offset_ = 0;
};

std::size_t line_count(const Mesh& mesh) {
    std::size_t lines = 0;
    for (const Marker& marker : mesh.markers) lines += marker.edges.size();
    return lines;
}

/// Values of the cells, then `of_line` for each line.
template <class T, class V>
void put_cell_array(VtuWriter& vtu, const char* name, const std::vector<V>& values, std::size_t lines, T of_line) {
    if (values.empty()) return;
    vtu.array<T>(name, values.size() + lines, 1, [&values, lines, of_line](auto emit) {
        for (const V value : values) emit(value);
        for (std::size_t i = 0; i < lines; ++i) emit(of_line);
    });
}

void put_field_data(const Mesh& mesh, VtuWriter& vtu) {
    std::string names;
    for (const Marker& marker : mesh.markers) names += marker.name + '\0';
    vtu.xml += "    <FieldData>\n";
    constexpr bool in_field_data = true;
    vtu.array<std::uint8_t>(
        "marker_names", names.size(), 1,
        [names](auto emit) {
            for (const char c : names) emit(c);
        },
        in_field_data);
    vtu.array<std::uint32_t>(
        "constraints", mesh.constraints.size(), 2,
        [&mesh](auto emit) {
            for (const Segment& edge : mesh.constraints) emit(edge.a.value), emit(edge.b.value);
        },
        in_field_data);
    vtu.array<std::uint8_t>(
        "marker_kinds", mesh.markers.size(), 1,
        [&mesh](auto emit) {
            for (const Marker& marker : mesh.markers) emit(marker.kind);
        },
        in_field_data);
    vtu.xml += "    </FieldData>\n";
}

void put_cell_data(const Mesh& mesh, VtuWriter& vtu) {
    const std::size_t cells = mesh.triangles.size() + mesh.quads.size(), lines = line_count(mesh);
    vtu.xml += "      <CellData>\n";
    put_cell_array<std::uint8_t>(vtu, "region", mesh.region, lines, 2);
    put_cell_array<std::uint32_t>(vtu, "piece", mesh.piece, lines, 0);
    put_cell_array<std::uint16_t>(vtu, "layer", mesh.layer, lines, 0);
    vtu.array<std::uint32_t>("marker", cells + lines, 1, [&mesh, cells](auto emit) {
        for (std::size_t i = 0; i < cells; ++i) emit(0);
        for (std::size_t m = 0; m < mesh.markers.size(); ++m)
            for (std::size_t i = 0; i < mesh.markers[m].edges.size(); ++i) emit(m + 1);
    });
    vtu.xml += "      </CellData>\n";
}

void put_points(const Mesh& mesh, VtuWriter& vtu) {
    vtu.xml += "      <Points>\n";
    vtu.array<double>("Points", mesh.points.size(), 3, [&mesh](auto emit) {
        for (const Point p : mesh.points) emit(p.x), emit(p.y), emit(0.0);
    });
    vtu.xml += "      </Points>\n";
}

void put_cells(const Mesh& mesh, VtuWriter& vtu) {
    const std::size_t triangles = mesh.triangles.size(), quads = mesh.quads.size(), lines = line_count(mesh);
    vtu.xml += "      <Cells>\n";
    vtu.array<std::int64_t>("connectivity", 3 * triangles + 4 * quads + 2 * lines, 1, [&mesh](auto emit) {
        for (const Triangle& t : mesh.triangles)
            for (const VertexId v : t.v) emit(v.value);
        for (const Quad& q : mesh.quads)
            for (const VertexId v : q.v) emit(v.value);
        for (const Marker& marker : mesh.markers)
            for (const Segment& edge : marker.edges) emit(edge.a.value), emit(edge.b.value);
    });
    vtu.array<std::int64_t>("offsets", triangles + quads + lines, 1, [=](auto emit) {
        std::int64_t offset = 0;
        for (std::size_t i = 0; i < triangles; ++i) emit(offset += 3);
        for (std::size_t i = 0; i < quads; ++i) emit(offset += 4);
        for (std::size_t i = 0; i < lines; ++i) emit(offset += 2);
    });
    vtu.array<std::uint8_t>("types", triangles + quads + lines, 1, [=](auto emit) {
        for (std::size_t i = 0; i < triangles; ++i) emit(triangle_type);
        for (std::size_t i = 0; i < quads; ++i) emit(quad_type);
        for (std::size_t i = 0; i < lines; ++i) emit(line_type);
    });
    vtu.xml += "      </Cells>\n";
}

// --- Reading

/// An element's name and attributes; closing ones have a name that begins with '/'.
struct Tag {
    std::string_view name;
    std::map<std::string_view, std::string_view> attributes;
    bool closed = false;  ///< ends with "/>"
};

/// Just enough XML for what VTK writes: tags with quoted attributes, and text, which is skipped.
class TagReader {
public:
    explicit TagReader(std::string_view text) : text_(text) {}

    /// False at the end of the text, also where it ends within a tag.
    bool next(Tag& tag) {
        tag = {};
        const std::size_t start = text_.find('<', at_);
        if (start == std::string_view::npos) return false;
        at_ = start + 1;
        tag.name = word();
        while (at_ < text_.size()) {
            skip_space();
            if (at_ < text_.size() && (text_[at_] == '/' || text_[at_] == '?')) {
                tag.closed = true;
                ++at_;
            } else if (at_ < text_.size() && text_[at_] == '>') {
                ++at_;
                return true;
            } else if (!attribute(tag)) {
                return false;
            }
        }
        return false;
    }
    /// Behind the last tag.
    std::size_t position() const { return at_; }

private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
    void skip_space() {
        while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    }
    std::string_view word() {
        const std::size_t start = at_;
        if (at_ < text_.size() && (text_[at_] == '/' || text_[at_] == '?')) ++at_;
        while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '=' && text_[at_] != '>' &&
               text_[at_] != '/' && text_[at_] != '?')
            ++at_;
        return text_.substr(start, at_ - start);
    }
    bool attribute(Tag& tag) {
        const std::string_view key = word();
        skip_space();
        if (key.empty() || at_ >= text_.size() || text_[at_] != '=') return false;
        ++at_;
        skip_space();
        if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return false;
        const std::size_t start = at_ + 1, end = text_.find(text_[at_], start);
        if (end == std::string_view::npos) return false;
        tag.attributes[key] = text_.substr(start, end - start);
        at_ = end + 1;
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

class VtuReader {
public:
    VtuReader(const std::string& bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

    Mesh read() {
        read_header();
        read_points();
        read_markers_and_constraints();
        read_cells();
        return std::move(mesh_);
    }

private:
    struct Array {
        std::string_view type;
        std::size_t offset = 0;
    };

    [[noreturn]] void fail(const std::string& reason) const { throw InputError({file_, 0, {}}, reason); }

    std::size_t number(const Tag& tag, std::string_view attribute) const {
        const auto found = tag.attributes.find(attribute);
        const std::string_view text = found == tag.attributes.end() ? std::string_view{} : found->second;
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size())
            fail(fmt::format("no number in attribute '{}' of <{}>", attribute, tag.name));
        return value;
    }
    void demand(const Tag& tag, std::string_view attribute, std::string_view value) const {
        const auto found = tag.attributes.find(attribute);
        if (found == tag.attributes.end() || found->second != value)
            fail(fmt::format("<{}> without {}=\"{}\" cannot be read", tag.name, attribute, value));
    }

    /// Finds the arrays, named "section/name", and the byte their offsets count from.
    void read_header() {
        TagReader tags(bytes_);
        std::string_view section;
        bool is_vtu = false, has_piece = false;
        for (Tag tag; tags.next(tag);) {
            if (tag.name == "VTKFile") {
                demand(tag, "type", "UnstructuredGrid");
                demand(tag, "byte_order", "LittleEndian");
                demand(tag, "header_type", "UInt64");
                if (tag.attributes.contains("compressor")) fail("compressed files cannot be read");
                is_vtu = true;
            } else if (tag.name == "Piece") {
                if (has_piece) fail("files of more than one piece cannot be read");
                has_piece = true;
                points_ = number(tag, "NumberOfPoints");
                cells_ = number(tag, "NumberOfCells");
            } else if (tag.name == "FieldData" || tag.name == "PointData" || tag.name == "CellData" ||
                       tag.name == "Points" || tag.name == "Cells") {
                section = tag.name;
            } else if (tag.name == "DataArray") {
                demand(tag, "format", "appended");
                arrays_[fmt::format("{}/{}", section, section == "Points" ? "" : tag.attributes["Name"])] = {
                    tag.attributes["type"], number(tag, "offset")};
            } else if (tag.name == "AppendedData") {
                demand(tag, "encoding", "raw");
                const std::size_t underscore = bytes_.find('_', tags.position());
                if (!is_vtu || !has_piece || underscore == std::string::npos) break;
                data_ = underscore + 1;
                return;
            }
        }
        fail("not a VTU file with appended data, or cut short");
    }

    bool has(const std::string& name) const { return arrays_.contains(name); }

    std::string_view array_bytes(const std::string& name) const {
        const auto found = arrays_.find(name);
        if (found == arrays_.end()) fail(fmt::format("array '{}' is missing", name));
        const std::size_t size = bytes_.size() - data_, offset = found->second.offset;
        std::uint64_t length = 0;
        if (offset > size || size - offset < sizeof length) fail(fmt::format("cut short before array '{}'", name));
        std::memcpy(&length, bytes_.data() + data_ + offset, sizeof length);
        if (length > size - offset - sizeof length) fail(fmt::format("cut short within array '{}'", name));
        return std::string_view(bytes_).substr(data_ + offset + sizeof length, length);
    }

    /// The values of an array, converted from whatever type they have. Integers that T cannot hold are refused.
    template <class T>
    std::vector<T> values(const std::string& name) const {
        const std::string_view raw = array_bytes(name);
        const std::string_view type = arrays_.find(name)->second.type;
        if (type == "Float64") return convert<T, double>(name, raw);
        if (type == "Float32") return convert<T, float>(name, raw);
        if (type == "Int64") return convert<T, std::int64_t>(name, raw);
        if (type == "UInt64") return convert<T, std::uint64_t>(name, raw);
        if (type == "Int32") return convert<T, std::int32_t>(name, raw);
        if (type == "UInt32") return convert<T, std::uint32_t>(name, raw);
        if (type == "Int16") return convert<T, std::int16_t>(name, raw);
        if (type == "UInt16") return convert<T, std::uint16_t>(name, raw);
        if (type == "Int8") return convert<T, std::int8_t>(name, raw);
        if (type == "UInt8") return convert<T, std::uint8_t>(name, raw);
        fail(fmt::format("array '{}' has the unknown type '{}'", name, type));
    }
    template <class T, class Stored>
    std::vector<T> convert(const std::string& name, std::string_view raw) const {
        if (raw.size() % sizeof(Stored) != 0) fail(fmt::format("array '{}' has a broken length", name));
        std::vector<T> result(raw.size() / sizeof(Stored));
        for (std::size_t i = 0; i < result.size(); ++i) {
            Stored value;
            std::memcpy(&value, raw.data() + i * sizeof value, sizeof value);
            if constexpr (std::is_integral_v<T>) {
                bool fits = false;
                if constexpr (std::is_integral_v<Stored>) fits = std::in_range<T>(value);
                if (!fits) fail(fmt::format("array '{}' holds a value that is out of range", name));
            }
            result[i] = static_cast<T>(value);
        }
        return result;
    }
    template <class T>
    std::vector<T> values(const std::string& name, std::size_t expected) const {
        std::vector<T> result = values<T>(name);
        if (result.size() != expected)
            fail(fmt::format("array '{}' has {} values where {} are announced", name, result.size(), expected));
        return result;
    }

    void read_points() {
        if (points_ > bytes_.size()) fail("NumberOfPoints exceeds the file");
        const std::vector<double> coordinates = values<double>("Points/", 3 * points_);
        mesh_.points.resize(points_);
        for (std::size_t i = 0; i < points_; ++i) {
            mesh_.points[i] = {coordinates[3 * i], coordinates[3 * i + 1]};
            if (!std::isfinite(mesh_.points[i].x) || !std::isfinite(mesh_.points[i].y))
                fail(fmt::format("point {} is not finite", i));
        }
    }

    VertexId vertex(std::int64_t index) const {
        if (index < 0 || static_cast<std::size_t>(index) >= points_)
            fail(fmt::format("vertex index {} where there are {} points", index, points_));
        return VertexId(static_cast<std::size_t>(index));
    }

    void read_markers_and_constraints() {
        if (has("FieldData/marker_names")) {
            std::string_view names = array_bytes("FieldData/marker_names");
            for (std::size_t end; (end = names.find('\0')) != std::string_view::npos; names.remove_prefix(end + 1))
                mesh_.markers.push_back({std::string(names.substr(0, end)), MarkerKind::other, {}});
            if (!names.empty()) fail("the last marker's name does not end");
        }
        if (has("FieldData/marker_kinds")) {
            const auto kinds = values<std::uint8_t>("FieldData/marker_kinds", mesh_.markers.size());
            for (std::size_t m = 0; m < kinds.size(); ++m) {
                if (kinds[m] > static_cast<std::uint8_t>(MarkerKind::other)) fail("unknown kind of marker");
                mesh_.markers[m].kind = static_cast<MarkerKind>(kinds[m]);
            }
        }
        if (has("FieldData/constraints")) {
            const auto ends = values<std::int64_t>("FieldData/constraints");
            if (ends.size() % 2 != 0) fail("constraints do not come in pairs of points");
            for (std::size_t i = 0; i < ends.size(); i += 2)
                mesh_.constraints.push_back({vertex(ends[i]), vertex(ends[i + 1])});
        }
    }

    void read_cells() {
        if (cells_ > bytes_.size()) fail("NumberOfCells exceeds the file");
        const auto types = values<std::uint8_t>("Cells/types", cells_);
        const auto offsets = values<std::int64_t>("Cells/offsets", cells_);
        const auto connectivity = values<std::int64_t>("Cells/connectivity");
        const auto marker = has("CellData/marker") ? values<std::uint32_t>("CellData/marker", cells_)
                                                   : std::vector<std::uint32_t>(cells_, 0);

        std::vector<std::size_t> triangles, quads;  // where they stand in the file
        std::int64_t first = 0;
        for (std::size_t i = 0; i < cells_; ++i) {
            const std::int64_t corners = types[i] == triangle_type ? 3 : types[i] == quad_type ? 4 : 2;
            if (corners == 2 && types[i] != line_type)
                fail(fmt::format("cell {} has the unknown type {}", i, types[i]));
            if (offsets[i] != first + corners || static_cast<std::size_t>(offsets[i]) > connectivity.size())
                fail(fmt::format("cell {} has not the {} vertices of its type", i, corners));
            const auto corner = [&](std::int64_t k) {
                return vertex(connectivity[static_cast<std::size_t>(first + k)]);
            };
            if (corners == 3) {
                triangles.push_back(i);
                mesh_.triangles.push_back({{corner(0), corner(1), corner(2)}});
            } else if (corners == 4) {
                quads.push_back(i);
                mesh_.quads.push_back({{corner(0), corner(1), corner(2), corner(3)}});
            } else if (marker[i] != 0) {
                if (marker[i] > mesh_.markers.size()) fail(fmt::format("cell {} has a marker without a name", i));
                mesh_.markers[marker[i] - 1].edges.push_back({corner(0), corner(1)});
            }
            first = offsets[i];
        }
        triangles.insert(triangles.end(), quads.begin(), quads.end());
        const auto read_cell_array = [&](const char* name, auto& target, std::size_t limit) {
            if (!has(name)) return;
            const auto all = values<std::uint32_t>(name, cells_);
            for (const std::size_t i : triangles) {
                if (all[i] > limit) fail(fmt::format("array '{}' holds a value that is out of range", name));
                target.push_back(static_cast<typename std::decay_t<decltype(target)>::value_type>(all[i]));
            }
        };
        read_cell_array("CellData/region", mesh_.region, static_cast<std::size_t>(Region::isotropic));
        read_cell_array("CellData/piece", mesh_.piece, std::numeric_limits<std::uint32_t>::max());
        read_cell_array("CellData/layer", mesh_.layer, std::numeric_limits<std::uint16_t>::max());
    }

    const std::string& bytes_;
    std::string file_;
    std::map<std::string, Array> arrays_;
    std::size_t data_ = 0, points_ = 0, cells_ = 0;
    Mesh mesh_;
};

}  // namespace

void write_vtu(const Mesh& mesh, const std::filesystem::path&, std::ostream& out) {
    VtuWriter vtu;
    vtu.xml =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "  <UnstructuredGrid>\n";
    put_field_data(mesh, vtu);
    vtu.xml += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.points.size(),
                           mesh.triangles.size() + mesh.quads.size() + line_count(mesh));
    put_cell_data(mesh, vtu);
    put_points(mesh, vtu);
    put_cells(mesh, vtu);
    vtu.xml += "    </Piece>\n  </UnstructuredGrid>\n";
    vtu.write(out);
}

Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file) {
    return VtuReader(bytes, file.string()).read();
}

}  // namespace lamina::detail
