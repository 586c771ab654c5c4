#include "geometry/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/coordinate_blocks.hpp"
#include "geometry/point_runs.hpp"
#include "geometry/surface_table.hpp"

namespace lamina::geometry {

namespace {

// ---- blocks of one section -----------------------------------------------------------------------------------------

/// The numbers of points that a Lednicer file announces for its surfaces.
struct SurfaceCounts {
    std::size_t upper, lower;

    std::size_t total() const { return upper + lower; }
};

/// Returns the counts of a Lednicer file where the first point of `points`, all that is left of a section, can only be
/// such counts: whole numbers that either fit exactly or lie well outside the section itself. In per cent of the chord,
/// (100, 2) may be a point.
std::optional<SurfaceCounts> read_counts(const PointRun& points, const std::string& file) {
    const Point p = points[0].at;
    if (!(p.x >= 2 && p.y >= 2 && p.x <= 1e8 && p.y <= 1e8 && p.x == std::floor(p.x) && p.y == std::floor(p.y)))
        return std::nullopt;
    const std::size_t available = points.size() - 1;
    const SurfaceCounts counts{static_cast<std::size_t>(p.x), static_cast<std::size_t>(p.y)};
    const std::size_t total = counts.total();
    const PointRun rest(points.begin() + 1,
                        points.begin() + 1 + static_cast<std::ptrdiff_t>(std::min(total, available)));
    Box box;
    for (const RowPoint& q : rest) box.include(q.at);
    if (rest.empty() || box.contains(p)) return std::nullopt;
    const double distance_outside =
        std::max({box.lower.x - p.x, p.x - box.upper.x, box.lower.y - p.y, p.y - box.upper.y});
    if (total == available || (total < available && distance_outside > extent(rest))) return counts;
    if (total > available && distance_outside > 2 * extent(rest))
        throw InputError({file, points[0].line, {}}, fmt::format("the counts {} + {} announce {} points, but {} follow",
                                                                 counts.upper, counts.lower, total, available));
    return std::nullopt;
}

/// Joins the blocks of a file that has a blank line after every point.
void join_double_spaced(CoordinateSection& section) {
    if (section.size() < 3) return;
    if (std::any_of(section.begin(), section.end(), [](const CoordinateBlock& b) { return b.points.size() > 1; }))
        return;
    for (std::size_t i = 1; i < section.size(); ++i) section[0].points.push_back(section[i].points[0]);
    section.resize(1);
}

/// Returns whether b continues a, so that only a blank line divides one run: the step from a to b is at most twice as
/// long as a neighbouring step.
bool continues(const PointRun& a, const PointRun& b) {
    if (a.size() > 1 && a.front().at == a.back().at) return false;
    if (is_loop(b) || (is_loop(a) && b.size() > a.size())) return false;
    double neighbour = 0;
    if (a.size() > 1) neighbour = distance(a[a.size() - 2].at, a.back().at);
    if (b.size() > 1) neighbour = std::max(neighbour, distance(b[0].at, b[1].at));
    return distance(a.back().at, b.front().at) <= 2 * neighbour;
}

void join_continued_blocks(CoordinateSection& section) {
    CoordinateSection joined;
    for (CoordinateBlock& block : section) {
        if (!joined.empty() && continues(joined.back().points, block.points)) {
            PointRun& run = joined.back().points;
            run.insert(run.end(), block.points.begin(), block.points.end());
        } else {
            joined.push_back(std::move(block));
        }
    }
    section = std::move(joined);
}

/// Removes the first points of a section, as many as whole blocks have. Returns how many of them remain in the first
/// block that is left.
std::size_t remove_blocks(CoordinateSection& section, std::size_t points) {
    while (points > 0 && points >= section[0].points.size()) {
        points -= section[0].points.size();
        section.erase(section.begin());
    }
    return points;
}

PointRun all_points(const CoordinateSection& section) {
    PointRun points;
    for (const CoordinateBlock& block : section) points.insert(points.end(), block.points.begin(), block.points.end());
    return points;
}

// ---- a section to outlines -----------------------------------------------------------------------------------------

/// Appends the outlines of one section to a list.
class SectionAssembler {
public:
    SectionAssembler(CoordinateSection section, const CoordinateDocument& document, const std::string& file,
                     std::vector<RawOutline>& outlines)
        : section_(std::move(section)), document_(document), file_(file), outlines_(outlines) {}

    void assemble() {
        if (add_table()) return;
        while (!section_.empty() && add_counted_surfaces()) {
        }
        for (const CoordinateBlock& block : section_) check_columns(block.points);
        join_double_spaced(section_);
        join_continued_blocks(section_);
        drop_lone_points();
        for (std::size_t i = 0; i < section_.size();) i += add_blocks(i);
        if (!notes_.empty() && !outlines_.empty())
            outlines_.back().notes.insert(outlines_.back().notes.end(), notes_.begin(), notes_.end());
    }

private:
    CoordinateSection section_;  ///< blocks that have no outline yet
    const CoordinateDocument& document_;
    const std::string& file_;
    std::vector<RawOutline>& outlines_;
    std::vector<std::string> notes_;  ///< for the next outline

    void add(const PointRun& points, const std::string& title, const std::string& format) {
        RawOutline& outline = outlines_.emplace_back();
        outline.points.assign(points.begin(), points.end());
        outline.title = title;
        outline.format = format;
        outline.notes = std::exchange(notes_, {});
    }

