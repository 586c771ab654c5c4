// One run of `lamina morph`: the same mesh round other shapes, once or for every time of a sequence.
#pragma once

#include <string>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/io.hpp>
#include <lamina/morph.hpp>

#include "app/morph_sequence.hpp"

namespace lamina::app {

struct MorphSettings {
    std::string mesh;                 ///< mesh file, or a case file, whose mesh is made first
    std::string mesh_format;          ///< of the mesh file; empty: by its name
    std::vector<std::string> shapes;  ///< airfoils that the bodies become; empty: theirs stay
    GeometryOptions geometry{};       ///< transformations of the bodies, or of the shapes
    std::string displacements;        ///< CSV file of displacements of wall vertices; empty: none
    SequenceArguments sequence{};     ///< turns in time; none: one mesh is made
    MorphOptions morph{};             ///< how far and in how many steps
    bool reconnect = false;           ///< whether triangles beyond the layer are made better afterwards
    std::string output;               ///< mesh file, folder of a case, or pattern with {step}
    WriteOptions write{};             ///< of the output
    std::string report;               ///< JSON file; empty: none
};

/// Moves the mesh, writes it and prints the summary. Throws UsageError unless the settings say in one way where the
/// walls go, and the errors of the stages.
void run_morph(const MorphSettings& settings);

}  // namespace lamina::app
