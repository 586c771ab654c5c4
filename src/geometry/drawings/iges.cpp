// IGES: lines of 80 columns. The directory has two lines for each entity; its parameters stand in lines of their own.
// Source: IGES 5.3 (US PRO, 1996): entities 100, 102, 104, 106, 110, 124 and 126.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "geometry/characters.hpp"
#include "geometry/drawings/drawing.hpp"

namespace lamina::geometry {

namespace {

/// Matrices of matrices, and composite curves of composite curves.
constexpr std::size_t max_depth_of_entities = 16;

/// An entity: what its two lines in the directory say.
struct Entity {
    std::size_t type = 0, parameters = 0, lines = 0, matrix = 0, form = 0;
    std::string status;
    std::uint32_t line = 0;
    std::size_t owner = 0;  ///< the composite curve that it is a part of; 0: none
    bool is_edge = false;   ///< whether it bounds a trimmed surface
};

class IgesReader {
public:
    explicit IgesReader(const std::string& file) : file_(file) {}

    Drawing read(std::string_view text) {
        divide(text);
        read_global();
        read_directory();
        for (const auto& [number, entity] : entities_)
            if (entity.type == 102)
                own_parts(number, entity);
            else if (entity.type == 142)
                mark_edge(entity);
        for (const auto& [number, entity] : entities_) take(entity);
        return std::move(drawing_);
    }

private:
    struct Line {
        std::string_view text;
        std::uint32_t number;
    };
    const std::string& file_;
    Drawing drawing_;
    std::string global_;
    std::vector<Line> directory_, parameters_;
    char divider_ = ',', end_ = ';';
    std::map<std::size_t, Entity> entities_;  ///< by the number of their first line in the directory
    mutable std::map<std::size_t, Frame3> matrices_;
    mutable std::size_t lines_read_ = 0;  ///< of parameters

    void divide(std::string_view text) {
        constexpr std::size_t section_column = 72;
        for (std::uint32_t number = 1; !text.empty(); ++number) {
            std::string_view line = text.substr(0, text.find('\n'));
            text.remove_prefix(std::min(line.size() + 1, text.size()));
            if (line.size() <= section_column) continue;
            const char section = line[section_column];
            if (section == 'G') global_ += line.substr(0, section_column);
            if (section == 'D') directory_.push_back({line, number});
            if (section == 'P') parameters_.push_back({line, number});
        }
    }

    /// Divides parameters, of which texts begin with their length: 4Hname. Stops at the end of a record.
    std::vector<std::string> divided(std::string_view text) const {
        std::vector<std::string> fields(1);
        for (std::size_t i = 0; i < text.size() && text[i] != end_; ++i) {
            std::string& field = fields.back();
            if (text[i] == divider_) {
                fields.emplace_back();
            } else if (text[i] == 'H' && !field.empty() && field.size() < 8 &&
                       std::all_of(field.begin(), field.end(), is_digit)) {
                const std::size_t count = std::min<std::size_t>(std::stoul(field), text.size() - i - 1);
                field = text.substr(i + 1, count);
                i += count;
            } else if (text[i] != ' ') {
                field += text[i];
            }
        }
        return fields;
    }

    /// Reads which characters divide parameters and end records, and the unit: the first two fields and the 14th.
    void read_global() {
        constexpr std::size_t unit_field = 11;  // behind the first two
        constexpr std::array<const char*, 11> units{"", "in", "mm", "", "ft", "", "m", "", "", "um", "cm"};
        std::string_view text = global_;
        const auto take_character = [&](char& character) {
            const bool is_given = text.size() > 3 && text.starts_with("1H");
            if (is_given) character = text[2];
            text.remove_prefix(std::min<std::size_t>(is_given ? 4 : 1, text.size()));
        };
        take_character(divider_);
        take_character(end_);
        const std::vector<std::string> fields = divided(text);
        if (fields.size() <= unit_field) return;
        const std::string& field = fields[unit_field];
        if (field.empty() || field.size() > 2 || !std::all_of(field.begin(), field.end(), is_digit)) return;
        if (const std::size_t unit = std::stoul(field); unit < units.size()) drawing_.unit = units[unit];
    }

    std::size_t count(std::string_view text, std::uint32_t line) const {
        return trimmed(text).empty() ? 0 : drawn_count(text, file_, line);
    }

    void read_directory() {
        constexpr std::size_t width = 8;
        for (std::size_t i = 0; i + 1 < directory_.size(); i += 2) {
            const auto field = [&](std::size_t line, std::size_t k) {
                return directory_[i + line].text.substr(k * width, width);
            };
            Entity e;
            e.line = directory_[i].number;
            e.type = count(field(0, 0), e.line);
            e.parameters = count(field(0, 1), e.line);
            const std::string_view matrix = trimmed(field(0, 6));
            e.matrix = matrix.starts_with('-') ? 0 : count(matrix, e.line);
            e.status = field(0, 8);
            std::replace(e.status.begin(), e.status.end(), ' ', '0');
            e.lines = count(field(1, 3), e.line);
            const std::string_view form = trimmed(field(1, 4));
            e.form = form.starts_with('-') ? 0 : count(form, e.line);
            entities_[i + 1] = std::move(e);
        }
    }

