// Work without the lock of the interpreter, which Ctrl-C and callbacks can end.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <lamina/pipeline.hpp>

#include "values.hpp"

namespace lamina::python {

/// Throws the Python exception of a signal that has arrived, such as KeyboardInterrupt. Precondition: the calling
/// thread holds the lock of the interpreter.
inline void raise_signals() {
    if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
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
