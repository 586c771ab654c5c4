// The neighbours of rays, and limits on how much they differ.
#include "layers/neighbours.hpp"

namespace lamina::layers {

RayNeighbours::RayNeighbours(const RaySet& set) : next(set.following()), previous(next.size()) {
    for (std::size_t i = 0; i < next.size(); ++i) previous[next[i]] = i;
}

void limit_count_differences(const RaySet& set, std::vector<std::uint32_t>& counts) {
    lower_to_neighbours(set, counts, [&](std::size_t from, std::size_t) { return counts[from] + 1; });
}

}  // namespace lamina::layers

namespace lamina {

std::vector<std::size_t> RaySet::following() const {
    std::vector<std::size_t> next(lines.size());
    for (std::size_t e = 0; e < elements(); ++e)
        for (std::size_t i = begin[e]; i < begin[e + 1]; ++i) next[i] = i + 1 < begin[e + 1] ? i + 1 : begin[e];
    return next;
}

}  // namespace lamina
