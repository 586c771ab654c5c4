#include "io/mesh_layout.hpp"

#include <memory>
#include <utility>

#include "core/atomic_file.hpp"
#include "io/binary_output.hpp"
#include "io/mesh_parts.hpp"
#include "io/section_file.hpp"

namespace lamina::io {

namespace {

class LayoutSink : public MeshSink {
public:
    LayoutSink(std::unique_ptr<MeshLayout> layout, std::filesystem::path file, bool has_internal_markers)
        : layout_(std::move(layout)), file_(std::move(file)), has_internal_markers_(has_internal_markers) {
        for (std::size_t i = 0; i < layout_->sections(); ++i) sections_.push_back(std::make_unique<SectionFile>(file_));
    }

    Bytes format(const MeshPart& part) const override { return layout_->format(part); }
    void append(const Bytes& bytes) override {
        for (std::size_t i = 0; i < sections_.size(); ++i) sections_[i]->append(bytes[i]);
    }
    void finish(const MeshCounts& counts, std::span<const Marker> markers,
                std::span<const Segment> constraints) override {
        counts_ = counts;
        markers_.assign(markers.begin(), markers.end());
        if (!has_internal_markers_) markers_ = markers_of_kind(markers, false);
        layout_->require_names(markers_);
        constraints_.assign(constraints.begin(), constraints.end());
    }
    void commit() override {
        std::vector<std::uint64_t> sizes;
        for (const auto& section : sections_) sizes.push_back(section->size());
        core::write_stream_atomically(file_, [&](std::ostream& out) {
            for (const FileStretch& stretch : layout_->stretches({counts_, markers_, constraints_}, sizes)) {
                out << stretch.text;
                if (stretch.section) sections_[*stretch.section]->move_to(out);
                stretch.write_records(out);
            }
        });
    }
    std::size_t bytes() const override {
        std::size_t sum = 0;
        for (const auto& section : sections_) sum += section->size();
        return sum;
    }

private:
    std::unique_ptr<MeshLayout> layout_;
    std::filesystem::path file_;
    bool has_internal_markers_;
    std::vector<std::unique_ptr<SectionFile>> sections_;
    MeshCounts counts_;
    std::vector<Marker> markers_;
    std::vector<Segment> constraints_;
};

}  // namespace

void FileStretch::write_records(std::ostream& out) const {
    if (count > 0) io::write_records(out, count, record_bytes, fill);
}

std::unique_ptr<MeshSink> open_layout_sink(std::unique_ptr<MeshLayout> layout, const std::filesystem::path& file,
                                           bool has_internal_markers) {
    return std::make_unique<LayoutSink>(std::move(layout), file, has_internal_markers);
}

}  // namespace lamina::io
