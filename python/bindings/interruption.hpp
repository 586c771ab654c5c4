// Work without the lock of the interpreter, which Ctrl-C and callbacks can end.
#pragma once

#include <optional>
#include <utility>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <lamina/interruption.hpp>
#include <lamina/pipeline.hpp>

#include "values.hpp"

namespace lamina::python {

/// Throws the Python exception of a signal that has arrived, such as KeyboardInterrupt. Precondition: the calling
/// thread holds the lock of the interpreter.
inline void raise_signals() {
    if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
}

/// Calls work() without the lock of the interpreter. Now and then it looks for signals, and calls `stop` unless that is
/// None; the exception of either ends the work. Precondition: the calling thread holds the lock.
template <class Work>
void run_unlocked(Work&& work, const nanobind::object& stop = nanobind::none()) {
    std::optional<nanobind::python_error> raised;
    const auto is_unwanted = [&] {
        const nanobind::gil_scoped_acquire lock;
        try {
            raise_signals();
            if (!stop.is_none()) stop();
        } catch (nanobind::python_error& error) {
            raised.emplace(std::move(error));
        }
        return raised.has_value();
    };
    try {
        const nanobind::gil_scoped_release unlocked;
        with_interruption(is_unwanted, work);
    } catch (const Interrupted&) {
        throw nanobind::python_error(std::move(*raised));
    }
    raise_signals();
}

/// Returns the progress that looks for signals, and calls callback(stage, estimate or None) unless that is None.
/// Exceptions of the callback end the run. The callback must outlive the result.
inline Progress python_progress(const nanobind::object& callback) {
    return [&callback](const ProgressEvent& event) {
        const nanobind::gil_scoped_acquire lock;
        raise_signals();
        if (callback.is_none()) return;
        callback(event.stage, event.estimate ? to_python(*event.estimate) : nanobind::none());
    };
}

}  // namespace lamina::python
