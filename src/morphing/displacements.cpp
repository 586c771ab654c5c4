// Displacements of wall vertices from a file.
#include <lamina/morph.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/text.hpp"
#include "morphing/rays.hpp"

namespace lamina {

using namespace morphing;

std::vector<Point> displaced_wall_points(const MorphMap& map, const std::filesystem::path& file) {
    const std::string name = input_name(file);
    const WallVertices& walls = map.walls();
    std::vector<std::uint32_t> place(map.reference().points.size(), no_ray);
    for (std::size_t i = 0; i < walls.vertex.size(); ++i)
        place[walls.vertex[i].index()] = static_cast<std::uint32_t>(i);
    std::vector<Point> wall = map.wall_points();
    const std::vector<std::string> lines = core::split(read_file(file, max_text_bytes), '\n');
    for (std::size_t n = 1; n <= lines.size(); ++n) {
        std::string line = lines[n - 1];
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty() || (n == 1 && line == "vertex,dx,dy")) continue;
        const auto fail = [&](const std::string& reason) { throw InputError({.file = name, .line = n}, reason); };
        std::vector<double> numbers;
        try {
            numbers = core::parse_numbers(line, ',');
        } catch (const UsageError& error) {
            fail(error.what());
        }
        if (numbers.size() != 3) fail(core::concat("'", line, "' is not 'vertex,dx,dy'"));
        const double vertex = numbers[0];
        if (!(vertex >= 0 && vertex < static_cast<double>(place.size())) || vertex != std::floor(vertex))
            fail(core::concat("the mesh has no vertex ", vertex));
        std::uint32_t& at = place[static_cast<std::size_t>(vertex)];
        if (at == no_ray) fail(core::concat("vertex ", vertex, " is on no wall, or has a line before"));
        wall[at] = wall[at] + Point{numbers[1], numbers[2]};
        at = no_ray;
    }
    return wall;
}

}  // namespace lamina
