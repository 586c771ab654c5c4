#include "adaptation/vertex_patches.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::adaptation {

namespace {

/// Takes the cells that touch others which are not isotropic.
void take_ring(const Mesh& mesh, std::vector<char>& isotropic) {
    const mesh::CellEdges cells(mesh);
    std::vector<char> inside(mesh.points.size(), 0);
    const auto corners = [&](std::size_t cell, auto&& act) {
        for (std::size_t i = 0; i < cells.corners(cell); ++i) act(inside[cells.corner(cell, i).index()]);
    };
    for (std::size_t cell = 0; cell < isotropic.size(); ++cell)
        if (!isotropic[cell]) corners(cell, [](char& mark) { mark = 1; });
    for (std::size_t cell = 0; cell < isotropic.size(); ++cell)
        corners(cell, [&](char mark) {
            if (mark) isotropic[cell] = 0;
        });
}

/// Returns the regions by the shapes of cells. Where the mesh has no markers, all of its boundary may be walls.
std::vector<Region> regions_by_shape(const Mesh& mesh) {
    if (!mesh.markers.empty()) return estimate_regions(mesh);
    Mesh marked = mesh;
    const mesh::CellEdges edges(mesh);
    Marker& boundary = marked.markers.emplace_back(Marker{"boundary", MarkerKind::wall, {}});
    for (const std::uint32_t edge : mesh::find_adjacency(mesh).boundary)
        boundary.edges.push_back({edges.origin(edge), edges.target(edge)});
    return estimate_regions(marked);
}

}  // namespace

std::vector<char> isotropic_cells(const Mesh& mesh) {
    // Triangles between rows of quads may look isotropic.
    constexpr int doubtful_rings = 2;
    const bool known = !mesh.region.empty();
    const std::vector<Region> regions = known ? mesh.region : regions_by_shape(mesh);
    std::vector<char> isotropic(mesh.triangles.size() + mesh.quads.size(), 1);
    for (std::size_t i = 0; i < regions.size(); ++i) isotropic[i] = regions[i] == Region::isotropic;
    for (int ring = 0; !known && ring < doubtful_rings; ++ring) take_ring(mesh, isotropic);
    return isotropic;
}

const SolutionField& field_named(const Solution& solution, const std::string& name, const std::string& option) {
    for (const SolutionField& field : solution.fields)
        if (field.name == name) return field;
    throw OptionError(option, fmt::format("'{}' is none of the fields", name));
}

void require_fitting(const Mesh& mesh, const SolutionField& field) {
    const std::size_t places = field.at_cells ? mesh.triangles.size() + mesh.quads.size() : mesh.points.size();
    if (field.values.size() != places)
        throw OptionError("field", "'" + field.name + "' has " + std::to_string(field.values.size()) +
                                       " values where the mesh has " + std::to_string(places) +
                                       (field.at_cells ? " cells" : " vertices"));
}

VertexCells::VertexCells(const Mesh& mesh, std::span<const char> chosen)
    : mesh_(mesh), first_(mesh.points.size() + 1, 0) {
    const auto each = [&](auto&& act) {
        for (std::size_t cell = 0; cell < chosen.size(); ++cell)
            if (chosen[cell])
                for (const VertexId v : corners(cell)) act(v.index(), static_cast<std::uint32_t>(cell));
    };
    each([&](std::size_t vertex, std::uint32_t) { ++first_[vertex + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    cells_.resize(first_.back());
    each([&](std::size_t vertex, std::uint32_t cell) { cells_[next[vertex]++] = cell; });
}

std::span<const VertexId> VertexCells::corners(std::size_t cell) const {
    const std::size_t triangles = mesh_.triangles.size();
    if (cell < triangles) return {mesh_.triangles[cell].v, 3};
    return {mesh_.quads[cell - triangles].v, 4};
}

void PatchSearch::begin(std::size_t vertex) {
    ++round_;
    found_ = {static_cast<std::uint32_t>(vertex)};
    mark_[vertex] = round_;
    grown_ = 0;
}

bool PatchSearch::grow() {
    const std::size_t end = found_.size();
    for (; grown_ < end; ++grown_)
        for (const std::uint32_t cell : cells_.at(found_[grown_]))
            for (const VertexId v : cells_.corners(cell)) {
                if (mark_[v.index()] == round_) continue;
                mark_[v.index()] = round_;
                found_.push_back(v.value);
            }
    return found_.size() > end;
}

}  // namespace lamina::adaptation
