// The rounds of `lamina adapt`: what is known about each, and their page.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <fmt/format.h>

#include "app/adapt_solver.hpp"

namespace lamina::app {

/// A round that is complete.
struct AdaptRound {
    std::size_t vertices = 0, cells = 0;
    SolvedForces forces;
    double seconds = 0;
};

/// Returns a number as text, or `none` where there is none.
std::string optional_text(const auto& number, const char* none = "") {
    return number ? fmt::format("{}", *number) : none;
}

/// Returns a page in HTML without scripts: forces against the numbers of vertices, a table, and links to the pages of
/// the meshes, round_N/mesh.html.
std::string adapt_page(const std::string& title, std::span<const AdaptRound> rounds);

}  // namespace lamina::app
