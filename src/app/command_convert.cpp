// lamina convert: converts a mesh from one format to another.
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/marker_lookup.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"

namespace lamina::app {

namespace {

struct ConvertArguments {
    std::string from, from_format, to, span_ends;
    WriteOptions options;
    std::vector<std::string> walls, far_fields, symmetries;
};

/// Sets the kind of the markers of these names, since not all formats hold kinds.
void set_kind(std::vector<Marker>& markers, const std::vector<std::string>& names, MarkerKind kind,
              const std::string& file) {
    for (const std::string& name : names) {
        Marker* const marker = find_marker(markers, name, kind);
        if (marker == nullptr) throw InputError({file, 0, {}}, "no marker '" + name + "'");
        marker->kind = kind;
    }
}

void convert(const ConvertArguments& arguments) {
    require_format(arguments.from, arguments.from_format, "--input-format");
    require_format(arguments.to, arguments.options.format, "--format");
    check_writable(arguments.to, arguments.options);
    require_parts_taken(std::span(&arguments.to, 1), arguments.options);
    std::vector<RunFile> outputs;
    for (const std::filesystem::path& file : output_files(arguments.to, arguments.options))
        outputs.push_back({file, "OUT"});
    require_distinct(files_of_mesh(arguments.from, arguments.from_format), outputs);
    const SignalGuard guard(outputs);
    StoredMesh mesh = read_stored_mesh(arguments.from, {.format = arguments.from_format, .curved = true});
    const bool is_curved = mesh.curved().order > 1;
    if (is_curved)
        require_curved_format(arguments.to, arguments.options, mesh.curved().order, mesh.curved().distribution);
    const std::string name = input_name(arguments.from);
    set_kind(mesh.markers(), arguments.walls, MarkerKind::wall, name);
    set_kind(mesh.markers(), arguments.far_fields, MarkerKind::far_field, name);
    set_kind(mesh.markers(), arguments.symmetries, MarkerKind::symmetry, name);
    print_warnings(make_marker_names_legal(mesh.markers()));
    print_warnings(lost_marker_warnings(mesh.markers(), arguments.to, arguments.options));
    if (is_curved)
        write_curved_mesh(mesh.view(), mesh.curved(), arguments.to, arguments.options);
    else
        write_mesh(mesh.view(), arguments.to, arguments.options);
}

}  // namespace

void add_convert_command(CLI::App& app) {
    CLI::App* command = add_command(app, "convert", "convert a mesh from one format to another");
    auto arguments = std::make_shared<ConvertArguments>();
    add_option(*command, "IN", arguments->from, "mesh file; - for standard input").required();
    add_option(*command, "OUT", arguments->to,
               "mesh file; its extension says the format, unless --format does; - for standard output")
        .required();
    add_input_format(*command, arguments->from_format);
    add_option(*command, "--format", arguments->options.format, "format of OUT").type_name(format_names());
    add_option(*command, "--wall", arguments->walls, "set the kind of this marker to wall; may be given several times")
        .type_name("NAME")
        .one_at_a_time();
    add_option(*command, "--far", arguments->far_fields,
               "set the kind of this marker to far field; may be given several times")
        .type_name("NAME")
        .one_at_a_time();
    add_option(*command, "--symmetry-marker", arguments->symmetries,
               "set the kind of this marker to symmetry; may be given several times")
        .type_name("NAME")
        .one_at_a_time();
    add_option(*command, "--span", arguments->options.span,
               "depth in units of the mesh, which becomes one of prisms and hexahedra in space: CGNS, VTU, "
               "msh22-extruded, OpenFOAM, FUN3D")
        .positive()
        .type_name("L");
    add_option(*command, "--span-cells", arguments->options.span_cells, "number of cells across --span")
        .in_range(std::size_t{1}, std::size_t{100'000})
        .type_name("N");
    add_option(*command, "--span-ends", arguments->span_ends, "what the two planes at the ends of --span are")
        .one_of({"symmetry", "periodic"})
        .type_name("symmetry|periodic");
    add_flag(*command, "--wall-distance", arguments->options.wall_distance,
             "write the distance to the nearest wall as point data, in VTU files");
    add_option(*command, "--parts", arguments->options.parts,
               "number of parts of equal size: of PVTU files, and of cellDecomposition beside OpenFOAM's polyMesh")
        .in_range(std::size_t{1}, max_parts)
        .type_name("N");
    set_footer(*command, format_help());
    run_with(*command, [arguments] {
        arguments->options.span_periodic = arguments->span_ends == "periodic";
        convert(*arguments);
    });
}

}  // namespace lamina::app
