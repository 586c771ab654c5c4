// Meshes of so many vertices or cells.
#include "pipeline/budget.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"

namespace lamina::pipeline {

namespace {

/// Counts may be off by this share.
constexpr double tolerance = 0.03;

/// Finds the scale at which the logarithm of a count is right: by a power of the scale first, and between scales that
/// were too small and too large once both are known.
class ScaleSearch {
public:
    /// Takes how far the logarithm of the count at the current scale is from what is wanted, and moves on.
    void learn(double miss) {
        (miss < 0 ? low_ : high_) = Trial{scale_, miss};
        if (low_ && high_) return move_between();
        // The count grows with a power between 1, that of walls alone, and 2, that of an area. By the latter no mesh
        // has too many vertices, which a limit may refuse; one that has too few is cheap.
        constexpr double power_down = 1.4, power_up = 2, longest_step = 4;
        const double step = core::exp_reproducible(-miss / (miss < 0 ? power_up : power_down));
        scale_ *= std::clamp(step, 1 / longest_step, longest_step);
    }
    /// Takes that there is no mesh at the current scale, which is not 1, and moves on towards 1.
    void learn_refusal() {
        (scale_ < 1 ? low_ : high_) = Trial{scale_, {}};
        move_between();
    }
    double scale() const { return scale_; }

private:
    struct Trial {
        double scale;
        std::optional<double> miss;  ///< empty: there is no mesh
    };
    /// Precondition: both ends are known.
    void move_between() {
        double share = 0.5;
        // A false position near one end would hardly move it.
        if (low_->miss && high_->miss) share = std::clamp(*low_->miss / (*low_->miss - *high_->miss), 0.1, 0.9);
        scale_ = low_->scale * core::pow_reproducible(high_->scale / low_->scale, share);
    }

    double scale_ = 1;
    std::optional<Trial> low_, high_;
};

}  // namespace

bool has_budget(const CaseOptions& options) { return options.vertices || options.cells; }

void refuse_budget(const CaseOptions& options) {
    if (has_budget(options))
        throw OptionError(
            options.vertices ? "vertices" : "cells",
            "several meshes are made to find its scale, so that none is written while it is made, or shared "
            "by processes");
}

MeshResult mesh_within_budget(const CaseOptions& options, const std::function<MeshResult(const CaseOptions&)>& make) {
    const double wanted = static_cast<double>(options.vertices ? *options.vertices : *options.cells);
    const auto count = [&](const MeshResult& result) {
        const Mesh& mesh = result.mesh;
        return static_cast<double>(options.vertices ? mesh.points.size() : mesh.triangles.size() + mesh.quads.size());
    };
    ScaledMesh found = mesh_of_count(
        wanted, [&](double scale) { return make(with_scale(options, scale)); }, count);
    if (std::abs(found.count - wanted) > tolerance * wanted)
        throw OptionError(
            options.vertices ? "vertices" : "cells",
            fmt::format("cannot be {:.0f} with these options: the nearest mesh has {:.0f}", wanted, found.count));
    found.result.scale = found.scale;
    return std::move(found.result);
}

}  // namespace lamina::pipeline

namespace lamina {

ScaledMesh mesh_of_count(double wanted, const std::function<MeshResult(double scale)>& make,
                         const std::function<double(const MeshResult&)>& count) {
    constexpr int most_trials = 8;
    pipeline::ScaleSearch search;
    ScaledMesh best;
    const auto is_near = [&] { return std::abs(best.count - wanted) <= pipeline::tolerance * wanted; };
    for (int trial = 0; trial < most_trials && !is_near(); ++trial) {
        const double scale = search.scale();
        try {
            MeshResult result = make(scale);
            const double made = count(result);
            if (std::abs(made - wanted) < std::abs(best.count - wanted) || trial == 0)
                best = {scale, std::move(result), made};
            search.learn(core::log_reproducible(made / wanted));
        } catch (const OptionError&) {
            if (trial == 0) throw;
            search.learn_refusal();
        }
    }
    return best;
}

}  // namespace lamina
