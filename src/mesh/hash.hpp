// The hash of a mesh, summed over its parts.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

namespace lamina::mesh {

/// The sum of the hashes of parts of a mesh, modulo 2^128. It depends on the order of parts no more than on that of
/// cells.
class LAMINA_EXPORT HashOfParts {
public:
    void add(std::span<const Point> points, std::span<const Triangle> triangles);
    void add(std::span<const Point> points, std::span<const Quad> quads);
    void add(std::span<const Point> points, std::span<const Marker> markers);
    void add(const HashOfParts& other) { add(other.high_, other.low_); }
    /// Returns the hash as mesh_hash() does.
    std::string text() const;

private:
    std::uint64_t high_ = 0, low_ = 0;

    void add(std::uint64_t high, std::uint64_t low) {
        low_ += low;
        high_ += high + (low_ < low);
    }
};

}  // namespace lamina::mesh
