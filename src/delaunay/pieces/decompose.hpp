// Decomposition of a region into subdomains along dividing paths.
#pragma once

#include <optional>
#include <utility>

#include <lamina/delaunay.hpp>

#include "delaunay/pieces/subdomain.hpp"

namespace lamina::delaunay::pieces {

/// The two parts of a subdomain, that with the lower coordinates first.
struct Halves {
    Subdomain low, high;
};

/// Cuts a subdomain along the first dividing path, of several tried in a fixed order, that crosses no edge of its
/// border and leaves neither part with more than 0.75 of its points; nothing where there is none. The storage of the
/// subdomain becomes that of its low part. O(points).
/// Source: thesis 4.2-4.5, 6.3, 6.7.
std::optional<Halves> cut_subdomain(const SortedPoints& sorted, Subdomain& subdomain, DecompositionStats& stats);

/// Is it small or deep enough to be triangulated, or without points inside?
bool is_leaf(const Subdomain& subdomain, const DecompositionOptions& options);

}  // namespace lamina::delaunay::pieces
