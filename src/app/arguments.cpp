#include "app/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <lamina/error.hpp>

#include "app/option_hint.hpp"

namespace lamina::app {

namespace {

/// Returns the arguments with the options for the words that stand for them: help, help COMMAND, version.
std::vector<std::string> with_options_for_words(std::vector<std::string> arguments) {
    if (arguments.empty()) throw UsageError("no command (see lamina --help)");
    if (arguments.front() == "version") arguments.front() = "--version";
    if (arguments.front() != "help") return arguments;
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
    return arguments;
}

/// Where --help asks for the short help of a command, takes its further options out of it; --help-all becomes --help.
void choose_help(CLI::App& app, std::vector<std::string>& arguments) {
    const auto all = std::find(arguments.begin(), arguments.end(), "--help-all");
    if (all != arguments.end()) {
        *all = "--help";
        return;
    }
    if (std::none_of(arguments.begin(), arguments.end(),
                     [](const std::string& word) { return word == "--help" || word == "-h"; }))
        return;
    for (CLI::App* command : app.get_subcommands({})) {
        std::size_t further = 0;
        for (CLI::Option* option : command->get_options()) {
            if (!option->get_group().ends_with(further_options)) continue;
            option->group("");
            ++further;
        }
        if (further > 0)
            command->footer("lamina " + command->get_name() + " --help-all shows " + std::to_string(further) +
                            " further options.\n\n" + command->get_footer());
    }
}

/// Throws UsageError for unknown commands, for which CLI11 would say that the command is missing.
void require_known_command(const CLI::App& app, const std::string& command) {
    if (command.starts_with("-")) return;
    std::vector<std::string> names;
    std::string known;
    for (const CLI::App* each : app.get_subcommands({})) {
        if (each->get_name() == command) return;
        if (each->get_group().empty()) continue;
        names.push_back(each->get_name());
        known += (known.empty() ? "" : ", ") + each->get_name();
    }
    throw UsageError("command '" + command + "' is not known" + hint_text(hint_for_command(command, names), "lamina ") +
                     " (known: " + known + ")");
}

std::string help_hint(const CLI::App& app) {
    std::string command = app.get_name();
    for (const CLI::App* named : app.get_subcommands()) command += " " + named->get_name();
    return " (see " + command + " --help)";
}

std::vector<std::string> long_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back(name);
    return names;
}

/// Returns the name of the command that has this option; empty where none has it.
std::string command_with(const CLI::App& app, const std::string& option) {
    for (const CLI::App* command : app.get_subcommands({}))
        for (const std::string& name : long_names(*command))
            if (option == "--" + name) return command->get_name();
    return {};
}

/// Returns what was probably meant by an option that the command in use does not have.
std::string unknown_option_hint(const CLI::App& app, const std::string& option) {
    const std::vector<CLI::App*> used = app.get_subcommands();
    if (used.empty()) return {};
    const std::string word = option.substr(0, option.find('=')), command = used.front()->get_name();
    Hint hint = hint_for_other_word(command, word);
    if (const std::string other = command_with(app, word); hint.empty() && !other.empty())
        hint.advice = "it belongs to lamina " + other;
    if (hint.empty()) hint = hint_for_option(command, word, long_names(*used.front()));
    return hint_text(hint, "--");
}

/// Throws UsageError where the command line holds what no option and no argument of the command took.
void require_known_arguments(const CLI::App& app) {
    const std::vector<std::string> extras = app.remaining(true);
    if (extras.empty()) return;
    const std::string& extra = extras.front();
    if (!extra.starts_with("-")) throw UsageError("unexpected argument " + extra + help_hint(app));
    throw UsageError("unknown option " + extra + unknown_option_hint(app, extra) + help_hint(app));
}

/// Returns what an option takes, for messages: "no or yes" where it has choices, else what stands for it in the help.
std::string values_of(const CLI::Option& option) {
    std::string text = option.get_type_name();
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += std::strlen(" or "))
        text.replace(at, 1, " or ");
    return text;
}

