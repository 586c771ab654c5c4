// The bytes of a mesh are a sequence of arrays of whole numbers, in the order of share/page/decode.js. An array is
// stored as its length (4 bytes), the number of bytes of a number (1 byte), and then all lowest bytes, all second
// bytes, and so on: high bytes are alike and vanish in compression. All is little-endian. Numbers with a sign are
// stored as 0, -1, 1, -2, ... -> 0, 1, 2, 3, ...
#include "page/packed_mesh.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <lamina/error.hpp>

#include "page/growth.hpp"
#include "page/steps.hpp"
#include "page/traversal.hpp"

namespace lamina::page {

namespace {

constexpr std::uint32_t format_version = 1;

std::uint64_t without_sign(std::int64_t number) {
    const auto bits = static_cast<std::uint64_t>(number);
    return number < 0 ? ~(bits << 1) : bits << 1;
}

class ByteArrays {
public:
    /// Adds an array of numbers without signs.
    template <class Number>
    void add(const std::vector<Number>& numbers) {
        const Number largest = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
        std::uint8_t planes = 1;
        while (planes < sizeof(Number) && static_cast<std::uint64_t>(largest) >> (8 * planes) != 0) ++planes;
        for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<char>(numbers.size() >> (8 * k)));
        bytes.push_back(static_cast<char>(planes));
        for (int k = 0; k < planes; ++k)
            for (const Number number : numbers)
                bytes.push_back(static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * k)));
    }
    void add(const std::string& text) { add(std::vector<std::uint8_t>(text.begin(), text.end())); }

    std::string bytes;
};

void add_points(ByteArrays& arrays, const Mesh& mesh, const Traversal& order) {
    const std::vector<std::int16_t> exponent_of = step_exponents(mesh);
    const std::size_t count = order.vertex.size();
    std::vector<std::uint32_t> exponents(count), numbers(count);
    std::vector<std::uint64_t> residuals[2];
    std::vector<Point> stored(count);  // as the reader will see them
    for (std::size_t i = 0; i < count; ++i) {
        const auto [a, b, o] = order.prediction[i];
        const bool first = a == no_vertex;
        const std::uint32_t v = order.vertex[i];
        const int exponent = exponent_of[v];
        exponents[i] = static_cast<std::uint32_t>(without_sign(exponent - (first ? 0 : exponent_of[order.vertex[a]])));
        numbers[i] = static_cast<std::uint32_t>(without_sign(std::int64_t{v} - (first ? 0 : order.vertex[b])));
        const Point guess = first ? Point{} : stored[a] + stored[b] - stored[o];
        const auto place = [&](double x, double guessed, int axis) {
            const double steps = steps_in(x, exponent);
            residuals[axis].push_back(without_sign(static_cast<std::int64_t>(steps - steps_in(guessed, exponent))));
            return std::ldexp(steps, exponent);
        };
        stored[i] = {place(mesh.points[v].x, guess.x, 0), place(mesh.points[v].y, guess.y, 1)};
    }
    arrays.add(exponents);
    arrays.add(numbers);
    for (const auto& axis : residuals) arrays.add(axis);
}

/// Adds a number per cell as its difference to that of the cell that it was found from.
template <class Value>
void add_cell_data(ByteArrays& arrays, const Traversal& order, Value value) {
    std::vector<std::uint32_t> differences(order.cell.size());
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const std::int64_t before = order.parent[i] == no_vertex ? 0 : value(order.cell[order.parent[i]]);
        differences[i] = static_cast<std::uint32_t>(without_sign(std::int64_t{value(order.cell[i])} - before));
    }
    arrays.add(differences);
}

template <class Number>
void add_optional(ByteArrays& arrays, const Traversal& order, const std::vector<Number>& values) {
    if (values.size() < order.cell.size()) return arrays.add(std::vector<std::uint8_t>{});
    add_cell_data(arrays, order, [&](std::size_t cell) { return static_cast<std::int64_t>(values[cell]); });
}

void add_markers(ByteArrays& arrays, const Mesh& mesh) {
    std::string names;
    std::vector<std::uint8_t> kinds;
    std::vector<std::uint32_t> sizes, ends;
    for (const Marker& marker : mesh.markers) {
        names += marker.name + '\0';
        kinds.push_back(static_cast<std::uint8_t>(marker.kind));
        sizes.push_back(static_cast<std::uint32_t>(marker.edges.size()));
        std::int64_t last = 0;
        for (const Segment edge : marker.edges)
            for (const VertexId end : {edge.a, edge.b}) {
                ends.push_back(static_cast<std::uint32_t>(without_sign(std::int64_t{end.value} - last)));
                last = end.value;
            }
    }
    arrays.add(names);
    arrays.add(kinds);
    arrays.add(sizes);
    arrays.add(ends);
}

/// Adds the vertices of the walls, the number of them on each, and the first heights over them, as bits of floats.
void add_walls(ByteArrays& arrays, const Mesh& mesh) {
    const WallVertices walls = wall_vertices(mesh);
    std::vector<std::uint32_t> vertices, sizes, heights;
    std::int64_t last = 0;
    for (std::size_t i = 0; i < walls.vertex.size(); ++i) {
        vertices.push_back(static_cast<std::uint32_t>(without_sign(std::int64_t{walls.vertex[i].value} - last)));
        last = walls.vertex[i].value;
        const auto height = static_cast<float>(walls.first_height[i]);
        std::uint32_t bits = 0;
        std::memcpy(&bits, &height, sizeof bits);
        heights.push_back(bits);
    }
    for (std::size_t body = 0; body + 1 < walls.body_first.size(); ++body)
        sizes.push_back(static_cast<std::uint32_t>(walls.body_first[body + 1] - walls.body_first[body]));
    arrays.add(vertices);
    arrays.add(sizes);
    arrays.add(heights);
}

std::string compressed(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
        throw MeshError("a mesh cannot be compressed for want of memory");
    packed.resize(size);
    return packed;
}

}  // namespace

std::string pack_mesh(const Mesh& mesh) {
    const Traversal order = traverse(mesh);
    ByteArrays arrays;
    arrays.add(std::vector<std::uint32_t>{format_version, static_cast<std::uint32_t>(mesh.points.size()),
                                          static_cast<std::uint32_t>(mesh.triangles.size()),
                                          static_cast<std::uint32_t>(mesh.quads.size())});
    arrays.add(order.symbols);
    arrays.add(order.references);
    add_points(arrays, mesh, order);
    add_cell_data(arrays, order, [](std::size_t cell) { return static_cast<std::int64_t>(cell); });
    add_optional(arrays, order, mesh.region);
    add_optional(arrays, order, mesh.piece);
    add_optional(arrays, order, mesh.layer);
    add_markers(arrays, mesh);
    add_walls(arrays, mesh);
    arrays.add(growth_histogram(mesh));
    return compressed(arrays.bytes);
}

}  // namespace lamina::page
