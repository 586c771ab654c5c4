// lamina completion: prints what a shell needs to complete the command line, and the manual page.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "app/command_facts.hpp"
#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/man_page.hpp"
#include "app/standard_output.hpp"
#include "core/option_builders.hpp"

namespace lamina::app {

namespace {

using Printer = std::string (*)(const std::vector<CommandFacts>&);

constexpr std::pair<const char*, Printer> printers[] = {
    {"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}, {"man", man_page}};

std::vector<std::string> printer_names() {
    std::vector<std::string> names;
    for (const auto& [name, print] : printers) names.emplace_back(name);
    return names;
}

void print_for(const CLI::App& app, const std::string& shell) {
    for (const auto& [name, print] : printers)
        if (shell == name) return print_result(print(facts_of_commands(app)));
    throw UsageError("SHELL: " + unknown_choice(shell, printer_names()));
}

}  // namespace

void add_completion_command(CLI::App& app) {
    CLI::App* command =
        add_command(app, "completion", "print the script that completes the command line in a shell, or the manual");
    auto shell = std::make_shared<std::string>();
    add_option(*command, "SHELL", *shell, "bash, zsh or fish; man prints the manual page instead")
        .required()
        .type_name("bash|zsh|fish|man");
    run_with(*command, [&app, shell] { print_for(app, *shell); });
}

}  // namespace lamina::app
