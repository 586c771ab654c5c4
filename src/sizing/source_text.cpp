// Reads and writes the texts of size sources and wakes: "box:0,-1,3,1,0.05", "10:2:0.01".
#include <lamina/sizing.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <lamina/option_builders.hpp>

#include "core/text.hpp"

namespace lamina {

using core::require_text;

WakeOptions parse_wake(const std::string& text) {
    const std::vector<std::string> parts = core::split(text, ':');
    require_text(parts.size() <= 3, text, "a wake is ANGLE[:LENGTH[:SIZE]]");
    WakeOptions wake;
    if (parts[0] != auto_word) wake.angle_deg = core::parse_number(parts[0]);
    require_text(std::abs(wake.angle_deg.value_or(0)) <= 360, text, "the angle must be from -360 to 360 degrees");
    if (parts.size() > 1) wake.length = parse_length(parts[1]);
    require_text(wake.length.value > 0, text, "the length must be > 0");
    if (parts.size() > 2) wake.size = parse_length(parts[2]);
    require_text(wake.size.value_or(1).value > 0, text, "the size must be > 0");
    return wake;
}

std::string wake_text(const WakeOptions& wake) {
    const std::string angle = wake.angle_deg ? core::to_text(*wake.angle_deg) : auto_word;
    const std::string text = core::concat(angle, ":", length_text(wake.length));
    return wake.size ? core::concat(text, ":", length_text(*wake.size)) : text;
}

SizeSource parse_size_source(const std::string& text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string shape = text.substr(0, colon);
    const std::size_t count = shape == "box" || shape == "line" ? 5 : shape == "circle" ? 4 : 0;
    require_text(count > 0 && colon < text.size(), text,
                 "a shape is box:X0,Y0,X1,Y1,H, circle:X,Y,R,H or line:X0,Y0,X1,Y1,H");
    const std::vector<double> numbers = core::parse_numbers(text.substr(colon + 1), ',');
    require_text(numbers.size() == count, text,
                 core::concat("a ", shape, " takes ", count, " numbers, not ", numbers.size()));
    require_text(numbers.back() > 0, text, "the edge length must be > 0");
    if (shape == "circle") {
        require_text(numbers[2] > 0, text, "the radius must be > 0");
        return {.a = {numbers[0], numbers[1]}, .b = {numbers[0], numbers[1]}, .size = numbers[3], .radius = numbers[2]};
    }
    const Point a{numbers[0], numbers[1]}, b{numbers[2], numbers[3]};
    if (shape == "line") return {.a = a, .b = b, .size = numbers[4]};
    Box box;
    box.include(a);
    box.include(b);
    return {.a = box.lower, .b = box.upper, .size = numbers[4], .shape = SizeSource::Shape::box};
}

std::string size_source_text(const SizeSource& source) {
    const auto [a, b, size, radius, shape] = source;
    if (radius > 0) return core::concat("circle:", a.x, ",", a.y, ",", radius, ",", size);
    return core::concat(shape == SizeSource::Shape::box ? "box:" : "line:", a.x, ",", a.y, ",", b.x, ",", b.y, ",",
                        size);
}

}  // namespace lamina
