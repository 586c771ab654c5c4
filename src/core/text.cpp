// Text is made here and read in text_parsing.cpp, which the amalgamation (tools/amalgamate.py) does without.
#include "core/text.hpp"

namespace lamina::core {

std::string TextPart::text() const {
    switch (kind_) {
        case Kind::letter:
            return to_text(letter_);
        case Kind::number:
            return to_text(number_);
        case Kind::integer:
            return to_text(integer_);
        case Kind::natural:
            return to_text(natural_);
        case Kind::text:
            break;
    }
    return std::string(text_);
}

std::string joined_text(std::initializer_list<TextPart> parts) {
    std::string text;
    for (const TextPart& part : parts) text += part.text();
    return text;
}

}  // namespace lamina::core
