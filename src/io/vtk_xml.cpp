// Sources: VTK User's Guide, "VTK File Formats", XML; base64: RFC 4648.
//
// A binary array is stored as follows; all numbers have the width of the header:
//   plain         [bytes][data]
//   compressed    [blocks][bytes of a block][bytes of the last block, 0 = as the others]
//                 [compressed bytes of each], then the blocks, each a zlib stream
// In base64, VTK encodes each part that it writes at once by itself, and the part may end in padding: a plain array as
// a whole, but the header of a compressed array and the blocks behind it each by themselves. A decoder that begins anew
// behind padding need not know where the parts end.
#include "io/vtk_xml.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include <lamina/error.hpp>

#include "io/number_text.hpp"

namespace lamina::io {

namespace {

constexpr unsigned char no_digit = 0xff;

/// Returns the value of each character of base64, and no_digit for all others.
constexpr std::array<unsigned char, 256> base64_digits() {
    std::array<unsigned char, 256> digits{};
    digits.fill(no_digit);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
        digits[static_cast<unsigned char>(alphabet[i])] = static_cast<unsigned char>(i);
    return digits;
}

bool is_section(std::string_view tag_name) {
    constexpr std::array<std::string_view, 5> sections{"FieldData", "PointData", "CellData", "Points", "Cells"};
    return std::find(sections.begin(), sections.end(), tag_name) != sections.end();
}

}  // namespace

/// The bytes stored for an array, read part by part and decoded from base64 where needed.
class VtkXmlFile::ByteStream {
public:
    ByteStream(const VtkXmlFile& file, const std::string& name, std::size_t at, ArrayEncoding encoding)
        : file_(file), name_(name), at_(at), base64_(encoding == ArrayEncoding::base64) {}

    /// Reads this number of bytes. The result is valid until the next call.
    std::string_view read(std::size_t count) {
        const std::string_view all = file_.bytes_;
        // Four characters of base64 make three bytes, so the file must hold at least `count` bytes in either case.
        if (at_ > all.size() || all.size() - at_ + carried_.size() < count) fail();
        if (base64_) return read_base64(count);
        at_ += count;
        return all.substr(at_ - count, count);
    }
    /// Reads a number of the header.
    std::size_t read_number() {
        char stored[8] = {};
        const std::string_view bytes = read(file_.header_bytes_);
        std::copy(bytes.begin(), bytes.end(), stored);
        if (file_.order_ == ByteOrder::big) std::reverse(stored, stored + file_.header_bytes_);
        std::uint64_t value = 0;
        std::memcpy(&value, stored, sizeof value);
        return value;
    }

private:
    [[noreturn]] void fail() const { file_.fail(fmt::format("cut short within array '{}'", name_)); }

    std::string_view read_base64(std::size_t count) {
        buffer_ = carried_;
        buffer_.reserve(count + 3);
        while (buffer_.size() < count) decode_quantum();
        carried_ = buffer_.substr(count);
        buffer_.resize(count);
        return buffer_;
    }
    /// Decodes four characters to three bytes, or to fewer where the characters end in padding.
    void decode_quantum() {
        static constexpr std::array<unsigned char, 256> digits = base64_digits();
        unsigned quantum = 0, figures = 0, padding = 0;
        while (figures + padding < 4) {
            if (at_ == file_.bytes_.size()) fail();
            const char c = file_.bytes_[at_++];
            if (is_blank(c)) continue;
            const unsigned digit = digits[static_cast<unsigned char>(c)];
            if (digit == no_digit ? c != '=' || figures < 2 : padding > 0) fail();
            (digit == no_digit ? padding : figures) += 1;
            quantum = quantum << 6 | (digit == no_digit ? 0u : digit);
        }
        for (unsigned i = 0; i < 3 - padding; ++i) buffer_.push_back(static_cast<char>(quantum >> (16 - 8 * i)));
    }

