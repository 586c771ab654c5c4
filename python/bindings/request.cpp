#include "request.hpp"

#include <algorithm>
#include <iterator>
#include <memory>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <lamina/former_options.hpp>
#include <lamina/io.hpp>

#include "bindings.hpp"
#include "core/option_builders.hpp"

namespace lamina::python {

namespace nb = nanobind;

namespace {

constexpr const char* preset_key = "preset";

OptionTable<MeshRequest> make_request_table() {
    OptionTableBuilder<MeshRequest> presets("Files"), sizes("Outer region"), run("Run");
    presets.choice(preset_key,
                   "options to begin with, which all others override; auto: rans where a Reynolds number "
                   "is given, else none",
                   preset_choices(), member_at(&MeshRequest::preset));
    OptionTable<MeshRequest> table = presets.take();
    for (Option<MeshRequest>& row :
         nested_table<MeshRequest>(option_table<CaseOptions>(), member_at(&MeshRequest::options)))
        if (!row.library_only) table.push_back(std::move(row));
    const auto set_background = [](MeshRequest& request, const OptionValue& value) {
        request.options.sizing.background = std::make_shared<const SizedMesh>(read_sizes(as_word(value, "background")));
    };
    sizes.add({"background", OptionKind::path, "FILE",
               "VTU or MSH mesh to read with an edge length at each vertex, in units of the input, or the arrays "
               "(points, triangles, sizes); linear in its triangles",
               "", set_background, [](const MeshRequest&) { return std::optional<OptionValue>{}; }});
    run.flag("allow-defects",
             "return the mesh even where isotropic triangles have an angle below min_angle that no sharp corner "
             "excuses; otherwise such a run raises MeshError",
             true, member_at(&MeshRequest::allow_defects));
    for (auto* builder : {&sizes, &run})
        for (Option<MeshRequest>& row : builder->take()) table.push_back(std::move(row));
    return table;
}

/// Returns one dictionary for each option.
nb::list option_rows() {
    const MeshRequest defaults;
    nb::list rows;
    for (const Option<MeshRequest>& option : request_table()) {
        nb::dict row;
        row["key"] = option.key();
        row["kind"] = option_kind_name(option.kind);
        row["metavar"] = option.metavar;
        row["help"] = option.help;
        row["range"] = option.range;
        row["group"] = option.group;
        row["default"] = nb::cast(option.get(defaults));
        rows.append(row);
    }
    return rows;
}

}  // namespace

const OptionTable<MeshRequest>& request_table() {
    static const OptionTable<MeshRequest> table = make_request_table();
    return table;
}

MeshRequest make_request(const std::vector<std::pair<std::string, OptionValue>>& values) {
    const auto is_given = [&](const std::string& key) {
        return std::any_of(values.begin(), values.end(), [&](const auto& entry) { return entry.first == key; });
    };
    MeshRequest request;
    for (const auto& [key, value] : values)
        if (key == preset_key) find_row_of_key(request_table(), key).set(request, value);
    request.options =
        preset_options(request.preset, std::any_of(std::begin(reynolds_options), std::end(reynolds_options), is_given));
    for (const auto& [key, value] : values) {
        refuse_former_option(key);
        const Option<MeshRequest>& row = find_row_of_key(request_table(), key);
        row.set(request, value);
        request.given.push_back(row.name);
    }
    require_consistent(request_table(), request.given);
    validate(request.options);
    return request;
}

void add_options(nb::module_& module) {
    module.def("option_rows", &option_rows);
    module.def("check_options",
               [](const std::vector<std::pair<std::string, OptionValue>>& values) { make_request(values); });
}

}  // namespace lamina::python
