#include "app/case.hpp"

#include <algorithm>
#include <filesystem>

#include <lamina/error.hpp>

#include "app/case_file.hpp"

namespace lamina::app {

MeshCase case_of_inputs(const std::vector<std::string>& inputs) {
    if (inputs.empty()) throw UsageError("no INPUT: give an airfoil file, naca:DIGITS or a case file");
    const auto is_case_file = [](const std::string& input) {
        return std::filesystem::path(input).extension() == ".toml";
    };
    if (inputs.size() == 1 && is_case_file(inputs.front())) return read_case_file(inputs.front());
    const auto case_file = std::find_if(inputs.begin(), inputs.end(), is_case_file);
    if (case_file != inputs.end()) throw UsageError("case file " + *case_file + " must be the only INPUT");

    MeshCase mesh_case;
    mesh_case.inputs = inputs;
    return mesh_case;
}

}  // namespace lamina::app
