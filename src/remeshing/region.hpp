// The part of a mesh that is remeshed, taken out of it and put back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/remesh.hpp>

#include "remeshing/metric_mesh.hpp"

namespace lamina::remeshing {

/// A view of a mesh with regions: those that it has, or estimate_regions().
class MeshWithRegions {
public:
    explicit MeshWithRegions(const MeshView& mesh) : view_(mesh) {
        if (!mesh.region.empty()) return;
        estimated_ = estimate_regions(mesh);
        view_.region = estimated_;
    }
    MeshWithRegions(const MeshWithRegions&) = delete;
    MeshWithRegions& operator=(const MeshWithRegions&) = delete;

    const MeshView& view() const { return view_; }

private:
    std::vector<Region> estimated_;
    MeshView view_;
};

/// Returns whether a cell is remeshed: a triangle that is not of the layer.
bool is_remeshed(const MeshView& mesh, std::size_t cell);

/// Returns the triangles that are remeshed, with all vertices of the mesh, which keep their numbers. Edges behind which
/// nothing changes are borders; if `divide_borders`, those on straight lines of the boundary have the number of their
/// marker. Throws InputError where a triangle is not counter-clockwise, and where an edge has several cells on a side.
MetricMesh take_region(const MeshView& mesh, std::span<const MetricTensor> metric, bool divide_borders);

/// Lowers the metric along edges that stay until they are no longer than an edge that is in order: without that, the
/// triangles at them would be divided without end.
void limit_at_frozen_edges(MetricMesh& region);

/// Returns the mesh with its region replaced, and fills in the metric at its vertices: that of the region and, in the
/// layer, the one asked for.
Mesh put_back(const MeshView& mesh, const MetricMesh& region, std::span<const MetricTensor> asked,
              std::vector<MetricTensor>& metric);

}  // namespace lamina::remeshing
