// Writes a mesh of five million triangles in each format, and as many bytes without any computation for comparison. The
// files go to the folder LAMINA_BENCH_FOLDER, or else to the folder for temporary files, so the times include its disk.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

namespace fs = std::filesystem;

const Mesh& large_mesh() {
    static const Mesh mesh = test::annulus({.around = 2500, .rings = 1000, .layer_rings = 300});
    return mesh;
}

fs::path make_folder() {
    const char* given = std::getenv("LAMINA_BENCH_FOLDER");
    const fs::path folder =
        (given ? fs::path(given) : fs::temp_directory_path()) / ("lamina-bench-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    return folder;
}

std::uintmax_t bytes_in(const fs::path& folder) {
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) bytes += entry.file_size();
    return bytes;
}

void make_empty(const fs::path& folder) {
    fs::remove_all(folder);
    fs::create_directories(folder);
}

void write_plain_bytes(const fs::path& file, std::uintmax_t bytes) {
    const std::string block(std::size_t{1} << 20, 'x');
    std::ofstream out(file, std::ios::binary);
    for (std::uintmax_t written = 0; written < bytes; written += block.size())
        out.write(block.data(), static_cast<std::streamsize>(block.size()));
}

/// Measures the writing of one format. The counter `plain` is the time to write as many bytes without any computation,
/// in seconds.
void write(benchmark::State& state, const MeshFormat& format) {
    const fs::path folder = make_folder();
    const std::string& extension = format.extensions.front();
    const fs::path file = folder / (extension.starts_with('.') ? "m" + extension : extension);
    double plain = 0;
    std::uintmax_t bytes = 0;
    for (auto _ : state) {
        state.PauseTiming();
        make_empty(folder);
        state.ResumeTiming();
        write_mesh(large_mesh(), file, {.format = format.name});
        state.PauseTiming();
        bytes = bytes_in(folder);
        make_empty(folder);
        const auto start = std::chrono::steady_clock::now();
        write_plain_bytes(folder / "plain", bytes);
        plain += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        state.ResumeTiming();
    }
    fs::remove_all(folder);
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
    state.counters["plain"] = plain / static_cast<double>(state.iterations());
}

[[maybe_unused]] const bool registered = [] {
    for (const MeshFormat& format : mesh_formats())
        benchmark::RegisterBenchmark(("write/" + format.name).c_str(),
                                     [format](benchmark::State& state) { write(state, format); })
            ->Unit(benchmark::kSecond)
            ->UseRealTime()
            ->Iterations(3);
    return true;
}();

}  // namespace
}  // namespace lamina
