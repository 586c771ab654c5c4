// The program: reads the command line, runs one command, and turns an error into one line and an exit code.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include <lamina/error.hpp>
#include <lamina/version.hpp>

#include "app/arguments.hpp"
#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/standard_output.hpp"

namespace lamina::app {

namespace {

/// Prints an error as one line, and returns the exit code.
int report_error(ExitCode code, std::string line) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::fprintf(stderr, "lamina: error: %s\n", line.c_str());  // needs no memory
    return static_cast<int>(code);
}

/// Returns the name on the command line of an option that the library names as case files do.
std::string name_on_command_line(const std::string& key) {
    for (const auto& option : mesh_options())
        if (option.key() == key) return "option " + command_line_name(option);
    return key;
}

/// Prints the exception that is being handled as one line, and returns the exit code.
int report_current_error() {
    try {
        throw;
    } catch (const OptionError& error) {
        return report_error(error.exit_code(), name_on_command_line(error.option()) + ": " + error.reason());
    } catch (const Error& error) {
        return report_error(error.exit_code(), error.what());
    } catch (const std::bad_alloc&) {
        return report_error(ExitCode::mesh_failed, "out of memory");
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again)
            return report_error(ExitCode::mesh_failed, "a thread cannot be started");
        return report_error(ExitCode::io_failed, error.what());
    } catch (const std::exception& error) {
        return report_error(ExitCode::mesh_failed, std::string("internal error: ") + error.what());
    } catch (...) {
        return report_error(ExitCode::mesh_failed, "internal error");
    }
}

/// Ends the process where an exception has no other place to go: the thread library cannot hand on those of its own
/// threads that find no memory for the next one.
[[noreturn]] void end_at_once() {
    if (!std::current_exception()) std::abort();  // a bug
    std::_Exit(report_current_error());
}

}  // namespace

}  // namespace lamina::app

int main(int argc, char** argv) {
    using namespace lamina;
    using namespace lamina::app;
    std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the size limit then fails like a full disk
    std::signal(SIGPIPE, SIG_IGN);  // so does a pipe that nobody reads
    std::set_terminate(end_at_once);
    guard_closed_streams();
    try {
        const std::string version = "lamina " LAMINA_VERSION;
        CLI::App app("Two-dimensional viscous meshes round airfoils", "lamina");
        app.set_version_flag("-V,--version", version);
        app.require_subcommand(1);
        app.footer(
            "Exit codes: 0 done; 2 wrong usage; 3 bad input; 4 no valid mesh could be made, or a checked mesh is not "
            "as required; 5 reading or writing failed.");
        add_mesh_command(app);
        add_family_command(app);
        add_sizes_command(app);
        add_batch_command(app);
        add_case_command(app);
        add_check_command(app);
        add_plot_command(app);
        add_view_command(app);
        add_convert_command(app);
        add_info_command(app);
        add_flow_command(app);
        add_delaunay_command(app);
        add_completion_command(app);
        for (CLI::App* command : app.get_subcommands({})) command->set_version_flag("--version", version)->group("");
        run_arguments(app, {argv + std::min(argc, 1), argv + argc});
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw IoError("standard output", "cannot be written");
        return static_cast<int>(ExitCode::done);
    } catch (...) {
        return report_current_error();
    }
}
