// The errors that bad input, an impossible request or a failing disk raise. Bugs in the library assert instead.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

#include <lamina/point.hpp>

namespace lamina {

/// What the program returns to the shell (see the user guide, "Exit codes").
enum class ExitCode : int {
    done = 0,
    usage = 2,        ///< wrong options or arguments
    bad_input = 3,    ///< the input cannot be meshed: file, line, what, where
    mesh_failed = 4,  ///< the mesh could not be made to the promised standard
    io_failed = 5,    ///< reading or writing failed
};

/// Base of all errors thrown by lamina; what() is one line, ready to be shown.
class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
    ExitCode exit_code() const noexcept { return code_; }

private:
    ExitCode code_;
};

/// Options that contradict each other or lie outside their range.
class UsageError : public Error {
public:
    explicit UsageError(const std::string& line) : Error(ExitCode::usage, line) {}
};

/// Where in the input something is wrong; parts that do not apply stay empty.
struct InputPlace {
    std::string file;
    std::size_t line = 0;  ///< 1-based; 0 = not tied to one line
    std::optional<Point> at;
};

/// The input cannot be used. what() reads "file:line: reason (at x, y)".
class InputError : public Error {
public:
    InputError(InputPlace place, const std::string& reason);
    const InputPlace& place() const noexcept { return place_; }

private:
    InputPlace place_;
};

/// A mesh of the promised standard could not be made, or one that was read is not valid.
class MeshError : public Error {
public:
    explicit MeshError(const std::string& line) : Error(ExitCode::mesh_failed, line) {}
};

/// A file could not be read or written.
class IoError : public Error {
public:
    IoError(const std::string& file, const std::string& reason);
};

}  // namespace lamina
