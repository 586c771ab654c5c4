// SVG: the shapes and paths of a page, whose y axis points down. Groups and their transformations are a stack, so that
// nothing recurs.
// Source: W3C, Scalable Vector Graphics (SVG) 1.1 (2011), chapters 7 to 9; appendix F.6 for arcs.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "geometry/characters.hpp"
#include "geometry/drawings/drawing.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t max_depth_of_groups = 256;

/// Numbers in a list, which white space, commas, signs and further points divide: "1.5.5-3e-2".
class NumberList {
public:
    NumberList(std::string_view text, const std::string& file, std::uint32_t line)
        : text_(text), file_(file), line_(line) {}

    /// Returns the next character that divides no numbers; 0 at the end.
    char peek() {
        while (!text_.empty() && (is_blank(text_[0]) || text_[0] == ',')) text_.remove_prefix(1);
        return text_.empty() ? '\0' : text_[0];
    }
    void skip() { text_.remove_prefix(1); }
    bool has_number() {
        const char c = peek();
        return is_digit(c) || c == '-' || c == '+' || c == '.';
    }
    double number() {
        if (!has_number()) refuse();
        std::size_t end = 1;
        bool has_point = text_[0] == '.', has_exponent = false;
        for (; end < text_.size(); ++end) {
            const char c = text_[end], last = text_[end - 1];
            const bool after_exponent = last == 'e' || last == 'E';
            if (is_digit(c) || (after_exponent && (c == '-' || c == '+'))) continue;
            if (c == '.' && !has_point && !has_exponent) {
                has_point = true;
            } else if ((c == 'e' || c == 'E') && !has_exponent && end + 1 < text_.size() &&
                       (is_digit(text_[end + 1]) || text_[end + 1] == '-' || text_[end + 1] == '+')) {
                has_exponent = true;
            } else {
                break;
            }
        }
        const double value = drawn_number(text_.substr(0, end), file_, line_);
        text_.remove_prefix(end);
        return value;
    }
    /// Returns a flag of an arc, which is a single digit.
    bool flag() {
        const char c = peek();
        if (c != '0' && c != '1') refuse();
        skip();
        return c == '1';
    }
    Point3 point() {
        const double x = number();
        return {x, number(), 0};
    }
    [[noreturn]] void refuse() {
        throw InputError({file_, line_, {}}, fmt::format("'{}' stands in an SVG path where a number belongs",
                                                         printable(text_.substr(0, 24))));
    }

private:
    std::string_view text_;
    const std::string& file_;
    std::uint32_t line_;
};

/// The outlines of a path's data.
class PathReader {
public:
    PathReader(std::string_view data, const std::string& file, std::uint32_t line) : list_(data, file, line) {}

    std::vector<SpaceCurve> read() {
        while (const char c = list_.peek()) {
            if (is_letter(c)) {
                list_.skip();
                command_ = c;
                if (c == 'z' || c == 'Z') {
                    close();
                    continue;
                }
            } else if (!list_.has_number() || command_ == 'z' || command_ == 'Z' || command_ == '\0') {
                list_.refuse();
            }
            step();
        }
        flush();
        return std::move(curves_);
    }

private:
    NumberList list_;
    std::vector<SpaceCurve> curves_;
    std::vector<Point3> straight_;  ///< vertices since the last curve that is not straight
    Point3 start_{}, at_{}, control_{};
    char command_ = '\0', last_ = '\0';

    void flush() {
        if (straight_.size() > 1) curves_.push_back(polyline(straight_));
        straight_.clear();
    }
    void line_to(Point3 p) {
        if (straight_.empty()) straight_.push_back(at_);
        straight_.push_back(p);
        at_ = p;
    }
    void curve_to(std::vector<Point3> control) {
        flush();
        at_ = control.back();
        curves_.push_back(bezier(std::move(control)));
    }
    void close() {
        if (length(at_ - start_) > 0) line_to(start_);
        flush();
        at_ = start_;
        last_ = 'Z';
    }

    /// Reads what follows a command, or follows its last repetition.
    void step() {
        const bool is_relative = command_ >= 'a';
        const char kind = is_relative ? static_cast<char>(command_ - 'a' + 'A') : command_;
        const Point3 origin = is_relative ? at_ : Point3{};
        const auto point = [&] { return origin + list_.point(); };
        // The reflected control point of a curve before this one, where it is of the same kind.
        const auto reflected = [&](char one, char other) {
            return last_ == one || last_ == other ? 2 * at_ - control_ : at_;
        };
        if (kind == 'M') {
            flush();
            start_ = at_ = point();
            command_ = is_relative ? 'l' : 'L';
        } else if (kind == 'L') {
            line_to(point());
        } else if (kind == 'H') {
            line_to({origin.x + list_.number(), at_.y, 0});
        } else if (kind == 'V') {
            line_to({at_.x, origin.y + list_.number(), 0});
        } else if (kind == 'C' || kind == 'S') {
            const Point3 from = at_, first = kind == 'C' ? point() : reflected('C', 'S');
            control_ = point();
            curve_to({from, first, control_, point()});
        } else if (kind == 'Q' || kind == 'T') {
            const Point3 from = at_;
            control_ = kind == 'Q' ? point() : reflected('Q', 'T');
            curve_to({from, control_, point()});
        } else if (kind == 'A') {
            arc(origin);
        } else {
            list_.refuse();
        }
        last_ = kind;
    }

