// Reads a mesh in the format of LAMINA_FUZZ_FILES, a list of file names, the first of which is opened. What is read is
// checked, as `lamina check` does.
#include <array>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "fuzz/fuzz.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    constexpr auto names = std::to_array<std::string_view>({LAMINA_FUZZ_FILES});
    const InputFiles files(input, names);
    try {
        check_mesh(read_mesh(files.folder() / LAMINA_FUZZ_OPENED));
    } catch (const Error&) {
    }
}
