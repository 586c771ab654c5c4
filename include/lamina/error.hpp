// The errors of lamina.
//
// Guarantees:
//  1. Bad input, options out of range, failing disks and meshes that cannot be made throw one of these types.
//  2. what() is one line to show to a person; the members hold the same facts as data.
// Limits:
//  1. Broken preconditions and bugs of the library assert instead, in builds with assertions. Besides these errors,
//     std::bad_alloc, Interrupted (interruption.hpp) and what callbacks throw may come out of lamina.
// Example:
//     try {
//         triangulate(std::vector<Point>{{0, 0}, {1, 0}, {0, 1}, {1, 0}});
//         assert(false);
//     } catch (const InputError& error) {  // two points are equal
//         assert(error.exit_code() == ExitCode::bad_input);
//         assert((error.place().points == std::vector<std::size_t>{1, 3}));
//     }
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The kinds of errors, and the exit codes that the program returns for them.
enum class ExitCode : int {
    done = 0,
    usage = 2,        ///< options or arguments are wrong
    bad_input = 3,    ///< the input cannot be meshed
    mesh_failed = 4,  ///< no mesh of the promised standard could be made
    io_failed = 5,    ///< reading or writing failed
};

/// The base of all errors that lamina throws.
class LAMINA_EXPORT Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}  ///< what() is the line
    ExitCode exit_code() const noexcept { return code_; }                                     ///< the kind of the error

private:
    ExitCode code_;
};

/// Arguments that contradict each other or that lamina does not know.
class LAMINA_EXPORT UsageError : public Error {
public:
    explicit UsageError(const std::string& line) : Error(ExitCode::usage, line) {}  ///< what() is this line
};

/// An option whose value is out of range or does not go with the others.
class LAMINA_EXPORT OptionError : public UsageError {
public:
    OptionError(const std::string& option, const std::string& reason);  ///< what() reads "option: reason"
    const std::string& option() const noexcept { return option_; }      ///< its name in case files: "first_height"
    const std::string& reason() const noexcept { return reason_; }      ///< what is wrong with its value

private:
    std::string option_, reason_;
};

/// A place in the input where something is wrong. Parts that do not apply stay empty.
struct InputPlace {
    std::string file{};                    ///< path or name of the input
    std::size_t line = 0;                  ///< counts from 1; 0: not tied to one line
    std::optional<Point> at{};             ///< coordinates of the place
    std::string element{};                 ///< name of the body
    std::vector<std::size_t> points{};     ///< indices into the points handed in
    std::vector<std::size_t> segments{};   ///< indices into the segments handed in
    std::vector<std::size_t> triangles{};  ///< indices into the triangles handed in
    std::vector<std::size_t> seeds{};      ///< indices into the holes or regions handed in
};

/// Input that cannot be used.
class LAMINA_EXPORT InputError : public Error {
public:
    /// Makes an error whose what() reads "file:line: reason (at x, y)", without the parts that are empty.
    InputError(InputPlace place, const std::string& reason);
    const InputPlace& place() const noexcept { return place_; }     ///< where the input is wrong
    const std::string& reason() const noexcept { return reason_; }  ///< what is wrong, without the place

private:
    InputPlace place_;
    std::string reason_;
};

/// A mesh of the promised standard that could not be made, or a mesh that was read and is not valid.
class LAMINA_EXPORT MeshError : public Error {
public:
    /// Makes an error whose what() is this line, with the place of the first defect where it is known.
    explicit MeshError(const std::string& line, std::optional<Point> at = std::nullopt)
        : Error(ExitCode::mesh_failed, line), at_(at) {}
    const std::optional<Point>& at() const noexcept { return at_; }  ///< this place

private:
    std::optional<Point> at_;
};

/// A file that could not be read or written.
class LAMINA_EXPORT IoError : public Error {
public:
    IoError(const std::string& file, const std::string& reason);    ///< what() reads "file: reason"
    const std::string& file() const noexcept { return file_; }      ///< the path of the file
    const std::string& reason() const noexcept { return reason_; }  ///< why it could not be read or written

private:
    std::string file_, reason_;
};

}  // namespace lamina
