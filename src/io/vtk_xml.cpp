// Sources: VTK User's Guide, "VTK File Formats", XML; base64: RFC 4648.
//
// What is stored of a binary array, with numbers of the header's width:
//   plain         [bytes][data]
//   compressed    [blocks][bytes of a block][bytes of the last, 0 = as the others][compressed bytes of each], then the
//                 blocks, each a zlib stream
// In base64 what is written at one go is encoded by itself and may end in padding: a plain array as a whole, headers
// and the blocks behind them each. A decoder that begins anew behind padding needs not know which.
#include "io/vtk_xml.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <type_traits>
#include <utility>

#include <lamina/error.hpp>

namespace lamina::io {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// An element's name and attributes; closing ones have a name that begins with '/'.
struct Tag {
    std::string_view name;
    std::map<std::string_view, std::string_view> attributes;
};

/// Just enough XML for what VTK writes: tags with quoted attributes, comments, and text, which is skipped.
class TagReader {
public:
    explicit TagReader(std::string_view text) : text_(text) {}

    /// False at the end of the text, also where it ends within a tag.
    bool next(Tag& tag) {
        tag = {};
        std::size_t start = text_.find('<', at_);
        while (start != std::string_view::npos && text_.substr(start).starts_with("<!--")) {
            const std::size_t end = text_.find("-->", start);
            start = end == std::string_view::npos ? end : text_.find('<', end);
        }
        if (start == std::string_view::npos) return false;
        at_ = start + 1;
        tag.name = word();
        while (at_ < text_.size()) {
            skip_space();
            if (at_ < text_.size() && (text_[at_] == '/' || text_[at_] == '?')) {
                ++at_;
            } else if (at_ < text_.size() && text_[at_] == '>') {
                ++at_;
                return true;
            } else if (!attribute(tag)) {
                return false;
            }
        }
        return false;
    }
    /// Behind the last tag.
    std::size_t position() const { return at_; }

private:
    void skip_space() {
        while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    }
    std::string_view word() {
        const std::size_t start = at_;
        if (at_ < text_.size() && (text_[at_] == '/' || text_[at_] == '?')) ++at_;
        while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '=' && text_[at_] != '>' &&
               text_[at_] != '/' && text_[at_] != '?')
            ++at_;
        return text_.substr(start, at_ - start);
    }
    bool attribute(Tag& tag) {
        const std::string_view key = word();
        skip_space();
        if (key.empty() || at_ >= text_.size() || text_[at_] != '=') return false;
        ++at_;
        skip_space();
        if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return false;
        const std::size_t start = at_ + 1, end = text_.find(text_[at_], start);
        if (end == std::string_view::npos) return false;
        tag.attributes[key] = text_.substr(start, end - start);
        at_ = end + 1;
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

constexpr unsigned char no_digit = 0xff;

constexpr std::array<unsigned char, 256> base64_digits() {
    std::array<unsigned char, 256> digits{};
    digits.fill(no_digit);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
        digits[static_cast<unsigned char>(alphabet[i])] = static_cast<unsigned char>(i);
    return digits;
}

}  // namespace

/// The bytes stored for an array, one piece after the other.
class VtkXmlFile::Stream {
public:
    Stream(const VtkXmlFile& file, const std::string& name, std::size_t at, Encoding encoding)
        : file_(file), name_(name), at_(at), base64_(encoding == Encoding::base64) {}

    /// Good until the next call.
    std::string_view bytes(std::size_t count) {
        const std::string& all = file_.bytes_;
        // Three bytes of four figures, so there are never fewer bytes left than asked for.
        if (at_ > all.size() || all.size() - at_ + carried_.size() < count) fail();
        if (base64_) return decoded(count);
        at_ += count;
        return std::string_view(all).substr(at_ - count, count);
    }
    /// A number of the header.
    std::size_t number() {
        char stored[8] = {};
        const std::string_view bytes_of_number = bytes(file_.header_bytes_);
        std::copy(bytes_of_number.begin(), bytes_of_number.end(), stored);
        if (file_.order_ == ByteOrder::big) std::reverse(stored, stored + file_.header_bytes_);
        std::uint64_t value = 0;
        std::memcpy(&value, stored, sizeof value);
        return value;
    }

private:
    [[noreturn]] void fail() const { file_.fail(fmt::format("cut short within array '{}'", name_)); }

    std::string_view decoded(std::size_t count) {
        static constexpr std::array<unsigned char, 256> digits = base64_digits();
        buffer_ = carried_;
        buffer_.reserve(count + 3);
        while (buffer_.size() < count) {
            unsigned quantum = 0, figures = 0, padding = 0;
            while (figures + padding < 4) {
                if (at_ == file_.bytes_.size()) fail();
                const char c = file_.bytes_[at_++];
                if (is_space(c)) continue;
                const unsigned char digit = digits[static_cast<unsigned char>(c)];
                if (digit == no_digit ? c != '=' || figures < 2 : padding > 0) fail();
                (digit == no_digit ? padding : figures) += 1;
                quantum = quantum << 6 | (digit == no_digit ? 0u : digit);
            }
            for (unsigned i = 0; i < 3 - padding; ++i) buffer_.push_back(static_cast<char>(quantum >> (16 - 8 * i)));
        }
        carried_ = buffer_.substr(count);
        buffer_.resize(count);
        return buffer_;
    }

