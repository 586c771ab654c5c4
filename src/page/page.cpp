// Fills in the page of a mesh.
#include <lamina/page.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <lamina/files.hpp>

#include "core/markup.hpp"
#include "page/packed_mesh.hpp"
#include "page/parts.hpp"

namespace lamina::page {

namespace {

/// Returns JSON that no browser takes for the end of the element that it stands in.
std::string escaped_json(std::string_view json) {
    std::string escaped;
    for (const char c : json) {
        if (c == '<') {
            escaped += "\\u003c";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

/// Source: RFC 4648, section 4.
std::string base64(std::string_view bytes) {
    static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t group = 0;
        const std::size_t count = bytes.size() - at < 3 ? bytes.size() - at : 3;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0u);
        for (std::size_t i = 0; i < 4; ++i) text += i <= count ? digits[group >> (18 - 6 * i) & 63] : '=';
    }
    return text;
}

/// Returns the text with the marks @name@ replaced, in their order.
std::string filled(std::string_view text, std::initializer_list<std::pair<std::string_view, std::string_view>> marks) {
    std::string page;
    for (const auto& [mark, value] : marks) {
        const std::size_t at = text.find(mark);
        page.append(text.substr(0, at)).append(value);
        text.remove_prefix(at + mark.size());
    }
    return page.append(text);
}

}  // namespace

}  // namespace lamina::page

namespace lamina {

std::string mesh_page(const Mesh& mesh, const PageText& text) {
    using namespace lamina::page;
    std::string script;
    for (const std::string_view module : modules) script += module;
    return filled(html, {{"@title@", core::escaped_markup(text.title)},
                         {"@style@", style},
                         {"@facts@", escaped_json(text.facts)},
                         {"@mesh@", base64(pack_mesh(mesh))},
                         {"@script@", script}});
}

void write_page(const Mesh& mesh, const std::filesystem::path& file, const PageText& text) {
    check_folder_writable(file);
    write_file(file, mesh_page(mesh, text));
}

}  // namespace lamina
