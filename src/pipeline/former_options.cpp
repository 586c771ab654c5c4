#include <lamina/former_options.hpp>

#include <algorithm>
#include <iterator>

#include <lamina/error.hpp>

#include "core/suggestion.hpp"

namespace lamina {

namespace {

constexpr const char* layer_is_in_pieces =
    "the program chooses the pieces of the layer, which never change its triangles";

constexpr const char *exact_points_argument = "--exact-points N", *exact_points_line = "exact_points = N",
                     *exact_points_reason =
                         "it takes the place of surface-points, too, and fixes the numbers of edges on bases and of "
                         "rays in fans";

constexpr FormerOption former_option_table[] = {
    {"surface-points-exact", exact_points_argument, exact_points_line, exact_points_reason},
    {"base-edges", exact_points_argument, exact_points_line, exact_points_reason},
    {"fan-rays", exact_points_argument, exact_points_line, exact_points_reason},
    {"flip", "--transform all:rotate:180 --transform all:mirror", "transform = [\"all:rotate:180\", \"all:mirror\"]",
     "they exchange left and right"},
    {"decomposition-depth", "", "", layer_is_in_pieces},
    {"leaf-vertices", "", "", layer_is_in_pieces},
    {"pieces-target", "", "", "subdomains have about 50,000 triangles"},
    {"separators", "", "", "borders between subdomains have edges as long as those of the triangles beside them"},
    {"options-as-markdown", "--help-all", "", "it describes all options, as docs/options.md does"},
};

std::string advice_of(const std::string& order, const FormerOption& option) { return order + ": " + option.reason; }

}  // namespace

std::span<const FormerOption> former_options() { return former_option_table; }

const FormerOption* find_former_option(const std::string& word) {
    const std::string letters = plain_word(word.substr(0, word.find('=')));
    const auto* const found = std::find_if(std::begin(former_option_table), std::end(former_option_table),
                                           [&](const FormerOption& o) { return plain_word(o.name) == letters; });
    return found == std::end(former_option_table) ? nullptr : found;
}

std::string advice_on_command_line(const FormerOption& option) {
    const std::string arguments = option.arguments;
    return advice_of(arguments.empty() ? "leave it out" : "give " + arguments, option);
}

std::string advice_in_file(const FormerOption& option) {
    const std::string line = option.line;
    return advice_of(line.empty() ? "delete it" : "write " + line, option);
}

void refuse_former_option(const std::string& key) {
    if (const FormerOption* option = find_former_option(key))
        throw OptionError(key, "no such option: " + advice_in_file(*option));
}

}  // namespace lamina
