// One file from several processes: sizes are gathered, offsets follow from the order of all parts, and each process
// writes its parts where they belong.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/threads.hpp>

#include "core/atomic_file.hpp"
#include "core/connected_ranks.hpp"
#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "io/formats.hpp"
#include "io/mesh_layout.hpp"
#include "io/section_file.hpp"
#include "mesh/shared_parts.hpp"

namespace lamina::io {

namespace {

using core::Packer;
using core::Unpacker;

/// Number of parts that each thread formats before they are written.
constexpr std::size_t parts_at_once = 4;
/// Bytes of records that a process writes at once.
constexpr std::size_t record_bytes_at_once = std::size_t{16} << 20;

/// Where the parts of this process begin in the sections, and what all processes do together.
struct Arrangement {
    std::vector<std::uint64_t> offsets;        ///< per part and section
    std::vector<std::uint64_t> section_sizes;  ///< of the whole file
    std::size_t rounds = 0;                    ///< the largest number of batches of parts that a process writes
};

void put_numbers(const std::vector<std::uint64_t>& numbers, Packer& packer) {
    packer.put_short(numbers.size());
    for (const std::uint64_t number : numbers) packer.put_short(number);
}

std::vector<std::uint64_t> get_numbers(Unpacker& unpacker) {
    std::vector<std::uint64_t> numbers(unpacker.get_short());
    for (std::uint64_t& number : numbers) number = unpacker.get_short();
    return numbers;
}

std::size_t batch_size() { return parts_at_once * thread_count(); }

/// Collective: returns where the parts belong.
Arrangement arrange(const mesh::MeshParts& parts, const MeshLayout& layout, core::ConnectedRanks& ranks) {
    const std::size_t sections = layout.sections();
    const std::vector<std::uint64_t> places = parts.places();
    std::vector<std::uint64_t> sizes(places.size() * sections);
    core::parallel_for(places.size(), 1, [&](std::size_t i, std::size_t) {
        const auto take = [&](const std::vector<std::size_t>& of_part) {
            std::copy(of_part.begin(), of_part.end(), sizes.begin() + static_cast<std::ptrdiff_t>(i * sections));
        };
        if (const auto of_part = layout.sizes(parts.counts(i)))
            take(*of_part);
        else
            parts.visit(i, [&](const MeshPart& part) { take(layout.sizes(part)); });
    });
    Packer packer;
    packer.put<std::uint64_t>((places.size() + batch_size() - 1) / batch_size());
    put_numbers(places, packer);
    put_numbers(sizes, packer);
    const std::vector<std::string> of_ranks = ranks.gather(packer.take());

    struct Part {
        std::uint64_t place;
        std::size_t rank, i;
    };
    std::vector<Part> all;
    std::vector<std::vector<std::uint64_t>> bytes;  // per rank: sizes at first, then offsets
    std::uint64_t rounds = 0;
    for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
        Unpacker unpacker(of_ranks[rank]);
        rounds = std::max(rounds, unpacker.get<std::uint64_t>());
        const std::vector<std::uint64_t> of_rank = get_numbers(unpacker);
        for (std::size_t i = 0; i < of_rank.size(); ++i) all.push_back({of_rank[i], rank, i});
        bytes.push_back(get_numbers(unpacker));
    }
    std::sort(all.begin(), all.end(), [](const Part& a, const Part& b) { return a.place < b.place; });
    std::vector<std::uint64_t> next(sections, 0);
    for (const Part& part : all)
        for (std::size_t k = 0; k < sections; ++k) {
            std::uint64_t& at = bytes[part.rank][part.i * sections + k];
            next[k] += std::exchange(at, next[k]);
        }
    std::vector<std::string> answers;
    for (const auto& offsets : bytes) {
        Packer answer;
        answer.put(rounds);
        put_numbers(next, answer);
        put_numbers(offsets, answer);
        answers.push_back(answer.take());
    }
    const std::string answer = ranks.scatter(answers);
    Unpacker unpacker(answer);
    Arrangement arrangement;
    arrangement.rounds = unpacker.get<std::uint64_t>();
    arrangement.section_sizes = get_numbers(unpacker);
    arrangement.offsets = get_numbers(unpacker);
    return arrangement;
}

/// The blocks that a process writes in one round, with their bytes.
class Blocks {
public:
    void add(std::uint64_t offset, std::string bytes) {
        if (!bytes.empty()) blocks_.push_back({offset, std::move(bytes)});
    }
    void write(core::SharedFile& file) {
        std::sort(blocks_.begin(), blocks_.end(), [](const Owned& a, const Owned& b) { return a.offset < b.offset; });
        std::vector<core::SharedFile::Block> views;
        for (const Owned& block : blocks_) views.push_back({block.offset, block.bytes});
        file.write(views);
        blocks_.clear();
    }

private:
    struct Owned {
        std::uint64_t offset;
        std::string bytes;
    };
    std::vector<Owned> blocks_;
};

/// Writes all of a file that this process has to write, in the same rounds as all others.
class SharedWriter {
public:
    SharedWriter(const mesh::MeshParts& parts, const MeshLayout& layout, const MeshFrame& frame,
                 core::ConnectedRanks& ranks, const Arrangement& arrangement)
        : parts_(parts),
          layout_(layout),
          ranks_(ranks),
          arrangement_(arrangement),
          stretches_(layout.stretches(frame, arrangement.section_sizes)),
          first_of_section_(layout.sections()) {
        std::uint64_t at = 0;
        for (const FileStretch& stretch : stretches_) {
            first_of_stretch_.push_back(at);
            at += stretch.text.size();
            if (stretch.section) {
                first_of_section_[*stretch.section] = at;
                at += arrangement.section_sizes[*stretch.section];
            }
            at += stretch.count * stretch.record_bytes;
        }
        size_ = at;
    }

