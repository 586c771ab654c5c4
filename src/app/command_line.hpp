// The command line as commands declare it. CLI11 reads it; its headers take more time to compile than most commands, so
// few sources include them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lamina::app {

/// An option or an argument that was added to a command. Each function says one thing more of it.
class AddedOption {
public:
    explicit AddedOption(CLI::Option& option) : option_(&option) {}

    AddedOption required() const;                            ///< it must be given
    AddedOption type_name(const std::string& name) const;    ///< what stands for its value in help
    AddedOption group(const std::string& heading) const;     ///< its heading in help
    AddedOption description(const std::string& help) const;  ///< in place of the one that it was added with
    AddedOption needs(const std::string& option) const;      ///< the option of this name must be given, too
    AddedOption excludes(const std::string& option) const;   ///< the option of this name must not be given
    AddedOption delimiter(char between) const;               ///< what parts values that are given together
    AddedOption repeated() const;                            ///< all values of an option that takes one at a time count
    AddedOption one_at_a_time() const;                       ///< further words are no further values
    AddedOption show_default() const;                        ///< help shows the value that it has now
    AddedOption positive() const;                            ///< the value must be above 0, as help says then
    AddedOption in_range(int lower, int upper) const;        ///< the value must be one of these
    AddedOption in_range(std::size_t lower, std::size_t upper) const;  ///< the same
    AddedOption one_of(const std::vector<std::string>& words) const;   ///< the value must be one of these
    /// `fault` returns why a word is no value of it; nothing where it is one.
    AddedOption check(std::function<std::string(const std::string& word)> fault) const;

private:
    CLI::Option* option_;

    AddedOption with_range(const std::string& range) const;  ///< help ends with the values that it takes
};

/// Adds a command to the program.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description);
/// Says what runs when the command is named.
void run_with(CLI::App& command, std::function<void()> run);
/// Sets what help prints at its end.
void set_footer(CLI::App& command, const std::string& text);

/// Adds an option, with its names in the form of CLI11 ("-o,--output"), or an argument ("MESH"). `value` receives what
/// is given: a text, a number, an optional one, or a list.
template <class Value>
AddedOption add_option(CLI::App& command, const std::string& names, Value& value, const std::string& help);
/// Adds an option whose value may be left out: `text` is empty then, and has no value where the option is not given.
AddedOption add_option_with_or_without_value(CLI::App& command, const std::string& names,
                                             std::optional<std::string>& text, const std::string& help);
/// Adds an option without a value; `flag` receives whether it is given.
AddedOption add_flag(CLI::App& command, const std::string& names, bool& flag, const std::string& help);
/// Adds an option without a value; `text` becomes "true" where it is given.
AddedOption add_text_flag(CLI::App& command, const std::string& names, std::string& text, const std::string& help);
/// Returns an option that was added before. Precondition: the command has it.
AddedOption option_of(CLI::App& command, const std::string& name);

}  // namespace lamina::app
