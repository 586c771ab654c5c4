#include "io/extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "io/mesh_parts.hpp"

namespace lamina::io {

void require_span(const WriteOptions& options) {
    if (options.span == 0 && (options.span_cells != 1 || options.span_periodic))
        throw UsageError("the cells and the ends of a span need the span");
    if (!(options.span >= 0 && std::isfinite(options.span)) || options.span_cells == 0)
        throw UsageError(
            fmt::format("a span of {} in {} cells: both must be positive", options.span, options.span_cells));
}

Extrusion extrusion_of(const MeshView& mesh, const std::filesystem::path& file, const WriteOptions& options) {
    require_span(options);
    Extrusion extrusion;
    if (options.span > 0) extrusion = {options.span, options.span_cells, options.span_periodic};
    // A cell has five or six faces, of which it shares all but a few.
    const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
    const double largest =
        std::max(static_cast<double>(extrusion.planes()) * static_cast<double>(mesh.points.size()),
                 static_cast<double>(extrusion.planes()) * static_cast<double>(3 * cells + count_marker_edges(mesh)));
    if (largest > static_cast<double>(std::numeric_limits<std::int32_t>::max()))
        throw UsageError(fmt::format("{}: more than 2^31 nodes or faces in {} cells across the span", file.string(),
                                     extrusion.cells));
    return extrusion;
}

}  // namespace lamina::io
