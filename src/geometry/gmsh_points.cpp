#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/text.hpp"
#include "geometry/characters.hpp"
#include "geometry/coordinate_fields.hpp"
#include "geometry/join_blocks.hpp"
#include "geometry/other_formats.hpp"

namespace lamina::geometry {

namespace {

/// A statement "KIND(NUMBER) = {LIST};".
struct Statement {
    std::string kind, number;
    std::vector<std::string> list;
    std::size_t line = 0;
};

/// Returns a text with spaces in place of comments.
std::string without_comments(std::string_view text) {
    std::string plain(text);
    for (std::size_t i = 0; i + 1 < plain.size(); ++i) {
        if (plain[i] != '/' || (plain[i + 1] != '/' && plain[i + 1] != '*')) continue;
        const bool to_end_of_line = plain[i + 1] == '/';
        std::size_t end = to_end_of_line ? plain.find('\n', i) : plain.find("*/", i + 2);
        end = end == std::string::npos ? plain.size() : end + (to_end_of_line ? 0 : 2);
        for (; i < end; ++i)
            if (plain[i] != '\n') plain[i] = ' ';
        --i;
    }
    return plain;
}

/// Returns a text without white space and line ends.
std::string squeezed(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (!is_space(c) && c != '\n' && c != '\r') result += c;
    return result;
}

/// Returns the statement that a text between semicolons is, if it has the form of one.
std::optional<Statement> statement_of(std::string_view text, std::size_t line) {
    const std::string s = squeezed(text);
    const std::size_t open = s.find('('), close = s.find(")={");
    if (open == std::string::npos || close == std::string::npos || close < open || s.back() != '}') return std::nullopt;
    const std::size_t list = close + 3;
    return Statement{s.substr(0, open), s.substr(open + 1, close - open - 1),
                     core::split(s.substr(list, s.size() - 1 - list), ','), line};
}

/// Reads the statements of a file, and joins its curves.
class GmshReader {
public:
    explicit GmshReader(const std::string& file) : file_(file) {}

