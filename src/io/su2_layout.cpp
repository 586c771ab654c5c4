// The SU2 format part by part: the lines of cells and those of points are a section each, and the numbers of both stand
// before them.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "io/formats.hpp"
#include "io/mesh_layout.hpp"
#include "io/mesh_parts.hpp"
#include "io/su2_lines.hpp"

namespace lamina::io {

namespace {

std::size_t digits_of(std::size_t value) {
    std::size_t digits = 1;
    for (; value >= 10; value /= 10) ++digits;
    return digits;
}

/// Returns the number of digits of first, first + 1 ... first + n - 1 together.
std::size_t digits_of_range(std::size_t first, std::size_t n) {
    std::size_t sum = 0;
    while (n > 0) {
        const std::size_t digits = digits_of(first);
        std::size_t beyond = 1;
        for (std::size_t i = 0; i < digits; ++i) beyond *= 10;
        const std::size_t here = std::min(n, beyond - first);
        sum += here * digits;
        first += here;
        n -= here;
    }
    return sum;
}

/// Returns the bytes of a number with 17 significant digits: "-1.2345678901234567e-01".
std::size_t number_bytes(double value) {
    constexpr std::size_t bytes = 22;  // of a number without a sign, with two digits in its exponent
    const double size = std::abs(value);
    const bool three_digits = size != 0 && !(size >= 1e-99 && size < 1e99);
    if (!three_digits) return bytes + std::signbit(value);
    char text[40];
    return static_cast<std::size_t>(std::to_chars(text, text + 30, value, std::chars_format::scientific, 16).ptr -
                                    text);
}

template <class Cell>
std::size_t cell_bytes(std::span<const Cell> cells, std::size_t first_cell) {
    constexpr std::size_t corners = std::size(Cell{}.v);
    std::size_t sum = cells.size() * (corners + 3) + digits_of_range(first_cell, cells.size());
    for (const Cell& cell : cells)
        for (const VertexId v : cell.v) sum += digits_of(v.index());
    return sum;
}

class Su2Layout : public MeshLayout {
public:
    explicit Su2Layout(std::filesystem::path file) : file_(std::move(file)) {}

    std::size_t sections() const override { return 2; }
    MeshSink::Bytes format(const MeshPart& part) const override {
        const std::size_t first_quad = part.first_cell + part.triangles.size();
        std::string cells = format_lines(0, part.triangles.size(), [&](LineText& line, std::size_t i) {
            put_su2_cell(line, part.triangles[i], part.first_cell + i);
        });
        cells += format_lines(0, part.quads.size(), [&](LineText& line, std::size_t i) {
            put_su2_cell(line, part.quads[i], first_quad + i);
        });
        return {std::move(cells), format_lines(0, part.points.size(), [&](LineText& line, std::size_t i) {
                    put_su2_point(line, part.points[i], part.first_vertex + i);
                })};
    }
    std::vector<std::size_t> sizes(const MeshPart& part) const override {
        std::size_t points = 3 * part.points.size() + digits_of_range(part.first_vertex, part.points.size());
        for (const Point p : part.points) points += number_bytes(p.x) + number_bytes(p.y);
        return {cell_bytes(part.triangles, part.first_cell) +
                    cell_bytes(part.quads, part.first_cell + part.triangles.size()),
                points};
    }
    void require_names(std::span<const Marker> markers) const override { require_su2_marker_names(markers, file_); }
    std::vector<FileStretch> stretches(const MeshFrame& frame, std::span<const std::uint64_t>) const override {
        std::ostringstream markers;
        write_su2_markers(frame.markers, markers);
        std::vector<FileStretch> stretches(3);
        stretches[0].text = fmt::format("NDIME= 2\nNELEM= {}\n", frame.counts.triangles + frame.counts.quads);
        stretches[0].section = 0;
        stretches[1].text = fmt::format("NPOIN= {}\n", frame.counts.vertices);
        stretches[1].section = 1;
        stretches[2].text = std::move(markers).str();
        return stretches;
    }

private:
    std::filesystem::path file_;
};

}  // namespace

std::unique_ptr<MeshLayout> su2_layout(const std::filesystem::path& file) { return std::make_unique<Su2Layout>(file); }

}  // namespace lamina::io
