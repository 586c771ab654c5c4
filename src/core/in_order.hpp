// Results that several threads finish in any order, taken one by one in the order of their places.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

namespace lamina::core {

/// Calls take(value) for the values of the places 0, 1, 2 ... in this order, each as soon as all before it have been
/// put. One call runs at a time. Once a call throws, all further values are dropped.
template <class T>
class InOrder {
public:
    explicit InOrder(std::function<void(T)> take) : take_(std::move(take)) {}

    /// May be called by several threads at once, once for each place. Throws what take() throws.
    void put(std::size_t place, T value) {
        const std::lock_guard lock(mutex_);
        if (failed_) return;
        waiting_.emplace(place, std::move(value));
        while (!waiting_.empty() && waiting_.begin()->first == next_) {
            auto first = waiting_.extract(waiting_.begin());
            ++next_;
            failed_ = true;  // unless the call returns
            take_(std::move(first.mapped()));
            failed_ = false;
        }
    }

private:
    std::function<void(T)> take_;
    std::mutex mutex_;
    std::map<std::size_t, T> waiting_;
    std::size_t next_ = 0;
    bool failed_ = false;
};

}  // namespace lamina::core
