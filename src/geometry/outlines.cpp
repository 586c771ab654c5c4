#include "geometry/outlines.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/characters.hpp"
#include "geometry/columns.hpp"
#include "geometry/coordinate_blocks.hpp"
#include "geometry/join_blocks.hpp"
#include "geometry/numbered_curves.hpp"
#include "geometry/numeric_header.hpp"
#include "geometry/point_runs.hpp"
#include "geometry/surface_table.hpp"

namespace lamina::geometry {

namespace {

/// Appends the outlines of one section to a list.
class SectionAssembler {
public:
    SectionAssembler(CoordinateSection section, const CoordinateDocument& document, const std::string& file,
                     bool keep_open, std::vector<RawOutline>& outlines)
        : section_(std::move(section)), document_(document), file_(file), keep_open_(keep_open), outlines_(outlines) {}

    void assemble() {
        if (section_.empty()) return;
        divide_curves();
        if (outlines_.empty()) drop_numeric_title();
        ColumnReading columns = choose_columns(section_, document_, file_);
        for (std::string& note : columns.notes) notes_.push_back(std::move(note));
        if (columns.table) return add_table(*columns.table);
        while (!section_.empty() && add_counted_surfaces()) {
        }
        join_commented_blocks(section_);
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
    bool keep_open_;  ///< whether open runs are outlines, as options say
    std::vector<RawOutline>& outlines_;
    std::vector<std::string> notes_;  ///< for the next outline

    void add(std::vector<SourcePoint> points, const std::string& title, const std::string& format) {
        RawOutline& outline = outlines_.emplace_back();
        outline.points = std::move(points);
        outline.title = title;
        outline.format = format;
        outline.notes = std::exchange(notes_, {});
    }

    /// Divides files of curves, and leaves out lines that are no outlines.
    void divide_curves() {
        for (const auto divide : {remove_auxiliary_lines, divide_counted_curves, divide_numbered_curves})
            for (std::string& note : divide(section_)) notes_.push_back(std::move(note));
    }

    /// Makes the first row a title where it cannot be anything else.
    void drop_numeric_title() {
        PointRun copies;
        const std::optional<std::string> reason = why_title(all_points(section_, copies), document_);
        if (!reason) return;
        CoordinateBlock& block = section_[0];
        notes_.push_back(fmt::format("line {}: '{}' taken as a title, not as coordinates: {}", block.points[0].line,
                                     document_.first_row, *reason));
        std::string title = block.title.empty() ? document_.first_row : block.title;
        block.points.erase(block.points.begin());
        if (block.points.empty()) section_.erase(section_.begin());
        section_[0].title = std::move(title);
    }

    /// Adds the outline of a table of both surfaces.
    void add_table(const SurfaceTable& table) {
        notes_.push_back(fmt::format("line {}: table of {}, joined at the first row",
                                     std::min(table.upper.front().line, table.upper.back().line), table.contents));
        add(join_surfaces(table.upper, table.lower), section_[0].title, "table");
    }

    /// Adds the outline whose surfaces follow their counts at the start of the section, and removes its blocks. Returns
    /// whether there are counts.
    bool add_counted_surfaces() {
        PointRun copies;
        const PointSpan rest = all_points(section_, copies);
        const std::optional<SurfaceCounts> counts = read_counts(rest, file_);
        if (!counts) return false;
        const auto first = rest.begin() + 1, second = first + static_cast<std::ptrdiff_t>(counts->upper);
        const auto end = second + static_cast<std::ptrdiff_t>(counts->lower);
        add(join_surfaces({first, second}, {second, end}), section_[0].title, "lednicer");
        if (remove_blocks(section_, counts->total() + 1) > 0)
            throw InputError(
                {file_, end->line, end->at},
                fmt::format("a point beyond the {} that the counts of line {} announce (put # before that line if "
                            "it is a title)",
                            counts->total(), rest[0].line));
        return true;
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
        const PointRun& points = section_[i].points;
        const std::string& title = section_[i].title;
        if (stands_for_both_surfaces(points)) {
            add_mirrored(points, title);
        } else if (const auto second_surface = find_second_surface(points)) {
            const auto second = points.begin() + static_cast<std::ptrdiff_t>(*second_surface);
            add(join_surfaces({points.begin(), second}, {second, points.end()}), title, "lednicer");
        } else if (is_loop(points) || section_.size() == 1) {
            add({points.begin(), points.end()}, title, "");
        } else if (i + 1 < section_.size() && are_two_surfaces(points, section_[i + 1].points)) {
            add(join_surfaces(points, section_[i + 1].points), title, "lednicer");
            return 2;
        } else if (keep_open_) {
            add({points.begin(), points.end()}, title, "");
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

/// Returns the error for rows without outlines, which shows a line that may have been meant as coordinates.
InputError error_without_coordinates(const TextRows& rows, const std::string& file) {
    constexpr std::size_t most_shown = 60;  // bytes
    if (rows.empty()) return InputError({file, 0, {}}, "the file is empty");
    const auto has_fraction = [](const TextRow& row) {
        const std::string& text = row.words().text;
        const std::size_t point = text.find('.');
        return row.kind == RowKind::text && point != std::string::npos && point + 1 < text.size() &&
               is_digit(text[point + 1]);
    };
    const auto row = std::find_if(rows.begin(), rows.end(), has_fraction);
    if (row == rows.end()) return InputError({file, 0, {}}, "no coordinates found: no line starts with two numbers");
    const std::string& text = row->words().text;
    const bool is_long = text.size() > most_shown;
    return InputError({file, row->line, {}},
                      fmt::format("no coordinates found: no line starts with two numbers; this one is '{}{}'",
                                  printable(std::string_view(text).substr(0, most_shown)), is_long ? "..." : ""));
}

}  // namespace

std::vector<RawOutline> assemble_outlines(CoordinateDocument document, const std::string& file, bool keep_open) {
    std::vector<RawOutline> outlines;
    for (CoordinateSection& section : document.sections)
        SectionAssembler(std::move(section), document, file, keep_open, outlines).assemble();
    if (outlines.empty()) return outlines;
    for (RawOutline& outline : outlines) {
        outline.unit = document.unit;
        if (outline.format.empty()) outline.format = document.csv ? "csv" : document.titled ? "selig" : "xy";
    }
    if (outlines[0].title.empty()) outlines[0].title = document.first_comment;
    outlines[0].notes.insert(outlines[0].notes.begin(), document.notes.begin(), document.notes.end());
    return outlines;
}

std::vector<RawOutline> assemble_outlines(TextRows rows, const std::string& file, bool keep_open) {
    CoordinateDocument document = split_into_blocks(rows, file);
    const InputError refusal = error_without_coordinates(rows, file);
    TextRows().swap(rows);  // they take as much as the points, of which copies are made
    std::vector<RawOutline> outlines = assemble_outlines(std::move(document), file, keep_open);
    if (outlines.empty()) throw refusal;
    return outlines;
}

}  // namespace lamina::geometry
