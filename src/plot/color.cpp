#include "plot/color.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lamina::plot {

Color mix(Color a, Color b, double t) { return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)}; }

Color viridis(double t) {
    static constexpr Color entries[] = {{0.267, 0.005, 0.329}, {0.279, 0.175, 0.483}, {0.230, 0.322, 0.546},
                                        {0.173, 0.449, 0.558}, {0.128, 0.567, 0.551}, {0.158, 0.684, 0.502},
                                        {0.369, 0.789, 0.383}, {0.678, 0.864, 0.190}, {0.993, 0.906, 0.144}};
    constexpr int last = static_cast<int>(std::size(entries)) - 1;
    const double at = std::clamp(t, 0.0, 1.0) * last;
    const int i = std::min(static_cast<int>(at), last - 1);
    return mix(entries[i], entries[i + 1], at - i);
}

Color distinct_color(std::uint32_t number) {
    const double hue = std::fmod(number * 0.6180339887498949, 1.0);
    const auto channel = [&](double shift) {
        const double distance = std::abs(std::fmod(hue + shift, 1.0) * 6 - 3) - 1;
        return 1 - 0.34 * (1 - std::clamp(distance, 0.0, 1.0));
    };
    return {channel(0), channel(2.0 / 3), channel(1.0 / 3)};
}

}  // namespace lamina::plot