    /// Returns the size of the file.
    std::uint64_t size() const { return size_; }

    void write(core::SharedFile& file) const {
        Blocks blocks;
        if (ranks_.rank() == 0)
            for (std::size_t i = 0; i < stretches_.size(); ++i) blocks.add(first_of_stretch_[i], stretches_[i].text);
        blocks.write(file);
        const std::size_t parts = parts_.places().size(), batch = batch_size();
        for (std::size_t round = 0; round < arrangement_.rounds; ++round) {
            const std::size_t begin = std::min(parts, round * batch), end = std::min(parts, begin + batch);
            std::vector<MeshSink::Bytes> bytes = format(begin, end);
            for (std::size_t i = begin; i < end; ++i)
                for (std::size_t k = 0; k < first_of_section_.size(); ++k)
                    blocks.add(first_of_section_[k] + arrangement_.offsets[i * first_of_section_.size() + k],
                               std::move(bytes[i - begin][k]));
            blocks.write(file);
        }
        for (std::size_t i = 0; i < stretches_.size(); ++i) write_records(i, blocks, file);
    }

private:
    const mesh::MeshParts& parts_;
    const MeshLayout& layout_;
    core::ConnectedRanks& ranks_;
    const Arrangement& arrangement_;
    std::vector<FileStretch> stretches_;
    std::vector<std::uint64_t> first_of_stretch_, first_of_section_;
    std::uint64_t size_ = 0;

    std::vector<MeshSink::Bytes> format(std::size_t begin, std::size_t end) const {
        std::vector<MeshSink::Bytes> bytes(end - begin);
        core::parallel_for(end - begin, 1, [&](std::size_t i, std::size_t) {
            parts_.visit(begin + i, [&](const MeshPart& part) { bytes[i] = layout_.format(part); });
        });
        return bytes;
    }

    /// Each process makes an equal share of the records.
    void write_records(std::size_t stretch_number, Blocks& blocks, core::SharedFile& file) const {
        const FileStretch& stretch = stretches_[stretch_number];
        if (stretch.count == 0) return;
        const std::uint64_t first = first_of_stretch_[stretch_number] + stretch.text.size();
        const std::size_t at_once = record_bytes_at_once / stretch.record_bytes;
        const std::size_t share = (stretch.count + ranks_.size() - 1) / ranks_.size();
        const std::size_t share_begin = std::min(stretch.count, ranks_.rank() * share);
        const std::size_t share_end = std::min(stretch.count, share_begin + share);
        for (std::size_t done = 0; done < share; done += at_once) {
            const std::size_t begin = std::min(share_end, share_begin + done);
            const std::size_t end = std::min(share_end, begin + at_once);
            std::string bytes((end - begin) * stretch.record_bytes, '\0');
            for (std::size_t i = begin; i < end; ++i)
                stretch.fill(bytes.data() + (i - begin) * stretch.record_bytes, i);
            blocks.add(first + begin * stretch.record_bytes, std::move(bytes));
            blocks.write(file);
        }
    }
};

/// Takes bytes and forgets them.
class NoFile : public core::SharedFile {
public:
    void write(const std::vector<Block>&) override {}
    std::string close() override { return {}; }
};

}  // namespace

}  // namespace lamina::io

namespace lamina {

using namespace io;

void write_shared_mesh(const mesh::MeshParts& parts, const MeshFrame& frame, Ranks& all,
                       const std::filesystem::path& file, const WriteOptions& options) {
    core::ConnectedRanks& ranks = core::connected(all);
    require_shareable(file, options);
    const bool keeps = !is_null_device(file);
    const auto write_parts = find_format(file, options.format).write_shared;
    if (is_standard_stream(file) || ((keeps || write_parts != nullptr) && core::is_device(file)))
        throw UsageError("several processes write a file together: '" + file.string() + "' is none");
    check_writable(file, options);
    if (write_parts != nullptr) return write_parts(parts, frame, ranks, file);
    const std::unique_ptr<MeshLayout> layout = find_format(file, options.format).layout(file);
    layout->require_names(frame.markers);
    const Arrangement arrangement = arrange(parts, *layout, ranks);
    const SharedWriter writer(parts, *layout, frame, ranks, arrangement);
    if (!keeps) {
        NoFile no_file;
        return writer.write(no_file);
    }
    const auto write = [&](const std::filesystem::path& temporary) {
        const std::unique_ptr<core::SharedFile> shared = ranks.open_file(temporary, file);
        writer.write(*shared);
        if (const std::string failure = shared->close(); !failure.empty()) throw IoError(file.string(), failure);
        ranks.agree();
    };
    // The file gets its name on rank 0, when all have written. Not every MPI reports a full disk, so there is room
    // before.
    if (ranks.rank() == 0) {
        core::write_atomically(file, [&](const std::filesystem::path& temporary) {
            core::reserve_room(temporary, file, writer.size());
            write(ranks.broadcast(temporary.string()));
        });
    } else {
        write(ranks.broadcast({}));
    }
    ranks.agree();
}

}  // namespace lamina
