#include "app/case.hpp"

#include <algorithm>
#include <filesystem>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "app/case_file.hpp"
#include "app/option_hint.hpp"
#include "app/presets.hpp"

namespace lamina::app {

MeshCase case_of_inputs(const std::vector<std::string>& inputs, const std::optional<std::string>& preset,
                        bool has_reynolds) {
    if (inputs.empty()) throw UsageError("no INPUT: give an airfoil file, naca:DIGITS or a case file");
    for (const std::string& input : inputs)
        if (input.starts_with('-') && !is_standard_stream(input))
            throw UsageError("unknown option " + input + hint_text(hint_for_other_word("mesh", input), "--"));
    const auto is_case_file = [](const std::string& input) {
        return std::filesystem::path(input).extension() == ".toml";
    };
    if (inputs.size() == 1 && is_case_file(inputs.front())) return read_case_file(inputs.front(), preset, has_reynolds);
    const auto case_file = std::find_if(inputs.begin(), inputs.end(), is_case_file);
    if (case_file != inputs.end()) throw UsageError("case file " + *case_file + " must be the only INPUT");

    MeshCase mesh_case = case_of_preset(preset.value_or(automatic_preset), has_reynolds);
    mesh_case.inputs = inputs;
    return mesh_case;
}

}  // namespace lamina::app
