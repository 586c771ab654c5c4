// Large subdomains are refined first, so that no thread is left with a large one at the end.
#include "decoupling/refine_all.hpp"

#include <algorithm>
#include <numeric>

#include "core/parallel.hpp"

namespace lamina::decoupling {

namespace {

/// Returns the numbers from 0 to n, those with the largest of these estimates first.
template <class Estimate>
std::vector<std::size_t> by_estimate(std::size_t n, Estimate&& estimate) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return estimate(a) > estimate(b); });
    return order;
}

}  // namespace

std::vector<std::size_t> largest_first(std::span<const Subdomain> subdomains) {
    return by_estimate(subdomains.size(), [&](std::size_t i) { return subdomains[i].estimated_triangles; });
}

std::vector<std::size_t> largest_first(std::span<const EstimatedBorder> borders) {
    return by_estimate(borders.size(), [&](std::size_t i) { return borders[i].estimate.triangles; });
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

}  // namespace lamina::decoupling

namespace lamina {

using namespace decoupling;

Refinement refine(const Subdomain& subdomain) {
    return refine(subdomain.points, subdomain.segments, subdomain.size, subdomain.refine);
}

std::vector<Refinement> refine(std::span<const Subdomain> subdomains) { return refine_all(subdomains, nullptr, 0); }

}  // namespace lamina