    void arc(Point3 origin) {
        double rx = std::abs(list_.number()), ry = std::abs(list_.number());
        const double turn = core::radians(std::fmod(list_.number(), 360));
        const bool is_large = list_.flag(), is_positive = list_.flag();
        const Point3 from = at_, to = origin + list_.point();
        if (length(to - from) == 0) return;
        if (rx == 0 || ry == 0) return line_to(to);
        const double c = core::cos_reproducible(turn), s = core::sin_reproducible(turn);
        // In the axes of the ellipse, scaled to a unit circle.
        const auto on_circle = [&](Point3 p) { return Point{(c * p.x + s * p.y) / rx, (c * p.y - s * p.x) / ry}; };
        Point half = on_circle(0.5 * (to - from));
        if (const double size = lamina::length(half); size > 1) {
            rx *= size;
            ry *= size;
            half = (1 / size) * half;
        }
        const double h2 = squared_length(half);
        const double apart = std::sqrt(std::max(0.0, (1 - h2) / h2));
        const Point center = (is_large == is_positive ? -1 : 1) * apart * perpendicular(half);
        const Point first = -half - center, last = half - center;
        double sweep = core::atan2_reproducible(lamina::cross(first, last), lamina::dot(first, last));
        if (is_positive && sweep < 0) sweep += 2 * core::pi;
        if (!is_positive && sweep > 0) sweep -= 2 * core::pi;
        const Point3 u{c * rx, s * rx, 0}, v{-s * ry, c * ry, 0};
        const Point3 middle = 0.5 * (from + to) + center.x * u + center.y * v;
        flush();
        SpaceCurve curve = elliptic_arc(middle, u, v, core::atan2_reproducible(first.y, first.x), sweep);
        curve.control.front() = from;
        curve.control.back() = to;
        curves_.push_back(std::move(curve));
        at_ = to;
    }
};

/// A tag with its attributes.
struct Tag {
    std::string_view name, attributes;
    bool is_end = false, is_empty = false;
    std::uint32_t line = 1;
};

/// Returns the value of an attribute; empty where the tag has none.
std::string_view attribute(const Tag& tag, std::string_view name) {
    std::string_view rest = tag.attributes;
    while (true) {
        const std::size_t equals = rest.find('=');
        if (equals == std::string_view::npos) return {};
        const std::string_view key = without_blanks(rest.substr(0, equals));
        rest = without_blanks(rest.substr(equals + 1));
        if (rest.empty() || (rest[0] != '"' && rest[0] != '\'')) return {};
        const std::size_t end = rest.find(rest[0], 1);
        if (end == std::string_view::npos) return {};
        if (key == name) return rest.substr(1, end - 1);
        rest.remove_prefix(end + 1);
    }
}

/// The tags of a text in turn, without comments and declarations.
class TagReader {
public:
    explicit TagReader(std::string_view text) : text_(text) {}

    std::optional<Tag> next() {
        while (true) {
            const std::size_t open = text_.find('<', at_);
            if (open == std::string_view::npos) return std::nullopt;
            advance(open);
            if (skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<?", "?>") || skip_declaration()) continue;
            return take();
        }
    }

private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::uint32_t line_ = 1;

    void advance(std::size_t to) {
        to = std::min(to, text_.size());
        line_ += static_cast<std::uint32_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                       text_.begin() + static_cast<std::ptrdiff_t>(to), '\n'));
        at_ = to;
    }
    bool skip(std::string_view begin, std::string_view end) {
        if (!text_.substr(at_).starts_with(begin)) return false;
        const std::size_t close = text_.find(end, at_);
        advance(close == std::string_view::npos ? text_.size() : close + end.size());
        return true;
    }
    /// Skips a declaration of a document type, whose subset in brackets holds declarations of its own.
    bool skip_declaration() {
        if (!text_.substr(at_).starts_with("<!")) return false;
        const std::size_t close = text_.find('>', at_);
        const std::string_view declaration = text_.substr(at_, close == std::string_view::npos ? close : close - at_);
        if (declaration.find('[') != std::string_view::npos) return skip("<!", "]>");
        advance(close == std::string_view::npos ? text_.size() : close + 1);
        return true;
    }
    Tag take() {
        Tag tag;
        tag.line = line_;
        std::size_t end = at_ + 1;
        for (char quote = '\0'; end < text_.size() && (quote != '\0' || text_[end] != '>'); ++end) {
            const char c = text_[end];
            if (quote == '\0' ? c == '"' || c == '\'' : c == quote) quote = quote == '\0' ? c : '\0';
        }
        std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
        advance(end + 1);
        tag.is_end = inside.starts_with('/');
        if (tag.is_end) inside.remove_prefix(1);
        tag.is_empty = inside.ends_with('/');
        if (tag.is_empty) inside.remove_suffix(1);
        const auto name_end = std::find_if(inside.begin(), inside.end(), is_blank);
        tag.name = inside.substr(0, static_cast<std::size_t>(name_end - inside.begin()));
        tag.attributes = inside.substr(tag.name.size());
        if (const std::size_t colon = tag.name.find(':'); colon != std::string_view::npos)
            tag.name.remove_prefix(colon + 1);
        return tag;
    }
};

