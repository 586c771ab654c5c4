// Metrics: lengths and directions of edges that a mesh is to have, as tensors at vertices, and the files that hold
// them.
//
// Guarantees:
//  1. read_metric() reads back exactly what write_metric() writes.
// Limits:
//  1. The tensors belong to the vertices of a mesh in their order; the file of the mesh is another one. Whether a
//     tensor is positive definite is checked by those who use it.
// Example:
//     write_metric(std::vector<MetricTensor>{{100, 0, 2500}}, "flat.sol");  // edges of 1/10 along x, of 1/50 along y
//     assert(read_metric("flat.sol") == (std::vector<MetricTensor>{{100, 0, 2500}}));
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include <lamina/export.hpp>

namespace lamina {

/// A symmetric positive definite tensor M. A vector e has the length sqrt(e . M e), so that an edge of length h along
/// an eigenvector is as long as asked for where the eigenvalue is 1 / h^2.
struct MetricTensor {
    double xx = 1;  ///< in units of the mesh to the power of -2, as all entries
    double xy = 0;  ///< off the diagonal
    double yy = 1;  ///< the second entry of the diagonal
    /// Returns whether all entries are equal.
    friend constexpr bool operator==(const MetricTensor&, const MetricTensor&) = default;
};

/// Reads the tensors at the vertices of a mesh: from a Medit file in ASCII (.sol) with one solution per vertex, a
/// symmetric tensor or a size; or from a VTU file whose point data hold the array `metric`, or one tensor alone. A
/// tensor has 3 components (xx, xy, yy; only with this name), 4, 6 (xx, yy, zz, xy, yz, xz) or 9. A size h is the
/// tensor with 1 / h^2 on its diagonal. Throws IoError; UsageError for other extensions; InputError where the file is
/// malformed or holds none.
LAMINA_EXPORT std::vector<MetricTensor> read_metric(const std::filesystem::path& file);
/// Writes tensors as a Medit file in ASCII (.sol). Throws IoError; UsageError for other extensions.
LAMINA_EXPORT void write_metric(std::span<const MetricTensor> metric, const std::filesystem::path& file);

}  // namespace lamina