    const VtkXmlFile& file_;
    const std::string& name_;
    std::size_t at_;
    bool base64_;
    std::string buffer_;   ///< the decoded bytes of the last call
    std::string carried_;  ///< decoded bytes behind them
};

VtkXmlFile::VtkXmlFile(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {
    read_tags();
}

void VtkXmlFile::fail(const std::string& reason) const { throw InputError({file_, 0, {}}, reason); }

// --- Tags

void VtkXmlFile::read_tags() {
    VtkTagReader tags(bytes_);
    VtkTag tag;
    std::string_view section;
    bool is_vtu = false, has_piece = false, has_appended = false, is_whole = false;
    while (!is_whole && tags.next(tag)) {
        if (tag.name == "VTKFile") {
            read_file_tag(tag);
            is_vtu = true;
        } else if (tag.name == "Piece") {
            if (has_piece) fail("files of more than one piece cannot be read");
            has_piece = true;
            points_ = number_attribute(tag, "NumberOfPoints");
            cells_ = number_attribute(tag, "NumberOfCells");
        } else if (is_section(tag.name)) {
            section = tag.name;
        } else if (tag.name == "DataArray") {
            read_array_tag(tag, section, tags.position());
        } else if (tag.name == "AppendedData") {
            has_appended = is_whole = read_appended_tag(tag, tags.position());
            if (!has_appended) break;
        } else if (tag.name == "/VTKFile") {
            is_whole = true;
        }
    }
    const bool needs_appended =
        std::any_of(arrays_.begin(), arrays_.end(), [](const auto& array) { return array.second.appended; });
    if (!is_vtu || !has_piece || !is_whole || (needs_appended && !has_appended)) fail("not a VTU file, or cut short");
}

void VtkXmlFile::read_file_tag(const VtkTag& tag) {
    word_attribute(tag, "type", {}, {"UnstructuredGrid"});
    if (word_attribute(tag, "byte_order", "LittleEndian", {"LittleEndian", "BigEndian"}) == "BigEndian")
        order_ = ByteOrder::big;
    if (word_attribute(tag, "header_type", "UInt32", {"UInt32", "UInt64"}) == "UInt64") header_bytes_ = 8;
    compressed_ = !word_attribute(tag, "compressor", {}, {"", "vtkZLibDataCompressor"}).empty();
}

/// Notes an array of this section. `position` is the position behind the tag.
void VtkXmlFile::read_array_tag(const VtkTag& tag, std::string_view section, std::size_t position) {
    const std::string_view format = word_attribute(tag, "format", "ascii", {"ascii", "binary", "appended"});
    ArrayHeader array{.type = std::string(tag.value("type")),
                      .encoding = format == "ascii" ? ArrayEncoding::ascii : ArrayEncoding::base64,
                      .appended = format == "appended",
                      .at = position};
    if (tag.value("NumberOfComponents", "1") != "1") array.components = number_attribute(tag, "NumberOfComponents");
    if (array.appended) array.at = number_attribute(tag, "offset");
    arrays_[fmt::format("{}/{}", section, section == "Points" ? "" : tag.value("Name"))] = std::move(array);
}

/// Finds the beginning of the appended data, behind an underscore. Returns false where there is none.
bool VtkXmlFile::read_appended_tag(const VtkTag& tag, std::size_t position) {
    if (word_attribute(tag, "encoding", "base64", {"raw", "base64"}) == "base64")
        appended_encoding_ = ArrayEncoding::base64;
    const std::size_t underscore = bytes_.find('_', position);
    if (underscore == std::string_view::npos) return false;
    appended_start_ = underscore + 1;
    return true;
}

/// Returns the value of an attribute. Fails unless it is one of the known words.
std::string_view VtkXmlFile::word_attribute(const VtkTag& tag, std::string_view attribute,
                                            std::string_view default_value,
                                            std::initializer_list<std::string_view> known) const {
    const std::string_view found = tag.value(attribute, default_value);
    if (std::find(known.begin(), known.end(), found) == known.end())
        fail(fmt::format("<{}> with {}=\"{}\" cannot be read", tag.name, attribute, found));
    return found;
}

std::size_t VtkXmlFile::number_attribute(const VtkTag& tag, std::string_view attribute) const {
    const std::optional<std::size_t> number = parse_whole<std::size_t>(tag.value(attribute));
    if (!number) fail(fmt::format("no number in attribute '{}' of <{}>", attribute, tag.name));
    return *number;
}

// --- Arrays

std::vector<std::string> VtkXmlFile::scalars(const std::string& section) const {
    std::vector<std::string> names;
    for (const auto& [name, array] : arrays_)
        if (name.starts_with(section + "/") && array.components == 1) names.push_back(name.substr(section.size() + 1));
    return names;
}

std::vector<std::string> VtkXmlFile::arrays(const std::string& section) const {
    std::vector<std::string> names;
    for (const auto& [name, array] : arrays_)
        if (name.starts_with(section + "/")) names.push_back(name.substr(section.size() + 1));
    return names;
}

const VtkXmlFile::ArrayHeader& VtkXmlFile::header_of(const std::string& name) const {
    const auto found = arrays_.find(name);
    if (found == arrays_.end()) fail(fmt::format("array '{}' is missing", name));
    return found->second;
}

/// Returns the position of the first byte of an array.
std::size_t VtkXmlFile::components(const std::string& name) const { return header_of(name).components; }

std::size_t VtkXmlFile::start_of(const ArrayHeader& array, const std::string& name) const {
    if (!array.appended) return array.at;
    if (array.at > bytes_.size() - appended_start_) fail(fmt::format("cut short before array '{}'", name));
    return appended_start_ + array.at;
}

/// Returns how many values an array may have whose number the file does not announce: names, constraints, the vertices
/// of cells. Of the last ones a cell has at most four, but for those that are ignored.
std::size_t VtkXmlFile::most_values(const std::string& name) const {
    constexpr std::size_t each = 4, of_file = 2;  // numbers of a point or cell; bytes of a compressed byte
    return std::max(each * (std::min(points_, bytes_.size()) + std::min(cells_, bytes_.size())),
                    of_file * bytes_.size() / stored_bytes(name));
}

/// Returns the data of a binary array, decoded and decompressed. Fails where it is compressed and larger than `most`
/// bytes.
std::string VtkXmlFile::plain_bytes(const std::string& name, std::size_t most) const {
    const ArrayHeader& stored = header_of(name);
    ByteStream stream(*this, name, start_of(stored, name), stored.appended ? appended_encoding_ : stored.encoding);
    return compressed_ ? inflated_bytes(stream, name, most) : std::string(stream.read(stream.read_number()));
}

std::string VtkXmlFile::inflated_bytes(ByteStream& stream, const std::string& name, std::size_t most) const {
    const std::size_t blocks = stream.read_number();
    if (blocks == 0) return {};
    const std::size_t block = stream.read_number(), last = stream.read_number();
    const auto require_sound = [&](bool sound) {
        if (!sound) fail(fmt::format("array '{}' has a broken header", name));
    };
    require_sound(blocks <= bytes_.size() / header_bytes_ && last <= block);
    // The whole size is known before anything is decompressed.
    if (blocks > 1 ? block > most / (blocks - 1) : (last > 0 ? last : block) > most)
        fail(fmt::format("array '{}' has a broken header: it would unpack to more values than the file announces",
                         name));
    std::vector<std::size_t> sizes(blocks);
    for (std::size_t& compressed : sizes) compressed = stream.read_number();
    std::string whole;
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t expected = i + 1 == blocks && last > 0 ? last : block;
        const std::string_view compressed = stream.read(sizes[i]);
        // Deflate makes at most this many bytes of one, so a damaged size is refused before memory is asked for.
        constexpr std::size_t most_of_a_byte = 1032;
        require_sound(expected / most_of_a_byte <= compressed.size());
        const std::size_t so_far = whole.size();
        whole.resize(so_far + expected);
        uLongf length = expected;
        if (uncompress(reinterpret_cast<Bytef*>(whole.data() + so_far), &length,
                       reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()) != Z_OK ||
            length != expected)
            fail(fmt::format("array '{}' cannot be decompressed", name));
    }
    return whole;
}

template <class T>
std::vector<T> VtkXmlFile::ascii_values(const std::string& name) const {
    const std::size_t start = header_of(name).at, end = std::min(bytes_.find('<', start), bytes_.size());
    std::vector<T> result;
    const char* at = bytes_.data() + start;
    for (const char* const last = bytes_.data() + end;;) {
        while (at < last && is_blank(*at)) ++at;
        if (at == last) return result;
        T value{};
        const auto [behind, error] = std::from_chars(at, last, value);
        if (error != std::errc{} || (behind < last && !is_blank(*behind)))
            fail(fmt::format("array '{}' holds something that is no number, or a number out of range", name));
        result.push_back(value);
        at = behind;
    }
}

template <class T, class Stored>
std::vector<T> VtkXmlFile::converted(std::string_view plain, const std::string& name) const {
    if (plain.size() % sizeof(Stored) != 0) fail(fmt::format("array '{}' has a broken length", name));
    std::vector<T> result(plain.size() / sizeof(Stored));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const auto value = load<Stored>(plain.data() + i * sizeof(Stored), order_);
        if constexpr (std::is_integral_v<T>) {
            bool fits = false;
            if constexpr (std::is_integral_v<Stored>) fits = std::in_range<T>(value);
            if (!fits) fail(fmt::format("array '{}' holds a value that is out of range", name));
        }
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): the values of an Int8 array are numbers, not characters
        result[i] = static_cast<T>(value);
    }
    return result;
}