    const VtkXmlFile& file_;
    const std::string& name_;
    std::size_t at_;
    bool base64_;
    std::string buffer_, carried_;  ///< decoded: the last piece, and what is left of its last quantum
};

VtkXmlFile::VtkXmlFile(const std::string& bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {
    read_tags();
}

void VtkXmlFile::fail(const std::string& reason) const { throw InputError({file_, 0, {}}, reason); }

void VtkXmlFile::read_tags() {
    TagReader tags(bytes_);
    Tag tag;
    const auto value = [&](std::string_view attribute, std::string_view standard = {}) {
        const auto found = tag.attributes.find(attribute);
        return found == tag.attributes.end() ? standard : found->second;
    };
    const auto one_of = [&](std::string_view attribute, std::string_view standard,
                            std::initializer_list<std::string_view> known) {
        const std::string_view found = value(attribute, standard);
        if (std::find(known.begin(), known.end(), found) == known.end())
            fail(fmt::format("<{}> with {}=\"{}\" cannot be read", tag.name, attribute, found));
        return found;
    };
    const auto number = [&](std::string_view attribute) {
        const std::string_view text = value(attribute);
        std::size_t result = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
        if (error != std::errc{} || end != text.data() + text.size())
            fail(fmt::format("no number in attribute '{}' of <{}>", attribute, tag.name));
        return result;
    };
    std::string_view section;
    bool is_vtu = false, has_piece = false, has_appended = false, is_whole = false;
    while (!is_whole && tags.next(tag)) {
        if (tag.name == "VTKFile") {
            one_of("type", {}, {"UnstructuredGrid"});
            if (one_of("byte_order", "LittleEndian", {"LittleEndian", "BigEndian"}) == "BigEndian")
                order_ = ByteOrder::big;
            if (one_of("header_type", "UInt32", {"UInt32", "UInt64"}) == "UInt64") header_bytes_ = 8;
            compressed_ = one_of("compressor", {}, {"", "vtkZLibDataCompressor"}) != "";
            is_vtu = true;
        } else if (tag.name == "/VTKFile") {
            is_whole = true;
        } else if (tag.name == "Piece") {
            if (has_piece) fail("files of more than one piece cannot be read");
            has_piece = true;
            points_ = number("NumberOfPoints");
            cells_ = number("NumberOfCells");
        } else if (tag.name == "FieldData" || tag.name == "PointData" || tag.name == "CellData" ||
                   tag.name == "Points" || tag.name == "Cells") {
            section = tag.name;
        } else if (tag.name == "DataArray") {
            const std::string_view format = one_of("format", "ascii", {"ascii", "binary", "appended"});
            Array array{.type = std::string(value("type")),
                        .encoding = format == "ascii" ? Encoding::ascii : Encoding::base64,
                        .at = tags.position(),
                        .appended = format == "appended",
                        .components = value("NumberOfComponents", "1") == "1" ? 1 : number("NumberOfComponents")};
            if (array.appended) array.at = number("offset");
            arrays_[fmt::format("{}/{}", section, section == "Points" ? "" : value("Name"))] = std::move(array);
        } else if (tag.name == "AppendedData") {
            if (one_of("encoding", "base64", {"raw", "base64"}) == "base64") appended_encoding_ = Encoding::base64;
            const std::size_t underscore = bytes_.find('_', tags.position());
            if (underscore == std::string::npos) break;
            appended_ = underscore + 1;
            has_appended = is_whole = true;
        }
    }
    const bool needs_appended =
        std::any_of(arrays_.begin(), arrays_.end(), [](const auto& array) { return array.second.appended; });
    if (!is_vtu || !has_piece || !is_whole || (needs_appended && !has_appended)) fail("not a VTU file, or cut short");
}

std::vector<std::string> VtkXmlFile::scalars(const std::string& section) const {
    std::vector<std::string> names;
    for (const auto& [name, array] : arrays_)
        if (name.starts_with(section + "/") && array.components == 1) names.push_back(name.substr(section.size() + 1));
    return names;
}

const VtkXmlFile::Array& VtkXmlFile::array(const std::string& name) const {
    const auto found = arrays_.find(name);
    if (found == arrays_.end()) fail(fmt::format("array '{}' is missing", name));
    return found->second;
}

std::size_t VtkXmlFile::start_of(const Array& array, const std::string& name) const {
    if (!array.appended) return array.at;
    if (array.at > bytes_.size() - appended_) fail(fmt::format("cut short before array '{}'", name));
    return appended_ + array.at;
}

std::string VtkXmlFile::plain_bytes(const std::string& name) const {
    const Array& stored = array(name);
    Stream stream(*this, name, start_of(stored, name), stored.appended ? appended_encoding_ : stored.encoding);
    return compressed_ ? inflated(stream, name) : std::string(stream.bytes(stream.number()));
}

std::string VtkXmlFile::inflated(Stream& stream, const std::string& name) const {
    const std::size_t blocks = stream.number();
    if (blocks == 0) return {};
    const std::size_t block = stream.number(), last = stream.number();
    const auto demand = [&](bool sound) {
        if (!sound) fail(fmt::format("array '{}' has a broken header", name));
    };
    demand(blocks <= bytes_.size() / header_bytes_ && last <= block);
    std::vector<std::size_t> sizes(blocks);
    for (std::size_t& compressed : sizes) compressed = stream.number();
    std::string whole;
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t expected = i + 1 == blocks && last > 0 ? last : block;
        const std::string_view compressed = stream.bytes(sizes[i]);
        // Nothing is compressed to less than a thousandth: no damaged number asks for more memory than that.
        demand(expected / 2000 <= compressed.size());
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
std::vector<T> VtkXmlFile::in_figures(const std::string& name) const {
    const std::size_t start = array(name).at, end = std::min(bytes_.find('<', start), bytes_.size());
    std::vector<T> result;
    const char* at = bytes_.data() + start;
    for (const char* const last = bytes_.data() + end;;) {
        while (at < last && is_space(*at)) ++at;
        if (at == last) return result;
        T value{};
        const auto [behind, error] = std::from_chars(at, last, value);
        if (error != std::errc{} || (behind < last && !is_space(*behind)))
            fail(fmt::format("array '{}' holds what is no number, or out of range", name));
        result.push_back(value);
        at = behind;
    }
}

template <class T, class Stored>
std::vector<T> VtkXmlFile::converted(const std::string& name) const {
    const std::string plain = plain_bytes(name);
    if (plain.size() % sizeof(Stored) != 0) fail(fmt::format("array '{}' has a broken length", name));
    std::vector<T> result(plain.size() / sizeof(Stored));
    for (std::size_t i = 0; i < result.size(); ++i) {
        char bytes[sizeof(Stored)];
        std::memcpy(bytes, plain.data() + i * sizeof bytes, sizeof bytes);
        if (order_ == ByteOrder::big) std::reverse(bytes, bytes + sizeof bytes);
        Stored value;
        std::memcpy(&value, bytes, sizeof value);
        if constexpr (std::is_integral_v<T>) {
            bool fits = false;
            if constexpr (std::is_integral_v<Stored>) fits = std::in_range<T>(value);
            if (!fits) fail(fmt::format("array '{}' holds a value that is out of range", name));
        }
        result[i] = static_cast<T>(value);
    }
    return result;
}

template <class T>
std::vector<T> VtkXmlFile::values(const std::string& name) const {
    const Array& stored = array(name);
    if (stored.encoding == Encoding::ascii && !stored.appended) return in_figures<T>(name);
    if (stored.type == "Float64") return converted<T, double>(name);
    if (stored.type == "Float32") return converted<T, float>(name);
    if (stored.type == "Int64") return converted<T, std::int64_t>(name);
    if (stored.type == "UInt64") return converted<T, std::uint64_t>(name);
    if (stored.type == "Int32") return converted<T, std::int32_t>(name);
    if (stored.type == "UInt32") return converted<T, std::uint32_t>(name);
    if (stored.type == "Int16") return converted<T, std::int16_t>(name);
    if (stored.type == "UInt16") return converted<T, std::uint16_t>(name);
    if (stored.type == "Int8") return converted<T, std::int8_t>(name);
    if (stored.type == "UInt8") return converted<T, std::uint8_t>(name);
    fail(fmt::format("array '{}' has the unknown type '{}'", name, stored.type));
}

template <class T>
std::vector<T> VtkXmlFile::values(const std::string& name, std::size_t expected) const {
    std::vector<T> result = values<T>(name);
    if (result.size() != expected)
        fail(fmt::format("array '{}' has {} values where {} are announced", name, result.size(), expected));
    return result;
}

template std::vector<double> VtkXmlFile::values(const std::string&, std::size_t) const;
template std::vector<std::uint8_t> VtkXmlFile::values(const std::string&) const;
template std::vector<std::uint8_t> VtkXmlFile::values(const std::string&, std::size_t) const;
template std::vector<std::uint32_t> VtkXmlFile::values(const std::string&, std::size_t) const;
template std::vector<std::int64_t> VtkXmlFile::values(const std::string&) const;
template std::vector<std::int64_t> VtkXmlFile::values(const std::string&, std::size_t) const;

}  // namespace lamina::io
