// DXF: groups of a code and a value, in two lines each. A group 0 begins an entity, which lasts up to the next one.
// Source: Autodesk, DXF Reference (2012).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "geometry/characters.hpp"
#include "geometry/drawings/drawing.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t max_depth_of_blocks = 8;

struct Group {
    std::size_t code;
    std::string_view value;
    std::uint32_t line;
};

/// The groups of a text in turn.
class GroupReader {
public:
    GroupReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    std::optional<Group> next() {
        if (text_.find_first_not_of(" \t\r\n\x1a") == std::string_view::npos) return std::nullopt;
        const std::uint32_t line = line_ + 1;
        const std::string_view code = take_line(text_);
        if (text_.empty()) throw InputError({file_, line, {}}, "the DXF drawing ends within a group");
        const std::string_view value = take_line(text_);
        line_ += 2;
        return Group{drawn_count(code, file_, line), value, line};
    }

private:
    std::string_view text_;
    const std::string& file_;
    std::uint32_t line_ = 0;
};

/// An entity, or another record.
struct Record {
    std::string_view type;
    std::uint32_t line = 0;
    std::vector<Group> groups;
};

/// The groups of a record as numbers and texts.
class RecordView {
public:
    RecordView(const Record& record, const std::string& file) : record_(record), file_(file) {}

    const Group* find(std::size_t code) const {
        const auto at =
            std::find_if(record_.groups.begin(), record_.groups.end(), [&](const Group& g) { return g.code == code; });
        return at == record_.groups.end() ? nullptr : &*at;
    }
    std::string_view text(std::size_t code) const {
        const Group* group = find(code);
        return group ? group->value : std::string_view();
    }
    double number(std::size_t code, double otherwise = 0) const {
        const Group* group = find(code);
        return group ? value(*group) : otherwise;
    }
    /// Returns the bits of a group of flags.
    unsigned flags(std::size_t code) const {
        constexpr double most = 1e6;
        return static_cast<unsigned>(std::clamp(number(code), 0.0, most));
    }
    Point3 point(std::size_t code, Point3 otherwise = {}) const {
        return {number(code, otherwise.x), number(code + 10, otherwise.y), number(code + 20, otherwise.z)};
    }
    std::vector<double> numbers(std::size_t code) const {
        std::vector<double> result;
        for (const Group& g : record_.groups)
            if (g.code == code) result.push_back(value(g));
        return result;
    }
    /// Returns the points whose x, y and z have the codes code, code + 10 and code + 20. Each x begins a point.
    std::vector<Point3> points(std::size_t code) const {
        std::vector<Point3> result;
        for (const Group& g : record_.groups) {
            if (g.code == code) result.push_back({value(g), 0, 0});
            if (result.empty()) continue;
            if (g.code == code + 10) result.back().y = value(g);
            if (g.code == code + 20) result.back().z = value(g);
        }
        return result;
    }
    double value(const Group& group) const { return drawn_number(group.value, file_, group.line + 1); }

private:
    const Record& record_;
    const std::string& file_;
};

/// Returns the frame of the coordinates of an entity whose plane has this normal ("arbitrary axis algorithm").
Frame3 frame_of_normal(Point3 normal) {
    constexpr double near_z = 1.0 / 64;
    const Point3 c = unit_or(normal, {0, 0, 1});
    const bool is_near_z = std::abs(c.x) < near_z && std::abs(c.y) < near_z;
    const Point3 a = unit_or(cross(is_near_z ? Point3{0, 1, 0} : Point3{0, 0, 1}, c), {1, 0, 0});
    return {{}, a, cross(c, a), c};
}

/// A block that is put into the drawing, or into another block.
struct Insert {
    std::string block;
    Frame3 frame;
    std::uint32_t line;
};

/// The entities of a block, or those of the drawing itself.
struct Block {
    Point3 base{};
    std::vector<DrawnCurve> curves;
    std::vector<Insert> inserts;
};

struct PolylineVertex {
    Point3 at;
    double bulge = 0;
};

class DxfReader {
public:
    explicit DxfReader(const std::string& file) : file_(file) {}

    Drawing read(std::string_view text) {
        GroupReader groups(text, file_);
        Record record;
        while (const std::optional<Group> group = groups.next()) {
            if (group->code == 999) continue;
            if (group->code != 0) {
                record.groups.push_back(*group);
                continue;
            }
            take(record);
            record = {group->value, group->line, {}};
        }
        take(record);
        end_polyline();
        expand(entities_, {}, 0);
        return std::move(drawing_);
    }

private:
    const std::string& file_;
    Drawing drawing_;
    std::string_view section_;
    std::map<std::string, Block, std::less<>> blocks_;
    Block entities_;
    Block* block_ = nullptr;                     ///< the one that entities are added to
    std::set<std::string, std::less<>> hidden_;  ///< layers that are off or frozen
    std::set<std::string, std::less<>> centre_;  ///< layers of centre lines
    std::optional<Record> polyline_;             ///< whose vertices follow
    std::vector<PolylineVertex> vertices_;       ///< of that polyline

