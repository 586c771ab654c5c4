// Reads points, segments and triangles in Triangle's formats.
#include <array>

#include <lamina/error.hpp>
#include <lamina/triangle_files.hpp>

#include "fuzz/fuzz.hpp"
#include "io/triangle_elements.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    constexpr std::array<std::string_view, 3> names{"input.poly", "input.ele", "input.node"};
    const InputFiles files(input, names);
    try {
        const TriangleInput read = read_triangle_files(files.folder() / names[0]);
        for (const Segment& s : read.segments)
            require(s.a.index() < read.points.size() && s.b.index() < read.points.size(), "a segment has no point");
        io::read_triangle_elements(files.folder() / names[1], read.first_index, read.points.size());
    } catch (const Error&) {
    }
}
