// A hash by which processes compare what they have.
#pragma once

#include <bit>
#include <cstdint>

#include <lamina/point.hpp>

namespace lamina::core {

/// A hash of numbers in their order: FNV-1a with words in place of bytes (http://www.isthe.com/chongo/tech/comp/fnv/).
class WordHash {
public:
    void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3u; }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(Point p) {
        add(p.x);
        add(p.y);
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace lamina::core
