// Reads a background mesh with sizes, in the format of LAMINA_FUZZ_OPENED.
#include <array>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "fuzz/fuzz.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    constexpr std::array<std::string_view, 1> names{LAMINA_FUZZ_OPENED};
    const InputFiles files(input, names);
    try {
        const SizedMesh sized = read_sizes(files.folder() / names[0]);
        for (const double size : sized.sizes) require(size > 0, "a size is not positive");
    } catch (const Error&) {
    }
}
