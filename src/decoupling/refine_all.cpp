// Large subdomains are refined first, so that no thread is left with a large one at the end.
#include "decoupling/refine_all.hpp"

#include <algorithm>
#include <numeric>

#include "core/parallel.hpp"

namespace lamina::decoupling {

std::vector<std::size_t> largest_first(std::span<const Subdomain> subdomains) {
    std::vector<std::size_t> order(subdomains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return subdomains[a].estimated_triangles > subdomains[b].estimated_triangles;
    });
    return order;
}

std::vector<Refinement> refine_all(std::span<const Subdomain> subdomains, core::BusyTimes* times, std::size_t kind) {
    const std::vector<std::size_t> order = largest_first(subdomains);
    std::vector<Refinement> refinements(subdomains.size());
    core::parallel_for(order.size(), 1, [&](std::size_t begin, std::size_t end) {
        const core::BusyTimes::Scope busy(times, kind);
        for (std::size_t i = begin; i < end; ++i) refinements[order[i]] = refine(subdomains[order[i]]);
    });
    return refinements;
}

Refinement refine(const Subdomain& subdomain) {
    return refine(subdomain.points, subdomain.segments, subdomain.size, subdomain.refine);
}

std::vector<Refinement> refine(std::span<const Subdomain> subdomains) { return refine_all(subdomains, nullptr, 0); }

}  // namespace lamina::decoupling
