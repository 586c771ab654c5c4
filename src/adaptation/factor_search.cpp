#include "adaptation/factor_search.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"

namespace lamina::adaptation {

bool FactorSearch::goes_on() const {
    constexpr double good_enough = 0.01;
    constexpr int most_rounds = 16;
    return rounds_ < most_rounds && best_ > good_enough;
}

bool FactorSearch::note(std::size_t vertices) {
    constexpr double widening = 4;
    ++rounds_;
    const double made = static_cast<double>(vertices);
    const bool is_best = std::abs(made / wanted_ - 1) < best_;
    if (is_best) {
        best_ = std::abs(made / wanted_ - 1);
        vertices_ = vertices;
    }
    const double at = core::log_reproducible(factor_), miss = core::log_reproducible(made / wanted_);
    End &here = miss > 0 ? low_ : high_, &other = miss > 0 ? high_ : low_;
    // An end that stays would hold the secant back (Illinois method).
    if (last_ == &here) other.miss *= 0.5;
    last_ = &here;
    here = {at, miss, true};
    if (!low_.known || !high_.known) {
        // As many vertices as the inverse square of the factor, and some that do not depend on it: steps double.
        step_ = std::clamp(step_ == 0 ? 0.7 * miss : 2 * step_, -core::log_reproducible(widening),
                           core::log_reproducible(widening));
        factor_ = core::exp_reproducible(at + step_);
        return is_best;
    }
    // The secant, kept off both ends.
    const double share = std::clamp(low_.miss / (low_.miss - high_.miss), 0.1, 0.9);
    factor_ = core::exp_reproducible(low_.at + share * (high_.at - low_.at));
    return is_best;
}

void FactorSearch::require_found(const SolutionSizeOptions& options) const {
    constexpr double acceptable = 0.02;
    if (best_ <= acceptable) return;
    const bool too_many = static_cast<double>(vertices_) > wanted_;
    throw OptionError("vertices",
                      fmt::format("cannot be {}: with sizes within a factor of {} of those of the solution's mesh, the "
                                  "next mesh has {} {}",
                                  wanted_, options.max_change, too_many ? "no fewer than" : "no more than", vertices_));
}

}  // namespace lamina::adaptation
