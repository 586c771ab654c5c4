// Files in VTK's XML formats: the tags, and the arrays of numbers in whichever way they are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/binary_output.hpp"

namespace lamina::io {

/// An unstructured grid of one piece. Arrays are ASCII, or binary: inline or appended, raw or base64, plain or
/// compressed by zlib, of either byte order, with headers of 32 or 64 bits. Throws InputError with the file's name.
class VtkXmlFile {
public:
    /// Reads the tags. `bytes` must stay.
    VtkXmlFile(const std::string& bytes, std::string file);

    std::size_t points() const { return points_; }
    std::size_t cells() const { return cells_; }

    /// Arrays are named "section/name": PointData/size, Cells/types, Points/ (that one without a name).
    bool has(const std::string& name) const { return arrays_.contains(name); }
    /// Names without the section of its arrays of one component.
    std::vector<std::string> scalars(const std::string& section) const;
    /// The values of an array, converted from whatever type they have. Integers that T cannot hold are refused.
    template <class T>
    std::vector<T> values(const std::string& name) const;
    template <class T>
    std::vector<T> values(const std::string& name, std::size_t expected) const;

    [[noreturn]] void fail(const std::string& reason) const;

private:
    enum class Encoding { ascii, raw, base64 };
    struct Array {
        std::string type;
        Encoding encoding = Encoding::ascii;
        std::size_t at = 0;  ///< first byte of what is stored, counted from the appended data's where it is there
        bool appended = false;
        std::size_t components = 1;
    };
    class Stream;

    void read_tags();
    const Array& array(const std::string& name) const;
    std::size_t start_of(const Array& array, const std::string& name) const;
    std::string plain_bytes(const std::string& name) const;
    std::string inflated(Stream& stream, const std::string& name) const;
    template <class T>
    std::vector<T> in_figures(const std::string& name) const;
    template <class T, class Stored>
    std::vector<T> converted(const std::string& name) const;

    const std::string& bytes_;
    std::string file_;
    std::map<std::string, Array> arrays_;
    std::size_t appended_ = 0;  ///< first byte of appended data
    Encoding appended_encoding_ = Encoding::raw;
    ByteOrder order_ = ByteOrder::little;
    std::size_t header_bytes_ = 4;
    bool compressed_ = false;
    std::size_t points_ = 0, cells_ = 0;
};

}  // namespace lamina::io