    /// Returns the parameters of an entity, behind its type.
    std::vector<std::string> parameters_of(const Entity& e) const {
        constexpr std::size_t width = 64;
        // Entities have lines of their own, which are read twice at most.
        lines_read_ += e.lines;
        if (lines_read_ > 2 * parameters_.size()) refuse(e, "its parameters have more lines than the file");
        std::string text;
        for (std::size_t k = 0; k < e.lines; ++k) {
            const std::size_t at = e.parameters + k;
            if (at == 0 || at > parameters_.size()) refuse(e, "its parameters are missing");
            text += parameters_[at - 1].text.substr(0, width);
        }
        std::vector<std::string> fields = divided(text);
        fields.erase(fields.begin());
        return fields;
    }

    [[noreturn]] void refuse(const Entity& e, const std::string& reason) const {
        throw InputError({file_, e.line, {}}, fmt::format("IGES entity {}: {}", e.type, reason));
    }

    /// The parameters of an entity as numbers; those that are left out are 0.
    class Numbers {
    public:
        Numbers(const IgesReader& reader, const Entity& entity)
            : reader_(reader), entity_(entity), fields_(reader.parameters_of(entity)) {}

        double next() {
            if (at_ >= fields_.size()) reader_.refuse(entity_, "its parameters end too early");
            const std::string& field = fields_[at_++];
            return field.empty() ? 0 : drawn_number(field, reader_.file_, entity_.line);
        }
        /// Returns a number of things, of which as many parameters follow at least.
        std::size_t next_count(double more = 0) {
            const double value = next() + more;
            if (!(value >= 0) || value != std::floor(value) || value > static_cast<double>(fields_.size()))
                reader_.refuse(entity_, "it announces more than it holds");
            return static_cast<std::size_t>(value);
        }
        Point3 point() {
            const double x = next(), y = next();
            return {x, y, next()};
        }
        bool at_end() const { return at_ >= fields_.size(); }

    private:
        const IgesReader& reader_;
        const Entity& entity_;
        std::vector<std::string> fields_;
        std::size_t at_ = 0;
    };

    /// Sets the owner of the parts of a composite curve.
    void own_parts(std::size_t number, const Entity& composite) {
        // Behind the parts stand the associativities and the properties of the curve.
        const std::vector<std::string> fields = parameters_of(composite);
        const std::size_t parts = fields.empty() ? 0 : count(fields[0], composite.line);
        if (parts >= std::max<std::size_t>(fields.size(), 1)) refuse(composite, "it announces more than it holds");
        for (std::size_t i = 1; i <= parts; ++i) {
            if (fields[i].empty()) continue;
            const auto part = entities_.find(drawn_count(fields[i], file_, composite.line));
            if (part != entities_.end()) part->second.owner = number;
        }
    }

    /// Marks the curve in space that bounds a trimmed surface.
    void mark_edge(const Entity& boundary) {
        constexpr std::size_t curve_field = 3;
        const std::vector<std::string> fields = parameters_of(boundary);
        if (fields.size() <= curve_field || fields[curve_field].empty()) return;
        const auto curve = entities_.find(drawn_count(fields[curve_field], file_, boundary.line));
        if (curve != entities_.end()) curve->second.is_edge = true;
    }

    bool is_edge(const Entity& e) const {
        const Entity* part = &e;
        for (std::size_t depth = 0; depth < max_depth_of_entities; ++depth) {
            if (part->is_edge) return true;
            if (part->owner == 0) return false;
            part = &entities_.at(part->owner);
        }
        return false;
    }

    Frame3 own_matrix(const Entity& e) const {
        Numbers numbers(*this, e);
        std::array<double, 12> m{};
        for (double& x : m) x = numbers.next();
        return {{m[3], m[7], m[11]}, {m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}};
    }

    Frame3 matrix_of(std::size_t number, std::size_t depth, const Entity& user) const {
        if (number == 0) return {};
        const auto found = entities_.find(number);
        if (found == entities_.end() || found->second.type != 124 || depth == max_depth_of_entities)
            refuse(user, fmt::format("its transformation {} is none", number));
        const auto [known, is_new] = matrices_.try_emplace(number);
        if (is_new) known->second = own_matrix(found->second);
        const Frame3& frame = known->second;
        return matrix_of(found->second.matrix, depth + 1, user).after(frame);
    }

    /// Returns the map of an entity, and of the composite curves that it is a part of.
    Frame3 frame_of(const Entity& e) const {
        Frame3 frame = matrix_of(e.matrix, 0, e);
        const Entity* part = &e;
        for (std::size_t depth = 0; part->owner != 0; ++depth) {
            if (depth == max_depth_of_entities) refuse(e, "it is a part of too many composite curves");
            part = &entities_.at(part->owner);
            if (part->matrix != 0) frame = matrix_of(part->matrix, 0, e).after(frame);
        }
        return frame;
    }

