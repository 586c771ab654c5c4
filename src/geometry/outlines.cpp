// From rows to outlines: runs of coordinates ("blocks") between blank lines, comments, labels and 999-separators are
// told apart into surfaces of one element (Lednicer and the like), pieces of one loop, and separate elements.
// Formats as XFOIL, MSES and the UIUC collection know them. All criteria are ratios of lengths, so they hold for
// rotated and scaled sections, too.
#include "geometry/outlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <lamina/predicates.hpp>
#include <optional>
#include <utility>

namespace lamina::geometry {

namespace {

struct BlockPoint : SourcePoint {
    std::size_t columns = 2;
    double third = 0;  ///< third column
};

/// A run of coordinates.
struct Block {
    std::vector<BlockPoint> points;
    std::string title;
};

/// What stands between two 999-separators.
using Section = std::vector<Block>;

struct Document {
    std::vector<Section> sections{1};
    bool csv = false;
    bool titled = false;
    std::string first_comment;
    std::string heading;            ///< all text before the first coordinates, in lower case
    std::size_t symmetry_line = 0;  ///< says that the one surface there is stands for both; 0 = none does
    std::vector<std::string> notes;
};

// ---- rows to blocks ------------------------------------------------------------------------------------------------

bool is_separator(const Row& row) { return row.values[0] == 999.0 && row.values[1] == 999.0; }

/// MSES and ISES: a line of four or more numbers before the coordinates gives the domain.
bool is_domain_line(const std::vector<Row>& rows, std::size_t i) {
    if (rows[i].count < 4) return false;
    const auto next = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(i) + 1, rows.end(),
                                   [](const Row& r) { return r.kind == RowKind::numbers; });
    return next != rows.end() && next->count < 4;
}

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// What a row without coordinates says about those that follow.
void note_heading(const Row& row, Document& document) {
    const std::string text = lower_case(row.text);
    document.heading += text + '\n';
    // OpenVSP: "1  Sym Flag (0 - No, 1 - Yes)".
    if (text.starts_with("1") && text.find("sym flag") != text.npos) document.symmetry_line = row.line;
}

Document split_blocks(const std::vector<Row>& rows, const std::string& file) {
    Document document;
    bool in_run = false;
    bool any_numbers = false;
    std::string label;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        if (row.kind == RowKind::numbers) {
            // "12 34 revised" on top is a title; "1.0 0.0 revised" is a point with a remark.
            const bool is_title = !any_numbers && label.empty() && row.remark && !row.points_written;
            if (is_title) {
                label = row.text;
                document.titled = true;
                continue;
            }
            if (is_separator(row)) {
                document.sections.emplace_back();
                in_run = false;
                continue;
            }
            if (!any_numbers && is_domain_line(rows, i)) continue;
            if (row.count > 3)
                throw InputError({file, row.line, {}}, fmt::format("{} numbers where x and y are expected", row.count));
            const Point at{row.values[0], row.values[1]};
            if (!in_exact_range(at))
                throw InputError({file, row.line, at},
                                 fmt::format("coordinates must be 0 or of a magnitude from {} to {}",
                                             min_exact_coordinate, max_exact_coordinate));
            any_numbers = true;
            document.csv |= row.separated;
            if (row.decimal_comma && document.notes.empty())
                document.notes.push_back(fmt::format("line {}: decimal commas read as points", row.line));
            if (!in_run) document.sections.back().push_back({{}, std::exchange(label, {})});
            document.sections.back().back().points.push_back({{at, row.line}, row.count, row.values[2]});
            in_run = true;
            continue;
        }
        if (row.kind == RowKind::text) {
            const std::string& reason = in_run && row.damaged.empty() ? row.damaged_in_run : row.damaged;
            if (!reason.empty()) throw InputError({file, row.line, {}}, reason);
            if (label.empty()) label = row.text;
            if (!any_numbers) document.titled = true;
        } else if (row.kind == RowKind::comment && document.first_comment.empty() && !any_numbers) {
            document.first_comment = row.text;
        }
        if (!any_numbers) note_heading(row, document);
        in_run = false;
    }
    return document;
}

// ---- shapes of runs of points --------------------------------------------------------------------------------------

using Points = std::vector<BlockPoint>;

