// The files under share/page, which the program holds.
#pragma once

#include <span>
#include <string_view>

namespace lamina::page {

/// The page itself, with marks where the rest goes: @title@, @style@, @facts@, @mesh@, @script@.
extern const std::string_view html;
extern const std::string_view style;
/// The modules, which one behind the other are one module: none of them imports or exports anything.
extern const std::span<const std::string_view> modules;

}  // namespace lamina::page
