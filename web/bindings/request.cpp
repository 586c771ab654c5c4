#include "request.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <lamina/former_options.hpp>

#include "core/option_builders.hpp"
#include "values.hpp"

namespace lamina::web {

using emscripten::val;

namespace {

constexpr const char* preset_key = "preset";

/// What the module may use of the 4 GB that addresses of 32 bits reach; the rest is for files that it writes.
constexpr std::size_t default_memory_bytes = std::size_t{3} << 30;

const OptionTable<MeshRequest>& request_table() {
    static const OptionTable<MeshRequest> table = [] {
        OptionTableBuilder<MeshRequest> presets("Files"), run("Run");
        presets.choice(preset_key,
                       "options to begin with, which all others override; auto: rans where a Reynolds number is given, "
                       "else none",
                       preset_choices(), member_at(&MeshRequest::preset));
        run.flag("allow-defects",
                 "return the mesh even where isotropic triangles have an angle below min_angle that no sharp corner "
                 "excuses",
                 true, member_at(&MeshRequest::allow_defects));
        OptionTable<MeshRequest> rows = presets.take();
        for (Option<MeshRequest>& row :
             nested_table<MeshRequest>(option_table<CaseOptions>(), member_at(&MeshRequest::options)))
            if (!row.library_only) rows.push_back(std::move(row));
        for (Option<MeshRequest>& row : run.take()) rows.push_back(std::move(row));
        return rows;
    }();
    return table;
}

}  // namespace

MeshRequest make_request(const val& values) {
    const std::vector<std::string> keys = strings_of(val::global("Object").call<val>("keys", values));
    const auto is_given = [&](const std::string& key) { return std::count(keys.begin(), keys.end(), key) > 0; };
    MeshRequest request;
    if (is_given(preset_key))
        find_row_of_key(request_table(), preset_key).set(request, option_value_of(values[preset_key], preset_key));
    request.options =
        preset_options(request.preset, std::any_of(std::begin(reynolds_options), std::end(reynolds_options), is_given));
    std::vector<std::string> given;
    for (const std::string& key : keys) {
        refuse_former_option(key);
        const Option<MeshRequest>& row = find_row_of_key(request_table(), key);
        row.set(request, option_value_of(values[key], key));
        given.push_back(row.name);
    }
    require_consistent(request_table(), given);
    validate(request.options);
    WorkLimits& limits = request.options.limits;
    if (!limits.max_memory_bytes) limits.max_memory_bytes = default_memory_bytes;
    return request;
}

val option_rows() {
    const MeshRequest defaults;
    val rows = val::array();
    for (const Option<MeshRequest>& option : request_table()) {
        val row = val::object();
        row.set("key", option.key());
        row.set("kind", std::string(option_kind_name(option.kind)));
        row.set("metavar", option.metavar);
        row.set("help", option.help);
        row.set("range", option.range);
        row.set("group", option.group);
        row.set("default", to_javascript(option.get(defaults)));
        std::vector<std::string> excludes;
        for (const std::string& name : option.excludes) excludes.push_back(option_key(name));
        row.set("excludes", to_javascript(excludes));
        rows.call<void>("push", row);
    }
    return rows;
}

}  // namespace lamina::web
