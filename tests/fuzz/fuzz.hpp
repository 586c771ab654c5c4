// Tools that all fuzz targets share. A target is a source that defines fuzz(). Built with libFuzzer it is fed with
// inputs that reach new code (./dev fuzz); built as a test it replays the inputs of its folder in corpus/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lamina::fuzz {

/// Runs the code under test on one input. Returns on success and on every error that the code is meant to report; any
/// other exception, an abort, a sanitizer's finding or a run without end is a defect.
void fuzz(std::span<const std::uint8_t> input);

/// Numbers from the bytes of an input. After the last byte all numbers are 0.
class Numbers {
public:
    explicit Numbers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool at_end() const { return bytes_.empty(); }
    /// Returns the next byte.
    unsigned byte();
    /// Returns a number from 0 to n - 1, made of one byte.
    std::size_t below(std::size_t n) { return byte() % n; }
    /// Returns a number in [low, high], made of two bytes.
    double real(double low, double high);
    /// Returns a coordinate. It is often a small integer, so that ties and collinear points are frequent, and
    /// sometimes of any magnitude.
    double coordinate();

private:
    std::span<const std::uint8_t> bytes_;
};

/// A folder in memory with the input as a file or, where the input is divided by form feeds, as several files.
class InputFiles {
public:
    /// Writes one file for each name. Missing parts of the input become empty files.
    InputFiles(std::span<const std::uint8_t> input, std::span<const std::string_view> names);
    ~InputFiles();
    InputFiles(const InputFiles&) = delete;
    InputFiles& operator=(const InputFiles&) = delete;

    const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
};

/// Aborts if a condition does not hold, in every build.
void require(bool condition, const char* what);

}  // namespace lamina::fuzz
