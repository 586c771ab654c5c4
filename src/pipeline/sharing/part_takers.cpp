#include "pipeline/sharing/part_takers.hpp"

#include <cstddef>
#include <utility>

namespace lamina::pipeline {

namespace {

template <class T>
void append_all(std::span<const T> from, std::vector<T>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

PartTaker::Append MeshTaker::prepare(const MeshPart& part, std::shared_ptr<const Refinement> owner) {
    return [this, part, held = std::move(owner)] { append(part); };
}

void MeshTaker::append(const MeshPart& part) {
    if (mesh_.points.empty()) reserve();
    append_all(part.points, mesh_.points);
    append_all(part.triangles, mesh_.triangles);
    append_all(part.quads, mesh_.quads);
    const std::size_t cells = mesh_.triangles.size() + mesh_.quads.size();
    append_all(part.layers, mesh_.layer);
    mesh_.layer.resize(cells, 0);
    mesh_.region.resize(cells, part.region);
    mesh_.piece.resize(cells, part.piece);
}

/// Memory that is reserved but not used costs nothing, while vectors that grow are copied.
void MeshTaker::reserve() {
    constexpr double room = 1.05;  // estimates of many subdomains together are better than this
    double triangles = 0;
    for (const decoupling::Subdomain& subdomain : decoupling_.subdomains) triangles += subdomain.estimated_triangles;
    // There is half a vertex for each triangle.
    const auto vertices = static_cast<std::size_t>(room * triangles / 2),
               cells = static_cast<std::size_t>(room * triangles);
    mesh_.points.reserve(decoupling_.points.size() + vertices);
    mesh_.triangles.reserve(cells);
    mesh_.layer.reserve(cells);
    mesh_.region.reserve(cells);
    mesh_.piece.reserve(cells);
}

PartTaker::Append SinkTaker::prepare(const MeshPart& part, std::shared_ptr<const Refinement> /*owner*/) {
    return [this, bytes = sink_.format(part)] { sink_.append(bytes); };
}

}  // namespace lamina::pipeline
