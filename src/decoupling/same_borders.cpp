// Processes compare hashes of what they have cut.
#include <bit>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/packing.hpp"
#include "decoupling/cut_region.hpp"

namespace lamina::decoupling {

namespace {

/// A hash of numbers in their order: FNV-1a with words in place of bytes (http://www.isthe.com/chongo/tech/comp/fnv/).
class WordHash {
public:
    void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3u; }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(Point p) {
        add(p.x);
        add(p.y);
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

void require_same(const WordHash& hash, Ranks& ranks) {
    core::Packer packer;
    packer.put(hash.value());
    const std::vector<std::string> hashes = ranks.gather(packer.take());
    for (std::size_t rank = 0; rank < hashes.size(); ++rank)
        if (hashes[rank] != hashes.front())
            throw MeshError(
                fmt::format("process {} has cut the domain in another way than process 0: all must run the same "
                            "program on the same input",
                            rank));
}

}  // namespace

void require_same_skeleton(const Skeleton& skeleton, Ranks& ranks) {
    WordHash hash;
    for (const Point p : skeleton.points) hash.add(p);
    for (const Segment& edge : skeleton.edges) hash.add(std::uint64_t{edge.a.value} << 32 | edge.b.value);
    require_same(hash, ranks);
}

void require_same_borders(std::span<const Point> points, std::span<const EstimatedBorder> borders, Ranks& ranks) {
    WordHash hash;
    for (const Point p : points) hash.add(p);
    for (const EstimatedBorder& estimated : borders) {
        hash.add(estimated.estimate.triangles);
        for (const auto& loop : estimated.border.loops) {
            hash.add(std::uint64_t{loop.size()});
            for (const VertexId v : loop) hash.add(std::uint64_t{v.value});
        }
    }
    require_same(hash, ranks);
}

}  // namespace lamina::decoupling
