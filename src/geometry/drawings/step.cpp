// STEP: numbered instances "#12=NAME(...);" that name each other. Of a part the edges are read, of a drawing its
// curves.
// Source: ISO 10303-21 (2016), the text; ISO 10303-42, curves.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "core/text.hpp"
#include "geometry/characters.hpp"
#include "geometry/drawings/drawing.hpp"
#include "geometry/length_units.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t max_depth_of_instances = 16, most_reads_of_byte = 100;

/// Returns the parts of a list "a,(b,c),'d'", which commas divide outside of brackets and texts.
std::vector<std::string_view> parts_of(std::string_view list) {
    std::vector<std::string_view> parts;
    std::size_t depth = 0, begin = 0;
    bool in_text = false;
    for (std::size_t i = 0; i <= list.size(); ++i) {
        const bool at_end = i == list.size();
        if (!at_end && list[i] == '\'') in_text = !in_text;
        if (!at_end && in_text) continue;
        if (!at_end && list[i] == '(') ++depth;
        if (!at_end && list[i] == ')' && depth > 0) --depth;
        if (!at_end && (list[i] != ',' || depth > 0)) continue;
        parts.push_back(without_blanks(list.substr(begin, i - begin)));
        begin = i + 1;
    }
    return parts;
}

/// Returns what stands between the brackets of a list; empty for other texts.
std::string_view inside(std::string_view list) {
    if (list.size() < 2 || list.front() != '(' || list.back() != ')') return {};
    return list.substr(1, list.size() - 2);
}

/// An instance: its text behind '=', such as "LINE('',#1,#2)", or "(A(1) B(2))".
struct Instance {
    std::string_view text;
    std::uint32_t line = 0;

    std::string_view name() const { return without_blanks(text.substr(0, std::min(text.find('('), text.size()))); }
};

class StepReader {
public:
    StepReader(std::string_view text, const std::string& file)
        : file_(file), bytes_left_(most_reads_of_byte * text.size() + 1) {}

    Drawing read(std::string_view text) {
        divide(text);
        read_unit();
        bool has_edges = false;
        for (const std::size_t number : order_) {
            if (instances_.at(number).name() != "EDGE_CURVE") continue;
            add_edge(number);
            has_edges = true;
        }
        if (!has_edges) add_free_curves();
        return std::move(drawing_);
    }

private:
    const std::string& file_;
    Drawing drawing_;
    std::unordered_map<std::size_t, Instance> instances_;
    std::vector<std::size_t> order_;  ///< of the instances in the file
    mutable std::size_t bytes_left_;  ///< that may still be read

    [[noreturn]] void refuse(std::size_t number, const std::string& reason) const {
        const auto found = instances_.find(number);
        const std::uint32_t line = found == instances_.end() ? 0 : found->second.line;
        throw InputError({file_, line, {}}, fmt::format("STEP instance #{}: {}", number, reason));
    }

