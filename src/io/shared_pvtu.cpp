// PVTU files from several processes: each writes the cells that it holds as parts of their own, so nothing but the
// numbers of the parts is sent. Which cells a part holds depends on who has made which piece; all parts together are
// the mesh.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "core/packing.hpp"
#include "io/formats.hpp"
#include "io/pvtu.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/shared_parts.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// A part is closed once it has this many cells, so that memory is bounded where pieces wait on the disk.
constexpr std::size_t cells_of_full_part = std::size_t{1} << 22;

/// Collects parts of a mesh as one part of a PVTU file.
class PartCollector {
public:
    void add(const MeshPart& part) {
        if (part.triangles.empty() && part.quads.empty()) return;
        shared_ = part.shared;
        if (!part.points.empty()) blocks_.push_back({part.first_vertex, {part.points.begin(), part.points.end()}});
        triangles_.insert(triangles_.end(), part.triangles.begin(), part.triangles.end());
        quads_.insert(quads_.end(), part.quads.begin(), part.quads.end());
        of_triangles_.add(part, 0, part.triangles.size());
        of_quads_.add(part, part.triangles.size(), part.quads.size());
    }
    std::size_t cells() const { return triangles_.size() + quads_.size(); }

    /// Returns the part, with those edges of the markers that its cells have.
    PartMesh take(std::span<const Marker> markers) {
        PartMesh part;
        Mesh& mesh = part.mesh;
        std::vector<VertexId>& vertices = part.vertices;
        for (const Triangle& t : triangles_) vertices.insert(vertices.end(), t.v, t.v + 3);
        for (const Quad& q : quads_) vertices.insert(vertices.end(), q.v, q.v + 4);
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        std::sort(blocks_.begin(), blocks_.end(), [](const Block& a, const Block& b) { return a.first < b.first; });
        for (const VertexId v : vertices) mesh.points.push_back(point(v));
        for (Triangle& t : triangles_)
            for (VertexId& v : t.v) v = *local(vertices, v);
        for (Quad& q : quads_)
            for (VertexId& v : q.v) v = *local(vertices, v);
        mesh.triangles = std::move(triangles_);
        mesh.quads = std::move(quads_);
        of_triangles_.append(of_quads_);
        mesh.region = std::move(of_triangles_.region);
        mesh.piece = std::move(of_triangles_.piece);
        mesh.layer = std::move(of_triangles_.layer);
        add_markers(markers, part);
        *this = {};
        return part;
    }

private:
    struct Block {
        std::size_t first;
        std::vector<Point> points;
    };
    /// The arrays per cell.
    struct CellArrays {
        std::vector<Region> region;
        std::vector<std::uint32_t> piece;
        std::vector<std::uint16_t> layer;

        void add(const MeshPart& part, std::size_t first, std::size_t count) {
            region.insert(region.end(), count, part.region);
            piece.insert(piece.end(), count, part.piece);
            for (std::size_t i = first; i < first + count; ++i)
                layer.push_back(part.layers.empty() ? std::uint16_t{0} : part.layers[i]);
        }
        void append(const CellArrays& other) {
            region.insert(region.end(), other.region.begin(), other.region.end());
            piece.insert(piece.end(), other.piece.begin(), other.piece.end());
            layer.insert(layer.end(), other.layer.begin(), other.layer.end());
        }
    };
    std::span<const Point> shared_;
    std::vector<Block> blocks_;
    std::vector<Triangle> triangles_;
    std::vector<Quad> quads_;
    CellArrays of_triangles_, of_quads_;

