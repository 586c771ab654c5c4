// Prints what numbers become as text, and texts as numbers: one hash for each thousand of them. Compiled natively and
// to WebAssembly, it must print the same (numbers.mjs).
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

namespace {

/// The generator SplitMix64. Source: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014.
struct Generator {
    std::uint64_t state = 0;
    std::uint64_t operator()() {
        std::uint64_t z = state += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
};

/// The hash FNV-1a.
struct Hash {
    std::uint64_t value = 0xcbf29ce484222325;
    void add(const void* data, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            value = (value ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3;
    }
};

void add_texts(Hash& hash, double number) {
    char text[400];
    const auto add = [&](std::to_chars_result result) {
        if (result.ec == std::errc{})
            hash.add(text, static_cast<std::size_t>(result.ptr - text) + 1);
        else
            hash.add("too long", 8);
    };
    for (char& c : text) c = ' ';
    add(std::to_chars(text, text + 24, number));
    add(std::to_chars(text, text + 30, number, std::chars_format::scientific, 16));
    add(std::to_chars(text, text + 30, number, std::chars_format::scientific, 1));
    add(std::to_chars(text, text + 30, number, std::chars_format::general, 17));
    add(std::to_chars(text, text + 400, number, std::chars_format::fixed, 2));
}

void add_number(Hash& hash, const std::string& text) {
    double number = 7;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::uint64_t facts[] = {std::bit_cast<std::uint64_t>(number), static_cast<std::uint64_t>(end - text.data()),
                                   error == std::errc{}, error == std::errc::result_out_of_range};
    hash.add(facts, sizeof facts);
}

std::string random_text(Generator& generator, double number) {
    char text[64];
    const char* rest[] = {"", " x", "e", "e+", ".", ",5"};
    const int digits = static_cast<int>(generator() % 20) + 1;
    const int length = std::snprintf(text, sizeof text, "%.*g%s", digits, number, rest[generator() % 6]);
    return {text, static_cast<std::size_t>(length)};
}

}  // namespace

int main() {
    Generator generator;
    for (const char* text : {"", "+1", "-", "- 1", ".5", "5.", ".", "1e999", "-1e999", "1e-999", "inf", "-inf",
                             "infinity", "0x10", "1,5", "1e5.5", " 1", "1_0"}) {
        Hash hash;
        add_number(hash, text);
        std::printf("%s %016llx\n", text, static_cast<unsigned long long>(hash.value));
    }
    for (int thousand = 0; thousand < 200; ++thousand) {
        Hash hash;
        for (int i = 0; i < 250; ++i) {
            const std::uint64_t bits = generator(), shift = generator() % 63, count = generator() % 1000000;
            const double numbers[] = {std::bit_cast<double>(bits),
                                      static_cast<double>(static_cast<std::int64_t>(bits) >> shift),
                                      std::ldexp(static_cast<double>(count), -static_cast<int>(shift)),
                                      (static_cast<double>(count) - 500000) / 1000};
            for (const double number : numbers) {
                if (std::isnan(number)) continue;
                add_texts(hash, number);
                add_number(hash, random_text(generator, number));
            }
        }
        std::printf("%d %016llx\n", thousand, static_cast<unsigned long long>(hash.value));
    }
}
