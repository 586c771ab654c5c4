// One job of `lamina batch`: its mesh is made and written, and recorded as an object of JSON.
#pragma once

#include <string>

#include <lamina/mesh.hpp>
#include <lamina/morph.hpp>

#include "app/batch_run.hpp"
#include "app/report.hpp"

namespace lamina::app {

/// The mesh whose cells all meshes of a batch have.
struct MeshTemplate {
    Mesh mesh;
    std::string hash;
    MorphMap map;

    /// Reads the mesh. Throws what read_valid_mesh() throws.
    explicit MeshTemplate(const std::string& file);
};

/// Makes and writes the mesh of a job, and returns its record, also where it fails. `reference`: the template; null:
/// there is none. `digits`: the fingerprint of the job. `jobs`: how many run at a time, and share the memory that is
/// free. `strict`: whether warnings make it fail.
Json run_job(const BatchJob& job, const MeshTemplate* reference, const std::string& digits, unsigned jobs, bool strict);

}  // namespace lamina::app