/// Converts the bytes of a binary array.
template <class T>
std::vector<T> VtkXmlFile::values_of(std::string_view plain, const std::string& name) const {
    const ArrayHeader& stored = header_of(name);
    if (stored.type == "Float64") return converted<T, double>(plain, name);
    if (stored.type == "Float32") return converted<T, float>(plain, name);
    if (stored.type == "Int64") return converted<T, std::int64_t>(plain, name);
    if (stored.type == "UInt64") return converted<T, std::uint64_t>(plain, name);
    if (stored.type == "Int32") return converted<T, std::int32_t>(plain, name);
    if (stored.type == "UInt32") return converted<T, std::uint32_t>(plain, name);
    if (stored.type == "Int16") return converted<T, std::int16_t>(plain, name);
    if (stored.type == "UInt16") return converted<T, std::uint16_t>(plain, name);
    if (stored.type == "Int8") return converted<T, std::int8_t>(plain, name);
    if (stored.type == "UInt8") return converted<T, std::uint8_t>(plain, name);
    fail(fmt::format("array '{}' has the unknown type '{}'", name, stored.type));
}

template <class T>
std::vector<T> VtkXmlFile::values_up_to(const std::string& name, std::size_t most) const {
    const ArrayHeader& stored = header_of(name);
    if (stored.encoding == ArrayEncoding::ascii && !stored.appended) return ascii_values<T>(name);
    if (is_raw(name)) return values_of<T>(raw_bytes(name), name);
    return values_of<T>(plain_bytes(name, most * stored_bytes(name)), name);
}

