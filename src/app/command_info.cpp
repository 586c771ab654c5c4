// lamina info: describes airfoils as they were read, repaired and prepared.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/commands.hpp"
#include "app/conditions_block.hpp"
#include "app/options.hpp"
#include "app/standard_output.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

void add_info_command(CLI::App& app) {
    CLI::App* command = add_command(app, "info", "describe airfoils: what was read, repaired and detected");
    auto inputs = std::make_shared<std::vector<std::string>>();
    auto given = std::make_shared<std::map<std::string, std::string>>();
    add_option(*command, "INPUT", *inputs, input_help);
    auto surface = std::make_shared<std::map<std::string, std::string>>();
    for (const char* name : {"close", "mirror-half"})
        add_table_flag(*command, option_table<GeometryOptions>(), name, (*given)[name]);
    for (const char* name : {"sharpen-te", "open-te"})
        add_table_option(*command, option_table<GeometryOptions>(), name, (*given)[name]);
    auto repeated = std::make_shared<std::map<std::string, std::vector<std::string>>>();
    for (const char* name : {"transform", "sheet"})
        add_repeated_table_option(*command, option_table<GeometryOptions>(), name, (*repeated)[name]);
    for (const char* name : {"surface", "smooth", "spacing-max"})
        add_table_option(*command, option_table<SurfaceOptions>(), name, (*surface)[name]);
    auto chord = std::make_shared<std::string>();
    add_table_option(*command, option_table<FlowConditions>(), "chord", *chord);
    run_with(*command, [inputs, given, repeated, surface, chord] {
        MeshCase mesh_case = case_of_inputs(*inputs);
        for (const auto& [name, text] : *given)
            set_by_name(option_table<GeometryOptions>(), name, text, mesh_case.options.geometry);
        for (const auto& [name, texts] : *repeated)
            set_by_name(option_table<GeometryOptions>(), name, texts, mesh_case.options.geometry);
        require_any_body(mesh_case);
        for (const auto& [name, text] : *surface) {
            set_by_name(option_table<SurfaceOptions>(), name, text, mesh_case.options.surface);
            if (!text.empty()) mesh_case.given.push_back(name);
        }
        set_by_name(option_table<FlowConditions>(), "chord", *chord, mesh_case.options.conditions);
        require_consistent(mesh_case);
        const CaseOptions& options = mesh_case.options;
        const Geometry geometry = read_geometry(mesh_case.inputs, options.geometry);
        print_result(describe(prepare_geometry(geometry, options)) + chord_line(options.conditions, geometry));
    });
}

}  // namespace lamina::app
