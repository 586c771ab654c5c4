#include "app/transition_options.hpp"

#include "app/table_option.hpp"

namespace lamina::app {

void add_transition_options(CLI::App& command, std::map<std::string, std::string>& texts) {
    for (const char* name : {"ncrit", "trip", "trip-lower"})
        add_table_option(command, option_table<TransitionOptions>(), name, texts[name]).group("Transition");
}

TransitionOptions transition_options(const std::map<std::string, std::string>& texts) {
    TransitionOptions options;
    for (const auto& [name, text] : texts) set_by_name(option_table<TransitionOptions>(), name, text, options);
    return options;
}

}  // namespace lamina::app
