// Reads a coordinate file. What is accepted must pass check_simple().
#include <array>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>

#include "fuzz/fuzz.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    constexpr std::array<std::string_view, 1> names{"input.dat"};
    const InputFiles files(input, names);
    const std::vector<std::string> inputs{(files.folder() / names[0]).string()};
    try {
        const Geometry geometry = read_geometry(inputs);
        check_simple(geometry);
    } catch (const Error&) {
    }
}
