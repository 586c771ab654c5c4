// A run that makes a mesh: what `lamina mesh`, `lamina family`, `lamina batch` and `lamina case` have
// in common.
#pragma once

#include <functional>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/ranks.hpp>
#include <lamina/warning.hpp>

#include "app/case.hpp"
#include "app/run_files.hpp"

namespace lamina::app {

/// The destination of the mesh of a run. The files beside it (files_beside_mesh) are no part of it.
struct MeshDestination {
    std::vector<RunFile> files;                                       ///< that are written
    std::function<void()> require_writable;                           ///< throws where they certainly cannot be written
    std::function<std::vector<Warning>(const MeshResult&)> warnings;  ///< about what the readers make of the mesh
    std::function<void(const MeshResult&)> write;                     ///< writes them
    bool holds_curved_cells = false;                                  ///< whether `write` knows MeshResult::curved
};

/// Returns how a case writes its mesh files; `chord` is what its lengths count.
WriteOptions write_options(const MeshCase& mesh_case, double chord = 1);

/// Returns the destination that the outputs of `lamina mesh` name. Throws UsageError where there are none. The
/// destination refers to the case.
MeshDestination destination_of_outputs(const MeshCase& mesh_case);

/// Returns the files that a run writes, each with the option that names it: those of the mesh, and those beside it.
std::vector<RunFile> files_written(const MeshCase& mesh_case, const MeshDestination& destination);

/// Throws where an output certainly cannot be written, before the work begins.
void require_outputs(const MeshCase& mesh_case, const MeshDestination& destination);

/// Adds what the readers of the mesh make of it, and the markers that its files lose, to the warnings of the result.
void add_warnings_of_readers(const MeshCase& mesh_case, const MeshDestination& destination, MeshResult& result);

/// Does so, prints all warnings, and throws where angles are not as promised.
void report_warnings(const MeshCase& mesh_case, const MeshDestination& destination, MeshResult& result);

/// Writes the mesh, the table of its walls and the reports of the run, as the case asks. Returns the seconds that the
/// mesh and the table took. Throws the errors of write_mesh().
double write_outputs(const MeshCase& mesh_case, const MeshDestination& destination, const MeshResult& result);

/// Makes the mesh, writes it and the files beside it, and prints warnings and the summary.
void run_mesh(const MeshCase& mesh_case, const MeshDestination& destination);

/// Says what the mesh of a case will be, for `lamina mesh --dry-run`. Of the files of the case it writes the report
/// alone.
void forecast_mesh_of_case(const MeshCase& mesh_case);

/// Makes a mesh for `lamina mesh --stream`, which writes it while it is made. Throws UsageError for outputs that need
/// the whole mesh.
void stream_mesh_of_case(const MeshCase& mesh_case, const MeshDestination& destination);

/// Collective: does so for several processes, of which each writes the pieces that it has made. With --stream the
/// pieces wait on the disk.
void share_mesh_of_case(const MeshCase& mesh_case, const MeshDestination& destination, Ranks& ranks);

/// Throws UsageError where the case asks for a mesh that is written while it is made: for commands that need all of it.
void require_whole(const MeshCase& mesh_case);

/// Throws UsageError for a case that asks for curved cells.
void require_straight(const MeshCase& mesh_case);

/// Sets the cells of the layer to quadrilaterals, which cell-centred solvers need, unless a case file or the command
/// line chooses them.
void prefer_quads(MeshCase& mesh_case);

/// Does so where the mesh is written for OpenFOAM and every format holds quadrilaterals.
void prefer_quads_for_openfoam(MeshCase& mesh_case);

}  // namespace lamina::app
