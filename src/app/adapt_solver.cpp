#include "app/adapt_solver.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/remesh.hpp>
#include <lamina/transfer.hpp>

#include "app/case_file.hpp"
#include "app/child_process.hpp"
#include "app/mesh_run.hpp"
#include "app/report.hpp"
#include "app/solver_case_run.hpp"

namespace lamina::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* log_name = "log.solver";

void require_program(const std::string& word) {
    if (find_program(word).empty())
        throw UsageError(fmt::format("option --solver: {} {}", word,
                                     word.find('/') == std::string::npos ? "is not in PATH" : "cannot be run"));
}

void require_finite(const SolvedForces& forces, const fs::path& file) {
    if (!std::isfinite(forces.cl) || !std::isfinite(forces.cd))
        throw IoError(file.string(), "the solution has diverged: forces are not finite numbers");
}

/// Returns a number of a report; nothing where there is none of this name.
std::optional<double> number_of(const Json& report, const char* key) {
    if (!report.is_object() || !report.contains(key) || !report[key].is_number()) return {};
    return report[key].get<double>();
}

/// Returns the largest of the y+ of the walls in a report; nothing where there is none.
std::optional<double> largest_y_plus(const Json& report) {
    std::optional<double> largest;
    if (!report.is_object() || !report.contains("y_plus")) return largest;
    for (const Json& wall : report["y_plus"])
        if (const std::optional<double> of_wall = number_of(wall, "largest"))
            largest = std::max(largest.value_or(*of_wall), *of_wall);
    return largest;
}

/// Returns a number as a count; nothing where it is none.
std::optional<std::size_t> count_of(const std::optional<double>& number) {
    constexpr double most = 1e15;  // whole numbers up to here have one double each
    if (!number || !(*number >= 0 && *number <= most)) return {};
    return static_cast<std::size_t>(*number);
}

