// The dense matrices that the factor of a sparse symmetric system is made of.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lamina::morphing {

/// The columns of a supernode, with all rows of its columns and those below them: column by column. Above the diagonal
/// are numbers of no meaning.
struct Panel {
    std::span<double> values;
    std::size_t rows, columns;
};

/// Factors the columns of a panel in its place, into D on the diagonal and L of L D L' below it, and subtracts their
/// products from the matrix of the rows and columns below it, which is given column by column, on and below the
/// diagonal. Returns false where a pivot is not positive. Each number gets its products one after the other, by
/// ascending columns: on any machine and any number of threads it is the same.
bool factor_panel(Panel panel, std::vector<double>& below);

}  // namespace lamina::morphing
