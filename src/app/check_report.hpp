// The check of a mesh from a file: what `lamina check` and `lamina view` have in common.
#pragma once

#include <string>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/mesh.hpp>

#include "app/report.hpp"

namespace lamina::app {

/// The requirements of the user, beyond validity, that a mesh does not meet.
using Shortcomings = std::vector<std::string>;

/// How it is known which cells belong to the boundary layer.
enum class RegionOrigin {
    file,
    estimate,  ///< estimate_regions()
    none,      ///< not at all: every cell counts as isotropic
};

/// Gives a mesh from a file regions where it has none.
RegionOrigin require_regions(Mesh& mesh);
RegionOrigin require_regions(StoredMesh& mesh);

/// Checks a mesh from a file.
MeshCheck check_file_mesh(const MeshView& mesh, RegionOrigin regions, const MeshCheckOptions& options = {});

/// Reads a mesh. Throws MeshError where it is not valid.
Mesh read_valid_mesh(const std::string& file, const std::string& format = {});

/// Returns the kind of a marker in words: "far field".
const char* kind_name(MarkerKind kind);

/// Returns the result of `lamina check --json`.
Json check_report(const MeshView& mesh, const MeshCheck& check, RegionOrigin regions, const Shortcomings& shortcomings);

/// Returns what `lamina check --json` says of curved cells.
Json curved_check_report(unsigned order, const CurvedCheck& check);

}  // namespace lamina::app
