// lamina view: writes a page with a view of a mesh, and opens it in a browser.
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/page.hpp>

#include "app/check_report.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/page_text.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"

extern char** environ;

namespace lamina::app {

namespace {

struct ViewArguments {
    std::string mesh, format;
    std::string page;
    bool no_open = false;
};

/// Returns whether there is a screen on which a browser could show a page.
bool has_screen() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

/// Starts the program that the desktop opens such files with. The signals that this program ignores or blocks are as
/// usual there. Returns whether it could be started.
bool start_opener(const std::filesystem::path& file, pid_t& process) {
    std::string program = "xdg-open", name = std::filesystem::absolute(file).string();
    char* const arguments[] = {program.data(), name.data(), nullptr};
    sigset_t none, ignored;
    sigemptyset(&none);
    sigemptyset(&ignored);
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored, signal);
    posix_spawnattr_t attributes;
    if (posix_spawnattr_init(&attributes) != 0) return false;
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &ignored);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int failed = posix_spawnp(&process, program.c_str(), nullptr, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    return failed == 0;
}

/// Opens the file on the desktop. Returns whether that succeeded, as far as can be seen: some desktops run the browser
/// in the foreground, and nobody wants to wait for its end.
bool open_on_desktop(const std::filesystem::path& file) {
    constexpr std::chrono::milliseconds patience(3000), pause(20);
    pid_t process = 0;
    if (!start_opener(file, process)) return false;
    for (auto waited = std::chrono::milliseconds(0); waited < patience; waited += pause) {
        int status = 0;
        if (waitpid(process, &status, WNOHANG) == process) return status == 0;
        std::this_thread::sleep_for(pause);
    }
    return true;
}

/// Returns the name of the page of a mesh: in the working folder, with the stem of the mesh.
std::string name_of_page(const std::string& mesh) {
    if (is_standard_stream(mesh)) return "mesh.html";
    std::filesystem::path path = std::filesystem::path(mesh).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();  // a folder, with a slash at its end
    return path.stem().string() + ".html";
}

void view(const ViewArguments& arguments) {
    require_format(arguments.mesh, arguments.format, "--input-format");
    const std::string page = arguments.page.empty() ? name_of_page(arguments.mesh) : arguments.page;
    const std::vector<RunFile> outputs{{page, arguments.page.empty() ? "MESH" : "option --output"}};
    require_distinct(files_of_mesh(arguments.mesh, arguments.format), outputs);
    const SignalGuard guard(outputs);
    Mesh mesh = read_curved_mesh(arguments.mesh, {.format = arguments.format}).mesh;
    const RegionOrigin regions = require_regions(mesh);
    const Json report = check_report(mesh, check_file_mesh(mesh, regions), regions, {});
    for (Marker& marker : mesh.markers)
        if (may_be_wall(marker.kind)) marker.kind = MarkerKind::wall;
    const std::string title =
        is_standard_stream(arguments.mesh) ? "mesh" : std::filesystem::path(arguments.mesh).filename().string();
    write_page(mesh, page, page_of_mesh(title, mesh, report));
    if (is_standard_stream(page)) return;
    const bool opened = !arguments.no_open && has_screen() && open_on_desktop(page);
    print_result(page + (opened ? ": written and opened\n" : ": written\n"));
}

}  // namespace

void add_view_command(CLI::App& app) {
    CLI::App* command = add_command(app, "view", "write a page to zoom into a mesh, and open it in a browser");
    auto arguments = std::make_shared<ViewArguments>();
    add_option(*command, "MESH", arguments->mesh, "mesh file; - for standard input").required();
    add_input_format(*command, arguments->format);
    add_option(*command, "-o,--output", arguments->page,
               "HTML file to write; - for standard output; else the name of the mesh with .html, in the working "
               "folder")
        .type_name("FILE");
    add_flag(*command, "--no-open", arguments->no_open, "write the page, and do not open it");
    run_with(*command, [arguments] { view(*arguments); });
}

}  // namespace lamina::app
