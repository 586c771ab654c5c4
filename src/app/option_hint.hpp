// Hints for options, keys and commands that lamina does not know: the closest name, or what other programs call one.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace lamina::app {

/// The name or the advice that a word which lamina does not know probably stands for.
struct Hint {
    std::string name;    ///< the name of an option or command; empty: none is meant
    std::string advice;  ///< a sentence in place of a name; empty where there is none

    bool empty() const { return name.empty() && advice.empty(); }
};

/// Returns what other programs or earlier versions mean by the word, if it is a word of theirs. `word` may have hyphens
/// in front.
Hint hint_for_other_word(const std::string& command, const std::string& word);

/// Returns the option of a command that a word probably means: the one that other programs call so, or else the one
/// with the closest name. `word` may have hyphens in front; `options` are all names that the command knows, without.
Hint hint_for_option(const std::string& command, const std::string& word, std::span<const std::string> options);

/// Returns the command that a word probably means.
Hint hint_for_command(const std::string& word, std::span<const std::string> commands);

/// Returns the hint as the end of a message: ": did you mean PREFIXname?", ": advice" or nothing.
std::string hint_text(const Hint& hint, const std::string& prefix);

}  // namespace lamina::app
