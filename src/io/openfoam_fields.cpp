// Reads the fields of an OpenFOAM case in ASCII or binary. Source: OpenFOAM user guide, "Boundaries", "Basic
// input/output file format".
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "io/foam_words.hpp"
#include "io/formats.hpp"
#include "io/number_text.hpp"
#include "io/plane_of_extrusion.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// Values of all cells, in the order of their numbers.
struct CellValues {
    std::vector<double> values;
    std::size_t components = 1;
    bool uniform = false;  ///< whether one tuple stands for all cells
};

double read_component(FoamWords& in) { return in.number<double>("value"); }

void read_tuple(FoamWords& in, std::size_t components, std::vector<double>& values) {
    if (components == 1) return values.push_back(read_component(in));
    in.expect("(");
    for (std::size_t i = 0; i < components; ++i) values.push_back(read_component(in));
    in.expect(")");
}

/// Leaves out the rest of an entry: up to its semicolon, or its closing brace.
void skip_entry(FoamWords& in) {
    int depth = 0;
    for (std::string_view word; !(word = in.next()).empty();) {
        if (word == "{") ++depth;
        if (word == "}") --depth;
        if (depth == 0 && (word == ";" || word == "}")) return;
    }
    in.fail("no internalField");
}

CellValues read_values(const fs::path& file) {
    FoamWords in(file);
    const std::string type = in.read_header(true);
    CellValues result;
    if (type == "volVectorField")
        result.components = 3;
    else if (type != "volScalarField")
        in.fail(fmt::format("class volScalarField or volVectorField expected, found '{}'", type));
    for (std::string_view key; (key = in.next()) != "internalField";) {
        if (key.empty()) in.fail("no internalField");
        skip_entry(in);
    }
    const std::string_view kind = in.next();
    result.uniform = kind == "uniform";
    if (!result.uniform && kind != "nonuniform") in.fail("'uniform' or 'nonuniform' expected");
    std::size_t count = 1;
    if (!result.uniform) {
        in.next();  // List<scalar> or List<vector>
        count = in.begin_list("number of values", result.components == 1 ? std::string_view("0 ").size()
                                                                         : std::string_view("(0 0 0)").size());
    }
    if (!result.uniform && in.is_binary()) {
        result.values = in.binary_numbers(count * result.components);
        in.expect(")");
        return result;
    }
    result.values.reserve(count * result.components);
    for (std::size_t i = 0; i < count; ++i) read_tuple(in, result.components, result.values);
    if (!result.uniform) in.expect(")");
    return result;
}

std::optional<double> time_of(const fs::path& folder) { return parse_whole<double>(folder.filename().string()); }

/// Returns the folder of the latest time of a case, or the folder itself where it has none.
fs::path latest_time(const fs::path& folder) {
    fs::path latest = folder;
    double latest_time = -HUGE_VAL;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        const std::optional<double> time = entry.is_directory(ignored) ? time_of(entry.path()) : std::nullopt;
        if (!time || *time <= latest_time) continue;
        latest = entry.path();
        latest_time = *time;
    }
    return latest;
}

/// Returns the folder without the separators that the user may have typed behind its name.
fs::path without_separators(const fs::path& folder) { return folder.has_filename() ? folder : folder.parent_path(); }

}  // namespace

Solution read_openfoam_solution(const fs::path& folder, std::span<const FieldRequest> fields, const fs::path& mesh) {
    const fs::path time = latest_time(without_separators(folder));
    NumberedCells cells = read_numbered_openfoam(mesh.empty() ? fs::absolute(time).parent_path() : mesh);
    Solution solution{std::move(cells.mesh), {}};
    for (const FieldRequest& request : fields) {
        const fs::path file = time / request.array;
        std::error_code ignored;
        if (!fs::exists(file, ignored))
            throw UsageError(fmt::format("{}: no field '{}'", time.string(), request.array));
        const CellValues read = read_values(file);
        const std::vector<double> all = part_of(request, read.values, read.components);
        if (!read.uniform && all.size() != cells.cells_in_files)
            throw InputError({file.string(), 0, {}},
                             fmt::format("{} values where the mesh has {} cells", all.size(), cells.cells_in_files));
        SolutionField field{request.name, true, {}};
        field.values = read.uniform ? std::vector<double>(cells.numbers.size(), all[0]) : values_at(all, cells.numbers);
        solution.fields.push_back(std::move(field));
    }
    return solution;
}

}  // namespace lamina::io
