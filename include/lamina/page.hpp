// A mesh as a page to look at: one HTML file without a network or any other file, for browsers with WebGL 2.
//
// Guarantees:
//  1. Vertices and cells keep their numbers; coordinates are rounded to less than 2^-16 of the height of cells beside.
//  2. A page takes at most 12 bytes a triangle beyond the first 150 kilobytes.
// Limits:
//  1. Indices are in range, and coordinates finite. MeshError from 2^32 directed edges on.
// Example:
//     const Mesh mesh = generate_mesh({"naca:0012:60"}, {.layer = {.enabled = false}}).mesh;
//     assert(mesh_page(mesh, {.title = "NACA 0012"}).find("<title>NACA 0012") != std::string::npos);
#pragma once

#include <filesystem>

#include <lamina/mesh.hpp>

namespace lamina {

/// What a page says beside the mesh.
struct PageText {
    std::string title;         ///< its heading, in UTF-8
    std::string facts = "{}";  ///< a JSON object; share/page/page.js says which keys it shows
};

/// Returns a page with an interactive view of the mesh: zoom to the first cell, colours, numbers, histograms.
LAMINA_EXPORT std::string mesh_page(const Mesh& mesh, const PageText& text);
/// Writes this page, as write_file() does. Throws IoError, too.
LAMINA_EXPORT void write_page(const Mesh& mesh, const std::filesystem::path& file, const PageText& text);

}  // namespace lamina
