// The passes of the remesher. Each goes once through the mesh, in the order of its numbers.
//
// Lengths are those of MetricMesh::edge_length(). A mesh is in order where edges are from 1 / sqrt(2) to sqrt(2) long,
// so that neither dividing one nor contracting one brings its length nearer to 1 (P. J. Frey, F. Alauzet, Comput.
// Methods Appl. Mech. Engrg. 194 (2005)).
#pragma once

#include <cstddef>
#include <vector>

#include "remeshing/background.hpp"
#include "remeshing/metric_mesh.hpp"

namespace lamina::remeshing {

inline constexpr double longest_in_order = 1.41421356237309505, shortest_in_order = 0.70710678118654752;

class Passes {
public:
    Passes(MetricMesh& mesh, const BackgroundMetric& background) : mesh_(mesh), background_(background) {}

    /// Divides edges longer than this, the longest of each triangle first, and swaps diagonals round the new vertices.
    void divide_longer(double length);
    /// Contracts edges shorter than 1 / sqrt(2) where no edge becomes longer than sqrt(2). Returns the number of
    /// vertices removed.
    std::size_t contract_short();
    /// Swaps diagonals where this lowers the sum of distortions.
    void swap_diagonals();
    /// Moves vertices towards where their triangles are equilateral with edges of length 1, where this lowers the sum
    /// of distortions.
    void move_vertices();
    /// Returns the length of the longest edge that may be divided.
    double longest_edge() const;

private:
    struct LongEdge {
        unsigned edge = 0;
        double length = 0;
    };
    LongEdge longest_edge_of(const MeshTriangle& triangle, double least) const;
    std::uint32_t divide(EdgeHandle h);
    void swap_round(std::uint32_t v);
    bool swap_if_better(EdgeHandle h);
    bool contract(std::uint32_t v, std::uint32_t onto);
    void swap_an_edge_of(std::uint32_t t);
    struct Target {
        Point place;              ///< the mean of the places where a triangle of the ring would be the one asked for
        float distortion_before;  ///< the sum of those of the ring
    };
    Target find_target(std::uint32_t v) const;
    void move(std::uint32_t v);

    MetricMesh& mesh_;
    const BackgroundMetric& background_;
    Ring ring_;
    std::vector<float> distortions_;
    std::vector<EdgeHandle> stack_;
};

}  // namespace lamina::remeshing