double extent(const Points& points) {
    Box box;
    for (const BlockPoint& p : points) box.include(p.at);
    return points.empty() ? 0 : std::max(box.width(), box.height());
}

double run_length(const Points& points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1].at, points[i].at);
    return sum;
}

double gap(const Points& points) { return distance(points.front().at, points.back().at); }

/// A run whose ends lie so near that closing it makes a body; a surface from leading to trailing edge is none.
bool is_loop(const Points& points) { return points.size() >= 3 && gap(points) <= 0.5 * run_length(points); }

/// Two runs that share (about) both ends, running the same way: upper and lower surface.
bool are_two_surfaces(const Points& a, const Points& b) {
    if (a.size() < 2 || b.size() < 2) return false;
    const double size = std::max(extent(a), extent(b));
    if (gap(a) <= 0.5 * size || gap(b) <= 0.5 * size) return false;
    const double at_start = distance(a.front().at, b.front().at), at_end = distance(a.back().at, b.back().at);
    return std::min(at_start, at_end) <= 0.1 * size && std::max(at_start, at_end) <= 0.5 * size;
}

/// Upper surface reversed, then lower: one run, the common first point once.
Points join_surfaces(const Points& upper, const Points& lower) {
    Points run(upper.rbegin(), upper.rend());
    const bool shared = run.back().at == lower.front().at;
    run.insert(run.end(), lower.begin() + (shared ? 1 : 0), lower.end());
    return run;
}

/// Where a run holds two surfaces one behind the other, the second starting anew: size of the first.
std::optional<std::size_t> find_second_surface(const Points& points) {
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double d = distance(points[i - 1].at, points[i].at);
        if (d > length) {
            length = d;
            longest = i;
        }
    }
    if (longest < 3 || points.size() - longest < 3) return std::nullopt;
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(longest);
    if (!are_two_surfaces({points.begin(), middle}, {middle, points.end()})) return std::nullopt;
    return longest;
}

// ---- sections to outlines ------------------------------------------------------------------------------------------

/// Two surfaces in one table: x, and the ordinates of both at it.
struct SurfaceTable {
    Points upper, lower;
    bool downward;  ///< the file counts lower ordinates downward
};

/// Understands three columns as x, upper and lower ordinate (or lower and upper, where the heading has them in this
/// order) if x rises from row to row, the surfaces meet at the nose, nearly at the tail, and nowhere between. Where
/// they would cross, the lower ordinates may be meant downward.
std::optional<SurfaceTable> read_table(const Points& points, const std::string& heading) {
    if (points.size() < 5) return std::nullopt;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].columns != 3) return std::nullopt;
        if (i > 0 && !(points[i].at.x > points[i - 1].at.x)) return std::nullopt;
    }
    const double chord = points.back().at.x - points.front().at.x;
    const std::size_t says_upper = heading.find("upper"), says_lower = heading.find("lower");
    const bool lower_first = says_upper != heading.npos && says_lower != heading.npos && says_lower < says_upper;
    const auto upper_at = [&](const BlockPoint& p) { return lower_first ? p.third : p.at.y; };
    const auto lower_at = [&](const BlockPoint& p) { return lower_first ? p.at.y : p.third; };
    const auto apart = [&](double sign) {
        const auto thickness = [&](const BlockPoint& p) { return upper_at(p) - sign * lower_at(p); };
        return std::abs(thickness(points.front())) <= 0.01 * chord &&
               std::abs(thickness(points.back())) <= 0.2 * chord &&
               std::all_of(points.begin() + 1, points.end() - 1, [&](const BlockPoint& p) { return thickness(p) > 0; });
    };
    const bool downward = !apart(1);
    if (downward && !apart(-1)) return std::nullopt;
    SurfaceTable table{points, points, downward};
    for (std::size_t i = 0; i < points.size(); ++i) {
        table.upper[i].at.y = upper_at(points[i]);
        table.lower[i].at.y = downward ? -lower_at(points[i]) : lower_at(points[i]);
    }
    return table;
}