/// Throws UsageError where an option that wants a value is followed by the name of an option of the same command, or by
/// nothing. CLI11 would take that name for the value, and the next value for an input, and so it would with the word
/// behind
/// --report=, an input that the report would replace. Numbers such as -5, and - for standard streams, are no names. Arguments
/// behind -- are not looked at.
void require_values(const CLI::App& app, const std::vector<std::string>& arguments) {
    const CLI::App* command = nullptr;
    for (const CLI::App* each : app.get_subcommands({}))
        if (each->get_name() == arguments.front()) command = each;
    if (command == nullptr) return;
    const auto option_named = [&](const std::string& word) -> const CLI::Option* {
        return word.size() > 1 && word.starts_with("-") ? command->get_option_no_throw(word) : nullptr;
    };
    const std::string help = fmt::format(" (see {} {} --help)", app.get_name(), command->get_name());
    for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--"; ++i) {
        const bool is_empty = arguments[i].ends_with('=');
        const std::string name = arguments[i].substr(0, arguments[i].size() - (is_empty ? 1 : 0));
        const CLI::Option* option = option_named(name);
        if (option == nullptr || option->get_items_expected_min() == 0) continue;
        if (is_empty) throw UsageError(fmt::format("{}: the value is empty{}", name, help));
        const std::string following = i + 1 < arguments.size() ? arguments[i + 1] : "";
        if (i + 1 < arguments.size() && option_named(following.substr(0, following.find('='))) == nullptr) {
            ++i;  // the value
            continue;
        }
        throw UsageError(fmt::format("{} wants a value: {}{}", name, values_of(*option), help));
    }
}

/// Returns whether two texts are the same value: the same text, or the same number.
bool are_one_value(const std::string& a, const std::string& b) {
    const auto number_of = [](const std::string& text) {
        double number = NAN;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        return error == std::errc{} && end == text.data() + text.size() ? number : NAN;
    };
    return a == b || number_of(a) == number_of(b);  // NaN equals nothing
}

/// Makes empty values errors, such as those of shell variables that are not set: no option has an empty value.
void refuse_empty_values(CLI::Option& option) {
    option.check([](const std::string& text) { return text.empty() ? "the value is empty" : ""; }, "");
}

/// Makes it an error where an option that holds one value is given again with another one, of which one would be lost.
void refuse_second_values(CLI::Option& option) {
    if (option.get_items_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll)
        return;
    option.multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    const auto first = std::make_shared<std::optional<std::string>>();
    option.check(
        [first](const std::string& text) -> std::string {
            if (!*first) *first = text;
            if (are_one_value(**first, text)) return {};
            return "it holds one value and is given two, '" + **first + "' and '" + text + "'";
        },
        "");
}

/// Adds these checks to all options. A flag has a value, too: --close=false.
void check_values(CLI::App& app) {
    for (CLI::App* command : app.get_subcommands({}))
        for (CLI::Option* option : command->get_options()) {
            if (option->get_items_expected_max() > 0) refuse_empty_values(*option);
            refuse_second_values(*option);
        }
}

/// Returns the reason of an error of CLI11, which says "Could not convert: --jobs = -1" of values that are no numbers.
std::string reason_of(const CLI::ParseError& error) {
    std::string text = error.what();
    const std::string beginning = "Could not convert: ", divider = " = ";
    const std::size_t end = text.find(divider);
    if (!text.starts_with(beginning) || end == std::string::npos) return text;
    return "option " + text.substr(beginning.size(), end - beginning.size()) + ": '" +
           text.substr(end + divider.size()) + "' is no number that it takes";
}

}  // namespace

void run_arguments(CLI::App& app, std::vector<std::string> arguments) {
    arguments = with_options_for_words(std::move(arguments));
    choose_help(app, arguments);
    check_values(app);
    require_known_command(app, arguments.front());
    require_values(app, arguments);
    std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 takes
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
        // CLI11 names a missing argument first. An unknown option is more often the reason, as in --out for -o.
        if (error.get_exit_code() != 0) require_known_arguments(app);
        if (error.get_exit_code() != 0) throw UsageError(reason_of(error) + help_hint(app));
        app.exit(error);  // prints the answer to --help or --version
    }
}

}  // namespace lamina::app
