// What makes the table of an options struct of its rows. The file that has the rows holds
//
//     template <>
//     OptionTable<PlotOptions> option_rows() {...}
//     template LAMINA_EXPORT const OptionTable<PlotOptions>& option_table();
#pragma once

#include <lamina/export.hpp>

#include "core/option_builders.hpp"

namespace lamina {

/// Returns the rows of a table.
template <class Options>
OptionTable<Options> option_rows();

template <class Options>
const OptionTable<Options>& option_table() {
    static const OptionTable<Options> table = option_rows<Options>();
    return table;
}

}  // namespace lamina
