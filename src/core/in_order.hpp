// Results that several threads finish in any order, taken one by one in the order of their places.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

namespace lamina::core {

/// Calls take(value) for the values of the places 0, 1, 2 ... in this order, each as soon as all before it have been
/// put. One call runs at a time.
template <class T>
class InOrder {
public:
    explicit InOrder(std::function<void(T)> take) : take_(std::move(take)) {}

    /// May be called by several threads at once, once for each place.
    void put(std::size_t place, T value) {
        const std::lock_guard lock(mutex_);
        waiting_.emplace(place, std::move(value));
        for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_; ++next_) {
            take_(std::move(first->second));
            first = waiting_.erase(first);
        }
    }

private:
    std::function<void(T)> take_;
    std::mutex mutex_;
    std::map<std::size_t, T> waiting_;
    std::size_t next_ = 0;
};

}  // namespace lamina::core
