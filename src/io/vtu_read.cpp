// Reads VTK XML unstructured grids of one piece with appended arrays, raw or compressed by zlib, of any numeric type,
// in little-endian files: triangles (5), quads (9) and lines (3). z and arrays that lamina does not write are ignored,
// and lines with marker 0 or without the array, too. What the arrays mean: vtu_write.cpp. Source: VTK User's Guide,
// "VTK File Formats", XML.
#include <fmt/format.h>
#include <zlib.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <lamina/error.hpp>

#include "io/formats.hpp"

namespace lamina::detail {

namespace {

enum CellType : std::uint8_t { line_type = 3, triangle_type = 5, quad_type = 9 };

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
    /// After read().
    std::vector<double> sizes() const {
        const std::string section = "PointData/";
        std::vector<std::string> scalars;
        for (const auto& [name, array] : arrays_)
            if (name.starts_with(section) && array.components == 1) scalars.push_back(name.substr(section.size()));
        return values<double>(section + size_array(scalars, file_), points_);
    }

private:
    struct Array {
        std::string_view type;
        std::size_t offset = 0;
        std::size_t components = 1;
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
                compressed_ = tag.attributes.contains("compressor");
                if (compressed_) demand(tag, "compressor", "vtkZLibDataCompressor");
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
                    tag.attributes["type"], number(tag, "offset"),
                    tag.attributes.contains("NumberOfComponents") ? number(tag, "NumberOfComponents") : 1};
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

    /// Reads numbers of the headers of arrays.
    class Cursor {
    public:
        Cursor(const VtuReader& reader, const std::string& name, std::size_t at)
            : reader_(reader), name_(name), at_(at) {}
        std::size_t number() {
            std::uint64_t value = 0;
            std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
            return value;
        }
        std::string_view bytes(std::size_t count) {
            if (at_ > reader_.bytes_.size() || reader_.bytes_.size() - at_ < count)
                reader_.fail(fmt::format("cut short within array '{}'", name_));
            const std::string_view found = std::string_view(reader_.bytes_).substr(at_, count);
            at_ += count;
            return found;
        }

    private:
        const VtuReader& reader_;
        const std::string& name_;
        std::size_t at_;
    };

    std::string array_bytes(const std::string& name) const {
        const auto found = arrays_.find(name);
        if (found == arrays_.end()) fail(fmt::format("array '{}' is missing", name));
        const std::size_t size = bytes_.size() - data_, offset = found->second.offset;
        if (offset > size) fail(fmt::format("cut short before array '{}'", name));
        Cursor cursor(*this, name, data_ + offset);
        return compressed_ ? inflated(cursor, name) : std::string(cursor.bytes(cursor.number()));
    }
    /// [blocks][bytes of a block][bytes of the last, 0 = as the others][compressed bytes of each], then the blocks.
    std::string inflated(Cursor& cursor, const std::string& name) const {
        const std::size_t blocks = cursor.number(), block = cursor.number(), last = cursor.number();
        // Nothing is compressed to less than a thousandth.
        if (blocks > bytes_.size() / 8 || (blocks > 0 && block > 2000 * bytes_.size() / blocks) || last > block)
            fail(fmt::format("array '{}' has a broken header", name));
        std::vector<std::size_t> sizes(blocks);
        for (std::size_t& compressed : sizes) compressed = cursor.number();
        std::string whole;
        for (std::size_t i = 0; i < blocks; ++i) {
            const std::size_t expected = i + 1 == blocks && last > 0 ? last : block;
            const std::string_view compressed = cursor.bytes(sizes[i]);
            std::string plain(expected, '\0');
            uLongf length = expected;
            if (uncompress(reinterpret_cast<Bytef*>(plain.data()), &length,
                           reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()) != Z_OK ||
                length != expected)
                fail(fmt::format("array '{}' cannot be decompressed", name));
            whole += plain;
        }
        return whole;
    }

    /// The values of an array, converted from whatever type they have. Integers that T cannot hold are refused.
    template <class T>
    std::vector<T> values(const std::string& name) const {
        const std::string raw = array_bytes(name);
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
            const std::string stored = array_bytes("FieldData/marker_names");
            std::string_view names = stored;
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
    bool compressed_ = false;
    Mesh mesh_;
};

}  // namespace

Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file) {
    return VtuReader(bytes, file.string()).read();
}

PointValues read_vtu_sizes(const std::string& bytes, const std::filesystem::path& file) {
    VtuReader reader(bytes, file.string());
    PointValues result;
    result.mesh = reader.read();
    result.values = reader.sizes();
    return result;
}

}  // namespace lamina::detail
