// A mesh as a page to look at: one HTML file that needs neither a network nor any other file.
#pragma once

#include <filesystem>
#include <string>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

namespace lamina {

/// This is what a page says beside the mesh.
struct PageText {
    std::string title;         ///< its heading, in UTF-8
    std::string facts = "{}";  ///< a JSON object; share/page/page.js says which keys it shows
};

/// Returns a page with an interactive view of the mesh, in a browser with WebGL 2: zoom from the far field to the first
/// cell, colours, numbers of cells and wall vertices, histograms. Vertices and cells keep their numbers; coordinates are
/// rounded to less than 2^-16 of the smallest height of the cells beside. The page takes at most
/// 12 bytes a triangle beyond the first 150 kilobytes. Precondition: all indices are in range, and coordinates are
/// finite. Throws MeshError from 2^32 directed edges on.
LAMINA_EXPORT std::string mesh_page(const Mesh& mesh, const PageText& text);

/// Writes this page. The file gets a temporary name beside the target and is renamed; "-" is standard output. Throws
/// IoError, too.
LAMINA_EXPORT void write_page(const Mesh& mesh, const std::filesystem::path& file, const PageText& text);

}  // namespace lamina