    Point point(VertexId v) const {
        if (v.index() < shared_.size()) return shared_[v.index()];
        const auto behind = std::upper_bound(blocks_.begin(), blocks_.end(), v.index(),
                                             [](std::size_t i, const Block& block) { return i < block.first; });
        const Block& block = *(behind - 1);
        return block.points[v.index() - block.first];
    }
    /// Returns the number of a vertex in the part, if it is there.
    static std::optional<VertexId> local(std::span<const VertexId> vertices, VertexId v) {
        const auto at = std::lower_bound(vertices.begin(), vertices.end(), v);
        if (at == vertices.end() || *at != v) return std::nullopt;
        return VertexId{static_cast<std::size_t>(at - vertices.begin())};
    }
    static void add_markers(std::span<const Marker> markers, PartMesh& part) {
        std::vector<Segment> edges;
        std::vector<std::size_t> marker_of_edge;
        for (std::size_t m = 0; m < markers.size(); ++m) {
            part.mesh.markers.push_back({markers[m].name, markers[m].kind, {}});
            for (const Segment& edge : markers[m].edges) {
                const auto a = local(part.vertices, edge.a), b = local(part.vertices, edge.b);
                if (!a || !b) continue;
                edges.push_back({*a, *b});
                marker_of_edge.push_back(m);
            }
        }
        const std::vector<std::uint32_t> found = mesh::find_edges(part.mesh, edges);
        for (std::size_t i = 0; i < edges.size(); ++i)
            if (found[i] != mesh::no_edge) part.mesh.markers[marker_of_edge[i]].edges.push_back(edges[i]);
    }
};

/// Returns where the parts of PVTU files end: each holds the parts [ends[k - 1], ends[k]) of this process.
std::vector<std::size_t> ends_of_parts(const mesh::MeshParts& parts) {
    std::vector<std::size_t> ends;
    const std::size_t n = parts.places().size();
    std::size_t cells = 0;
    for (std::size_t i = 0; i < n; ++i) {
        parts.visit(i, [&](const MeshPart& part) { cells += part.triangles.size() + part.quads.size(); });
        if (cells >= cells_of_full_part) {
            ends.push_back(i + 1);
            cells = 0;
        }
    }
    if (cells > 0) ends.push_back(n);
    return ends;
}

/// The numbers of parts.
struct PartNumbers {
    std::size_t before = 0, all = 0;  ///< of lower ranks, and of all ranks
};

/// Collective: counts the parts.
PartNumbers count_parts(std::size_t own, core::ConnectedRanks& ranks) {
    core::Packer packer;
    packer.put_short(own);
    PartNumbers numbers;
    const std::vector<std::string> told = ranks.all_gather(packer.take());
    for (unsigned rank = 0; rank < told.size(); ++rank) {
        if (rank == ranks.rank()) numbers.before = numbers.all;
        numbers.all += core::Unpacker(told[rank]).get_short();
    }
    return numbers;
}

}  // namespace

void write_shared_pvtu(const mesh::MeshParts& parts, const MeshFrame& frame, core::ConnectedRanks& ranks,
                       const fs::path& file) {
    const std::vector<std::size_t> ends = ends_of_parts(parts);
    const PartNumbers numbers = count_parts(ends.size(), ranks);
    std::vector<fs::path> targets;
    for (std::size_t k = 0; k < ends.size(); ++k) targets.push_back(part_file(file, numbers.before + k));
    const auto write_parts = [&](std::span<const fs::path> temporary) {
        std::size_t i = 0;
        PartCollector collector;
        for (std::size_t k = 0; k < ends.size(); ++k) {
            for (; i < ends[k]; ++i) parts.visit(i, [&](const MeshPart& part) { collector.add(part); });
            const PartMesh part = collector.take(frame.markers);
            core::write_stream(temporary[k], targets[k],
                               [&](std::ostream& out) { write_vtu_part(part.mesh, part.vertices, out); });
        }
        ranks.agree();  // no part gets its name before all are written
    };
    if (targets.empty())
        write_parts({});
    else
        core::write_files_atomically(targets, write_parts);
    ranks.agree();
    if (ranks.rank() == 0) {
        Mesh arrays;
        arrays.region = {Region::layer};
        arrays.piece = {0};
        arrays.layer = {0};
        core::write_stream_atomically(file,
                                      [&](std::ostream& out) { out << list_of_parts(arrays, file, numbers.all); });
    }
    ranks.agree();
}

}  // namespace lamina::io
