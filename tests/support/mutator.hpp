// Texts with random damage, for tests that readers end with a result or an error whatever they read.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace lamina::test