/// Returns the number that fills a text, whatever the locale; nothing where it is none.
std::optional<double> number_in(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

/// A table of numbers in text. Names of its columns stand in the first line, or in the last line that begins with #.
class NumberTable {
public:
    NumberTable(const fs::path& file, char divider) {
        std::istringstream lines(read_file(file));
        for (std::string line; std::getline(lines, line);) {
            const bool is_comment = line.starts_with('#');
            if (is_comment || names_.empty())
                names_ = fields_of(line.substr(is_comment ? 1 : 0), divider);
            else if (!line.empty())
                last_ = fields_of(line, divider);
        }
    }

    /// Returns the text in the last line; empty where there is no such column.
    std::string last(const std::string& name) const {
        const auto found = std::find(names_.begin(), names_.end(), name);
        const auto i = static_cast<std::size_t>(found - names_.begin());
        return i < last_.size() ? last_[i] : "";
    }
    std::optional<double> last_number(const std::string& name) const { return number_in(last(name)); }

private:
    static std::vector<std::string> fields_of(const std::string& line, char divider) {
        std::vector<std::string> fields;
        if (divider == ' ') {
            std::istringstream words(line);
            for (std::string word; words >> word;) fields.push_back(word);
            return fields;
        }
        std::istringstream parts(line);
        for (std::string part; std::getline(parts, part, divider);) {
            std::erase_if(part, [](char c) { return c == ' ' || c == '"' || c == '\t' || c == '\r'; });
            fields.push_back(part);
        }
        return fields;
    }

    std::vector<std::string> names_, last_;
};

/// A solver that lamina writes cases for.
class KnownSolver : public AdaptSolver {
public:
    KnownSolver(FlowSolver solver, const SolverCaseOptions& options) : solver_(solver), options_(options) {}

    void require_programs() const override {
        if (solver_ == FlowSolver::su2) return require_program("SU2_CFD");
        for (const char* program : {"simpleFoam", "renumberMesh"}) require_program(program);
        if (options_.adjoint) require_program("adjointOptimisationFoam");
        if (options_.compressible) require_program("rhoSimpleFoam");
    }
    std::vector<std::string> usual_fields() const override {
        if (solver_ == FlowSolver::su2) return {"Mach", "Pressure"};
        return {"mag(U)", "p"};
    }
    std::string velocity(const fs::path&) const override { return solver_ == FlowSolver::su2 ? "Momentum" : "U"; }
    std::string command() const override { return "Allrun"; }
    void prepare(MeshCase& mesh_case) override { prepare_case(solver_, options_, mesh_case); }
    std::vector<Warning> warnings(const MeshResult& result) const override {
        return warnings_of_case(solver_, result, options_);
    }
    void write_case(const MeshResult& result, const MeshCase& mesh_case, const fs::path& folder) const override {
        write_solver_case(solver_, result.mesh, solver_conditions(result, mesh_case.options), folder, options_);
    }
    void start_from(const fs::path& solved, const SolvedForces& forces, const fs::path& folder) const override {
        start_case_from(solver_, solved, folder, forces.cl);
    }
    SolvedForces run(const fs::path& folder, SignalGuard& guard) const override {
        constexpr int not_steady = 2;
        const fs::path log = folder / log_name;
        const int code = run_program_in(folder, {fs::absolute(folder / "Allrun").string()}, log, guard);
        if (code != 0 && code != not_steady)
            throw IoError(log.string(), fmt::format("the solver ended with exit code {}", code));
        const fs::path file = folder / "result.json";
        const Json result = Json::parse(read_file(file), nullptr, false);
        SolvedForces forces;
        forces.cl = number_of(result, "CL").value_or(NAN);
        forces.cd = number_of(result, "CD").value_or(NAN);
        forces.cm = number_of(result, "CM");
        forces.y_plus = largest_y_plus(result);
        require_finite(forces, file);
        forces.steady = code == 0;
        forces.iterations = count_of(number_of(result, "iterations"));
        forces.residual = residual(folder);
        if (options_.adjoint) find_adjoint(folder, guard);
        return forces;
    }
    Solution read(const fs::path& folder, const std::vector<std::string>& fields) const override {
        if (solver_ == FlowSolver::su2) return read_solution(folder / "restart_flow.dat", fields, folder / "mesh.vtu");
        return read_solution(folder, fields);
    }

private:
    void find_adjoint(const fs::path& folder, SignalGuard& guard) const {
        const fs::path log = folder / "log.adjoint";
        const int code = run_program_in(folder, {fs::absolute(folder / "Alladjoint").string()}, log, guard);
        if (code != 0) throw IoError(log.string(), fmt::format("the adjoint solver ended with exit code {}", code));
    }
    std::optional<double> residual(const fs::path& folder) const {
        if (solver_ == FlowSolver::su2) return NumberTable(folder / "history.csv", ',').last_number("rms[Rho]");
        // The last block of iterations has the folder of the largest number.
        std::map<double, fs::path> blocks;
        std::error_code ignored;
        for (const fs::directory_entry& entry :
             fs::directory_iterator(folder / "postProcessing" / "residuals", ignored))
            if (const auto first = number_in(entry.path().filename().string()))
                blocks[*first] = entry.path() / "solverInfo.dat";
        if (blocks.empty() || !fs::exists(blocks.rbegin()->second, ignored)) return {};
        const auto value = NumberTable(blocks.rbegin()->second, ' ').last_number("p_initial");
        return value && *value > 0 ? std::optional(std::log10(*value)) : std::nullopt;
    }

    FlowSolver solver_;
    SolverCaseOptions options_;
};

/// Any program.
class CommandSolver : public AdaptSolver {
public:
    explicit CommandSolver(const std::string& command) : words_(split_command(command, "option --solver")) {}

    void require_programs() const override { require_program(words_.front()); }
    std::vector<std::string> usual_fields() const override { return {"Mach", "Pressure"}; }
    std::string velocity(const fs::path& folder) const override {
        const std::vector<std::string> fields = solution_fields(solution_in(folder));
        for (const char* name : {"Velocity", "U", "Momentum"})
            if (std::find(fields.begin(), fields.end(), std::string(name) + ":x") != fields.end()) return name;
        return "";
    }
    std::string command() const override { return fmt::format("{}", fmt::join(words_, " ")); }
    void prepare(MeshCase&) override {}
    std::vector<Warning> warnings(const MeshResult&) const override { return {}; }
    void write_case(const MeshResult& result, const MeshCase& mesh_case, const fs::path& folder) const override {
        write_mesh(result.mesh, folder / "mesh.su2");
        write_file(folder / "case.toml", dump_case(mesh_case));
    }
    void start_from(const fs::path& solved, const SolvedForces&, const fs::path& folder) const override {
        const fs::path file = solution_in(solved);
        const Solution solution = read_solution(file, solution_fields(file), solved / "mesh.vtu");
        Solution start{read_mesh(folder / "mesh.vtu"), {}};
        start.fields = transfer(solution, start.mesh);
        write_solution(start, folder / "start.vtu");
    }
    SolvedForces run(const fs::path& folder, SignalGuard& guard) const override {
        std::vector<std::string> words = words_;
        words.front() = find_program(words.front()).string();
        const std::string mark = "{case}", place = fs::absolute(folder).string();
        for (std::string& word : words)
            for (std::size_t at = 0; (at = word.find(mark, at)) != std::string::npos; at += place.size())
                word.replace(at, mark.size(), place);
        const fs::path log = folder / log_name, file = folder / "forces.csv";
        const int code = run_program_in(folder, words, log, guard);
        if (code != 0) throw IoError(log.string(), fmt::format("the solver ended with exit code {}", code));
        for (const fs::path& needed : {file, solution_in(folder)})
            if (!fs::exists(needed)) throw IoError(needed.string(), "the solver has not left this file");
        const NumberTable table(file, ',');
        SolvedForces forces;
        forces.cl = table.last_number("CL").value_or(NAN);
        forces.cd = table.last_number("CD").value_or(NAN);
        forces.cm = table.last_number("CM");
        forces.y_plus = table.last_number("y_plus");
        require_finite(forces, file);
        const std::string steady = table.last("steady");
        forces.steady = steady != "0" && steady != "false" && steady != "no";
        forces.iterations = count_of(table.last_number("iterations"));
        forces.residual = table.last_number("residual");
        return forces;
    }
    Solution read(const fs::path& folder, const std::vector<std::string>& fields) const override {
        return read_solution(solution_in(folder), fields, folder / "mesh.vtu");
    }

private:
    static fs::path solution_in(const fs::path& folder) {
        std::error_code ignored;
        const fs::path cgns = folder / "solution.cgns";
        return fs::exists(cgns, ignored) ? cgns : folder / "solution.vtu";
    }

    std::vector<std::string> words_;
};

}  // namespace

std::unique_ptr<AdaptSolver> adapt_solver(const std::string& name, const SolverCaseOptions& options) {
    if (name == "pyfr") throw UsageError("option --solver: solutions of pyfr are not read: take openfoam or su2");
    for (const auto& [known, solver] : flow_solvers())
        if (known == name) return std::make_unique<KnownSolver>(solver, options);
    return std::make_unique<CommandSolver>(name);
}

}  // namespace lamina::app
