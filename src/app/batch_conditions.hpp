// The conditions of a batch: combinations of values that are swept, and samples of intervals.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/mesh_command_options.hpp"

namespace lamina::app {

/// What --sweep, --sample, --samples and --seed say.
struct ConditionArguments {
    std::vector<std::string> sweeps, samples;
    std::size_t number_of_samples = 0;
    std::uint64_t seed = 1;
};

/// The values that options get in one mesh of each input.
using BatchCondition = std::vector<OptionText>;

/// Returns all combinations of the values that are swept, the last option fastest, each with all samples. Throws
/// UsageError for options that there are not, values that they do not take, and options named twice.
std::vector<BatchCondition> conditions_of_batch(const ConditionArguments& arguments);

}  // namespace lamina::app