    /// Adds the outline of a table of both surfaces, and returns whether the section is one.
    bool add_table() {
        if (section_.size() != 1) return false;
        const CoordinateBlock& block = section_[0];
        const std::optional<SurfaceTable> table = read_surface_table(block.points, document_.heading);
        if (!table) return false;
        notes_.push_back(fmt::format("line {}: table of x, upper and lower ordinates{}, joined at the first row",
                                     block.points[0].line, table->downward ? " (these counted downward)" : ""));
        add(join_surfaces(table->upper, table->lower), block.title, "table");
        return true;
    }

    /// Adds the outline whose surfaces follow their counts at the start of the section, and removes its blocks. Returns
    /// whether there are counts.
    bool add_counted_surfaces() {
        const PointRun rest = all_points(section_);
        const std::optional<SurfaceCounts> counts = read_counts(rest, file_);
        if (!counts) return false;
        const auto first = rest.begin() + 1, second = first + static_cast<std::ptrdiff_t>(counts->upper);
        const auto end = second + static_cast<std::ptrdiff_t>(counts->lower);
        check_columns({first, end});
        add(join_surfaces({first, second}, {second, end}), section_[0].title, "lednicer");
        if (remove_blocks(section_, counts->total() + 1) > 0)
            throw InputError({file_, end->line, end->at},
                             fmt::format("a point beyond the {} that the counts of line {} announce", counts->total(),
                                         rest[0].line));
        return true;
    }

    /// Throws InputError unless a run has x and y in all rows, or a constant z beside them.
    void check_columns(const PointRun& points) {
        const RowPoint& first = points[0];
        for (const RowPoint& p : points) {
            if (p.columns != first.columns)
                throw InputError({file_, p.line, p.at},
                                 fmt::format("{} numbers where line {} has {}", p.columns, first.line, first.columns));
            if (p.columns == 3 && p.third != first.third)
                throw InputError({file_, p.line, p.at},
                                 "three columns that vary, where x and y are expected (and no table of x, upper and "
                                 "lower ordinates: x falls, or the surfaces cross)");
        }
        if (first.columns == 3)
            notes_.push_back(fmt::format("line {}: third column ignored, {} throughout", first.line, first.third));
    }

    /// Drops a reference point before the outline and a point left over after it. Throws InputError for further ones.
    void drop_lone_points() {
        if (section_.size() < 2) return;
        std::size_t dropped = 0;
        std::erase_if(section_, [&](const CoordinateBlock& block) {
            if (block.points.size() > 1) return false;
            const RowPoint& p = block.points[0];
            if (++dropped > 2) throw InputError({file_, p.line, p.at}, "a lone point that belongs to no outline");
            notes_.push_back(
                fmt::format("line {}: lone point left out, not part of an outline {}", p.line, coordinates(p.at)));
            return true;
        });
    }

    /// Returns whether the document says that the one surface of its section stands for both, which meet at y = 0.
    bool stands_for_both_surfaces(const PointRun& points) const {
        return document_.symmetry_line > 0 && section_.size() == 1 && !is_loop(points) && points.front().at.y == 0;
    }

    /// Adds the outline that begins with block i. Returns the number of blocks that it has.
    std::size_t add_blocks(std::size_t i) {
        const auto& [points, title] = section_[i];
        if (stands_for_both_surfaces(points)) {
            add_mirrored(points, title);
        } else if (const auto second_surface = find_second_surface(points)) {
            const auto second = points.begin() + static_cast<std::ptrdiff_t>(*second_surface);
            add(join_surfaces({points.begin(), second}, {second, points.end()}), title, "lednicer");
        } else if (is_loop(points) || section_.size() == 1) {
            add(points, title, "");
        } else if (i + 1 < section_.size() && are_two_surfaces(points, section_[i + 1].points)) {
            add(join_surfaces(points, section_[i + 1].points), title, "lednicer");
            return 2;
        } else {
            throw InputError({file_, points.front().line, points.front().at},
                             fmt::format("the points of lines {} to {} are neither a closed outline nor one of two "
                                         "surfaces",
                                         points.front().line, points.back().line));
        }
        return 1;
    }

    void add_mirrored(const PointRun& points, const std::string& title) {
        PointRun lower = points;
        for (RowPoint& p : lower) p.at.y = -p.at.y;
        notes_.push_back(fmt::format("line {}: symmetric section, the surface given stands for both, mirrored at y = 0",
                                     document_.symmetry_line));
        add(join_surfaces(points, lower), title, "lednicer");
    }
};

}  // namespace

std::vector<RawOutline> assemble_outlines(const std::vector<TextRow>& rows, const std::string& file) {
    CoordinateDocument document = split_into_blocks(rows, file);
    std::vector<RawOutline> outlines;
    for (CoordinateSection& section : document.sections)
        SectionAssembler(std::move(section), document, file, outlines).assemble();
    if (outlines.empty()) throw InputError({file, 0, {}}, rows.empty() ? "the file is empty" : "no coordinates found");

    for (RawOutline& outline : outlines)
        if (outline.format.empty()) outline.format = document.csv ? "csv" : document.titled ? "selig" : "xy";
    if (outlines[0].title.empty()) outlines[0].title = document.first_comment;
    outlines[0].notes.insert(outlines[0].notes.begin(), document.notes.begin(), document.notes.end());
    return outlines;
}

}  // namespace lamina::geometry
