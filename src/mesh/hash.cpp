// The hash of a mesh. Other programs can compute it by this recipe:
//  - A cell contributes the coordinates x, y, x, y ... of its vertices as a string of bytes: 8 bytes each, IEEE 754
//    binary64, little-endian, with -0 written as +0, in counter-clockwise order from the lexicographically smallest
//    vertex (by x, then by y).
//  - A marker edge contributes x, y of its first and its last vertex in the same way, in the direction of the edge, and
//    then the bytes of the marker's name (UTF-8).
//  - MurmurHash3_x64_128 with seed 0 turns each string of bytes into two numbers h1 and h2.
//  - The hash of the mesh is the sum of h1 2^64 + h2 over all strings, modulo 2^128, printed as 32 hexadecimal digits.
// Source: A. Appleby, MurmurHash3 (2011), public domain; the 128-bit variant for 64-bit machines.
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <span>

#include <lamina/mesh.hpp>

#include "core/parallel.hpp"
#include "mesh/hash.hpp"

namespace lamina::mesh {

namespace {

__extension__ using HashSum = unsigned __int128;

std::uint64_t finalize(std::uint64_t k) {
    k = (k ^ (k >> 33)) * 0xff51afd7ed558ccdU;
    k = (k ^ (k >> 33)) * 0xc4ceb9fe1a85ec53U;
    return k ^ (k >> 33);
}

/// Returns MurmurHash3_x64_128 with seed 0 of `length` bytes. They are given as little-endian words and padded with
/// zeros to a multiple of 16 bytes.
HashSum murmur3(std::span<const std::uint64_t> words, std::size_t length) {
    constexpr std::uint64_t c1 = 0x87c37b91114253d5U, c2 = 0x4cf5ad432745937fU;
    const auto mix1 = [&](std::uint64_t k) { return std::rotl(k * c1, 31) * c2; };
    const auto mix2 = [&](std::uint64_t k) { return std::rotl(k * c2, 33) * c1; };
    std::uint64_t h1 = 0, h2 = 0;
    const std::size_t blocks = length / 16;
    for (std::size_t i = 0; i < blocks; ++i) {
        h1 = (std::rotl(h1 ^ mix1(words[2 * i]), 27) + h2) * 5 + 0x52dce729;
        h2 = (std::rotl(h2 ^ mix2(words[2 * i + 1]), 31) + h1) * 5 + 0x38495ab5;
    }
    if (length % 16 != 0) {  // the padding has no effect, since zero is mixed to zero
        h1 ^= mix1(words[2 * blocks]);
        h2 ^= mix2(words[2 * blocks + 1]);
    }
    h1 ^= length;
    h2 ^= length;
    h1 += h2;
    h2 += h1;
    h1 = finalize(h1);
    h2 = finalize(h2);
    h1 += h2;
    h2 += h1;
    return HashSum{h1} << 64 | h2;
}

std::uint64_t bits(double c) { return std::bit_cast<std::uint64_t>(c + 0.0); }  // -0 + 0 is +0

/// Hashes the vertices of a cell, starting with the lexicographically smallest one.
template <std::size_t corners>
HashSum hash_cell(std::span<const Point> points, const VertexId (&v)[corners]) {
    Point p[corners];
    std::size_t smallest = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        p[i] = points[v[i].index()];
        if (lexicographically_less(p[i], p[smallest])) smallest = i;
    }
    std::uint64_t words[2 * corners];
    for (std::size_t i = 0; i < corners; ++i) {
        const Point q = p[(smallest + i) % corners];
        words[2 * i] = bits(q.x);
        words[2 * i + 1] = bits(q.y);
    }
    return murmur3(words, sizeof words);
}

HashSum hash_marker(std::span<const Point> points, const Marker& marker) {
    std::vector<std::uint64_t> words(4 + 2 * ((marker.name.size() + 15) / 16), 0);
    static_assert(std::endian::native == std::endian::little,
                  "the bytes of the name are copied into the words as they lie in memory");
    std::memcpy(words.data() + 4, marker.name.data(), marker.name.size());
    HashSum sum = 0;
    for (const Segment& edge : marker.edges) {
        const Point a = points[edge.a.index()], b = points[edge.b.index()];
        words[0] = bits(a.x);
        words[1] = bits(a.y);
        words[2] = bits(b.x);
        words[3] = bits(b.y);
        sum += murmur3(words, 32 + marker.name.size());
    }
    return sum;
}

template <class Cell>
HashSum hash_cells(std::span<const Point> points, std::span<const Cell> cells) {
    HashSum sum = 0;
    for (const Cell& cell : cells) sum += hash_cell(points, cell.v);
    return sum;
}

std::uint64_t high_word(HashSum sum) { return static_cast<std::uint64_t>(sum >> 64); }

}  // namespace

void HashOfParts::add(std::span<const Point> points, std::span<const Triangle> triangles) {
    const HashSum sum = hash_cells(points, triangles);
    add(high_word(sum), static_cast<std::uint64_t>(sum));
}

void HashOfParts::add(std::span<const Point> points, std::span<const Quad> quads) {
    const HashSum sum = hash_cells(points, quads);
    add(high_word(sum), static_cast<std::uint64_t>(sum));
}

void HashOfParts::add(std::span<const Point> points, std::span<const Marker> markers) {
    for (const Marker& marker : markers) {
        const HashSum sum = hash_marker(points, marker);
        add(high_word(sum), static_cast<std::uint64_t>(sum));
    }
}

std::string HashOfParts::text() const { return fmt::format("{:016x}{:016x}", high_, low_); }

}  // namespace lamina::mesh

namespace lamina {

namespace {

template <class Cell>
void add_in_parallel(std::span<const Point> points, std::span<const Cell> cells, mesh::HashOfParts& hash) {
    const auto hash_block = [&](std::size_t begin, std::size_t end) {
        mesh::HashOfParts part;
        part.add(points, cells.subspan(begin, end - begin));
        return part;
    };
    for (const mesh::HashOfParts& part : core::parallel_blocks(cells.size(), std::size_t{1} << 14, hash_block))
        hash.add(part);
}

}  // namespace

std::string mesh_hash(const MeshView& mesh) {
    mesh::HashOfParts hash;
    add_in_parallel<Triangle>(mesh.points, mesh.triangles, hash);
    add_in_parallel<Quad>(mesh.points, mesh.quads, hash);
    hash.add(mesh.points, mesh.markers);
    return hash.text();
}

}  // namespace lamina
