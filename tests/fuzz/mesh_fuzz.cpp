// Reads a mesh in the format of LAMINA_FUZZ_FILES, a list of file names, the first of which is opened. What is read is
// checked, as `lamina check` does.
#include <array>

#include <lamina/curved_mesh.hpp>
#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "fuzz/fuzz.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    constexpr auto names = std::to_array<std::string_view>({LAMINA_FUZZ_FILES});
    const InputFiles files(input, names);
    try {
        const CurvedMesh read = read_curved_mesh(files.folder() / LAMINA_FUZZ_OPENED);
        if (check_mesh(read.mesh).valid() && read.nodes.order > 1) check_curved(read.mesh, read.nodes);
    } catch (const Error&) {
    }
}
