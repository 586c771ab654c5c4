// Reads a metric, in the format of LAMINA_FUZZ_OPENED.
#include <array>

#include <lamina/error.hpp>
#include <lamina/metric.hpp>

#include "fuzz/fuzz.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    constexpr std::array<std::string_view, 1> names{LAMINA_FUZZ_OPENED};
    const InputFiles files(input, names);
    try {
        read_metric(files.folder() / names[0]);
    } catch (const Error&) {
    }
}
