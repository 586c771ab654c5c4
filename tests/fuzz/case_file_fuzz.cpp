// Reads a case file. The dump of what is accepted must be read back.
#include <array>
#include <fstream>

#include <lamina/error.hpp>

#include "app/case_file.hpp"
#include "fuzz/fuzz.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    constexpr std::array<std::string_view, 1> names{"case.toml"};
    const InputFiles files(input, names);
    const std::filesystem::path file = files.folder() / names[0];
    try {
        const std::string dumped = app::dump_case(app::read_case_file(file));
        std::ofstream(file, std::ios::binary | std::ios::trunc) << dumped;
        require(app::dump_case(app::read_case_file(file)) == dumped, "a dumped case is not read back");
    } catch (const Error&) {
    }
}
