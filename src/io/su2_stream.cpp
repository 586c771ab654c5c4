// The SU2 format part by part: the lines of cells and of points are collected in one temporary file each, since the
// numbers of both stand before them.
#include <filesystem>
#include <utility>

#include "core/atomic_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/section_file.hpp"
#include "io/su2_lines.hpp"

namespace lamina::io {

namespace {

class Su2Sink : public MeshSink {
public:
    explicit Su2Sink(std::filesystem::path file) : file_(std::move(file)), cells_(file_), points_(file_) {}

    Bytes format(const MeshPart& part) const override {
        const std::size_t first_quad = part.first_cell + part.triangles.size();
        std::string cells = format_lines(0, part.triangles.size(), [&](LineText& line, std::size_t i) {
            put_su2_cell(line, part.triangles[i], part.first_cell + i);
        });
        cells += format_lines(0, part.quads.size(), [&](LineText& line, std::size_t i) {
            put_su2_cell(line, part.quads[i], first_quad + i);
        });
        return {std::move(cells), format_lines(0, part.points.size(), [&](LineText& line, std::size_t i) {
                    put_su2_point(line, part.points[i], part.first_vertex + i);
                })};
    }
    void append(const Bytes& bytes) override {
        cells_.append(bytes[0]);
        points_.append(bytes[1]);
    }
    void finish(const MeshCounts& counts, std::span<const Marker> markers, std::span<const Segment>) override {
        require_su2_marker_names(markers, file_);
        counts_ = counts;
        markers_.assign(markers.begin(), markers.end());
    }
    void commit() override {
        core::write_stream_atomically(file_, [&](std::ostream& out) {
            out << "NDIME= 2\nNELEM= " << counts_.triangles + counts_.quads << '\n';
            cells_.move_to(out);
            out << "NPOIN= " << counts_.vertices << '\n';
            points_.move_to(out);
            write_su2_markers(markers_, out);
        });
    }
    std::size_t bytes() const override { return cells_.size() + points_.size(); }

private:
    std::filesystem::path file_;
    SectionFile cells_, points_;
    MeshCounts counts_;
    std::vector<Marker> markers_;
};

}  // namespace

std::unique_ptr<MeshSink> open_su2_sink(const std::filesystem::path& file) { return std::make_unique<Su2Sink>(file); }

}  // namespace lamina::io