    void read(std::string_view text) {
        std::size_t line = 1;
        while (!text.empty()) {
            const std::size_t end = std::min(text.find(';'), text.size());
            const std::string_view part = text.substr(0, end);
            const std::size_t first = std::min(part.find_first_not_of(" \t\r\n"), part.size());
            const auto lines = [](std::string_view s) {
                return static_cast<std::size_t>(std::count(s.begin(), s.end(), '\n'));
            };
            if (const auto statement = statement_of(part, line + lines(part.substr(0, first)))) take(*statement);
            line += lines(part);
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }

    bool has_points() const { return !order_.empty(); }

    CoordinateDocument document() {
        CoordinateDocument document;
        document.sections.clear();
        if (curves_.empty()) {
            document.sections.push_back({run_of(order_), {{}}, {}});
        } else {
            for (const std::vector<long>& chain : chains()) document.sections.push_back({run_of(chain), {{}}, {}});
        }
        if (document.sections.empty() || (other_.line > 0 && has_open(document)))
            throw InputError({file_, other_.line, {}},
                             fmt::format("the curve {}({}) does not pass through all its points: export points on it",
                                         other_.kind, other_.number));
        leave_out_far_field(document);
        document.notes.push_back(fmt::format("{} points of Gmsh's geometry", order_.size()));
        return document;
    }

private:
    const std::string& file_;
    std::map<long, RowPoint> points_;
    std::vector<long> order_;  ///< of the points in the file
    std::vector<std::vector<long>> curves_;
    std::size_t uses_ = 0;  ///< of points by curves
    Statement other_;       ///< the first curve that is neither a line nor a spline

    double number(const std::string& text, std::size_t line) const {
        const FieldList fields = read_fields(text);
        if (fields.fields.size() == 1 && fields.fields[0].kind == FieldKind::number) return fields.fields[0].value;
        throw InputError({file_, line, {}}, fmt::format("'{}' is not a number; lamina reads plain numbers of Gmsh's "
                                                        "geometry, no expressions",
                                                        printable(text)));
    }

    long whole(const std::string& text, std::size_t line) const {
        constexpr double most = 1e9;
        const double value = number(text, line);
        if (!(value >= -most && value <= most) || value != static_cast<double>(static_cast<long>(value)))
            throw InputError({file_, line, {}}, fmt::format("'{}' is no number of a point", printable(text)));
        return static_cast<long>(value);
    }

    void take(const Statement& s) {
        if (s.kind == "Point" && s.list.size() >= 2) {
            RowPoint p;
            p.line = static_cast<std::uint32_t>(s.line);
            p.at = {number(s.list[0], s.line), number(s.list[1], s.line)};
            const long id = whole(s.number, s.line);
            if (points_.insert_or_assign(id, p).second) order_.push_back(id);
        } else if (s.kind == "Line" || s.kind == "Spline") {
            add_curve(s);
        } else if ((s.kind == "BSpline" || s.kind == "Bezier" || s.kind == "Circle" || s.kind == "Ellipse") &&
                   other_.line == 0) {
            other_ = s;
        }
    }

    void add_curve(const Statement& s) {
        constexpr std::size_t most_uses = 8;
        std::vector<long> ids;
        for (const std::string& entry : s.list) {
            const std::vector<std::string> range = core::split(entry, ':');
            const long from = whole(range[0], s.line), to = whole(range.back(), s.line), step = from <= to ? 1 : -1;
            for (long id = from;; id += step) {
                if (!points_.contains(id))
                    throw InputError({file_, s.line, {}}, fmt::format("there is no point {} before this curve", id));
                // A point is an end of two curves; more uses by far are ranges that repeat each other.
                if (++uses_ > most_uses * order_.size())
                    throw InputError({file_, s.line, {}}, "the curves use the points too often to be outlines");
                if (ids.empty() || ids.back() != id) ids.push_back(id);
                if (id == to) break;
            }
        }
        if (ids.size() > 1) curves_.push_back(std::move(ids));
    }

    /// Returns the points of curves that end where others begin, each chain in order.
    std::vector<std::vector<long>> chains() const {
        std::multimap<long, std::size_t> at_end;
        for (std::size_t c = 0; c < curves_.size(); ++c) {
            at_end.emplace(curves_[c].front(), c);
            at_end.emplace(curves_[c].back(), c);
        }
        std::vector<bool> used(curves_.size());
        const auto extend = [&](std::vector<long>& chain) {
            const auto [first, last] = at_end.equal_range(chain.back());
            const auto next = std::find_if(first, last, [&](const auto& entry) { return !used[entry.second]; });
            if (next == last) return false;
            std::vector<long> curve = curves_[next->second];
            used[next->second] = true;
            if (curve.front() != chain.back()) std::reverse(curve.begin(), curve.end());
            chain.insert(chain.end(), curve.begin() + 1, curve.end());
            return true;
        };
        std::vector<std::vector<long>> chains;
        for (std::size_t c = 0; c < curves_.size(); ++c) {
            if (used[c]) continue;
            used[c] = true;
            std::vector<long> chain = curves_[c];
            while (chain.front() != chain.back() && extend(chain)) {
            }
            std::reverse(chain.begin(), chain.end());
            while (chain.front() != chain.back() && extend(chain)) {
            }
            std::reverse(chain.begin(), chain.end());
            chains.push_back(std::move(chain));
        }
        return chains;
    }

    PointRun run_of(const std::vector<long>& ids) const {
        PointRun run;
        for (const long id : ids) run.push_back(points_.at(id));
        return run;
    }

    static bool has_open(const CoordinateDocument& document) {
        return std::any_of(document.sections.begin(), document.sections.end(), [](const CoordinateSection& section) {
            return section.points.front().at != section.points.back().at;
        });
    }

    static void leave_out_far_field(CoordinateDocument& document) {
        const auto box_of = [](const CoordinateSection& section) {
            Box box;
            for (const RowPoint& p : section.points) box.include(p.at);
            return box;
        };
        const auto contains_all = [&](const CoordinateSection& outer) {
            const Box box = box_of(outer);
            return std::all_of(document.sections.begin(), document.sections.end(), [&](const CoordinateSection& inner) {
                const Box other = box_of(inner);
                return &inner == &outer || (box.lower.x < other.lower.x && box.lower.y < other.lower.y &&
                                            box.upper.x > other.upper.x && box.upper.y > other.upper.y);
            });
        };
        if (document.sections.size() < 2) return;
        const auto outer = std::find_if(document.sections.begin(), document.sections.end(), contains_all);
        if (outer == document.sections.end()) return;
        document.notes.push_back(
            fmt::format("line {}: the loop round all others left out, as a far field", outer->points[0].line));
        document.sections.erase(outer);
    }
};

}  // namespace

std::optional<CoordinateDocument> read_gmsh_points(std::string_view text, const std::string& file) {
    const std::size_t point = text.find("Point");
    if (point == std::string_view::npos || text.find('{', point) == std::string_view::npos) return std::nullopt;
    if (text.find(';', point) == std::string_view::npos) return std::nullopt;
    GmshReader reader(file);
    reader.read(without_comments(text));
    return reader.has_points() ? std::optional(reader.document()) : std::nullopt;
}

}  // namespace lamina::geometry
