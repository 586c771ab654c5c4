// VTU files part by part: each array whose values the parts know is a section. The others follow from the numbers of
// cells. vtu_write.cpp describes the format.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/formats.hpp"
#include "io/mesh_layout.hpp"
#include "io/vtk_cell_types.hpp"
#include "io/vtu_writer.hpp"
#include "mesh/quality.hpp"

namespace lamina::io {

namespace {

/// The bytes of an array in the making.
class ArrayBytes {
public:
    explicit ArrayBytes(std::size_t bytes) { bytes_.reserve(bytes); }

    template <class T>
    void add(T value) {
        char stored[sizeof value];
        store(stored, value);
        bytes_.append(stored, sizeof value);
    }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// The sections of the file.
enum VtuSection : std::size_t {
    points_section,
    region_section,
    piece_section,
    layer_section,
    quality_section,
    connectivity_section,
    vtu_sections
};

class VtuLayout : public MeshLayout {
public:
    std::size_t sections() const override { return vtu_sections; }
    std::vector<std::size_t> sizes(const MeshPart& part) const override {
        return *sizes(mesh::PartCounts{part.points.size(), part.triangles.size(), part.quads.size()});
    }
    std::optional<std::vector<std::size_t>> sizes(const mesh::PartCounts& part) const override {
        const std::size_t cells = part.triangles + part.quads;
        return std::vector<std::size_t>{24 * part.points, cells,     4 * cells,
                                        2 * cells,        4 * cells, 24 * part.triangles + 32 * part.quads};
    }
    MeshSink::Bytes format(const MeshPart& part) const override {
        const std::size_t cells = part.triangles.size() + part.quads.size();
        ArrayBytes points(24 * part.points.size());
        for (const Point p : part.points) {
            points.add(p.x);
            points.add(p.y);
            points.add(0.0);
        }
        ArrayBytes region(cells), piece(4 * cells), layer(2 * cells), quality(4 * cells), connectivity(24 * cells);
        const auto at = [&](VertexId v) {
            return v.index() < part.shared.size() ? part.shared[v.index()] : part.points[v.index() - part.first_vertex];
        };
        const auto add_cell = [&](const VertexId* v, std::size_t corners, std::size_t i) {
            region.add(static_cast<std::uint8_t>(part.region));
            piece.add(part.piece);
            layer.add(part.layers.empty() ? std::uint16_t{0} : part.layers[i]);
            quality.add(static_cast<float>(corners == 3 ? mesh::shape_of_triangle(at(v[0]), at(v[1]), at(v[2]))
                                                        : mesh::shape_of_quad(at(v[0]), at(v[1]), at(v[2]), at(v[3]))));
            for (std::size_t k = 0; k < corners; ++k) connectivity.add(std::int64_t{v[k].value});
        };
        for (std::size_t i = 0; i < part.triangles.size(); ++i) add_cell(part.triangles[i].v, 3, i);
        for (std::size_t i = 0; i < part.quads.size(); ++i) add_cell(part.quads[i].v, 4, part.triangles.size() + i);
        return {points.take(), region.take(), piece.take(), layer.take(), quality.take(), connectivity.take()};
    }
    void require_names(std::span<const Marker>) const override {}
    /// The edges of the markers are cells of the file, too.
    std::vector<FileStretch> stretches(const MeshFrame& frame, std::span<const std::uint64_t> sizes) const override {
        std::vector<std::uint32_t> marker_of_line;
        ArrayBytes region(0), piece(0), layer(0), quality(0), connectivity(0);
        for (std::size_t m = 0; m < frame.markers.size(); ++m)
            for (const Segment& edge : frame.markers[m].edges) {
                marker_of_line.push_back(static_cast<std::uint32_t>(m + 1));
                region.add(std::uint8_t{2});
                piece.add(std::uint32_t{0});
                layer.add(std::uint16_t{0});
                quality.add(0.0f);
                for (const VertexId v : {edge.a, edge.b}) connectivity.add(std::int64_t{v.value});
            }
        const std::size_t triangles = frame.counts.triangles, inner = triangles + frame.counts.quads;
        const std::size_t cells = inner + marker_of_line.size();
        VtuWriter vtu(false);
        vtu.xml = vtu_head(false);
        add_vtu_field_data(frame.markers, frame.constraints, nullptr, vtu);
        vtu.xml +=
            fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", frame.counts.vertices, cells);
        vtu.xml += "      <CellData>\n";
        vtu.add_section<std::uint8_t>("region", 1, region_section, sizes[region_section], region.take());
        vtu.add_section<std::uint32_t>("piece", 1, piece_section, sizes[piece_section], piece.take());
        vtu.add_section<std::uint16_t>("layer", 1, layer_section, sizes[layer_section], layer.take());
        vtu.add_array<std::uint32_t>("marker", cells, 1, [marker_of_line, inner](std::size_t i) {
            return i < inner ? 0 : marker_of_line[i - inner];
        });
        vtu.add_section<float>("quality", 1, quality_section, sizes[quality_section], quality.take());
        vtu.xml += "      </CellData>\n      <Points>\n";
        vtu.add_section<double>("Points", 3, points_section, sizes[points_section], {});
        vtu.xml += "      </Points>\n      <Cells>\n";
        vtu.add_section<std::int64_t>("connectivity", 1, connectivity_section, sizes[connectivity_section],
                                      connectivity.take());
        vtu.add_array<std::int64_t>("offsets", cells, 1,
                                    [=](std::size_t i) { return vtu_offset(i, triangles, inner); });
        vtu.add_array<std::uint8_t>("types", cells, 1, [=](std::size_t i) { return vtu_type(i, triangles, inner); });
        vtu.xml += "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n";
        return vtu.take();
    }
};

}  // namespace

std::unique_ptr<MeshLayout> vtu_layout(const std::filesystem::path&) { return std::make_unique<VtuLayout>(); }

}  // namespace lamina::io