/// x and y in all columns, or a constant z beside them.
void check_columns(const Points& points, const std::string& file, std::vector<std::string>& notes) {
    for (const BlockPoint& p : points) {
        if (p.columns != points[0].columns)
            throw InputError({file, p.line, p.at}, fmt::format("{} numbers where line {} has {}", p.columns,
                                                               points[0].line, points[0].columns));
        if (p.columns == 3 && p.third != points[0].third)
            throw InputError({file, p.line, p.at},
                             "three columns that vary, where x and y are expected (and no table of x, upper and lower "
                             "ordinates: x falls, or the surfaces cross)");
    }
    if (points[0].columns == 3)
        notes.push_back(fmt::format("line {}: third column ignored, {} throughout", points[0].line, points[0].third));
}

struct SurfaceCounts {
    std::size_t upper, lower;
};

/// Lednicer: does the first point of `points` (all that is left of a section) announce the sizes of two surfaces? The
/// pair must lie well outside the section itself, or the sum fit exactly: in per cent of chord, (100, 2) may be a
/// point.
std::optional<SurfaceCounts> read_counts(const Points& points, const std::string& file) {
    const Point p = points[0].at;
    if (!(p.x >= 2 && p.y >= 2 && p.x <= 1e8 && p.y <= 1e8 && p.x == std::floor(p.x) && p.y == std::floor(p.y)))
        return std::nullopt;
    const std::size_t available = points.size() - 1;
    const SurfaceCounts counts{static_cast<std::size_t>(p.x), static_cast<std::size_t>(p.y)};
    const std::size_t total = counts.upper + counts.lower;
    const Points rest(points.begin() + 1, points.begin() + 1 + static_cast<std::ptrdiff_t>(std::min(total, available)));
    Box box;
    for (const BlockPoint& q : rest) box.include(q.at);
    if (rest.empty() || box.contains(p)) return std::nullopt;
    const double beyond = std::max({box.lower.x - p.x, p.x - box.upper.x, box.lower.y - p.y, p.y - box.upper.y});
    if (total == available || (total < available && beyond > extent(rest))) return counts;
    if (total > available && beyond > 2 * extent(rest))
        throw InputError({file, points[0].line, {}}, fmt::format("the counts {} + {} announce {} points, but {} follow",
                                                                 counts.upper, counts.lower, total, available));
    return std::nullopt;
}

/// A file with a blank line after every point.
void join_double_spaced(Section& section) {
    if (section.size() < 3) return;
    if (std::any_of(section.begin(), section.end(), [](const Block& b) { return b.points.size() > 1; })) return;
    for (std::size_t i = 1; i < section.size(); ++i) section[0].points.push_back(section[i].points[0]);
    section.resize(1);
}

/// Is the step from a to b no longer than twice a neighbouring step, so that only a blank line parts one run?
bool continues(const Points& a, const Points& b) {
    if (a.size() > 1 && a.front().at == a.back().at) return false;
    if (is_loop(b) || (is_loop(a) && b.size() > a.size())) return false;
    double neighbour = 0;
    if (a.size() > 1) neighbour = distance(a[a.size() - 2].at, a.back().at);
    if (b.size() > 1) neighbour = std::max(neighbour, distance(b[0].at, b[1].at));
    return distance(a.back().at, b.front().at) <= 2 * neighbour;
}

void merge_pieces(Section& section) {
    Section merged;
    for (Block& block : section) {
        if (!merged.empty() && continues(merged.back().points, block.points)) {
            Points& run = merged.back().points;
            run.insert(run.end(), block.points.begin(), block.points.end());
        } else {
            merged.push_back(std::move(block));
        }
    }
    section = std::move(merged);
}

/// A reference point before the outline, or a point left over behind it.
void drop_lone_points(Section& section, const std::string& file, std::vector<std::string>& notes) {
    if (section.size() < 2) return;
    std::size_t dropped = 0;
    std::erase_if(section, [&](const Block& block) {
        if (block.points.size() > 1) return false;
        const BlockPoint& p = block.points[0];
        if (++dropped > 2) throw InputError({file, p.line, p.at}, "a lone point that belongs to no outline");
        notes.push_back(
            fmt::format("line {}: lone point left out, not part of an outline {}", p.line, coordinates(p.at)));
        return true;
    });
}