    /// Returns why an entity is not part of the outlines; null where it is.
    static const char* why_left_out(const Entity& e) {
        if (e.status.size() < 6) return nullptr;
        const std::string use = e.status.substr(4, 2);
        if (e.status.substr(0, 2) == "01") return "hidden entities";
        if (use == "05") return "curves of surface parameters";
        if (use == "01" || use == "02" || use == "06") return "notes, definitions and construction lines";
        return nullptr;
    }

    void take(const Entity& e) {
        if (e.type == 0 || e.type == 102 || e.type == 124) return;
        const char* reason = is_edge(e) ? nullptr : why_left_out(e);
        if (reason != nullptr) {
            ++drawing_.left_out[reason];
        } else if (std::optional<SpaceCurve> curve = curve_of(e)) {
            add_curve(drawing_, {mapped(std::move(*curve), frame_of(e)), e.line, {}},
                      fmt::format("IGES entity {}", e.type), file_);
        } else {
            ++drawing_.left_out[fmt::format("IGES entity {}", e.type)];
        }
    }

    std::optional<SpaceCurve> curve_of(const Entity& e) const {
        if (e.type == 126) return spline(e);
        if (e.type == 110 && e.form == 0) {
            Numbers n(*this, e);
            const Point3 from = n.point();
            return polyline({from, n.point()});
        }
        if (e.type == 100) return arc(e);
        if (e.type == 104 && e.form <= 1) return ellipse(e);
        if (e.type == 106) return points(e);
        return std::nullopt;
    }

    SpaceCurve spline(const Entity& e) const {
        Numbers n(*this, e);
        SpaceCurve curve;
        const std::size_t controls = n.next_count(1);
        curve.degree = n.next_count();
        n.next();
        n.next();
        const bool is_polynomial = n.next() == 1;
        n.next();
        for (std::size_t i = 0; i < controls + curve.degree + 1; ++i) curve.knots.push_back(n.next());
        for (std::size_t i = 0; i < controls; ++i) curve.weights.push_back(n.next());
        for (std::size_t i = 0; i < controls; ++i) curve.control.push_back(n.point());
        if (is_polynomial) curve.weights.clear();
        use_whole_range(curve);
        const double low = curve.first, high = curve.last, first = n.next(), last = n.next();
        if (first < last) {
            curve.first = std::clamp(first, low, high);
            curve.last = std::clamp(last, low, high);
        }
        return curve;
    }

    SpaceCurve arc(const Entity& e) const {
        Numbers n(*this, e);
        const double z = n.next();
        const auto point = [&] {
            const double x = n.next();
            return Point3{x, n.next(), z};
        };
        const Point3 center = point(), start = point(), end = point();
        const Point3 u = start - center, v{-u.y, u.x, 0}, w = end - center;
        double sweep = core::atan2_reproducible(dot(v, w), dot(u, w));
        if (sweep <= 1e-12) sweep += 2 * core::pi;
        return elliptic_arc(center, u, v, 0, sweep);
    }

    /// Returns the ellipse A x^2 + C y^2 + F = 0 from one of its points to another one, counter-clockwise; nothing for
    /// other conics.
    std::optional<SpaceCurve> ellipse(const Entity& e) const {
        Numbers n(*this, e);
        std::array<double, 6> c{};
        for (double& x : c) x = n.next();
        const double z = n.next(), x1 = n.next(), y1 = n.next(), x2 = n.next(), y2 = n.next();
        if (c[1] != 0 || c[3] != 0 || c[4] != 0 || !(c[0] * c[5] < 0 && c[2] * c[5] < 0)) return std::nullopt;
        const double a = std::sqrt(-c[5] / c[0]), b = std::sqrt(-c[5] / c[2]);
        const double from = core::atan2_reproducible(y1 / b, x1 / a);
        double sweep = core::atan2_reproducible(y2 / b, x2 / a) - from;
        if (sweep <= 1e-12) sweep += 2 * core::pi;
        return elliptic_arc({0, 0, z}, {a, 0, 0}, {0, b, 0}, from, sweep);
    }

    /// Returns a polyline of points, in a plane or in space; nothing for points alone.
    std::optional<SpaceCurve> points(const Entity& e) const {
        if (e.form != 11 && e.form != 12 && e.form != 13 && e.form != 63) return std::nullopt;
        Numbers n(*this, e);
        const auto kind = static_cast<int>(std::clamp(n.next(), 0.0, 9.0));
        const std::size_t count = n.next_count();
        const double z = kind == 1 ? n.next() : 0;
        std::vector<Point3> vertices;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = n.next(), y = n.next();
            vertices.push_back({x, y, kind == 1 ? z : n.next()});
            if (kind == 3) n.point();
        }
        if (vertices.size() < 2) return std::nullopt;
        if (e.form == 63) vertices.push_back(vertices[0]);
        return polyline(std::move(vertices));
    }
};

}  // namespace

Drawing read_iges(std::string_view text, const std::string& file) { return IgesReader(file).read(text); }

}  // namespace lamina::geometry