    void take(const Record& record) {
        const RecordView view(record, file_);
        if (record.type != "VERTEX") end_polyline();  // some have no SEQEND
        if (record.type == "SECTION") {
            section_ = view.text(2);
            block_ = section_ == "ENTITIES" ? &entities_ : nullptr;
            if (section_ == "HEADER") read_header(record);
        } else if (record.type == "ENDSEC") {
            section_ = {};
        } else if (section_ == "TABLES" && record.type == "LAYER") {
            if (view.number(62) < 0 || (view.flags(70) & 1) != 0) hidden_.emplace(view.text(2));
            if (is_centre_line(view.text(6))) centre_.emplace(view.text(2));
        } else if (section_ == "BLOCKS" && record.type == "BLOCK") {
            block_ = &blocks_[std::string(view.text(2))];
            block_->base = view.point(10);
        } else if (section_ == "BLOCKS" && record.type == "ENDBLK") {
            block_ = nullptr;
        } else if ((section_ == "ENTITIES" || section_ == "BLOCKS") && block_) {
            take_entity(record, view);
        }
    }

    void read_header(const Record& header) {
        constexpr std::array<const char*, 7> units{"", "in", "ft", "", "mm", "cm", "m"};
        for (std::size_t i = 0; i + 1 < header.groups.size(); ++i) {
            if (header.groups[i].value != "$INSUNITS") continue;
            const Group& group = header.groups[i + 1];
            const std::size_t unit = drawn_count(group.value, file_, group.line + 1);
            if (unit < units.size()) drawing_.unit = units[unit];
        }
    }

    static bool is_centre_line(std::string_view line_type) {
        const auto starts = [&](std::string_view name) { return line_type.starts_with(name); };
        return starts("CENTER") || starts("CENTRE") || starts("PHANTOM") || starts("DASHDOT");
    }

    /// Returns why an entity is not part of the outlines; null where it is.
    const char* why_left_out(const RecordView& view) const {
        const std::string_view layer = view.text(8), line_type = view.text(6);
        const bool by_layer = line_type.empty() || line_type == "BYLAYER" || line_type == "ByLayer";
        if (view.number(67) == 1) return "entities of the paper";
        if (view.number(60) == 1 || hidden_.contains(layer) || layer == "Defpoints") return "hidden entities";
        if (by_layer ? centre_.contains(layer) : is_centre_line(line_type)) return "centre lines";
        return nullptr;
    }

    void take_entity(const Record& record, const RecordView& view) {
        const std::string_view type = record.type;
        if (type == "VERTEX") return take_vertex(view);
        if (type == "SEQEND") return;
        if (const char* reason = why_left_out(view)) {
            ++drawing_.left_out[reason];
        } else if (type == "POLYLINE") {
            polyline_ = record;
        } else if (type == "INSERT") {
            take_insert(record, view);
        } else if (!take_curve(record, view)) {
            ++drawing_.left_out[std::string(printable(type.substr(0, 40)))];
        }
    }

    /// Adds the curves of an entity. Returns false for one that is none.
    bool take_curve(const Record& record, const RecordView& view) {
        const Frame3 frame = frame_of_normal(view.point(210, {0, 0, 1}));
        if (record.type == "LINE") {
            add(record, polyline({view.point(10), view.point(11)}));
        } else if (record.type == "ARC" || record.type == "CIRCLE") {
            const double radius = view.number(40), whole = 360;
            const bool is_arc = record.type == "ARC";
            const double from = is_arc ? std::fmod(view.number(50), whole) : 0;
            double sweep = is_arc ? std::fmod(view.number(51) - from, whole) : whole;
            if (sweep <= 0) sweep += whole;
            add(record, mapped(elliptic_arc(view.point(10), {radius, 0, 0}, {0, radius, 0}, core::radians(from),
                                            core::radians(sweep)),
                               frame));
        } else if (record.type == "ELLIPSE") {
            const Point3 major = view.point(11), normal = unit_or(view.point(210, {0, 0, 1}), {0, 0, 1});
            const double whole = 2 * core::pi, from = std::fmod(view.number(41), whole);
            double sweep = std::fmod(view.number(42, whole) - from, whole);
            if (sweep <= 1e-12) sweep += whole;
            add(record, elliptic_arc(view.point(10), major, view.number(40, 1) * cross(normal, major), from, sweep));
        } else if (record.type == "LWPOLYLINE") {
            add_polyline(record, vertices_of(record, view), (view.flags(70) & 1) != 0, frame);
        } else if (record.type == "SPLINE") {
            add_spline(record, view);
        } else {
            return false;
        }
        return true;
    }

    std::vector<PolylineVertex> vertices_of(const Record& record, const RecordView& view) const {
        std::vector<PolylineVertex> vertices;
        const double elevation = view.number(38);
        for (const Group& g : record.groups) {
            if (g.code == 10) vertices.push_back({{view.value(g), 0, elevation}});
            if (vertices.empty()) continue;
            if (g.code == 20) vertices.back().at.y = view.value(g);
            if (g.code == 42) vertices.back().bulge = view.value(g);
        }
        return vertices;
    }

