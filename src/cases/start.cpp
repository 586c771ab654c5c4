// The flow of a solved case as the start of another one.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/solution.hpp>
#include <lamina/solver_case.hpp>
#include <lamina/transfer.hpp>

#include "core/temporary_folder.hpp"
#include "io/formats.hpp"
#include "io/su2_restart.hpp"

namespace lamina::cases {

namespace fs = std::filesystem;

namespace {

/// A file of 0/, which has a uniform field.
struct InitialField {
    fs::path file;
    std::string name, text;
    bool is_vector = false;
};

std::vector<InitialField> initial_fields(const fs::path& folder) {
    std::vector<InitialField> fields;
    for (const std::string& name : core::names_in(folder / "0")) {
        const fs::path file = folder / "0" / name;
        InitialField field{file, name, read_file(file)};
        field.is_vector = field.text.find("volVectorField") != std::string::npos;
        fields.push_back(std::move(field));
    }
    if (fields.empty()) throw IoError((folder / "0").string(), "holds no fields of a case");
    std::sort(fields.begin(), fields.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return fields;
}

/// Returns the text with a list of values in place of its uniform field.
std::string with_values(const InitialField& field, const std::vector<std::vector<double>>& components) {
    const std::size_t begin = field.text.find("internalField"), end = field.text.find(';', begin);
    if (end == std::string::npos) throw InputError({field.file.string(), 0, {}}, "no internalField");
    const std::size_t cells = components.front().size();
    std::string list =
        fmt::format("internalField   nonuniform List<{}>\n{}\n(\n", field.is_vector ? "vector" : "scalar", cells);
    for (std::size_t i = 0; i < cells; ++i)
        list += field.is_vector ? fmt::format("({} {} 0)\n", components[0][i], components[1][i])
                                : fmt::format("{}\n", components[0][i]);
    return field.text.substr(0, begin) + list + ")\n" + field.text.substr(end);
}

void start_openfoam(const fs::path& solved, const fs::path& folder, double lift) {
    const std::vector<InitialField> fields = initial_fields(folder);
    std::vector<std::string> names;
    for (const InitialField& field : fields)
        for (const char* part : field.is_vector ? std::vector{":x", ":y"} : std::vector{""})
            names.push_back(field.name + part);
    const io::NumberedCells cells = io::read_numbered_openfoam(folder);
    const std::vector<SolutionField> carried = transfer(read_solution(solved, names), cells.mesh);
    std::size_t next = 0;
    for (const InitialField& field : fields) {
        std::vector<std::vector<double>> components;
        for (int part = 0; part < (field.is_vector ? 2 : 1); ++part) {
            const std::vector<double>& values = carried[next++].values;
            std::vector<double>& by_number = components.emplace_back(values.size());
            for (std::size_t i = 0; i < values.size(); ++i) by_number[cells.numbers[i]] = values[i];
        }
        write_file(field.file, with_values(field, components));
    }
    write_file(folder / "system/start", fmt::format("{}\n", lift));
}

void start_su2(const fs::path& solved, const fs::path& folder) {
    const fs::path file = solved / "restart_flow.dat";
    io::Su2Restart restart = io::read_su2_restart(file);
    const std::vector<std::string> names = restart.names;
    const Solution solution = io::with_mesh(std::move(restart), read_mesh(solved / "mesh.su2"), file);
    const Mesh mesh = read_mesh(folder / "mesh.su2");
    io::Su2Restart start{names, {{}, {}}};
    for (const Point p : mesh.points) {
        start.values[0].push_back(p.x);
        start.values[1].push_back(p.y);
    }
    for (SolutionField& field : transfer(solution, mesh)) start.values.push_back(std::move(field.values));
    io::write_su2_restart(start, folder / "start_flow.dat");
}

}  // namespace

}  // namespace lamina::cases

namespace lamina {

void start_case_from(FlowSolver solver, const std::filesystem::path& solved, const std::filesystem::path& folder,
                     double lift) {
    if (solver == FlowSolver::su2)
        cases::start_su2(solved, folder);
    else
        cases::start_openfoam(solved, folder, lift);
}

}  // namespace lamina
