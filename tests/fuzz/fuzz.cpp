#include "fuzz/fuzz.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <unistd.h>

namespace lamina::fuzz {

unsigned Numbers::byte() {
    if (bytes_.empty()) return 0;
    const unsigned first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
}

double Numbers::real(double low, double high) {
    // In this order with every compiler, so that a corpus means the same inputs.
    const unsigned high_byte = byte(), low_byte = byte();
    return low + (high - low) * ((high_byte << 8 | low_byte) / 65535.0);
}

double Numbers::coordinate() {
    const unsigned kind = byte();
    if (kind < 128) return static_cast<double>(kind % 16);
    if (kind < 240) return real(-20, 20);
    const double mantissa = real(-1, 1);
    return std::ldexp(mantissa, static_cast<int>(byte()) - 128);
}

InputFiles::InputFiles(std::span<const std::uint8_t> input, std::span<const std::string_view> names) {
    // Files in memory: millions of them are written.
    const std::filesystem::path memory = "/dev/shm";
    const auto base = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    folder_ = base / ("lamina-fuzz-" + std::to_string(::getpid()));
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    std::size_t begin = 0;
    for (const std::string_view name : names) {
        const std::size_t end = names.size() == 1 ? text.size() : std::min(text.find('\f', begin), text.size());
        const std::filesystem::path file = folder_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text.substr(begin, end - begin);
        begin = std::min(end + 1, text.size());
    }
}

InputFiles::~InputFiles() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "fuzz: %s\n", what);
    std::abort();
}

}  // namespace lamina::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    lamina::fuzz::fuzz({data, size});
    return 0;
}
