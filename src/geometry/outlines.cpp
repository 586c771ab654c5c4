#include "geometry/outlines.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/columns.hpp"
#include "geometry/coordinate_blocks.hpp"
#include "geometry/join_blocks.hpp"
#include "geometry/numbered_curves.hpp"
#include "geometry/numeric_header.hpp"
#include "geometry/point_runs.hpp"
#include "geometry/surface_table.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t max_outlines = 100'000;  // of one file; an element takes some 600 bytes beside its points

/// Appends the outlines of one section to a list.
class SectionAssembler {
public:
    SectionAssembler(CoordinateSection section, const CoordinateDocument& document, const std::string& file,
                     bool keep_open, std::vector<RawOutline>& outlines)
        : section_(std::move(section)), document_(document), file_(file), keep_open_(keep_open), outlines_(outlines) {}

    void assemble() {
        if (section_.points.empty()) return;
        divide_curves();
        if (outlines_.empty()) drop_numeric_title();
        ColumnReading columns = choose_columns(section_, document_, file_);
        for (std::string& note : columns.notes) notes_.push_back(std::move(note));
        if (columns.table) return add_table(*columns.table);
        add_counted_surfaces();
        join_commented_blocks(section_);
        join_continued_blocks(section_);
        drop_lone_points();
        for (std::size_t i = 0; i < section_.blocks.size();) i += add_blocks(i);
        if (!notes_.empty() && !outlines_.empty())
            outlines_.back().notes.insert(outlines_.back().notes.end(), notes_.begin(), notes_.end());
    }

private:
    CoordinateSection section_;  ///< blocks that have no outline yet
    const CoordinateDocument& document_;
    const std::string& file_;
    bool keep_open_;  ///< whether open runs are outlines, as options say
    std::vector<RawOutline>& outlines_;
    std::vector<std::string> notes_;  ///< for the next outline

    /// Throws InputError where a file has more outlines than the memory for its size holds as elements.
    void add(std::vector<SourcePoint> points, const std::string& title, const std::string& format) {
        if (outlines_.size() == max_outlines)
            throw InputError({file_, points.front().line, points.front().at},
                             fmt::format("more than {} outlines in one file", max_outlines));
        RawOutline& outline = outlines_.emplace_back();
        outline.points = std::move(points);
        outline.title = title;
        outline.format = format;
        outline.notes = std::exchange(notes_, {});
    }

    /// Divides files of curves, and leaves out lines that are no outlines.
    void divide_curves() {
        for (const auto divide_section : {remove_auxiliary_lines, divide_counted_curves, divide_numbered_curves})
            for (std::string& note : divide_section(section_)) notes_.push_back(std::move(note));
    }

    /// Makes the first row a title where it cannot be anything else.
    void drop_numeric_title() {
        const std::optional<std::string> reason = why_title(section_.points, document_);
        if (!reason) return;
        notes_.push_back(fmt::format("line {}: '{}' taken as a title, not as coordinates: {}", section_.points[0].line,
                                     document_.first_row, *reason));
        const std::string title = section_.title(0);
        section_.remove_first_point();
        section_.set_title(0, title.empty() ? document_.first_row : title);
    }

    /// Adds the outline of a table of both surfaces.
    void add_table(const SurfaceTable& table) {
        notes_.push_back(fmt::format("line {}: table of {}, joined at the first row",
                                     std::min(table.upper.front().line, table.upper.back().line), table.contents));
        add(join_surfaces(table.upper, table.lower), section_.title(0), "table");
    }

    /// Adds the outlines whose surfaces follow their counts at the start of the section, and removes their blocks.
    void add_counted_surfaces() {
        std::size_t used = 0;  // blocks
        while (used < section_.blocks.size()) {
            const PointSpan rest = PointSpan(section_.points).subspan(section_.blocks[used].first);
            const std::optional<SurfaceCounts> counts = read_counts(rest, file_);
            if (!counts) break;
            const auto first = rest.begin() + 1, second = first + static_cast<std::ptrdiff_t>(counts->upper);
            const auto end = second + static_cast<std::ptrdiff_t>(counts->lower);
            add(join_surfaces({first, second}, {second, end}), section_.title(used), "lednicer");
            const std::size_t next = section_.blocks[used].first + counts->total() + 1;
            while (used < section_.blocks.size() && section_.blocks[used].first < next) ++used;
            const std::size_t end_of_block =
                used < section_.blocks.size() ? section_.blocks[used].first : section_.points.size();
            if (end_of_block > next)
                throw InputError({file_, end->line, end->at},
                                 fmt::format("a point beyond the {} that the counts of line {} announce (put # before "
                                             "that line if it is a title)",
                                             counts->total(), rest[0].line));
        }
        std::vector<bool> removed(section_.blocks.size());
        std::fill_n(removed.begin(), used, true);
        section_.remove_blocks(removed);
    }

