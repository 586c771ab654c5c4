#include "geometry/surface_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <lamina/error.hpp>

#include "geometry/point_runs.hpp"

namespace lamina::geometry {

namespace {

/// Returns whether all rows have these columns.
template <std::size_t N>
bool have_columns(PointSpan rows, const std::array<std::size_t, N>& columns) {
    const std::size_t last = *std::max_element(columns.begin(), columns.end());
    return std::all_of(rows.begin(), rows.end(), [&](const RowPoint& p) { return p.columns > last; });
}

/// Returns the first row whose x does not go on in the direction of the first two; the end where x is monotone.
PointRun::const_iterator turning_row(const PointRun& points) {
    if (points.size() < 2) return points.end();
    const double sign = points[1].at.x > points[0].at.x ? 1 : -1;
    const auto turn = std::adjacent_find(points.begin(), points.end(), [&](const RowPoint& a, const RowPoint& b) {
        return !(sign * (b.at.x - a.at.x) > 0);
    });
    return turn == points.end() ? turn : turn + 1;
}

bool is_monotone(const PointRun& points) { return turning_row(points) == points.end(); }

bool rises(const PointRun& points) { return points.front().at.x < points.back().at.x; }

bool names_lower_first(const std::string& heading) {
    const std::size_t upper = heading.find("upper"), lower = heading.find("lower");
    return upper != std::string::npos && lower != std::string::npos && lower < upper;
}

/// Returns the points of a surface whose coordinates stand in two columns. Rows that end before them have none: the two
/// surfaces of a table may differ in their number of points.
PointRun surface_in(PointSpan rows, std::size_t x, std::size_t y) {
    PointRun surface;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(surface),
                 [&](const RowPoint& p) { return p.columns > std::max(x, y); });
    for (RowPoint& p : surface) p.at = {p[x], p[y]};
    return surface;
}

void run_from_nose(PointRun& surface) {
    if (!rises(surface)) std::reverse(surface.begin(), surface.end());
}

void mirror(PointRun& surface) {
    for (RowPoint& p : surface) p.at.y = -p.at.y;
}

/// Returns whether two surfaces with the same x, from the nose to the tail, meet at the ends alone. `sign` is -1 if the
/// ordinates of the lower one count downward, else 1.
bool are_apart(const PointRun& upper, const PointRun& lower, double sign) {
    const double chord = upper.back().at.x - upper.front().at.x;
    const auto thickness = [&](std::size_t i) { return upper[i].at.y - sign * lower[i].at.y; };
    if (std::abs(thickness(0)) > 0.01 * chord || std::abs(thickness(upper.size() - 1)) > 0.2 * chord) return false;
    for (std::size_t i = 1; i + 1 < upper.size(); ++i)
        if (!(thickness(i) > 0)) return false;
    return true;
}

/// Returns the table of two surfaces with the same x. Where they would cross otherwise, lower ordinates count downward.
SurfaceTable table_of_ordinates(PointRun upper, PointRun lower) {
    const bool downward = !are_apart(upper, lower, 1) && are_apart(upper, lower, -1);
    if (downward) mirror(lower);
    return {std::move(upper), std::move(lower),
            downward ? "x, upper and lower ordinates (these counted downward)" : "x, upper and lower ordinates"};
}

/// Returns the surfaces at camber +- factor x thickness.
SurfaceTable table_of_thickness(const PointRun& rows, std::size_t x, std::size_t thickness, double factor,
                                std::optional<std::size_t> camber) {
    SurfaceTable table{rows, rows, {}};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double middle = camber ? rows[i][*camber] : 0, half = factor * rows[i][thickness];
        table.upper[i].at = {rows[i][x], middle + half};
        table.lower[i].at = {rows[i][x], middle - half};
    }
    const std::string half = factor == 1 ? "half thickness" : "thickness",
                      at = factor == 1 ? "+- half thickness" : "+- thickness / 2";
    table.contents = camber ? "x, " + half + " and camber (surfaces at camber " + at + ")"
                            : "x and " + half + " of a symmetric section (surfaces at " + at + ")";
    return table;
}

/// Returns the table whose columns have these roles, with its rows as they stand.
std::optional<SurfaceTable> table_by_roles(const PointRun& rows, const std::vector<ColumnRole>& roles) {
    const auto column = [&](ColumnRole role) { return column_with(roles, role); };
    const auto x = column(ColumnRole::x), upper = column(ColumnRole::upper), lower = column(ColumnRole::lower),
               upper_x = column(ColumnRole::upper_x), lower_x = column(ColumnRole::lower_x);
    if (upper_x && upper && lower_x && lower)
        return SurfaceTable{surface_in(rows, *upper_x, *upper), surface_in(rows, *lower_x, *lower),
                            "the coordinates of both surfaces"};
    if (!x) return std::nullopt;
    if (upper && lower)
        return SurfaceTable{surface_in(rows, *x, *upper), surface_in(rows, *x, *lower), "x, upper and lower ordinates"};
    const auto camber = column(ColumnRole::camber);
    if (const auto thickness = column(ColumnRole::thickness))
        return table_of_thickness(rows, *x, *thickness, 0.5, camber);
    if (const auto half = column(ColumnRole::half_thickness)) return table_of_thickness(rows, *x, *half, 1, camber);
    return std::nullopt;
}

}  // namespace

std::optional<SurfaceTable> read_surface_table(PointSpan rows, const std::array<std::size_t, 3>& columns,
                                               const std::string& heading) {
    const auto [x, first, second] = columns;
    const auto falls = [x = x](const RowPoint& a, const RowPoint& b) { return !(b[x] > a[x]); };
    if (rows.size() < 5 || !have_columns(rows, columns) ||
        std::adjacent_find(rows.begin(), rows.end(), falls) != rows.end())
        return std::nullopt;
    const bool lower_first = names_lower_first(heading);
    PointRun upper = surface_in(rows, x, lower_first ? second : first),
             lower = surface_in(rows, x, lower_first ? first : second);
    if (!are_apart(upper, lower, 1) && !are_apart(upper, lower, -1)) return std::nullopt;
    return table_of_ordinates(std::move(upper), std::move(lower));
}

std::optional<SurfaceTable> read_paired_table(PointSpan rows, const std::array<std::size_t, 4>& columns) {
    if (rows.size() < 3 || !have_columns(rows, columns)) return std::nullopt;
    SurfaceTable table{surface_in(rows, columns[0], columns[1]), surface_in(rows, columns[2], columns[3]),
                       "the coordinates of both surfaces"};
    if (!is_monotone(table.upper) || !is_monotone(table.lower) || rises(table.upper) != rises(table.lower))
        return std::nullopt;
    run_from_nose(table.upper);
    run_from_nose(table.lower);
    return are_two_surfaces(table.upper, table.lower) ? std::optional(std::move(table)) : std::nullopt;
}

std::optional<SurfaceTable> read_named_table(const PointRun& rows, const std::vector<ColumnRole>& roles,
                                             const std::string& file) {
    std::optional<SurfaceTable> table = table_by_roles(rows, roles);
    if (!table) return std::nullopt;
    for (const PointRun* surface : {&table->upper, &table->lower})
        if (const auto turn = turning_row(*surface); turn != surface->end())
            throw InputError(
                {file, turn->line, turn->at},
                "x turns back here, but must rise or fall from row to row in a table of " + table->contents);
    run_from_nose(table->upper);
    run_from_nose(table->lower);
    const std::string ordinates = "x, upper and lower ordinates";
    if (table->contents == ordinates) return table_of_ordinates(std::move(table->upper), std::move(table->lower));
    return table;
}

}  // namespace lamina::geometry
