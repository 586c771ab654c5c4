// Curves that end where others begin are joined to chains.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geometry/drawings/plane.hpp"

namespace lamina::geometry {

/// A curve of a chain, by its number.
struct ChainLink {
    std::size_t curve;
    bool is_reversed = false;
};

struct Chain {
    std::vector<ChainLink> links;
    bool is_closed = false;
};

/// Joins curves whose ends are as near to each other as `share` of `size`, and of ten times the shorter curve. Where
/// more than two meet, lines that go nowhere and straight lines between two such places are construction lines, and
/// left out, with a note of their number. Throws InputError, with the place, where more than two are left, or an
/// outline could be divided by them in several ways. Curves of no length, and those that repeat another one, are left
/// out.
std::vector<Chain> join_curves(std::span<const FlatCurve> curves, double share, double size, const std::string& file,
                               std::vector<std::string>& notes);

}  // namespace lamina::geometry
