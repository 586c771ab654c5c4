#include "app/case_file.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/former_options.hpp>
#include <lamina/version.hpp>

#include "app/option_hint.hpp"
#include "app/options.hpp"
#include "app/presets.hpp"

namespace lamina::app {

namespace {

/// Returns whether the text stands for something else than a file: a NACA section, standard input or standard output.
bool is_no_path(const std::string& text) { return text.starts_with("naca:") || is_standard_stream(text); }

bool holds_paths(const Option<MeshCase>& option) {
    return option.kind == OptionKind::path || option.kind == OptionKind::paths;
}

/// Returns the value with `change` applied to each of its paths. Names of NACA sections and "-" are no paths.
template <class Change>
OptionValue with_paths(OptionValue value, Change change) {
    const auto apply = [&](std::string& text) {
        if (!text.empty() && !is_no_path(text)) text = change(std::filesystem::path(text)).string();
    };
    if (auto* text = std::get_if<std::string>(&value)) apply(*text);
    if (auto* texts = std::get_if<std::vector<std::string>>(&value)) std::for_each(texts->begin(), texts->end(), apply);
    return value;
}

/// Returns the value of a key. Numbers in an array become words, unless its entries are paths.
OptionValue value_of(const toml::node& node, const std::string& origin, bool are_paths) {
    if (const auto* flag = node.as_boolean()) return flag->get();
    if (const auto* count = node.as_integer()) return count->get();
    if (const auto* real = node.as_floating_point()) return real->get();
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* array = node.as_array()) {
        std::vector<std::string> texts;
        for (const toml::node& entry : *array) {
            if (const auto* text = entry.as_string())
                texts.push_back(text->get());
            else if (entry.is_number() && !are_paths)
                texts.push_back(to_text(value_of(entry, origin, are_paths)));
            else
                throw UsageError(origin + ": an array holds strings");
        }
        return texts;
    }
    throw UsageError(origin + ": must be a number, a string, true, false or an array of strings");
}

/// Returns the position behind the TOML string that begins at `at`, or where it is not closed, behind its line or the
/// text.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const bool multi_line = text.substr(at).starts_with(std::string(3, quote));
    for (at += multi_line ? 3 : 1; at < text.size(); ++at) {
        if (text[at] == '\\' && quote == '"') {
            ++at;
        } else if (!multi_line && (text[at] == quote || text[at] == '\n')) {
            return at + 1;
        } else if (multi_line && text.substr(at).starts_with(std::string(3, quote))) {
            return at + 3;
        }
    }
    return text.size();
}

/// Throws InputError where a key has more parts ("a.b.c") than any could have. The library makes a table of each part
/// and destroys nested tables by recursion, which exhausts the stack; what brackets nest it limits itself.
void require_shallow_keys(std::string_view text, const std::filesystem::path& file) {
    constexpr std::size_t max_dots = 8;
    constexpr std::string_view ends_key = "\n=,[]{}";
    std::size_t line = 1, dots = 0;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            const std::size_t end = end_of_string(text, at);
            line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                        text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
            at = end;
            continue;
        }
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (c == '\n') ++line;
        dots = ends_key.find(c) != std::string_view::npos ? 0 : dots + (c == '.' ? 1 : 0);
        if (dots > max_dots)
            throw InputError({file.string(), line, std::nullopt},
                             fmt::format("a key of more than {} parts: options have one", max_dots));
        ++at;
    }
}

toml::table parse(const std::filesystem::path& file) {
    const std::string text = read_file(file, max_text_bytes);
    require_shallow_keys(text, file);
    try {
        return toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        throw InputError({file.string(), error.source().begin.line, std::nullopt},
                         "not valid TOML: " + std::string(error.description()));
    }
}

/// Returns the key that an unknown key probably means, or what serves in place of one that is gone, as the end of a
/// message.
std::string hint_for_key(std::string_view key) {
    if (const FormerOption* former = find_former_option(std::string(key))) return ": " + advice_in_file(*former);
    std::vector<std::string> names;
    for (const Option<MeshCase>& option : mesh_options()) names.push_back(option.name);
    Hint hint = hint_for_option("mesh", std::string(key), names);
    hint.name = option_key(hint.name);
    return hint_text(hint, "");
}

std::string toml_text(const OptionValue& value) {
    if (const auto* real = std::get_if<double>(&value))
        return fmt::to_string(*real);  // the shortest text that reads back
    std::ostringstream out;
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) {
        toml::array array;
        for (const std::string& text : *texts) array.push_back(text);
        out << array;
    } else if (const auto* text = std::get_if<std::string>(&value)) {
        out << toml::value(*text);
    } else {
        out << to_text(value);
    }
    return out.str();
}

}  // namespace

MeshCase read_case_file(const std::filesystem::path& file, const std::optional<std::string>& preset,
                        bool has_reynolds) {
    const toml::table table = parse(file);
    for (const char* option : reynolds_options) has_reynolds = has_reynolds || table.contains(option);
    MeshCase mesh_case =
        case_of_preset(preset.value_or(table[preset_option].value_or<std::string>(automatic_preset)), has_reynolds);
    for (const auto& [key, node] : table) {
        const std::string_view name = key.str();
        const std::string origin = fmt::format("{}:{}: {}", file.string(), key.source().begin.line, name);
        const auto& options = mesh_options();
        const auto option =
            std::find_if(options.begin(), options.end(), [name](const Option<MeshCase>& o) { return o.key() == name; });
        if (option == options.end()) throw UsageError(origin + ": no such option" + hint_for_key(name));

        OptionValue value = value_of(node, origin, holds_paths(*option));
        if (holds_paths(*option)) {
            value = with_paths(std::move(value), [&](const auto& path) { return file.parent_path() / path; });
        }
        assign(*option, mesh_case, value, origin);
    }
    if (mesh_case.inputs.empty() && mesh_case.options.geometry.sheets.empty())
        throw UsageError(file.string() + ": no input");
    mesh_case.case_file = file.string();
    return mesh_case;
}

std::string dump_case(const MeshCase& mesh_case) {
    std::string text = fmt::format("# lamina {}\n", LAMINA_VERSION);
    std::string_view group;
    for (const Option<MeshCase>& option : mesh_options()) {
        if (option.group != group) text += fmt::format("\n# {}\n", group = option.group);
        std::optional<OptionValue> value = option.get(mesh_case);
        if (!value) {
            text += fmt::format("# {} is not set\n", option.key());
            continue;
        }
        if (holds_paths(option)) {
            value = with_paths(*std::move(value), [](const auto& path) { return std::filesystem::absolute(path); });
        }
        text += fmt::format("{} = {}\n", option.key(), toml_text(*value));
    }
    return text;
}

}  // namespace lamina::app
