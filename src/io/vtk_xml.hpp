// Files in VTK's XML formats: their tags, and their arrays of numbers in every encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/binary_output.hpp"
#include "io/vtk_tags.hpp"

namespace lamina::io {

/// An unstructured grid of one piece. Its arrays are in ASCII or binary; binary ones are inline or appended, raw or in
/// base64, plain or compressed by zlib, of either byte order, with headers of 32 or 64 bits. All functions throw
/// InputError with the name of the file.
class VtkXmlFile {
public:
    /// Reads the tags. `bytes` must outlive this object.
    VtkXmlFile(std::string_view bytes, std::string file);

    /// Return the numbers of points and cells that the file announces.
    std::size_t points() const { return points_; }
    std::size_t cells() const { return cells_; }

    /// Returns whether the file has an array. Arrays are named "section/name": PointData/size, Cells/types. The array
    /// of the points is named "Points/".
    bool has(const std::string& name) const { return arrays_.contains(name); }
    /// Returns the names, without the section, of the arrays of one component in a section.
    std::vector<std::string> scalars(const std::string& section) const;
    /// Returns the names of all arrays in a section, likewise.
    std::vector<std::string> arrays(const std::string& section) const;
    /// Returns the number of components of an array. Fails where there is no such array.
    std::size_t components(const std::string& name) const;
    /// Returns the values of an array, converted from the type that they are stored in. Fails for integers that T
    /// cannot hold, and for compressed arrays of more values than a file of this size and of so many points and cells
    /// can mean.
    template <class T>
    std::vector<T> values(const std::string& name) const;
    /// Fails unless the array has this number of values. No more are decompressed.
    template <class T>
    std::vector<T> values(const std::string& name, std::size_t expected) const;

    /// Returns `count` values of an array from value `first` on. Only these are looked at where the array is stored
    /// raw. Fails where it has not so many.
    template <class T>
    std::vector<T> part(const std::string& name, std::size_t first, std::size_t count) const;
    /// Returns the number of values of an array.
    std::size_t size(const std::string& name) const;
    /// Returns whether part() reads an array in place.
    bool is_raw(const std::string& name) const;

    [[noreturn]] void fail(const std::string& reason) const;

private:
    enum class ArrayEncoding { ascii, raw, base64 };
    struct ArrayHeader {
        std::string type;
        ArrayEncoding encoding = ArrayEncoding::ascii;
        bool appended = false;
        /// First byte of the data; for appended arrays counted from the first byte of the appended data.
        std::size_t at = 0;
        std::size_t components = 1;
    };
    class ByteStream;

    void read_tags();
    void read_file_tag(const VtkTag& tag);
    void read_array_tag(const VtkTag& tag, std::string_view section, std::size_t position);
    bool read_appended_tag(const VtkTag& tag, std::size_t position);
    std::string_view word_attribute(const VtkTag& tag, std::string_view attribute, std::string_view default_value,
                                    std::initializer_list<std::string_view> known) const;
    std::size_t number_attribute(const VtkTag& tag, std::string_view attribute) const;

    const ArrayHeader& header_of(const std::string& name) const;
    std::size_t start_of(const ArrayHeader& array, const std::string& name) const;
    std::string plain_bytes(const std::string& name, std::size_t most) const;
    std::string inflated_bytes(ByteStream& stream, const std::string& name, std::size_t most) const;
    std::size_t most_values(const std::string& name) const;
    template <class T>
    std::vector<T> values_up_to(const std::string& name, std::size_t most) const;
    template <class T>
    std::vector<T> ascii_values(const std::string& name) const;
    template <class T, class Stored>
    std::vector<T> converted(std::string_view plain, const std::string& name) const;
    template <class T>
    std::vector<T> values_of(std::string_view plain, const std::string& name) const;
    std::size_t stored_bytes(const std::string& name) const;
    std::string_view raw_bytes(const std::string& name) const;

    std::string_view bytes_;
    std::string file_;
    std::map<std::string, ArrayHeader> arrays_;
    std::size_t appended_start_ = 0;  ///< first byte of the appended data
    ArrayEncoding appended_encoding_ = ArrayEncoding::raw;
    ByteOrder order_ = ByteOrder::little;
    std::size_t header_bytes_ = 4;  ///< bytes of a number in the header of a binary array
    bool compressed_ = false;
    std::size_t points_ = 0, cells_ = 0;
};

}  // namespace lamina::io
