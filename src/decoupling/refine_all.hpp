// Refinement of all subdomains, with the times of the threads.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/busy_times.hpp"
#include "decoupling/subdomain.hpp"

namespace lamina::decoupling {

/// Refines all subdomains in parallel, the largest first, each on the next free thread. The times of the threads count
/// as work of this kind. The results stand in the order of the subdomains.
LAMINA_EXPORT std::vector<Refinement> refine_all(std::span<const Subdomain> subdomains, core::BusyTimes* times,
                                                 std::size_t kind);

/// Returns the numbers of the subdomains, those of the largest first.
LAMINA_EXPORT std::vector<std::size_t> largest_first(std::span<const Subdomain> subdomains);

}  // namespace lamina::decoupling
