#include "app/option_hint.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/former_options.hpp>

#include "core/suggestion.hpp"

namespace lamina::app {

namespace {

/// A word of other programs, or of plain English. Words are in lower case, without hyphens and underscores. Those that
/// name options of meshes are found by option_elsewhere().
struct OtherWord {
    const char* word;
    const char* ours;              ///< the name of our option; empty: advice alone
    const char* advice = nullptr;  ///< a sentence in place of it
};

constexpr const char* inputs_have_no_option = "inputs are named without an option, as in lamina mesh FILE";

constexpr const char* no_structured_grids =
    "meshes are rows of cells along walls, --layer-topology quads leaves them whole, and triangles beyond";

constexpr OtherWord mesh_words[] = {
    {"cgrid", "", no_structured_grids},
    {"ogrid", "", no_structured_grids},
    {"hgrid", "", no_structured_grids},
    {"gridtype", "", no_structured_grids},
    {"unstructured", "", "all cells beyond the layer are triangles"},
    {"config", "", "a case file is an input: lamina mesh case.toml"},
    {"seed", "", "nothing is random: equal inputs give equal meshes"},
    {"naca", "", "a NACA section is an input: lamina mesh naca:0012"},
    {"airfoil", "", inputs_have_no_option},
    {"file", "", inputs_have_no_option},
    {"geometry", "", inputs_have_no_option},
    {"i", "", inputs_have_no_option},
    {"inputfile", "", inputs_have_no_option},
    {"input", "", inputs_have_no_option},
    {"2", "", "every mesh is two-dimensional"},
    {"force", "", "outputs are replaced without asking, and inputs never"},
    {"overwrite", "", "outputs are replaced without asking, and inputs never"},
    {"deflection", "", "--transform ELEMENT:flap:DEG:X,Y deflects a flap"},
    {"flap", "", "--transform ELEMENT:flap:DEG:X,Y deflects a flap"},
    {"mirror", "", "--transform ELEMENT:mirror[:Y] mirrors a section"},
    {"move", "", "--transform ELEMENT:shift:DX,DY moves a section"},
    {"rotate", "", "--transform ELEMENT:rotate:DEG[:X,Y] turns a section"},
    {"scale", "", "--transform ELEMENT:scale:S[:X,Y] scales a section"},
    {"shift", "", "--transform ELEMENT:shift:DX,DY moves a section"},
    {"translate", "", "--transform ELEMENT:shift:DX,DY moves a section"},
};

constexpr OtherWord flow_words[] = {
    {"aoa", "alpha"},
    {"angleofattack", "alpha"},
    {"incidence", "alpha"},
    {"re", "reynolds"},
    {"reynoldsnumber", "reynolds"},
    {"nu", "viscosity"},
    {"speed", "velocity"},
    {"uinf", "velocity"},
    {"cp", "picture"},
    {"plot", "picture"},
    {"csv", "output"},
    {"out", "output"},
    {"table", "output"},
    {"format", "", "tables are CSV, and the extension of a picture says its format"},
    {"naca", "", "a NACA section is an input: lamina flow naca:0012"},
};

constexpr OtherWord delaunay_words[] = {
    {"area", "max-area"},        {"quality", "min-angle"},     {"minimumangle", "min-angle"},
    {"convexhull", "keep-hull"}, {"nosteiner", "keep-border"}, {"out", "output"},
    {"json", "report"},          {"silent", "quiet"},
};

constexpr OtherWord check_words[] = {{"delaunay", "require-delaunay"},
                                     {"minimumangle", "min-angle"},
                                     {"output", "json"},
                                     {"o", "json"},
                                     {"report", "json"},
                                     {"farfield", "far"},
                                     {"format", "input-format"}};

constexpr OtherWord plot_words[] = {{"zoom", "window"},       {"view", "window"},
                                    {"xlim", "window"},       {"colorby", "color"},
                                    {"dpi", "width"},         {"resolution", "width"},
                                    {"size", "width"},        {"out", "output"},
                                    {"from", "input-format"}, {"inputformat", "input-format"}};

constexpr OtherWord convert_words[] = {{"to", "format"},
                                       {"outputformat", "format"},
                                       {"from", "input-format"},
                                       {"farfield", "far"},
                                       {"o", "", "the second argument is the output: lamina convert IN OUT"},
                                       {"output", "", "the second argument is the output: lamina convert IN OUT"}};

constexpr OtherWord command_words[] = {
    {"create", "mesh"},       {"generate", "mesh"}, {"grid", "mesh"},         {"make", "mesh"},
    {"run", "mesh"},          {"inspect", "info"},  {"describe", "info"},     {"quality", "check"},
    {"validate", "check"},    {"verify", "check"},  {"stats", "check"},       {"view", "plot"},
    {"chk", "check"},         {"cp", "flow"},       {"panel", "flow"},        {"polar", "flow"},
    {"potential", "flow"},    {"solve", "flow"},    {"xfoil", "flow"},        {"pslg", "delaunay"},
    {"draw", "plot"},         {"show", "plot"},     {"picture", "plot"},      {"export", "convert"},
    {"translate", "convert"}, {"cdt", "delaunay"},  {"triangle", "delaunay"}, {"triangulate", "delaunay"},
    {"setup", "case"},        {"solve", "case"},    {"refine", "delaunay"},
};

/// Returns whether a command takes the options of meshes, or some of them.
bool takes_mesh_options(const std::string& command) {
    return command == "mesh" || command == "family" || command == "batch" || command == "case" || command == "adapt";
}

std::span<const OtherWord> words_of_command(const std::string& command) {
    if (takes_mesh_options(command)) return mesh_words;
    if (command == "flow") return flow_words;
    if (command == "delaunay") return delaunay_words;
    if (command == "check") return check_words;
    if (command == "plot") return plot_words;
    if (command == "convert") return convert_words;
    return {};
}

/// Returns what the other word means, if the table has it.
Hint look_up(std::span<const OtherWord> words, const std::string& word) {
    const std::string letters = plain_word(word);
    for (const OtherWord& other : words)
        if (letters == other.word) return {other.ours, other.advice != nullptr ? other.advice : ""};
    return {};
}

/// Returns our options for the switches of Triangle, which follow one hyphen without blanks: -pq30a0.1.
std::string triangle_switches(const std::string& word) {
    std::vector<std::string> meanings;
    for (const char c : word.substr(1)) {
        if (c == 'q') meanings.emplace_back("q is --min-angle DEG");
        if (c == 'a') meanings.emplace_back("a is --max-area A");
        if (c == 'Y') meanings.emplace_back("Y is --keep-border");
        if (c == 'c') meanings.emplace_back("c is --keep-hull");
        if (c == 'Q') meanings.emplace_back("Q is --quiet");
        if (c == 'p') meanings.emplace_back("p is not needed for a .poly file");
    }
    if (meanings.empty()) return {};
    return fmt::format("of Triangle's switches, {}", fmt::join(meanings, ", "));
}

bool is_input(const std::string& word) {
    std::error_code ignored;
    const std::string extension = std::filesystem::path(word).extension().string();
    return plain_word(word).starts_with("naca") || extension == ".dat" || extension == ".toml" ||
           std::filesystem::exists(word, ignored);
}

}  // namespace

Hint hint_for_other_word(const std::string& command, const std::string& word) {
    if (takes_mesh_options(command) || command == "info")
        if (const FormerOption* former = find_former_option(word)) return {"", advice_on_command_line(*former)};
    Hint hint = look_up(words_of_command(command), word);
    if (hint.empty() && takes_mesh_options(command)) hint.name = option_elsewhere(word);
    const bool one_hyphen = word.starts_with('-') && !word.starts_with("--");
    if (hint.empty() && command == "delaunay" && one_hyphen) hint.advice = triangle_switches(word);
    return hint;
}

Hint hint_for_option(const std::string& command, const std::string& word, std::span<const std::string> options) {
    Hint hint = hint_for_other_word(command, word);
    return hint.empty() ? Hint{closest_word(word, options), ""} : hint;
}

Hint hint_for_command(const std::string& word, std::span<const std::string> commands) {
    if (Hint hint = look_up(command_words, word); !hint.empty()) return hint;
    if (is_input(word)) return {"mesh " + word, ""};
    return {closest_word(word, commands), ""};
}

std::string hint_text(const Hint& hint, const std::string& prefix) {
    if (!hint.advice.empty()) return ": " + hint.advice;
    return hint.name.empty() ? "" : ": did you mean " + prefix + hint.name + "?";
}

}  // namespace lamina::app
