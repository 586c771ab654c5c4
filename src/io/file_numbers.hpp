// The numbers that a file gives to what it lists, and their positions in the list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace lamina::io {

/// Finds positions by the numbers of a file, which most files count upwards from one number on.
class FileNumbers {
public:
    explicit FileNumbers(std::size_t first) : first_(first) {}

    void add(std::size_t number) { numbers_.emplace_back(number, numbers_.size()); }
    std::size_t size() const { return numbers_.size(); }
    /// Must be called once all numbers are added. Returns false where two are the same.
    bool sort() {
        in_order_ = true;
        for (std::size_t i = 0; i < numbers_.size() && in_order_; ++i) in_order_ = numbers_[i].first == i + first_;
        if (in_order_) return true;
        std::sort(numbers_.begin(), numbers_.end());
        return std::adjacent_find(numbers_.begin(), numbers_.end(),
                                  [](const auto& a, const auto& b) { return a.first == b.first; }) == numbers_.end();
    }
    /// Returns the position, from 0, of what has this number; nothing where nothing has it.
    std::optional<std::size_t> find(std::size_t number) const {
        if (in_order_) return number - first_ < numbers_.size() ? std::optional(number - first_) : std::nullopt;
        const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), std::pair(number, std::size_t{0}));
        if (found == numbers_.end() || found->first != number) return std::nullopt;
        return found->second;
    }

private:
    std::vector<std::pair<std::size_t, std::size_t>> numbers_;  ///< numbers and positions
    std::size_t first_;
    bool in_order_ = false;  ///< whether the numbers are first_, first_ + 1, ...
};

}  // namespace lamina::io
