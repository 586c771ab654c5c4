// Values of C++ as values of JavaScript, and back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <emscripten/val.h>

#include <lamina/option.hpp>
#include <lamina/point.hpp>

namespace lamina::web {

/// Returns a typed array with a copy of `count` numbers, which JavaScript owns.
template <class Number>
emscripten::val copied(const Number* numbers, std::size_t count) {
    return emscripten::val(emscripten::typed_memory_view(count, numbers)).template call<emscripten::val>("slice");
}

/// Returns the numbers of a typed array.
template <class Number>
std::vector<Number> numbers_of(const emscripten::val& array) {
    return emscripten::convertJSArrayToNumberVector<Number>(array);
}

/// Returns the strings of an array.
std::vector<std::string> strings_of(const emscripten::val& array);

/// Returns the value of an option. Throws OptionError for values that are neither boolean, nor number, nor text, nor an
/// array of texts.
OptionValue option_value_of(const emscripten::val& value, const std::string& option);

emscripten::val to_javascript(const std::vector<std::string>& strings);
emscripten::val to_javascript(const std::optional<OptionValue>& value);  ///< null where there is none
emscripten::val to_javascript(Point p);                                  ///< [x, y]
emscripten::val to_javascript(const std::optional<Point>& p);            ///< null where there is none

}  // namespace lamina::web
