#include "values.hpp"

#include <cmath>
#include <cstdint>
#include <variant>

#include <lamina/error.hpp>

namespace lamina::web {

using emscripten::val;

std::vector<std::string> strings_of(const val& array) { return emscripten::vecFromJSArray<std::string>(array); }

OptionValue option_value_of(const val& value, const std::string& option) {
    constexpr double largest_count = 9007199254740992.0;  // beyond it, numbers of JavaScript leave out whole numbers
    const std::string type = value.typeOf().as<std::string>();
    if (type == "boolean") return value.as<bool>();
    if (type == "string") return value.as<std::string>();
    if (type == "number") {
        const auto number = value.as<double>();
        if (number == std::floor(number) && std::abs(number) <= largest_count) return static_cast<std::int64_t>(number);
        return number;
    }
    if (value.isArray()) return strings_of(value);
    throw OptionError(option, "must be a number, a word, true, false or a list of words");
}

val to_javascript(const std::vector<std::string>& strings) {
    val array = val::array();
    for (const std::string& text : strings) array.call<void>("push", text);
    return array;
}

val to_javascript(const std::optional<OptionValue>& value) {
    if (!value) return val::null();
    return std::visit(
        [](const auto& held) {
            using Held = std::decay_t<decltype(held)>;
            if constexpr (std::is_same_v<Held, std::vector<std::string>>)
                return to_javascript(held);
            else if constexpr (std::is_same_v<Held, std::int64_t>)
                return val(static_cast<double>(held));
            else
                return val(held);
        },
        *value);
}

val to_javascript(Point p) {
    val pair = val::array();
    pair.set(0, p.x);
    pair.set(1, p.y);
    return pair;
}

val to_javascript(const std::optional<Point>& p) { return p ? to_javascript(*p) : val::null(); }

}  // namespace lamina::web
