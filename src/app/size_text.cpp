#include "app/size_text.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "app/options.hpp"

namespace lamina::app {

namespace {

std::vector<double> parse_numbers(const std::string& text, char separator) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        numbers.push_back(parse_real(text.substr(at, end - at), "'" + text + "'"));
        if (!std::isfinite(numbers.back())) throw UsageError("'" + text + "': not a finite number");
        at = end + 1;
    }
    return numbers;
}

void require(bool condition, const std::string& text, const std::string& reason) {
    if (!condition) throw UsageError("'" + text + "': " + reason);
}

}  // namespace

WakeOptions parse_wake(const std::string& text) {
    const std::vector<double> numbers = parse_numbers(text, ':');
    require(numbers.size() <= 3, text, "a wake is ANGLE[:LENGTH[:SIZE]]");
    WakeOptions wake;
    wake.angle_deg = numbers[0];
    require(std::abs(wake.angle_deg) <= 360, text, "the angle must be from -360 to 360 degrees");
    if (numbers.size() > 1) wake.length = numbers[1];
    require(wake.length > 0, text, "the length must be > 0");
    if (numbers.size() > 2) wake.size = numbers[2];
    require(wake.size.value_or(1) > 0, text, "the size must be > 0");
    return wake;
}

std::string wake_text(const WakeOptions& wake) {
    const std::string text = fmt::format("{}:{}", wake.angle_deg, wake.length);
    return wake.size ? fmt::format("{}:{}", text, *wake.size) : text;
}

SizeSource parse_size_source(const std::string& text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string shape = text.substr(0, colon);
    const std::size_t wanted = shape == "box" || shape == "line" ? 5 : shape == "circle" ? 4 : 0;
    require(wanted > 0 && colon < text.size(), text,
            "a shape is box:X0,Y0,X1,Y1,H, circle:X,Y,R,H or line:X0,Y0,X1,Y1,H");
    const std::vector<double> n = parse_numbers(text.substr(colon + 1), ',');
    require(n.size() == wanted, text, fmt::format("a {} takes {} numbers, not {}", shape, wanted, n.size()));
    require(n.back() > 0, text, "the edge length must be > 0");
    if (shape == "circle") {
        require(n[2] > 0, text, "the radius must be > 0");
        return {.a = {n[0], n[1]}, .b = {n[0], n[1]}, .size = n[3], .radius = n[2]};
    }
    const Point a{n[0], n[1]}, b{n[2], n[3]};
    if (shape == "line") return {.a = a, .b = b, .size = n[4]};
    Box box;
    box.include(a);
    box.include(b);
    return {.a = box.lower, .b = box.upper, .size = n[4], .shape = SizeSource::Shape::box};
}

std::string size_source_text(const SizeSource& source) {
    const auto [a, b, size, radius, shape] = source;
    if (radius > 0) return fmt::format("circle:{},{},{},{}", a.x, a.y, radius, size);
    return fmt::format("{}:{},{},{},{},{}", shape == SizeSource::Shape::box ? "box" : "line", a.x, a.y, b.x, b.y, size);
}

std::vector<Point> parse_outline(const std::string& text) {
    const std::vector<double> n = parse_numbers(text, ',');
    require(n.size() >= 6 && n.size() % 2 == 0, text, "an outline is X0,Y0,X1,Y1,..., three corners or more");
    std::vector<Point> corners;
    for (std::size_t i = 0; i < n.size(); i += 2) corners.push_back({n[i], n[i + 1]});
    return corners;
}

std::string outline_text(const std::vector<Point>& corners) {
    std::string text;
    for (Point p : corners) text += fmt::format("{}{},{}", text.empty() ? "" : ",", p.x, p.y);
    return text;
}

}  // namespace lamina::app