/// An element that is open.
struct Open {
    std::string_view name;
    Frame3 frame;
    bool is_hidden = false;
    std::string_view id;
};

constexpr std::array<std::string_view, 10> unseen = {"defs",    "clipPath", "mask",  "symbol",   "marker",
                                                     "pattern", "text",     "title", "metadata", "foreignObject"};

class SvgReader {
public:
    explicit SvgReader(const std::string& file) : file_(file) {}

    Drawing read(std::string_view text) {
        TagReader tags(text);
        std::vector<Open> open{{{}, {{}, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, false, {}}};
        while (const std::optional<Tag> tag = tags.next()) {
            if (tag->is_end) {
                close(open, tag->name);
                continue;
            }
            Open element{tag->name, open.back().frame.after(transform_of(*tag)),
                         open.back().is_hidden || is_hidden(*tag), attribute(*tag, "id")};
            if (element.id.empty()) element.id = open.back().id;
            take(*tag, element);
            if (tag->is_empty) continue;
            if (open.size() == max_depth_of_groups)
                throw InputError({file_, tag->line, {}},
                                 fmt::format("more than {} SVG elements inside each other", max_depth_of_groups));
            open.push_back(element);
        }
        return std::move(drawing_);
    }

private:
    const std::string& file_;
    Drawing drawing_;

    static void close(std::vector<Open>& open, std::string_view name) {
        const auto last = std::find_if(open.rbegin(), open.rend(), [&](const Open& o) { return o.name == name; });
        if (last != open.rend() && last.base() - open.begin() > 1) open.erase(last.base() - 1, open.end());
    }

    static bool is_hidden(const Tag& tag) {
        const std::string_view style = attribute(tag, "style");
        return std::find(unseen.begin(), unseen.end(), tag.name) != unseen.end() ||
               attribute(tag, "display") == "none" || style.find("display:none") != std::string_view::npos ||
               style.find("display: none") != std::string_view::npos;
    }

    Frame3 transform_of(const Tag& tag) const {
        Frame3 frame;
        std::string_view rest = attribute(tag, "transform");
        while (true) {
            const std::size_t open = rest.find('('), close = rest.find(')');
            if (open == std::string_view::npos || close == std::string_view::npos || close < open) return frame;
            std::string_view name = rest.substr(0, open);
            while (!name.empty() && !is_letter(name[0])) name.remove_prefix(1);
            while (!name.empty() && !is_letter(name.back())) name.remove_suffix(1);
            NumberList list(rest.substr(open + 1, close - open - 1), file_, tag.line);
            std::vector<double> numbers;
            while (list.has_number() && numbers.size() < 6) numbers.push_back(list.number());
            frame = frame.after(transform(name, numbers));
            rest.remove_prefix(close + 1);
        }
    }

    static Frame3 transform(std::string_view name, std::span<const double> n) {
        const auto number = [&](std::size_t i, double otherwise) { return i < n.size() ? n[i] : otherwise; };
        if (name == "matrix" && n.size() == 6) return {{n[4], n[5], 0}, {n[0], n[1], 0}, {n[2], n[3], 0}, {0, 0, 1}};
        if (name == "translate") return {{number(0, 0), number(1, 0), 0}};
        if (name == "scale") return {{}, {number(0, 1), 0, 0}, {0, number(1, number(0, 1)), 0}, {0, 0, 1}};
        const double angle = core::radians(std::fmod(number(0, 0), 360));
        const double c = core::cos_reproducible(angle), s = core::sin_reproducible(angle);
        if (name == "rotate") {
            const Point3 center{number(1, 0), number(2, 0), 0};
            const Frame3 turn{{}, {c, s, 0}, {-s, c, 0}, {0, 0, 1}};
            return Frame3{center}.after(turn.after(Frame3{-1 * center}));
        }
        if (name == "skewX" && c != 0) return {{}, {1, 0, 0}, {s / c, 1, 0}, {0, 0, 1}};
        if (name == "skewY" && c != 0) return {{}, {1, s / c, 0}, {0, 1, 0}, {0, 0, 1}};
        return {};
    }

    void take(const Tag& tag, const Open& element) {
        const std::string_view name = tag.name;
        constexpr std::array<std::string_view, 7> shapes = {"path",   "polygon", "polyline", "line",
                                                            "circle", "ellipse", "rect"};
        constexpr std::array<std::string_view, 3> others = {"use", "image", "text"};
        if (std::find(others.begin(), others.end(), name) != others.end())
            ++drawing_.left_out[name == "use" ? "use (unlink clones)" : std::string(name)];
        if (std::find(shapes.begin(), shapes.end(), name) == shapes.end()) return;
        if (element.is_hidden) {
            ++drawing_.left_out["hidden or unplaced shapes"];
            return;
        }
        if (has_percentages(tag)) {
            ++drawing_.left_out["shapes with lengths in percent"];
            return;
        }
        for (SpaceCurve& curve : curves_of(tag))
            add_curve(drawing_, {mapped(std::move(curve), element.frame), tag.line, std::string(element.id)},
                      fmt::format("the SVG {}", name), file_);
    }

    /// Returns whether a length of a shape is a share of the page.
    static bool has_percentages(const Tag& tag) {
        constexpr std::array<std::string_view, 13> lengths = {"x",  "y", "x1", "y1", "x2",    "y2",    "cx",
                                                              "cy", "r", "rx", "ry", "width", "height"};
        if (tag.name == "path" || tag.name.starts_with("poly")) return false;
        return std::any_of(lengths.begin(), lengths.end(),
                           [&](std::string_view key) { return without_blanks(attribute(tag, key)).ends_with('%'); });
    }

    std::vector<SpaceCurve> curves_of(const Tag& tag) const {
        if (tag.name == "path") return PathReader(attribute(tag, "d"), file_, tag.line).read();
        const auto number = [&](std::string_view key) { return length_attribute(tag, key); };
        if (tag.name == "line") return {polyline({{number("x1"), number("y1"), 0}, {number("x2"), number("y2"), 0}})};
        if (tag.name == "circle" || tag.name == "ellipse") {
            const bool is_circle = tag.name == "circle";
            const double rx = number(is_circle ? "r" : "rx"), ry = number(is_circle ? "r" : "ry");
            return {elliptic_arc({number("cx"), number("cy"), 0}, {rx, 0, 0}, {0, ry, 0}, 0, 2 * core::pi)};
        }
        if (tag.name == "rect") return rectangle(tag);
        NumberList list(attribute(tag, "points"), file_, tag.line);
        std::vector<Point3> points;
        while (list.has_number()) points.push_back(list.point());
        if (tag.name == "polygon" && !points.empty()) points.push_back(points[0]);
        return points.size() > 1 ? std::vector<SpaceCurve>{polyline(std::move(points))} : std::vector<SpaceCurve>{};
    }

    std::vector<SpaceCurve> rectangle(const Tag& tag) const {
        const auto number = [&](std::string_view key) { return length_attribute(tag, key); };
        const double x = number("x"), y = number("y"), w = number("width"), h = number("height");
        double rx = number("rx"), ry = number("ry");
        if (attribute(tag, "rx").empty()) rx = ry;
        if (attribute(tag, "ry").empty()) ry = rx;
        rx = std::clamp(rx, 0.0, 0.5 * std::abs(w));
        ry = std::clamp(ry, 0.0, 0.5 * std::abs(h));
        if (rx == 0 || ry == 0)
            return {polyline({{x, y, 0}, {x + w, y, 0}, {x + w, y + h, 0}, {x, y + h, 0}, {x, y, 0}})};
        const std::string data = fmt::format(
            "M{},{} H{} A{r},{s} 0 0 1 {},{} V{} A{r},{s} 0 0 1 {},{} H{} A{r},{s} 0 0 1 {},{} V{} "
            "A{r},{s} 0 0 1 {},{} Z",
            x + rx, y, x + w - rx, x + w, y + ry, y + h - ry, x + w - rx, y + h, x + rx, x, y + h - ry, y + ry, x + rx,
            y, fmt::arg("r", rx), fmt::arg("s", ry));
        return PathReader(data, file_, tag.line).read();
    }

    /// Returns a length; the unit behind it, of which a page has one as a rule, does not count.
    double length_attribute(const Tag& tag, std::string_view key) const {
        const std::string_view text = attribute(tag, key);
        if (text.empty()) return 0;
        return NumberList(text, file_, tag.line).number();
    }
};

}  // namespace

Drawing read_svg(std::string_view text, const std::string& file) { return SvgReader(file).read(text); }

}  // namespace lamina::geometry
