#include "io/vtk_tags.hpp"

#include "io/number_text.hpp"

namespace lamina::io {

bool VtkTagReader::next(VtkTag& tag) {
    tag = {};
    std::size_t start = text_.find('<', at_);
    while (start != std::string_view::npos && text_.substr(start).starts_with("<!--")) {
        const std::size_t end = text_.find("-->", start);
        start = end == std::string_view::npos ? end : text_.find('<', end);
    }
    if (start == std::string_view::npos) return false;
    at_ = start + 1;
    tag.name = read_name();
    while (at_ < text_.size()) {
        skip_blanks();
        if (is_at('/') || is_at('?')) {
            ++at_;
        } else if (is_at('>')) {
            ++at_;
            return true;
        } else if (!read_attribute(tag)) {
            return false;
        }
    }
    return false;
}

void VtkTagReader::skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

std::string_view VtkTagReader::read_name() {
    const std::size_t start = at_;
    if (is_at('/') || is_at('?')) ++at_;
    const auto ends_name = [](char c) { return is_blank(c) || c == '=' || c == '>' || c == '/' || c == '?'; };
    while (at_ < text_.size() && !ends_name(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
}

bool VtkTagReader::read_attribute(VtkTag& tag) {
    const std::string_view key = read_name();
    skip_blanks();
    if (key.empty() || !is_at('=')) return false;
    ++at_;
    skip_blanks();
    if (!is_at('"') && !is_at('\'')) return false;
    const std::size_t start = at_ + 1, end = text_.find(text_[at_], start);
    if (end == std::string_view::npos) return false;
    tag.attributes[key] = text_.substr(start, end - start);
    at_ = end + 1;
    return true;
}

}  // namespace lamina::io
