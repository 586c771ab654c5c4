#include "io/sizes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "io/formats.hpp"

namespace lamina::io {

std::string size_array(const std::vector<std::string>& scalar_arrays, const std::filesystem::path& file) {
    std::string name = "size";
    if (std::find(scalar_arrays.begin(), scalar_arrays.end(), name) != scalar_arrays.end()) return name;
    if (scalar_arrays.size() == 1) return scalar_arrays.front();
    throw InputError({file.string(), 0, {}},
                     scalar_arrays.empty()
                         ? "no sizes: no array of one value a point"
                         : fmt::format("no array of one value a point is named 'size', and there are several: {}",
                                       fmt::join(scalar_arrays, ", ")));
}

namespace {

/// Returns the triangles, and the quads cut in two, with the points that they use.
SizedMesh make_sized_mesh(const PointValues& read, const std::filesystem::path& file) {
    SizedMesh result;
    result.gradation = read.gradation;
    result.walls = read.walls;
    result.triangles = read.mesh.triangles;
    for (const Quad& quad : read.mesh.quads) {
        result.triangles.push_back({{quad.v[0], quad.v[1], quad.v[2]}});
        result.triangles.push_back({{quad.v[0], quad.v[2], quad.v[3]}});
    }
    if (result.triangles.empty()) throw InputError({file.string(), 0, {}}, "no triangles to interpolate sizes in");

    std::vector<char> used(read.mesh.points.size(), 0);
    for (const Triangle& triangle : result.triangles)
        for (VertexId v : triangle.v) used[v.index()] = 1;
    std::vector<VertexId> new_id(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] == 0) continue;
        const Point p = read.mesh.points[i];
        const double size = read.values[i];
        if (std::isnan(size)) throw InputError({file.string(), 0, p}, fmt::format("vertex {} has no size", i));
        if (!(size > 0 && std::isfinite(size)))
            throw InputError({file.string(), 0, p}, fmt::format("size {} of vertex {}: must be positive", size, i));
        new_id[i] = VertexId(result.points.size());
        result.points.push_back(p);
        result.sizes.push_back(size);
    }
    for (Triangle& triangle : result.triangles)
        for (VertexId& v : triangle.v) v = new_id[v.index()];
    return result;
}

/// Returns the extensions of the formats that sizes are read from.
std::set<std::string> extensions_with_sizes() {
    std::set<std::string> extensions;
    for (const FormatRow& row : format_table())
        if (row.read_sizes != nullptr) extensions.insert(row.extensions.begin(), row.extensions.end());
    return extensions;
}

}  // namespace
}  // namespace lamina::io

namespace lamina {

using namespace io;

SizedMesh read_sizes(const std::filesystem::path& file) {
    const FormatRow& format = find_format(file);
    if (format.read_sizes == nullptr)
        throw UsageError(fmt::format("{}: sizes are read from files with the extensions {}", file.string(),
                                     fmt::join(extensions_with_sizes(), ", ")));
    return make_sized_mesh(format.read_sizes(read_file(file), input_name(file)), input_name(file));
}

}  // namespace lamina
