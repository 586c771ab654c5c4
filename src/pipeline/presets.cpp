#include <lamina/presets.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/option_builders.hpp"

namespace lamina::pipeline {

namespace {

/// A preset: its name, and the names and values of the options that it sets.
struct Preset {
    std::string name;
    std::vector<std::pair<std::string, OptionValue>> values;
};

const std::vector<Preset>& presets() {
    static const std::vector<Preset> table{
        // The flow decides where boundary layers and wakes are; one cell below y+ 1.
        {"rans",
         {{"y-plus", 1.0}, {"layers", std::string("auto")}, {"spacing-max", 0.01}, {"use-flow", std::string("yes")}}},
        // The first cell lies in the logarithmic layer, so that wall functions hold from y+ 30 to 100.
        {"wall-function",
         {{"y-plus", 60.0}, {"layers", std::string("auto")}, {"spacing-max", 0.01}, {"use-flow", std::string("yes")}}},
        {"euler", {{"no-layers", true}, {"spacing-le", 0.002}, {"spacing-te", 0.002}}},
        // Eddies are as long as wide: cells no longer than 0.5 % of the chord, which grow slowly away from the wall.
        {"les2d",
         {{"y-plus", 0.5},
          {"growth", 1.1},
          {"layers", std::string("auto")},
          {"spacing-max", 0.005},
          {"gradation", 0.05},
          {"use-flow", std::string("yes")}}},
        // What the cases of J. K. Pardue's thesis (2015) have in common (docs/reproduction.md).
        {"thesis",
         {{"first-height", 2.5e-5},
          {"growth", 1.15},
          {"layers", std::int64_t{30}},
          {"max-ray-angle", 4.0},
          {"layer-topology", std::string("delaunay")},
          {"far-field", 50.0}}},
    };
    return table;
}

Choices<std::string> make_preset_choices() {
    Choices<std::string> choices{{automatic_preset, automatic_preset}, {no_preset, no_preset}};
    for (const Preset& preset : presets()) choices.emplace_back(preset.name, preset.name);
    return choices;
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

const Choices<std::string>& preset_choices() {
    static const Choices<std::string> choices = make_preset_choices();
    return choices;
}

CaseOptions preset_options(const std::string& name, bool has_reynolds) {
    const std::string chosen = name != automatic_preset ? name : has_reynolds ? "rans" : no_preset;
    CaseOptions options;
    for (const Preset& preset : presets()) {
        if (preset.name != chosen) continue;
        for (const auto& [option, value] : preset.values)
            find_row(option_table<CaseOptions>(), option).set(options, value);
    }
    return options;
}

}  // namespace lamina
