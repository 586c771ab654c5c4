// The table of the options of cases.
#include <lamina/solver_case.hpp>

#include "core/option_rows.hpp"

namespace lamina {

template <>
OptionTable<SolverCaseOptions> option_rows() {
    OptionTableBuilder<SolverCaseOptions> table("Case");
    table.choice("turbulence",
                 "turbulence model: Spalart-Allmaras (sa, from a Reynolds number of 1e4 on), k-omega SST, or none "
                 "(laminar, below)",
                 Choices<TurbulenceModel>{{"sa", TurbulenceModel::spalart_allmaras},
                                          {"komega-sst", TurbulenceModel::k_omega_sst},
                                          {"laminar", TurbulenceModel::laminar}},
                 member_at(&SolverCaseOptions::turbulence));
    table.flag("overwrite", "replace files of the folder that have the names of files of the case", true,
               member_at(&SolverCaseOptions::overwrite));
    table.flag("unsteady", "solve in time, for flow that sheds vortices: behind a bluff body or a stalled section",
               true, member_at(&SolverCaseOptions::unsteady));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<SolverCaseOptions>& option_table();

}  // namespace lamina
