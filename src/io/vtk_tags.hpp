// The tags of XML files: VTK's and Nektar++'s.
#pragma once

#include <cstddef>
#include <map>
#include <string_view>

namespace lamina::io {

/// The name and the attributes of an XML element. The name of a closing tag begins with '/'.
struct VtkTag {
    std::string_view name;
    std::map<std::string_view, std::string_view> attributes;

    /// Returns the value of an attribute, or the default where the tag has no such attribute.
    std::string_view value(std::string_view attribute, std::string_view default_value = {}) const {
        const auto found = attributes.find(attribute);
        return found == attributes.end() ? default_value : found->second;
    }
};

/// Reads as much of XML as VTK writes: tags with quoted attributes, comments, and text, which is skipped. With expat
/// this would be about as long, and 25 times as slow where arrays are inline, since expat looks at each of their bytes.
class VtkTagReader {
public:
    /// The text must outlive this object and its tags.
    explicit VtkTagReader(std::string_view text) : text_(text) {}

    /// Reads the next tag. Returns false at the end of the text, also where it ends within a tag.
    bool next(VtkTag& tag);
    /// Returns the position behind the last tag.
    std::size_t position() const { return at_; }

private:
    void skip_blanks();
    std::string_view read_name();
    bool read_attribute(VtkTag& tag);
    bool is_at(char c) const { return at_ < text_.size() && text_[at_] == c; }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace lamina::io