    /// Divides the text at semicolons outside of texts and comments.
    void divide(std::string_view text) {
        std::uint32_t line = 1, first_line = 1;
        std::size_t begin = 0;
        bool in_text = false;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const char c = text[i];
            if (c == '\n') ++line;
            if (c == '\'') in_text = !in_text;
            if (in_text) continue;
            if (c == '/' && text.substr(i).starts_with("/*")) {
                const std::size_t end = std::min(text.find("*/", i), text.size());
                line += static_cast<std::uint32_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                              text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
                i = end;
                if (without_blanks(text.substr(begin, i - begin)).starts_with("/*"))
                    begin = std::min(i + 2, text.size());
            } else if (c == ';') {
                add_instance(text.substr(begin, i - begin), first_line);
                begin = i + 1;
            } else if (begin == i && is_blank(c)) {
                ++begin;
            }
            if (begin > i) first_line = line;
        }
    }

    void add_instance(std::string_view text, std::uint32_t line) {
        text = without_blanks(text);
        const std::size_t equals = text.find('=');
        if (!text.starts_with('#') || equals == std::string_view::npos) return;
        const std::size_t number = drawn_count(text.substr(1, equals - 1), file_, line);
        if (instances_.emplace(number, Instance{without_blanks(text.substr(equals + 1)), line}).second)
            order_.push_back(number);
    }

    /// Reads the unit of length: one by its name, or else a metre with a prefix, which may be what that is defined by.
    void read_unit() {
        constexpr std::array<std::pair<std::string_view, const char*>, 4> metres{
            {{"$", "m"}, {".CENTI.", "cm"}, {".MILLI.", "mm"}, {".MICRO.", "um"}}};
        for (const std::size_t number : order_) {
            if (!find_parameters(number, "LENGTH_UNIT")) continue;
            if (const auto named = find_parameters(number, "CONVERSION_BASED_UNIT")) {
                std::string_view name = (*named)[0];
                if (name.starts_with('\'')) name = name.substr(1, name.find('\'', 1) - 1);
                const std::optional<LengthUnitName> unit = length_unit(without_blanks(name));
                drawing_.unit = unit ? unit->name : "";
                return;
            }
            const auto si = find_parameters(number, "SI_UNIT");
            if (!si || si->size() < 2 || (*si)[1] != ".METRE.") continue;
            for (const auto& [prefix, unit] : metres)
                if ((*si)[0] == prefix && drawing_.unit.empty()) drawing_.unit = unit;
        }
    }

    // ---- instances -------------------------------------------------------------------------------------------------

    const Instance& instance(std::size_t number) const {
        const auto found = instances_.find(number);
        if (found == instances_.end()) refuse(number, "it is named, but missing");
        return found->second;
    }

    std::size_t reference(std::string_view text, std::size_t user) const {
        if (!text.starts_with('#')) refuse(user, fmt::format("'{}' names no instance", printable(text.substr(0, 24))));
        return drawn_count(text.substr(1), file_, instance(user).line);
    }

    double number(std::string_view text, std::size_t user) const {
        return drawn_number(text, file_, instance(user).line);
    }

    /// Returns the parameters of an instance with a name, or of the part of an instance of several parts that has it.
    std::optional<std::vector<std::string_view>> find_parameters(std::size_t number, std::string_view name) const {
        const std::string_view text = instance(number).text;
        if (!text.starts_with('(') && instance(number).name() != name) return std::nullopt;
        // Long instances that many others name are read again and again.
        bytes_left_ -= std::min(bytes_left_, text.size());
        if (bytes_left_ == 0) refuse(number, "it is named too often");
        if (!text.starts_with('(')) {
            return parts_of(inside(text.substr(std::min(text.find('('), text.size()))));
        }
        for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
            const char before = text[at - 1];
            const std::size_t open = text.find_first_not_of(" \t\r\n", at + name.size());
            if ((before != '(' && before != ')' && !is_blank(before)) || open == std::string_view::npos ||
                text[open] != '(')
                continue;
            std::size_t depth = 0, end = open;
            for (; end < text.size(); ++end) {
                depth += text[end] == '(' ? 1 : 0;
                if (text[end] == ')' && --depth == 0) break;
            }
            return parts_of(text.substr(open + 1, std::min(end, text.size()) - open - 1));
        }
        return std::nullopt;
    }

    /// Returns the parameters of an instance of a kind, of which there are so many at least.
    std::vector<std::string_view> parameters(std::size_t number, std::string_view name, std::size_t least) const {
        std::optional<std::vector<std::string_view>> list = find_parameters(number, name);
        if (!list || list->size() < least)
            refuse(number, fmt::format("it is no {}", core::lower_case(std::string(name))));
        return *std::move(list);
    }

    /// Returns the coordinates of a point or of a direction.
    Point3 triple(std::size_t number, std::string_view name) const {
        const std::vector<std::string_view> list = parts_of(inside(parameters(number, name, 2)[1]));
        if (list.size() != 2 && list.size() != 3) refuse(number, "it has neither two nor three coordinates");
        return {this->number(list[0], number), this->number(list[1], number),
                list.size() > 2 ? this->number(list[2], number) : 0};
    }
    Point3 point(std::size_t number) const { return triple(number, "CARTESIAN_POINT"); }

    Point3 vertex(std::size_t number) const {
        return point(reference(parameters(number, "VERTEX_POINT", 2)[1], number));
    }

    /// Returns the axes of a placement in space or in the plane.
    Frame3 placement(std::size_t number) const {
        if (const auto flat = find_parameters(number, "AXIS2_PLACEMENT_2D"); flat && flat->size() >= 3) {
            const Point3 a = (*flat)[2].starts_with('#')
                                 ? unit_or(triple(reference((*flat)[2], number), "DIRECTION"), {1, 0, 0})
                                 : Point3{1, 0, 0};
            return {point(reference((*flat)[1], number)), a, {-a.y, a.x, 0}, {0, 0, 1}};
        }
        const auto list = parameters(number, "AXIS2_PLACEMENT_3D", 4);
        const auto direction = [&](std::string_view text, Point3 otherwise) {
            return text.starts_with('#') ? unit_or(triple(reference(text, number), "DIRECTION"), otherwise) : otherwise;
        };
        const Point3 c = direction(list[2], {0, 0, 1});
        const Point3 given = direction(list[3], std::abs(c.x) < 0.9 ? Point3{1, 0, 0} : Point3{0, 1, 0});
        const Point3 a = unit_or(given - dot(given, c) * c, {1, 0, 0});
        return {point(reference(list[1], number)), a, cross(c, a), c};
    }

    // ---- curves ----------------------------------------------------------------------------------------------------

    /// A curve without ends of its own, or between its ends.
    struct BasisCurve {
        std::optional<SpaceCurve> spline;  ///< empty for conics and lines
        std::optional<Frame3> ellipse;     ///< whose axes have the lengths of its radii
        bool is_line = false;
        bool is_reversed = false;  ///< whether the curve runs against it
    };

    /// Returns what a curve is; nothing for kinds that are not read.
    std::optional<BasisCurve> basis(std::size_t number, std::size_t depth = 0) const {
        if (depth > max_depth_of_instances) refuse(number, "curves name each other in a circle");
        for (const char* name : {"SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE"})
            if (const auto list = find_parameters(number, name); list && list->size() > 1)
                return basis(reference((*list)[1], number), depth + 1);
        if (const auto list = find_parameters(number, "TRIMMED_CURVE"); list && list->size() > 4) {
            std::optional<BasisCurve> trimmed_curve = basis(reference((*list)[1], number), depth + 1);
            if (trimmed_curve && (*list)[4] == ".F.") trimmed_curve->is_reversed = !trimmed_curve->is_reversed;
            return trimmed_curve;
        }
        if (find_parameters(number, "LINE")) return BasisCurve{{}, {}, true, false};
        for (const char* name : {"CIRCLE", "ELLIPSE"}) {
            const auto list = find_parameters(number, name);
            if (!list || list->size() < 3) continue;
            Frame3 frame = placement(reference((*list)[1], number));
            frame.a = this->number((*list)[2], number) * frame.a;
            frame.b = this->number(list->back(), number) * frame.b;
            return BasisCurve{{}, frame, false, false};
        }
        if (std::optional<SpaceCurve> spline = spline_of(number))
            return BasisCurve{std::move(spline), {}, false, false};
        return std::nullopt;
    }

    std::vector<Point3> points_of(std::string_view list, std::size_t user) const {
        std::vector<Point3> points;
        for (const std::string_view part : parts_of(inside(list))) points.push_back(point(reference(part, user)));
        return points;
    }

    /// Returns a B-spline, whose parameters are one list or stand in several parts, or a polyline.
    std::optional<SpaceCurve> spline_of(std::size_t number) const {
        if (const auto list = find_parameters(number, "POLYLINE"); list && list->size() > 1)
            return polyline(points_of((*list)[1], number));
        SpaceCurve curve;
        std::optional<std::vector<std::string_view>> list = find_parameters(number, "B_SPLINE_CURVE_WITH_KNOTS"), knots;
        std::size_t first = 1;  // behind the label
        if (const auto base = find_parameters(number, "B_SPLINE_CURVE"); base && base->size() >= 2) {
            knots = std::exchange(list, base);
            first = 0;
        } else if (list && list->size() >= 8) {
            knots.emplace(list->begin() + 6, list->end());
        } else {
            for (const char* name : {"BEZIER_CURVE", "QUASI_UNIFORM_CURVE", "UNIFORM_CURVE"})
                if (!list) list = find_parameters(number, name);
        }
        if (!list || list->size() < first + 2) return std::nullopt;
        curve.degree = drawn_count((*list)[first], file_, instance(number).line);
        curve.control = points_of((*list)[first + 1], number);
        if (const auto weights = find_parameters(number, "RATIONAL_B_SPLINE_CURVE"); weights && !weights->empty())
            for (const std::string_view part : parts_of(inside((*weights)[0])))
                curve.weights.push_back(this->number(part, number));
        if (knots && knots->size() >= 2)
            read_knots(number, *knots, curve);
        else
            set_knots(number, curve);
        use_whole_range(curve);
        return curve;
    }

    /// Reads knots with their multiplicities, which may be as many as the curve has room for.
    void read_knots(std::size_t number, std::span<const std::string_view> lists, SpaceCurve& curve) const {
        const auto multiplicities = parts_of(inside(lists[0])), values = parts_of(inside(lists[1]));
        if (multiplicities.size() != values.size())
            refuse(number, "its knots and their multiplicities differ in number");
        const std::size_t most = curve.control.size() + std::min(curve.degree, max_curve_degree) + 1;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t times = drawn_count(multiplicities[i], file_, instance(number).line);
            if (times > most || curve.knots.size() + times > most) refuse(number, "it has more knots than it can have");
            curve.knots.insert(curve.knots.end(), times, this->number(values[i], number));
        }
    }

    /// Sets the knots of curves whose kind says what they are.
    void set_knots(std::size_t number, SpaceCurve& curve) const {
        const std::size_t n = curve.control.size(), p = curve.degree;
        if (p < 1 || p > max_curve_degree || n < p + 1) return;  // a defect, which add_curve() names
        const bool is_bezier = find_parameters(number, "BEZIER_CURVE").has_value();
        const bool is_uniform = find_parameters(number, "UNIFORM_CURVE").has_value();
        for (std::size_t i = 0; i < n + p + 1; ++i) {
            const double within = static_cast<double>(std::clamp(i, p, n) - p);
            const double bezier_knot = std::ceil(within / static_cast<double>(p));
            curve.knots.push_back(is_uniform ? static_cast<double>(i) : is_bezier ? bezier_knot : within);
        }
    }

    // ---- edges -----------------------------------------------------------------------------------------------------

    void add(std::size_t number, SpaceCurve curve) {
        add_curve(drawing_, {std::move(curve), instance(number).line, {}}, fmt::format("STEP instance #{}", number),
                  file_);
    }

    void leave_out(std::size_t number) {
        ++drawing_.left_out[std::string(printable(instance(number).name().substr(0, 40)))];
    }

    void add_edge(std::size_t number) {
        const auto list = parameters(number, "EDGE_CURVE", 5);
        const Point3 a = vertex(reference(list[1], number)), b = vertex(reference(list[2], number));
        const std::size_t curve = reference(list[3], number);
        add_between(number, curve, a, b, list[4] != ".F.");
    }

    /// Adds the part of a curve from one point to another.
    void add_between(std::size_t number, std::size_t curve, Point3 a, Point3 b, bool is_same_sense) {
        std::optional<BasisCurve> known = basis(curve);
        if (!known) return leave_out(curve);
        if (known->is_line) return add(number, polyline({a, b}));
        if (is_same_sense == known->is_reversed) std::swap(a, b);
        if (known->ellipse) return add_elliptic_arc(number, *known->ellipse, a, b);
        const SpaceCurve& spline = *known->spline;
        if (!defect_of(spline).empty()) return add(number, spline);  // which names the defect
        add_part(number, spline, parameter_near(spline, a), parameter_near(spline, b));
    }

    /// Adds the part of a spline from one of its parameters to another one: of a closed one that may be beyond its
    /// seam. Precondition: the spline has no defect.
    void add_part(std::size_t number, const SpaceCurve& spline, double from, double to) {
        constexpr double rounding = 1e-6;
        const double gap = length(at(spline, spline.last) - at(spline, spline.first));
        const bool is_closed = gap <= rounding * size_of(spline);
        if (is_closed && to == spline.first) to = spline.last;
        const auto add_range = [&](double first, double last) {
            SpaceCurve part = spline;
            part.first = first;
            part.last = last;
            if (first < last) add(number, std::move(part));
        };
        if (from < to) return add_range(from, to);
        if (!is_closed) refuse(number, "its end comes before its start on an open curve");
        add_range(from, spline.last);
        add_range(spline.first, to);
    }

    void add_elliptic_arc(std::size_t number, const Frame3& ellipse, Point3 a, Point3 b) {
        const double u = dot(ellipse.a, ellipse.a), v = dot(ellipse.b, ellipse.b);
        if (!(u > 0 && v > 0)) refuse(number, "its circle has no radius");
        const auto angle = [&](Point3 p) {
            const Point3 arm = p - ellipse.origin;
            return core::atan2_reproducible(dot(arm, ellipse.b) / v, dot(arm, ellipse.a) / u);
        };
        const double from = angle(a);
        double sweep = angle(b) - from;
        if (sweep <= 1e-9) sweep += 2 * core::pi;
        add(number, elliptic_arc(ellipse.origin, ellipse.a, ellipse.b, from, sweep));
    }

    static double size_of(const SpaceCurve& curve) {
        double size = 0;
        for (const Point3& c : curve.control) size = std::max(size, length(c - curve.control[0]));
        return size;
    }

    /// Returns the parameter of the point of a curve that is nearest to another one: an end of the curve where that is
    /// as near as rounding.
    static double parameter_near(const SpaceCurve& curve, Point3 p) {
        constexpr std::size_t samples_of_piece = 8, rounds = 60;
        constexpr double rounding = 1e-9;
        const auto away = [&](double t) { return length(at(curve, t) - p); };
        const double size = size_of(curve);
        if (away(curve.first) <= rounding * size) return curve.first;
        if (away(curve.last) <= rounding * size) return curve.last;
        const auto steps = static_cast<double>(samples_of_piece * curve.control.size());
        const double step = (curve.last - curve.first) / steps;
        double best = curve.first;
        for (double k = 0; k <= steps; ++k)
            if (const double t = std::min(curve.first + k * step, curve.last); away(t) < away(best)) best = t;
        double low = std::max(best - step, curve.first), high = std::min(best + step, curve.last);
        for (std::size_t k = 0; k < rounds; ++k) {
            const double third = (high - low) / 3;
            (away(low + third) < away(high - third) ? high : low) =
                away(low + third) < away(high - third) ? high - third : low + third;
        }
        return 0.5 * (low + high);
    }

    // ---- drawings without edges ------------------------------------------------------------------------------------

    /// Returns the point of a trim "(#12,PARAMETER_VALUE(0.))"; nothing where it has none.
    std::optional<Point3> trim_point(std::string_view trim, std::size_t user) const {
        for (const std::string_view part : parts_of(inside(trim)))
            if (part.starts_with('#')) return point(reference(part, user));
        return std::nullopt;
    }

    /// Returns the parameter of a trim; nothing where it has none.
    std::optional<double> trim_parameter(std::string_view trim, std::size_t user) const {
        constexpr std::string_view name = "PARAMETER_VALUE";
        for (const std::string_view part : parts_of(inside(trim)))
            if (part.starts_with(name)) return number(inside(without_blanks(part.substr(name.size()))), user);
        return std::nullopt;
    }

    void add_free_curves() {
        std::set<std::size_t> trimmed_curves;
        for (const std::size_t number : order_)
            if (const auto list = trimmed_parameters(number)) trimmed_curves.insert(reference((*list)[1], number));
        for (const std::size_t number : order_) {
            if (trimmed_curves.contains(number)) continue;
            if (const auto list = trimmed_parameters(number))
                add_trimmed(number, *list);
            else
                add_whole(number);
        }
    }

    void add_trimmed(std::size_t number, std::span<const std::string_view> list) {
        const auto a = trim_point(list[2], number), b = trim_point(list[3], number);
        const auto first = trim_parameter(list[2], number), last = trim_parameter(list[3], number);
        const bool prefers_points = list.size() < 6 || list[5] != ".PARAMETER." || !first || !last;
        const std::size_t curve = reference(list[1], number);
        if (a && b && prefers_points) return add_between(number, curve, *a, *b, list[4] != ".F.");
        const std::optional<BasisCurve> known = basis(curve);
        const bool has_parameters = known && known->spline && !known->is_reversed && first && last;
        if (has_parameters) return add_between_parameters(number, *known->spline, *first, *last, list[4] != ".F.");
        if (a && b) return add_between(number, curve, *a, *b, list[4] != ".F.");
        leave_out(number);
    }

    void add_between_parameters(std::size_t number, const SpaceCurve& spline, double from, double to,
                                bool is_same_sense) {
        if (!defect_of(spline).empty()) return add(number, spline);  // which names the defect
        if (!is_same_sense) std::swap(from, to);
        const auto within = [&](double t) { return std::clamp(t, spline.first, spline.last); };
        add_part(number, spline, within(from), within(to));
    }

    /// Adds a curve that nothing trims. Lines have no ends of their own.
    void add_whole(std::size_t number) {
        constexpr std::array<std::string_view, 8> kinds{
            "",       "POLYLINE", "B_SPLINE_CURVE_WITH_KNOTS", "BEZIER_CURVE", "QUASI_UNIFORM_CURVE", "UNIFORM_CURVE",
            "CIRCLE", "ELLIPSE"};
        if (std::find(kinds.begin(), kinds.end(), instance(number).name()) == kinds.end()) return;
        std::optional<BasisCurve> known = basis(number);
        if (!known) return;
        if (known->ellipse)
            add(number, elliptic_arc(known->ellipse->origin, known->ellipse->a, known->ellipse->b, 0, 2 * core::pi));
        else if (known->spline)
            add(number, *std::move(known->spline));
    }

    std::optional<std::vector<std::string_view>> trimmed_parameters(std::size_t number) const {
        if (instance(number).name() != "TRIMMED_CURVE") return std::nullopt;
        return parameters(number, "TRIMMED_CURVE", 5);
    }
};

}  // namespace

Drawing read_step(std::string_view text, const std::string& file) { return StepReader(text, file).read(text); }

}  // namespace lamina::geometry
