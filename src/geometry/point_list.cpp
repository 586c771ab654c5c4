#include "geometry/point_list.hpp"

#include <cstddef>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/text.hpp"
#include "geometry/coordinate_rows.hpp"

namespace lamina::geometry {

namespace {

std::vector<Point> read_point_list(const std::string& file) {
    const std::string text = read_file(file, max_text_bytes);
    RowReader rows(text, file);
    std::vector<Point> points;
    while (const auto row = rows.next()) {
        const bool is_title = row->kind == RowKind::text && row->damage.empty() && points.empty();
        if (row->kind == RowKind::blank || row->kind == RowKind::comment || is_title) continue;
        if (row->kind != RowKind::numbers || row->number_count != 2)
            throw InputError({input_name(file), row->line, {}}, "expected the two coordinates of a point of a line");
        points.push_back({row->values[0], row->values[1]});
    }
    return points;
}

bool is_list_of_numbers(const std::string& text) {
    return text.find(',') != std::string::npos && text.find_first_not_of("0123456789+-.,eE ") == std::string::npos;
}

}  // namespace

PointList parse_point_list(const std::string& text) {
    if (!is_list_of_numbers(text)) return {read_point_list(text), text};
    const std::vector<double> numbers = core::parse_numbers(text, ',');
    core::require_text(numbers.size() >= 4 && numbers.size() % 2 == 0, text,
                       "a line needs two coordinates for each of its points, and two points");
    PointList list;
    for (std::size_t i = 0; i < numbers.size(); i += 2) list.points.push_back({numbers[i], numbers[i + 1]});
    return list;
}

std::string point_list_text(std::span<const Point> points, const std::string& file) {
    if (!file.empty()) return file;
    std::string text;
    for (std::size_t i = 0; i < points.size(); ++i)
        text += core::concat(i > 0 ? "," : "", points[i].x, ",", points[i].y);
    return text;
}

}  // namespace lamina::geometry