template <class T>
std::vector<T> VtkXmlFile::values(const std::string& name) const {
    return values_up_to<T>(name, most_values(name));
}

bool VtkXmlFile::is_raw(const std::string& name) const {
    return header_of(name).appended && appended_encoding_ == ArrayEncoding::raw && !compressed_;
}

/// Returns the bytes of an array that is stored raw.
std::string_view VtkXmlFile::raw_bytes(const std::string& name) const {
    ByteStream stream(*this, name, start_of(header_of(name), name), appended_encoding_);
    return stream.read(stream.read_number());
}

/// Returns the number of bytes of a stored value.
std::size_t VtkXmlFile::stored_bytes(const std::string& name) const {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 4> widths{
        {{"64", 8}, {"32", 4}, {"16", 2}, {"8", 1}}};
    const std::string& type = header_of(name).type;
    for (const auto& [ending, bytes] : widths)
        if (type.ends_with(ending)) return bytes;
    fail(fmt::format("array '{}' has the unknown type '{}'", name, type));
}

std::size_t VtkXmlFile::size(const std::string& name) const {
    if (!is_raw(name)) return values<double>(name).size();
    const std::size_t bytes = raw_bytes(name).size(), width = stored_bytes(name);
    if (bytes % width != 0) fail(fmt::format("array '{}' has a broken length", name));
    return bytes / width;
}

template <class T>
std::vector<T> VtkXmlFile::part(const std::string& name, std::size_t first, std::size_t count) const {
    const auto require_room = [&](std::size_t size) {
        if (first > size || count > size - first) fail(fmt::format("array '{}' has only {} values", name, size));
    };
    if (!is_raw(name)) {
        const std::vector<T> all = values<T>(name);
        require_room(all.size());
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
        return {begin, begin + static_cast<std::ptrdiff_t>(count)};
    }
    const std::string_view bytes = raw_bytes(name);
    const std::size_t width = stored_bytes(name);
    require_room(bytes.size() / width);
    return values_of<T>(bytes.substr(first * width, count * width), name);
}

template <class T>
std::vector<T> VtkXmlFile::values(const std::string& name, std::size_t expected) const {
    std::vector<T> result = values_up_to<T>(name, expected);
    if (result.size() != expected)
        fail(fmt::format("array '{}' has {} values where {} are announced", name, result.size(), expected));
    return result;
}

template std::vector<double> VtkXmlFile::part(const std::string&, std::size_t, std::size_t) const;
template std::vector<std::uint8_t> VtkXmlFile::part(const std::string&, std::size_t, std::size_t) const;
template std::vector<std::uint32_t> VtkXmlFile::part(const std::string&, std::size_t, std::size_t) const;
template std::vector<std::int64_t> VtkXmlFile::part(const std::string&, std::size_t, std::size_t) const;
template std::vector<double> VtkXmlFile::values(const std::string&, std::size_t) const;
template std::vector<std::uint8_t> VtkXmlFile::values(const std::string&) const;
template std::vector<std::uint8_t> VtkXmlFile::values(const std::string&, std::size_t) const;
template std::vector<std::uint32_t> VtkXmlFile::values(const std::string&, std::size_t) const;
template std::vector<std::int64_t> VtkXmlFile::values(const std::string&) const;
template std::vector<std::int64_t> VtkXmlFile::values(const std::string&, std::size_t) const;

}  // namespace lamina::io
