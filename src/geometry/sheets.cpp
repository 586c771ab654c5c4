#include "geometry/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/marker_names.hpp>
#include <lamina/predicates.hpp>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "core/segments.hpp"
#include "core/text.hpp"
#include "geometry/point_list.hpp"
#include "geometry/sheet_curve.hpp"

namespace lamina::geometry {

namespace {

constexpr const char* sheet_option = "sheet";
constexpr const char* sheet_format = "sheet";

[[noreturn]] void refuse_sheet(const Sheet& sheet, const std::string& reason) {
    throw OptionError(sheet_option, fmt::format("{}: {}", sheet.name, reason));
}

/// Throws OptionError where a curve comes near to running back on itself, or crosses itself.
void require_simple_curve(const Sheet& sheet) {
    constexpr double most_turning_deg = 170;
    const std::vector<Point>& p = sheet.points;
    const auto at = [&](std::size_t i) { return fmt::format("at ({:.6g}, {:.6g})", p[i].x, p[i].y); };
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
        if (std::abs(core::degrees(core::angle_between(p[i] - p[i - 1], p[i + 1] - p[i]))) > most_turning_deg)
            refuse_sheet(sheet, "runs back on itself " + at(i) + ": give two sheets");
    tree_of_curve(p, false).overlapping_pairs([&](std::size_t i, std::size_t k) {
        if (k > i + 1 && core::segments_meet(p[i], p[i + 1], p[k], p[k + 1]))
            refuse_sheet(sheet, "crosses or touches itself " + at(k) +
                                    ": sheets are open; a closed curve is a body, given as INPUT");
    });
}

}  // namespace

Sheet parse_sheet(const std::string& text) {
    const std::size_t colon = text.find(':');
    core::require_text(colon != std::string::npos, text, "a sheet is NAME:FILE or NAME:X0,Y0,X1,Y1[,...]");
    PointList list = parse_point_list(text.substr(colon + 1));
    return {text.substr(0, colon), std::move(list.points), std::move(list.file)};
}

std::string sheet_text(const Sheet& sheet) { return sheet.name + ":" + point_list_text(sheet.points, sheet.file); }

void validate_sheets(std::span<const Sheet> sheets) {
    constexpr double least_edge = 1e-6;  // of the length: shorter ones are slips
    std::set<std::string> names;
    for (const Sheet& sheet : sheets) {
        if (sheet.name.empty() || legal_marker_name(sheet.name, MarkerKind::wall) != sheet.name)
            refuse_sheet(
                sheet,
                "is no name that every format takes: it begins with a letter, and letters, digits, _, - and . follow");
        if (!names.insert(sheet.name).second) refuse_sheet(sheet, "two sheets have this name");
        if (sheet.points.size() < 2) refuse_sheet(sheet, "has less than two points");
        const double least = least_edge * curve_length(sheet.points);
        for (std::size_t i = 0; i < sheet.points.size(); ++i) {
            if (!in_exact_range(sheet.points[i])) refuse_sheet(sheet, "has coordinates outside the exact range");
            if (i > 0 && !(distance(sheet.points[i], sheet.points[i - 1]) > least))
                refuse_sheet(sheet,
                             fmt::format("repeats the point ({:.6g}, {:.6g})", sheet.points[i].x, sheet.points[i].y));
        }
        require_simple_curve(sheet);
    }
}

Element open_sheet(const Sheet& sheet) {
    Element element;
    element.name = element.given_name = sheet.name;
    element.file = sheet.file.empty() ? sheet.name : sheet.file;
    element.format = sheet_format;
    element.points_read = sheet.points.size();
    element.points = sheet.points;
    for (std::size_t i = 0; sheet.file.empty() && i < sheet.points.size(); ++i) element.lines.push_back(i + 1);
    return element;
}

bool is_open_sheet(const Element& element) { return element.format == sheet_format && element.sheets.empty(); }

bool is_sheet(const Element& element) {
    return element.sheets.size() == 1 && element.sheets[0].begin == element.sheets[0].end;
}

double sheet_gap(std::span<const Point> curve) {
    // Far below any first height, and far above the rounding of coordinates, as of points far away from the origin.
    constexpr double share_of_length = 1e-12, roundings = 64;
    double largest = 0;
    for (const Point p : curve) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    return std::max(share_of_length * curve_length(curve),
                    roundings * std::numeric_limits<double>::epsilon() * largest);
}

std::vector<SheetRange> sheet_ranges(const Element& element) {
    const std::vector<Point>& p = element.points;
    const auto index = [&](Point at) {
        return static_cast<std::size_t>(std::find(p.begin(), p.end(), at) - p.begin());
    };
    std::vector<SheetRange> ranges;
    for (const SheetSides& sides : element.sheets) {
        SheetRange range{index(sides.begin), index(sides.tip), index(sides.end)};
        if (range.tip <= range.first) range.tip += p.size();
        while (range.last <= range.tip) range.last += p.size();
        ranges.push_back(range);
    }
    return ranges;
}

namespace {

/// Returns the curve of a sheet that its second side describes, which has more vertices than the first one. Vertices
/// that both sides have are those of the first side.
std::vector<Point> curve_of_second_side(const std::vector<Point>& p, const SheetRange& range) {
    const std::size_t n = p.size();
    std::vector<Point> curve;
    for (std::size_t i = range.last + 1; i-- > range.tip;) curve.push_back(p[i % n]);
    curve.front() = p[range.first % n];
    const double gap = sheet_gap(curve);
    const std::vector<Point> moved = beside_curve(curve, -gap);
    std::size_t near = range.first;
    for (std::size_t k = 1; k + 1 < curve.size(); ++k) {
        curve[k] = moved[k];
        for (std::size_t i = near; i < range.tip; ++i) {
            if (!(distance(p[i % n], moved[k]) < 4 * gap)) continue;
            curve[k] = p[i % n];
            near = i;
            break;
        }
    }
    return curve;
}

/// The curve of a sheet, and the vertices of the outline that its points come from.
struct FoldedCurve {
    std::vector<Point> points;
    std::vector<std::size_t> from;
    bool of_second_side = false;
};

/// Returns the curve of the side that has more vertices, or of the first one.
FoldedCurve curve_of_sheet(const std::vector<Point>& p, const SheetRange& range) {
    const std::size_t n = p.size();
    FoldedCurve curve;
    curve.of_second_side = range.last - range.tip > range.tip - range.first;
    if (curve.of_second_side) {
        curve.points = curve_of_second_side(p, range);
        for (std::size_t i = range.last + 1; i-- > range.tip;) curve.from.push_back(i % n);
        curve.from.front() = range.first % n;
        return curve;
    }
    for (std::size_t i = range.first; i <= range.tip; ++i) {
        curve.points.push_back(p[i % n]);
        curve.from.push_back(i % n);
    }
    return curve;
}

}  // namespace

std::vector<FoldedVertex> fold_again(Element& element) {
    std::vector<FoldedVertex> vertices;
    std::vector<Point> points;
    const auto add = [&](Point p, std::size_t from, bool is_across) {
        vertices.push_back({from, is_across});
        points.push_back(p);
    };
    std::vector<SheetRange> ranges = sheet_ranges(element);
    std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const std::size_t n = element.points.size();
    // The outline begins at the first sheet.
    const std::size_t begin = ranges.empty() ? 0 : ranges.front().first;
    std::size_t done = begin;
    const auto copy_up_to = [&](std::size_t end) {
        for (; done < end; ++done) add(element.points[done % n], done % n, false);
    };
    for (const SheetRange& range : ranges) {
        copy_up_to(range.first);
        const FoldedCurve curve = curve_of_sheet(element.points, range);
        const std::vector<Point> beside = beside_curve(curve.points, sheet_gap(curve.points));
        const std::size_t tip = curve.points.size() - 1;
        for (std::size_t k = 0; k <= tip; ++k)
            add(curve.points[k], curve.from[k], curve.of_second_side && k > 0 && k < tip);
        for (std::size_t k = tip; k-- > 1;) add(beside[k], curve.from[k], !curve.of_second_side);
        done = range.last;
    }
    copy_up_to(begin + n);
    const auto is_one_of = [](const std::vector<std::size_t>& sorted, std::size_t i) {
        return std::binary_search(sorted.begin(), sorted.end(), i);
    };
    std::vector<std::size_t> lines, corners, given;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const FoldedVertex& v = vertices[i];
        if (!element.lines.empty()) lines.push_back(v.is_across ? 0 : element.lines[v.from]);
        if (is_one_of(element.features.corners, v.from)) corners.push_back(i);
        if (is_one_of(element.given_corners, v.from)) given.push_back(i);
    }
    element.points = std::move(points);
    element.lines = std::move(lines);
    element.features.corners = std::move(corners);
    element.given_corners = std::move(given);
    return vertices;
}

}  // namespace lamina::geometry
