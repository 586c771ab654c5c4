#include "app/case.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "app/case_file.hpp"
#include "app/option_hint.hpp"
#include "app/presets.hpp"

namespace lamina::app {

namespace {

/// Returns whether a file is a mesh, by its name.
bool is_named_as_mesh(const std::string& input) {
    const std::filesystem::path path(input);
    const std::vector<MeshFormat> formats = mesh_formats();
    return std::any_of(formats.begin(), formats.end(), [&](const MeshFormat& format) {
        return std::count(format.extensions.begin(), format.extensions.end(), path.extension().string()) > 0;
    });
}

}  // namespace

MeshCase case_of_inputs(const std::vector<std::string>& inputs, const std::optional<std::string>& preset,
                        bool has_reynolds) {
    for (const std::string& input : inputs)
        if (input.starts_with('-') && !is_standard_stream(input))
            throw UsageError("unknown option " + input + hint_text(hint_for_other_word("mesh", input), "--"));
    const auto is_case_file = [](const std::string& input) {
        return std::filesystem::path(input).extension() == ".toml";
    };
    if (inputs.size() == 1 && is_case_file(inputs.front())) return read_case_file(inputs.front(), preset, has_reynolds);
    const auto case_file = std::find_if(inputs.begin(), inputs.end(), is_case_file);
    if (case_file != inputs.end()) throw UsageError("case file " + *case_file + " must be the only INPUT");

    for (const std::string& input : inputs)
        if (is_named_as_mesh(input))
            throw UsageError(input +
                             " is a mesh by its name, where an airfoil is wanted (lamina check describes meshes, " +
                             "and lamina view shows them)");

    MeshCase mesh_case = case_of_preset(preset.value_or(automatic_preset), has_reynolds);
    mesh_case.inputs = inputs;
    return mesh_case;
}

void require_any_body(const MeshCase& mesh_case) {
    if (mesh_case.inputs.empty() && mesh_case.options.geometry.sheets.empty())
        throw UsageError("no INPUT: give an airfoil file, naca:DIGITS or a case file");
}

}  // namespace lamina::app
