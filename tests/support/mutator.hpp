// Texts with random damage, for tests that readers end with a result or an error whatever they read.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

namespace lamina::test {

/// Damages a text at one to four random places.
class Mutator {
public:
    /// `pieces` are put into texts, and are those that readers may stumble over.
    Mutator(unsigned seed, std::vector<std::string> pieces) : random_(seed), pieces_(std::move(pieces)) {}

    std::string operator()(std::string text) {
        for (std::size_t k = 1 + below(4); k-- > 0;) mutate(text);
        return text;
    }

private:
    std::mt19937 random_;
    std::vector<std::string> pieces_;

    std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

    void mutate(std::string& text) {
        const std::size_t at = below(text.size() + 1);
        switch (below(7)) {
            case 0:
                text.insert(at, pieces_[below(pieces_.size())]);
                break;
            case 1:
                text.insert(at, 1, static_cast<char>(below(256)));
                break;
            case 2:
                text.erase(at, below(6));
                break;
            case 3:
                text.erase(at, below(text.size()));
                break;
            case 4:
                if (at < text.size()) text[at] = static_cast<char>(below(256));
                break;
            case 5:
                if (at < text.size()) text[at] = static_cast<char>('0' + below(10));
                break;
            default:
                text.insert(at, text.substr(below(text.size()), below(80)));
                break;
        }
    }
};

/// Calls read() with this many damaged texts. Expects it to refuse bad input in one line, and to take and to refuse a
/// twentieth of the texts at least.
template <class Read>
void expect_taken_or_refused(Mutator mutate, const std::vector<std::string>& seeds, std::size_t cases,
                             const Read& read) {
    std::size_t taken = 0, refused = 0;
    for (std::size_t i = 0; i < cases; ++i) {
        const std::string text = mutate(seeds[i % seeds.size()]);
        try {
            read(text);
            if (testing::Test::HasFatalFailure()) return;
            ++taken;
        } catch (const Error& e) {
            ASSERT_EQ(e.exit_code(), ExitCode::bad_input) << e.what();
            ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
            ++refused;
        }
    }
    EXPECT_GT(taken, cases / 20);
    EXPECT_GT(refused, cases / 20);
}

}  // namespace lamina::test
