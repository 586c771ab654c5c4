// Makes meshes in memory, into a sink and on several processes: all stages (run.hpp) with three drivers.
#include <lamina/pipeline.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/stream.hpp>
#include <lamina/threads.hpp>

#include "pipeline/budget.hpp"
#include "pipeline/derived_options.hpp"
#include "pipeline/run.hpp"
#include "pipeline/sharing/mesh_driver.hpp"

namespace lamina::pipeline {

namespace {

/// Runs all stages on what `read` returns.
template <class Read>
MadeMesh read_and_run(Read read, const CaseOptions& options, MeshDriver& driver, const Progress& progress) {
    validate(options);
    MadeMesh made;
    with_threads(options.threads, [&] {
        StageClock clock(progress);
        const Geometry& geometry = read(clock);
        made = run(geometry, options, driver, clock);
    });
    return made;
}

/// Reads the inputs and runs all stages on them.
MadeMesh run_on_inputs(const std::vector<std::string>& inputs, const CaseOptions& options, MeshDriver& driver,
                       const Progress& progress) {
    Geometry geometry;
    const auto read = [&](StageClock& clock) -> const Geometry& {
        clock.begin("geometry");
        geometry = read_inputs(inputs, options.geometry, options.far_field);
        clock.end(&StageSeconds::geometry);
        return geometry;
    };
    return read_and_run(read, options, driver, progress);
}

/// Returns the result with the mesh as a whole.
MeshResult whole(MadeMesh made) {
    made.result.mesh.constraints = std::move(made.constraints);
    return std::move(made.result);
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

Geometry prepare_geometry(Geometry geometry, const CaseOptions& options) {
    geometry = part_in_domain(std::move(geometry), options.far_field, options.conditions);
    const ReferenceConditions conditions = reference_conditions(options.conditions, geometry);
    const layers::LayerGrowth growth = layers::layer_growth(options.layer, conditions);
    const double gradation = wall_gradation(options.sizing, options.fineness);
    return surface::prepare_within(std::move(geometry), options.surface,
                                   spacing_limits(options.layer, growth, gradation, options.order), conditions.chord);
}

MeshResult generate_mesh(const Geometry& geometry, const CaseOptions& options, const Progress& progress) {
    const auto make = [&](const CaseOptions& of_mesh) {
        KeepingDriver driver;
        const auto given = [&](StageClock&) -> const Geometry& { return geometry; };
        return whole(read_and_run(given, of_mesh, driver, progress));
    };
    return has_budget(options) ? mesh_within_budget(options, make) : make(options);
}

MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, const Progress& progress) {
    if (has_budget(options)) {
        // Several meshes are made, and standard input can be read once.
        validate(options);
        return generate_mesh(read_inputs(inputs, options.geometry, options.far_field), options, progress);
    }
    KeepingDriver driver;
    return whole(run_on_inputs(inputs, options, driver, progress));
}

StreamedMesh stream_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, const OpenSink& open_sink,
                         const Progress& progress) {
    refuse_budget(options);
    if (std::any_of(options.lines.begin(), options.lines.end(), [](const InternalLine& l) { return l.two_sided; }))
        throw OptionError("line",
                          "a two-sided line doubles vertices of cells that have been written by then: leave --stream "
                          "out, or the word two-sided");
    if (options.order > 1) throw OptionError("order", "curved cells need the mesh as a whole: leave --stream out");
    if (!options.geometry.sheets.empty())
        throw OptionError("sheet", "sheets need the mesh as a whole: leave --stream out");
    StreamingDriver driver(open_sink);
    MadeMesh made = run_on_inputs(inputs, options, driver, progress);
    return {std::move(made.result), made.counts, std::move(made.hash), std::move(made.sink)};
}

SharedMesh share_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, Ranks& ranks,
                      const std::optional<std::filesystem::path>& beside, const Progress& progress) {
    refuse_budget(options);
    if (!options.lines.empty()) throw OptionError("line", "lines are made by one process: leave mpirun out");
    if (options.order > 1) throw OptionError("order", "curved cells are made by one process: leave mpirun out");
    if (!options.geometry.sheets.empty())
        throw OptionError("sheet", "sheets are made by one process: leave mpirun out");
    SharingDriver driver(core::connected(ranks), beside);
    MadeMesh made = run_on_inputs(inputs, options, driver, progress);
    return {std::move(made.result), made.counts, std::move(made.hash), std::move(made.constraints),
            std::move(made.parts)};
}

}  // namespace lamina