/// Appends the outlines of one section to `outlines`.
void assemble_section(Section section, const Document& document, const std::string& file,
                      std::vector<RawOutline>& outlines) {
    std::vector<std::string> notes;
    const auto add = [&](const Points& points, const std::string& title, const std::string& format) {
        RawOutline& outline = outlines.emplace_back();
        outline.points.assign(points.begin(), points.end());
        outline.title = title;
        outline.format = format;
        outline.notes = std::exchange(notes, {});
    };

    // A table of both surfaces.
    if (section.size() == 1) {
        if (const auto table = read_table(section[0].points, document.heading)) {
            notes.push_back(fmt::format("line {}: table of x, upper and lower ordinates{}, joined at the first row",
                                        section[0].points[0].line, table->downward ? " (these counted downward)" : ""));
            add(join_surfaces(table->upper, table->lower), section[0].title, "table");
            return;
        }
    }

    // Outlines with counts, one behind the other.
    while (!section.empty()) {
        Points rest;
        for (const Block& block : section) rest.insert(rest.end(), block.points.begin(), block.points.end());
        const auto counts = read_counts(rest, file);
        if (!counts) break;
        const auto first = rest.begin() + 1, second = first + static_cast<std::ptrdiff_t>(counts->upper);
        const auto end = second + static_cast<std::ptrdiff_t>(counts->lower);
        const Points upper(first, second), lower(second, end);
        check_columns({first, end}, file, notes);
        add(join_surfaces(upper, lower), section[0].title, "lednicer");
        std::size_t used = counts->upper + counts->lower + 1;
        while (used > 0 && used >= section[0].points.size()) {
            used -= section[0].points.size();
            section.erase(section.begin());
        }
        if (used > 0)
            throw InputError({file, end->line, end->at},
                             fmt::format("a point beyond the {} that the counts of line {} announce",
                                         counts->upper + counts->lower, rest[0].line));
    }

    for (const Block& block : section) check_columns(block.points, file, notes);
    join_double_spaced(section);
    merge_pieces(section);
    drop_lone_points(section, file, notes);
    for (std::size_t i = 0; i < section.size(); ++i) {
        const Points& points = section[i].points;
        if (document.symmetry_line > 0 && section.size() == 1 && !is_loop(points) && points.front().at.y == 0) {
            Points lower = points;
            for (BlockPoint& p : lower) p.at.y = -p.at.y;
            notes.push_back(
                fmt::format("line {}: symmetric section, the surface given stands for both, mirrored at "
                            "y = 0",
                            document.symmetry_line));
            add(join_surfaces(points, lower), section[i].title, "lednicer");
        } else if (const auto middle = find_second_surface(points)) {
            const auto second = points.begin() + static_cast<std::ptrdiff_t>(*middle);
            add(join_surfaces({points.begin(), second}, {second, points.end()}), section[i].title, "lednicer");
        } else if (is_loop(points) || section.size() == 1) {
            add(points, section[i].title, "");
        } else if (i + 1 < section.size() && are_two_surfaces(points, section[i + 1].points)) {
            add(join_surfaces(points, section[i + 1].points), section[i].title, "lednicer");
            ++i;
        } else {
            throw InputError({file, points.front().line, points.front().at},
                             fmt::format("the points of lines {} to {} are neither a closed outline nor one of two "
                                         "surfaces",
                                         points.front().line, points.back().line));
        }
    }
    if (!notes.empty() && !outlines.empty())
        outlines.back().notes.insert(outlines.back().notes.end(), notes.begin(), notes.end());
}

}  // namespace

std::string coordinates(Point p) { return fmt::format("({}, {})", p.x + 0.0, p.y + 0.0); }

std::vector<RawOutline> assemble_outlines(const std::vector<Row>& rows, const std::string& file) {
    Document document = split_blocks(rows, file);
    std::vector<RawOutline> outlines;
    for (Section& section : document.sections) assemble_section(std::move(section), document, file, outlines);
    if (outlines.empty()) throw InputError({file, 0, {}}, rows.empty() ? "the file is empty" : "no coordinates found");

    for (RawOutline& outline : outlines)
        if (outline.format.empty()) outline.format = document.csv ? "csv" : document.titled ? "selig" : "xy";
    if (outlines[0].title.empty()) outlines[0].title = document.first_comment;
    outlines[0].notes.insert(outlines[0].notes.begin(), document.notes.begin(), document.notes.end());
    return outlines;
}

}  // namespace lamina::geometry
