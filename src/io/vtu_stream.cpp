// VTU files part by part: each array whose values the parts know is collected in a temporary file. The others follow from
// the numbers of cells. vtu_write.cpp describes the format.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "io/formats.hpp"
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

class VtuSink : public MeshSink {
public:
    explicit VtuSink(std::filesystem::path file)
        : file_(std::move(file)),
          points_(file_),
          region_(file_),
          piece_(file_),
          layer_(file_),
          quality_(file_),
          connectivity_(file_) {}

    Bytes format(const MeshPart& part) const override {
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
    void append(const Bytes& bytes) override {
        SectionFile* const sections[] = {&points_, &region_, &piece_, &layer_, &quality_, &connectivity_};
        for (std::size_t i = 0; i < std::size(sections); ++i) sections[i]->append(bytes[i]);
    }
    /// Appends the edges of the markers, which are cells of the file, too.
    void finish(const MeshCounts& counts, std::span<const Marker> markers,
                std::span<const Segment> constraints) override {
        counts_ = counts;
        markers_.assign(markers.begin(), markers.end());
        constraints_.assign(constraints.begin(), constraints.end());
        ArrayBytes region(0), piece(0), layer(0), quality(0), connectivity(0);
        for (std::size_t m = 0; m < markers.size(); ++m)
            for (const Segment& edge : markers[m].edges) {
                marker_of_line_.push_back(static_cast<std::uint32_t>(m + 1));
                region.add(std::uint8_t{2});
                piece.add(std::uint32_t{0});
                layer.add(std::uint16_t{0});
                quality.add(0.0f);
                for (const VertexId v : {edge.a, edge.b}) connectivity.add(std::int64_t{v.value});
            }
        append({"", region.take(), piece.take(), layer.take(), quality.take(), connectivity.take()});
    }
    void commit() override {
        core::write_stream_atomically(file_, [&](std::ostream& out) { write(out); });
    }
    std::size_t bytes() const override {
        std::size_t sum = 0;
        for (const SectionFile* section : {&points_, &region_, &piece_, &layer_, &quality_, &connectivity_})
            sum += section->size();
        return sum;
    }

private:
    std::filesystem::path file_;
    SectionFile points_, region_, piece_, layer_, quality_, connectivity_;
    MeshCounts counts_;
    std::vector<Marker> markers_;
    std::vector<Segment> constraints_;
    std::vector<std::uint32_t> marker_of_line_;  ///< of each edge of a marker, from 1

    void write(std::ostream& out) {
        const std::size_t triangles = counts_.triangles, inner = triangles + counts_.quads;
        const std::size_t cells = inner + marker_of_line_.size();
        VtuWriter vtu(false);
        vtu.xml = vtu_head(false);
        add_vtu_field_data(markers_, constraints_, {}, vtu);
        vtu.xml += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", counts_.vertices, cells);
        vtu.xml += "      <CellData>\n";
        vtu.add_section<std::uint8_t>("region", 1, region_);
        vtu.add_section<std::uint32_t>("piece", 1, piece_);
        vtu.add_section<std::uint16_t>("layer", 1, layer_);
        vtu.add_array<std::uint32_t>(
            "marker", cells, 1, [this, inner](std::size_t i) { return i < inner ? 0 : marker_of_line_[i - inner]; });
        vtu.add_section<float>("quality", 1, quality_);
        vtu.xml += "      </CellData>\n      <Points>\n";
        vtu.add_section<double>("Points", 3, points_);
        vtu.xml += "      </Points>\n      <Cells>\n";
        vtu.add_section<std::int64_t>("connectivity", 1, connectivity_);
        vtu.add_array<std::int64_t>("offsets", cells, 1,
                                    [=](std::size_t i) { return vtu_offset(i, triangles, inner); });
        vtu.add_array<std::uint8_t>("types", cells, 1, [=](std::size_t i) { return vtu_type(i, triangles, inner); });
        vtu.xml += "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n";
        vtu.write(out);
    }
};

}  // namespace

std::unique_ptr<MeshSink> open_vtu_sink(const std::filesystem::path& file) { return std::make_unique<VtuSink>(file); }

}  // namespace lamina::io