    /// Drops a reference point before the outline and a point left over after it. Throws InputError for further ones.
    void drop_lone_points() {
        if (section_.blocks.size() < 2) return;
        std::size_t dropped = 0;
        std::vector<bool> removed;
        for (std::size_t i = 0; i < section_.blocks.size(); ++i) {
            removed.push_back(section_.block(i).size() == 1);
            if (!removed.back()) continue;
            const RowPoint& p = section_.block(i)[0];
            if (++dropped > 2) throw InputError({file_, p.line, p.at}, "a lone point that belongs to no outline");
            notes_.push_back(
                fmt::format("line {}: lone point left out, not part of an outline {}", p.line, coordinates(p.at)));
        }
        section_.remove_blocks(removed);
    }

    /// Returns whether the document says that the one surface of its section stands for both, which meet at y = 0.
    bool stands_for_both_surfaces(PointSpan points) const {
        return document_.symmetry_line > 0 && section_.blocks.size() == 1 && !is_loop(points) &&
               points.front().at.y == 0;
    }

    /// Returns whether block i and the one behind it are the surfaces of one outline.
    bool begins_two_surfaces(std::size_t i) const {
        return i + 1 < section_.blocks.size() && !is_loop(section_.block(i)) &&
               are_two_surfaces(section_.block(i), section_.block(i + 1));
    }

    /// Adds the outline that begins with block i. Returns the number of blocks that it has.
    std::size_t add_blocks(std::size_t i) {
        const PointSpan points = section_.block(i);
        const std::string title = section_.title(i);
        if (stands_for_both_surfaces(points)) {
            add_mirrored(points, title);
        } else if (const auto second_surface = find_second_surface(points)) {
            add(join_surfaces(points.first(*second_surface), points.subspan(*second_surface)), title, "lednicer");
        } else if (begins_two_surfaces(i)) {
            add(join_surfaces(points, section_.block(i + 1)), title, "lednicer");
            return 2;
        } else if (is_loop(points) || section_.blocks.size() == 1 || keep_open_) {
            add({points.begin(), points.end()}, title, "");
        } else {
            throw InputError({file_, points.front().line, points.front().at},
                             fmt::format("the points of lines {} to {} are neither a closed outline nor one of two "
                                         "surfaces",
                                         points.front().line, points.back().line));
        }
        return 1;
    }

    void add_mirrored(PointSpan points, const std::string& title) {
        PointRun lower(points.begin(), points.end());
        for (RowPoint& p : lower) p.at.y = -p.at.y;
        notes_.push_back(fmt::format("line {}: symmetric section, the surface given stands for both, mirrored at y = 0",
                                     document_.symmetry_line));
        add(join_surfaces(points, lower), title, "lednicer");
    }
};

/// Returns the error for a document without outlines, which shows a line that may have been meant as coordinates.
InputError error_without_coordinates(const CoordinateDocument& document, const std::string& file) {
    if (!document.has_rows) return InputError({file, 0, {}}, "the file is empty");
    const std::string message = "no coordinates found: no line starts with two numbers";
    if (document.fraction_line == 0) return InputError({file, 0, {}}, message);
    return InputError({file, document.fraction_line, {}},
                      fmt::format("{}; this one is '{}'", message, document.fraction_text));
}

}  // namespace

std::vector<RawOutline> assemble_outlines(CoordinateDocument document, const std::string& file, bool keep_open) {
    std::vector<RawOutline> outlines;
    for (CoordinateSection& section : document.sections)
        SectionAssembler(std::move(section), document, file, keep_open, outlines).assemble();
    if (outlines.empty()) throw error_without_coordinates(document, file);
    for (RawOutline& outline : outlines) {
        outline.unit = document.unit;
        if (outline.format.empty()) outline.format = document.csv ? "csv" : document.titled ? "selig" : "xy";
    }
    if (outlines[0].title.empty()) outlines[0].title = document.first_comment;
    outlines[0].notes.insert(outlines[0].notes.begin(), document.notes.begin(), document.notes.end());
    return outlines;
}

}  // namespace lamina::geometry
