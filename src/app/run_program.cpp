#include "app/run_program.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <lamina/error.hpp>
#include <lamina/version.hpp>

#include "app/arguments.hpp"
#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/standard_output.hpp"

namespace lamina::app {

namespace {

/// What a run ends with.
struct Failure {
    ExitCode code;
    std::string line;
};

/// Prints it as one line, and returns the exit code.
int report(Failure failure) {
    std::replace(failure.line.begin(), failure.line.end(), '\n', ' ');
    std::fprintf(stderr, "lamina: error: %s\n", failure.line.c_str());  // needs no memory
    return static_cast<int>(failure.code);
}

/// Returns the name on the command line of an option that the library names as case files do.
std::string name_on_command_line(const std::string& key) {
    for (const auto& option : mesh_options())
        if (option.key() == key) return "option " + command_line_name(option);
    return key;
}

/// Returns the exception that is being handled.
Failure current_failure() {
    try {
        throw;
    } catch (const OptionError& error) {
        return {error.exit_code(), name_on_command_line(error.option()) + ": " + error.reason()};
    } catch (const Error& error) {
        return {error.exit_code(), error.what()};
    } catch (const std::bad_alloc&) {
        return {ExitCode::mesh_failed, "out of memory"};
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again)
            return {ExitCode::mesh_failed, "a thread cannot be started"};
        return {ExitCode::io_failed, error.what()};
    } catch (const std::exception& error) {
        return {ExitCode::mesh_failed, std::string("internal error: ") + error.what()};
    } catch (...) {
        return {ExitCode::mesh_failed, "internal error"};
    }
}

/// Ends the process where an exception has no other place to go: the thread library cannot hand on those of its own
/// threads that find no memory for the next one.
[[noreturn]] void end_at_once() {
    if (!std::current_exception()) std::abort();  // a bug
    std::_Exit(report(current_failure()));
}

/// Throws UsageError where several processes are asked for what only one of them can do.
void require_shared_command(const Ranks& ranks, const std::vector<std::string>& arguments) {
    if (ranks.size() == 1 || arguments.empty() || arguments.front().starts_with("-")) return;
    if (arguments.front() != "mesh")
        throw UsageError("several processes run 'lamina mesh' alone, not '" + arguments.front() + "'");
}

void run(const std::vector<std::string>& arguments, Ranks* ranks) {
    const std::string version = "lamina " LAMINA_VERSION;
    CLI::App app("Two-dimensional viscous meshes round airfoils", "lamina");
    app.set_version_flag("-V,--version", version);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done; 2 wrong usage; 3 bad input; 4 no valid mesh could be made, or a checked mesh is not "
        "as required; 5 reading or writing failed.");
    add_mesh_command(app, ranks);
    add_family_command(app);
    add_sizes_command(app);
    add_remesh_command(app);
    add_adapt_command(app);
    add_morph_command(app);
    add_batch_command(app);
    add_case_command(app);
    add_check_command(app);
    add_plot_command(app);
    add_view_command(app);
    add_convert_command(app);
    add_info_command(app);
    add_flow_command(app);
    add_polar_command(app);
    add_yplus_command(app);
    add_delaunay_command(app);
    add_completion_command(app);
    for (CLI::App* command : app.get_subcommands({})) command->set_version_flag("--version", version)->group("");
    if (ranks != nullptr) require_shared_command(*ranks, arguments);
    run_arguments(app, arguments);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw IoError("standard output", "cannot be written");
    if (ranks != nullptr) ranks->agree();
}

/// Makes a failure of this process known to all others. Returns the one that all end with.
Failure shared_failure(Ranks& ranks, const Failure& failure) {
    Failure known = failure;
    try {
        ranks.fail(failure.code, failure.line);
    } catch (const RankFailure& of_all) {
        known = {of_all.exit_code(), of_all.what()};
    }
    return known;
}

}  // namespace

int run_program(int argc, char** argv, Ranks* ranks) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the size limit then fails like a full disk
    std::signal(SIGPIPE, SIG_IGN);  // so does a pipe that nobody reads
    std::set_terminate(end_at_once);
    guard_closed_streams();
    try {
        run({argv + std::min(argc, 1), argv + argc}, ranks);
        return static_cast<int>(ExitCode::done);
    } catch (const RankFailure& failure) {
        if (ranks == nullptr || ranks->rank() == 0) report({failure.exit_code(), failure.what()});
        return static_cast<int>(failure.exit_code());
    } catch (...) {
        Failure failure = current_failure();
        if (ranks == nullptr) return report(std::move(failure));
        failure = shared_failure(*ranks, failure);
        if (ranks->rank() == 0) report(failure);
        return static_cast<int>(failure.code);
    }
}

}  // namespace lamina::app
