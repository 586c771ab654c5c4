// The table of the options of cases.
#include <lamina/option_builders.hpp>
#include <lamina/solver_case.hpp>

namespace lamina {

namespace {

OptionTable<SolverCaseOptions> make_solver_case_table() {
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
    return table.take();
}

}  // namespace

const OptionTable<SolverCaseOptions>& solver_case_option_table() {
    static const OptionTable<SolverCaseOptions> table = make_solver_case_table();
    return table;
}

}  // namespace lamina
