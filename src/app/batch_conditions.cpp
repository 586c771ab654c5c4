#include "app/batch_conditions.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/former_options.hpp>
#include <lamina/latin_hypercube.hpp>
#include <lamina/value_range.hpp>

#include "app/options.hpp"
#include "core/suggestion.hpp"

namespace lamina::app {

namespace {

/// An option with the values that a batch gives it.
struct Sweep {
    const Option<MeshCase>* option;
    std::vector<std::string> values;
};

/// Returns whether the option takes numbers, so that a colon between some means a range.
bool takes_numbers(const Option<MeshCase>& option) {
    constexpr std::array kinds{OptionKind::number, OptionKind::number_or_range, OptionKind::number_or_word,
                               OptionKind::length, OptionKind::count,           OptionKind::count_or_auto};
    return std::find(kinds.begin(), kinds.end(), option.kind) != kinds.end();
}

/// Returns the values between commas, those of each range one by one.
std::vector<std::string> values_in(std::string_view text, const Option<MeshCase>& option) {
    std::vector<std::string> values;
    for (;;) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const std::string value(text.substr(0, comma));
        if (takes_numbers(option) && is_range(value)) {
            for (const double number : values_of(parse_range(value))) values.push_back(to_text(OptionValue(number)));
        } else {
            values.push_back(value);
        }
        if (comma == text.size()) return values;
        text.remove_prefix(comma + 1);
    }
}

/// An option, and what follows its name and "=".
struct NamedText {
    const Option<MeshCase>* option;
    std::string_view text;
};

/// Reads OPTION=TEXT, as `form` says, for the option `flag` of the batch.
NamedText parse_named(const std::string& text, const char* flag, const char* form) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size())
        throw UsageError(fmt::format("option {}: '{}' is not {}", flag, text, form));
    std::vector<std::string> names;
    for (const Option<MeshCase>& option : mesh_options()) {
        if (option.name == "input" || option.name == "output") continue;
        names.push_back(option.name);
        if (option.key() == option_key(text.substr(0, equals)))
            return {&option, std::string_view(text).substr(equals + 1)};
    }
    const std::string name = text.substr(0, equals);
    const FormerOption* former = find_former_option(name);
    throw UsageError(
        fmt::format("option {}: there is no option '{}'{}", flag, name,
                    former ? ": " + advice_on_command_line(*former) : did_you_mean(meant_option(name, names))));
}

/// Reads "reynolds=1e5,1e6".
Sweep parse_sweep(const std::string& text) {
    const NamedText named = parse_named(text, "--sweep", "OPTION=VALUE,VALUE,...");
    try {
        return {named.option, values_in(named.text, *named.option)};
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("option --sweep: {}: {}", named.option->name, error.what()));
    }
}

/// An option with the interval that samples of it come from.
struct SampledOption {
    const Option<MeshCase>* option;
    ValueInterval interval;
};

/// Reads "reynolds=1e5:1e7:log".
SampledOption parse_sample(const std::string& text) {
    const NamedText named = parse_named(text, "--sample", "OPTION=A:B");
    if (!takes_numbers(*named.option))
        throw UsageError(fmt::format("option --sample: {}: only numbers have intervals", named.option->name));
    try {
        return {named.option, parse_interval(std::string(named.text))};
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("option --sample: {}: {}", named.option->name, error.what()));
    }
}

/// Returns the value of an option as text, with six digits, since names of files may hold it.
std::string short_text(double value, const Option<MeshCase>& option) {
    const bool whole = option.kind == OptionKind::count || option.kind == OptionKind::count_or_auto;
    return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.6g}", value);
}

/// Returns the combinations of the values that are swept, the last option fastest.
std::vector<BatchCondition> combinations_of(const std::vector<Sweep>& sweeps) {
    std::vector<BatchCondition> all{{}};
    for (const Sweep& sweep : sweeps) {
        std::vector<BatchCondition> longer;
        for (const BatchCondition& condition : all)
            for (const std::string& value : sweep.values) {
                longer.push_back(condition);
                longer.back().emplace_back(sweep.option, value);
            }
        all = std::move(longer);
    }
    return all;
}

/// Returns the samples of these options together.
std::vector<BatchCondition> samples_of(const std::vector<SampledOption>& sampled, std::size_t count,
                                       std::uint64_t seed) {
    std::vector<ValueInterval> intervals;
    intervals.reserve(sampled.size());
    for (const SampledOption& one : sampled) intervals.push_back(one.interval);
    std::vector<BatchCondition> samples;
    for (const std::vector<double>& values : latin_hypercube(intervals, count, seed)) {
        BatchCondition& sample = samples.emplace_back();
        for (std::size_t i = 0; i < sampled.size(); ++i)
            sample.emplace_back(sampled[i].option, short_text(values[i], *sampled[i].option));
    }
    return samples;
}

/// Throws UsageError where an option has values already.
void require_new_option(const Option<MeshCase>* option, std::vector<const Option<MeshCase>*>& earlier,
                        const char* message) {
    if (std::find(earlier.begin(), earlier.end(), option) != earlier.end())
        throw UsageError(fmt::format(fmt::runtime(message), option->name));
    earlier.push_back(option);
}

}  // namespace

std::vector<BatchCondition> conditions_of_batch(const ConditionArguments& arguments) {
    std::vector<const Option<MeshCase>*> named;
    std::vector<Sweep> sweeps;
    for (const std::string& text : arguments.sweeps) {
        sweeps.push_back(parse_sweep(text));
        require_new_option(sweeps.back().option, named, "option --sweep: '{}' is swept twice");
    }
    std::vector<SampledOption> sampled;
    for (const std::string& text : arguments.samples) {
        sampled.push_back(parse_sample(text));
        require_new_option(sampled.back().option, named, "option --sample: '{}' has values already");
    }
    std::vector<BatchCondition> combinations = combinations_of(sweeps);
    if (sampled.empty()) return combinations;
    const std::vector<BatchCondition> samples = samples_of(sampled, arguments.number_of_samples, arguments.seed);
    std::vector<BatchCondition> all;
    for (const BatchCondition& combination : combinations)
        for (const BatchCondition& sample : samples) {
            all.push_back(combination);
            all.back().insert(all.back().end(), sample.begin(), sample.end());
        }
    return all;
}

}  // namespace lamina::app
