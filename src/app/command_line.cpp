#include "app/command_line.hpp"

#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace lamina::app {

AddedOption AddedOption::required() const { return AddedOption(*option_->required()); }
AddedOption AddedOption::type_name(const std::string& name) const { return AddedOption(*option_->type_name(name)); }
AddedOption AddedOption::group(const std::string& heading) const { return AddedOption(*option_->group(heading)); }
AddedOption AddedOption::description(const std::string& help) const { return AddedOption(*option_->description(help)); }
AddedOption AddedOption::needs(const std::string& option) const { return AddedOption(*option_->needs(option)); }
AddedOption AddedOption::excludes(const std::string& option) const { return AddedOption(*option_->excludes(option)); }
AddedOption AddedOption::delimiter(char between) const { return AddedOption(*option_->delimiter(between)); }
AddedOption AddedOption::repeated() const {
    return AddedOption(*option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}
AddedOption AddedOption::one_at_a_time() const { return AddedOption(*option_->allow_extra_args(false)); }
AddedOption AddedOption::show_default() const { return AddedOption(*option_->capture_default_str()); }
AddedOption AddedOption::positive() const {
    return check([](const std::string& word) -> std::string {
               double value = 0;
               return CLI::detail::lexical_cast(word, value) && value > 0 ? "" : "must be > 0, not " + word;
           })
        .with_range("> 0");
}
AddedOption AddedOption::in_range(int lower, int upper) const {
    return AddedOption(*option_->check(CLI::Range(lower, upper).description("")))
        .with_range(fmt::format(">= {} and <= {}", lower, upper));
}
AddedOption AddedOption::in_range(std::size_t lower, std::size_t upper) const {
    return AddedOption(*option_->check(CLI::Range(lower, upper).description("")))
        .with_range(fmt::format(">= {} and <= {}", lower, upper));
}
AddedOption AddedOption::one_of(const std::vector<std::string>& words) const {
    return AddedOption(*option_->check(CLI::IsMember(words).description("")));
}
AddedOption AddedOption::with_range(const std::string& range) const {
    return description(option_->get_description() + "; " + range);
}
AddedOption AddedOption::check(std::function<std::string(const std::string& word)> fault) const {
    return AddedOption(*option_->check(std::move(fault), ""));
}

CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description) {
    return program.add_subcommand(name, description);
}

void run_with(CLI::App& command, std::function<void()> run) { command.callback(std::move(run)); }

void set_footer(CLI::App& command, const std::string& text) { command.footer(text); }

template <class Value>
AddedOption add_option(CLI::App& command, const std::string& names, Value& value, const std::string& help) {
    return AddedOption(*command.add_option(names, value, help));
}

template AddedOption add_option(CLI::App&, const std::string&, std::string&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, std::vector<std::string>&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, int&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, unsigned&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, std::uint64_t&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, double&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, std::vector<double>&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, std::optional<int>&, const std::string&);
template AddedOption add_option(CLI::App&, const std::string&, std::optional<double>&, const std::string&);

AddedOption add_option_with_or_without_value(CLI::App& command, const std::string& names,
                                             std::optional<std::string>& text, const std::string& help) {
    // Without a value, the option holds what a switch does.
    const auto set = [&text](const CLI::results_t& words) {
        text = words.empty() || words.front() == "true" ? "" : words.front();
        return true;
    };
    return AddedOption(*command.add_option(names, set, help)->expected(0, 1));
}

AddedOption add_flag(CLI::App& command, const std::string& names, bool& flag, const std::string& help) {
    return AddedOption(*command.add_flag(names, flag, help));
}

AddedOption add_text_flag(CLI::App& command, const std::string& names, std::string& text, const std::string& help) {
    return AddedOption(*command.add_flag_callback(
        names, [&text] { text = "true"; }, help));
}

AddedOption option_of(CLI::App& command, const std::string& name) { return AddedOption(*command.get_option(name)); }

}  // namespace lamina::app