    void add_spline(const Record& record, const RecordView& view) {
        SpaceCurve curve;
        curve.degree = view.find(71) ? drawn_count(view.text(71), file_, record.line) : 3;
        curve.control = view.points(10);
        if (curve.control.empty()) {  // samples alone, which the surface stage joins by a spline of its own
            const std::vector<Point3> samples = view.points(11);
            if (samples.size() > 1) add(record, polyline(samples));
            return;
        }
        curve.knots = view.numbers(40);
        curve.weights = view.numbers(41);
        use_whole_range(curve);
        add(record, std::move(curve));
    }

    void take_vertex(const RecordView& view) {
        constexpr unsigned control_point = 16;
        if (!polyline_ || (view.flags(70) & control_point) != 0) return;
        vertices_.push_back({view.point(10), view.number(42)});
    }

    void end_polyline() {
        constexpr unsigned closed = 1, in_space = 8, mesh = 16, faces = 64;
        if (!polyline_) return;
        const Record record = *std::exchange(polyline_, std::nullopt);
        const RecordView view(record, file_);
        const unsigned flags = view.flags(70);
        if ((flags & (mesh | faces)) != 0) {
            ++drawing_.left_out["POLYLINE of faces"];
        } else {
            const bool is_plane = (flags & in_space) == 0;
            add_polyline(record, vertices_, (flags & closed) != 0,
                         is_plane ? frame_of_normal(view.point(210, {0, 0, 1})) : Frame3{});
        }
        vertices_.clear();
    }

    /// Adds the straight and the bulged parts of a polyline.
    void add_polyline(const Record& record, std::vector<PolylineVertex> vertices, bool is_closed, const Frame3& frame) {
        if (is_closed && !vertices.empty()) vertices.push_back({vertices[0].at});
        constexpr double flat_bulge = 1e-7;  // whose arc leaves its chord by less than samples may
        std::vector<Point3> straight;
        const auto flush = [&] {
            if (straight.size() > 1) add(record, mapped(polyline(straight), frame));
            straight.clear();
        };
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            straight.push_back(vertices[i].at);
            const bool is_last = i + 1 == vertices.size();
            if (is_last || std::abs(vertices[i].bulge) < flat_bulge) continue;
            flush();
            add(record, mapped(bulged_arc(vertices[i].at, vertices[i + 1].at, vertices[i].bulge), frame));
        }
        flush();
    }

    void take_insert(const Record& record, const RecordView& view) {
        const double angle = core::radians(std::fmod(view.number(50), 360));
        const double c = core::cos_reproducible(angle), s = core::sin_reproducible(angle);
        const double x = view.number(41, 1), y = view.number(42, 1), z = view.number(43, 1);
        const Frame3 placed{view.point(10), {x * c, x * s, 0}, {-y * s, y * c, 0}, {0, 0, z}};
        if (view.number(70, 1) > 1 || view.number(71, 1) > 1) ++drawing_.left_out["copies of an INSERT in rows"];
        block_->inserts.push_back(
            {std::string(view.text(2)), frame_of_normal(view.point(210, {0, 0, 1})).after(placed), record.line});
    }

    void add(const Record& record, SpaceCurve curve) {
        DrawnCurve drawn{std::move(curve), record.line, std::string(RecordView(record, file_).text(8))};
        if (const std::string defect = defect_of(drawn.curve); !defect.empty())
            throw InputError({file_, record.line, {}}, fmt::format("{}: {}", printable(record.type), defect));
        if (leave_out_point(drawing_, drawn.curve)) return;
        block_->curves.push_back(std::move(drawn));
    }

    /// Adds what a block holds, and the blocks that are put into it, to the drawing.
    void expand(const Block& block, const Frame3& frame, std::size_t depth) {
        for (const DrawnCurve& drawn : block.curves)
            add_curve(drawing_, {mapped(drawn.curve, frame), drawn.line, drawn.layer}, "a curve", file_);
        for (const Insert& insert : block.inserts) {
            const auto found = blocks_.find(insert.block);
            if (insert.block.starts_with("*D")) continue;
            if (found == blocks_.end()) {
                ++drawing_.left_out["INSERT of a block that is missing"];
                continue;
            }
            if (depth == max_depth_of_blocks || ++expansions_ > max_drawn_curves)
                throw InputError({file_, insert.line, {}}, "the block is put into itself, or too many into each other");
            const Frame3 to_origin{-1 * found->second.base, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
            expand(found->second, frame.after(insert.frame.after(to_origin)), depth + 1);
        }
    }

    std::size_t expansions_ = 0;
};

}  // namespace

Drawing read_dxf(std::string_view text, const std::string& file) { return DxfReader(file).read(text); }

}  // namespace lamina::geometry
