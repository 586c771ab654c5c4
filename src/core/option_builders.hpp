// Builders for the rows of option tables. Each builder takes the option's name as on the command line, its text in
// help, and member(options), which returns a reference to the member that the option sets.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lamina/length.hpp>
#include <lamina/option.hpp>
#include <lamina/value_range.hpp>

namespace lamina {

/// The word for a number that lamina chooses itself.
inline constexpr const char* auto_word = "auto";

/// The values of an enumeration, each with its word.
template <class Choice>
using Choices = std::vector<std::pair<std::string, Choice>>;

// Typed access to the value of an option, whose key is `option` in messages. All throw OptionError for values of
// another kind.

/// Returns a number, which may have been written as a whole number.
LAMINA_EXPORT double as_number(const OptionValue& value, const std::string& option);
/// Returns a length: a number counts chords, and a word is read by parse_length().
LAMINA_EXPORT Length as_length(const OptionValue& value, const std::string& option);
/// Returns a range of numbers, which a word is.
LAMINA_EXPORT ValueRange as_range(const OptionValue& value, const std::string& option);
/// Returns the value as a whole number. A real number without a fraction is one: 2e9.
LAMINA_EXPORT std::int64_t as_count(const OptionValue& value, const std::string& option);
/// Returns the value as true or false.
LAMINA_EXPORT bool as_flag(const OptionValue& value, const std::string& option);
/// Returns the value as a word.
LAMINA_EXPORT std::string as_word(const OptionValue& value, const std::string& option);
/// Returns a word, or the text of a number, for words that may be numbers.
LAMINA_EXPORT std::string as_word_or_number(const OptionValue& value, const std::string& option);
/// Returns several words; a single word counts as a list of one.
LAMINA_EXPORT std::vector<std::string> as_words(const OptionValue& value, const std::string& option);
/// Returns several words, or the text of one number, for words that may be numbers.
LAMINA_EXPORT std::vector<std::string> as_words_or_number(const OptionValue& value, const std::string& option);

/// Returns the value that as_length() reads back: a number of chords, or a word.
LAMINA_EXPORT OptionValue option_value(Length length);

/// Throws OptionError where the range does not contain the value.
LAMINA_EXPORT void require_in_range(const OptionRange& range, double value, const std::string& option);

/// Returns why a word is refused: it is none of these names. Says which of them was probably meant.
LAMINA_EXPORT std::string unknown_choice(const std::string& word, const std::vector<std::string>& names);

/// Collects the rows of one table under one heading of the help.
template <class Options>
class OptionTableBuilder {
public:
    /// Begins a table under this heading.
    explicit OptionTableBuilder(std::string group) : group_(std::move(group)) {}

    /// Adds an option that takes a number; member(options) is a double or an optional of one.
    template <class Member>
    Option<Options>& number(const std::string& name, std::string metavar, std::string help, OptionRange range,
                            Member member) {
        const std::string key = option_key(name);
        const auto set = [=](Options& o, const OptionValue& value) {
            const double number = as_number(value, key);
            require_in_range(range, number, key);
            member(o) = number;
        };
        const auto get = [=](const Options& o) { return value_of<double>(member(o)); };
        return add({name, OptionKind::number, std::move(metavar), std::move(help), range.text(), set, get});
    }

    /// Adds an option that takes a number, or a range of numbers whose middle one is the number then; member(options)
    /// is a double, and range_member(options) an optional ValueRange.
    template <class Member, class RangeMember>
    Option<Options>& number_or_range(const std::string& name, std::string metavar, std::string help, OptionRange range,
                                     Member member, RangeMember range_member) {
        const std::string key = option_key(name);
        const auto set_range = [=](Options& o, const std::string& text) {
            const std::vector<double> values = values_of(*(range_member(o) = as_range(text, key)));
            for (const double number : values) require_in_range(range, number, key);
            member(o) = values[values.size() / 2];
        };
        const auto range_of = [=](const Options& o) -> std::optional<OptionValue> {
            if (!range_member(o)) return {};
            return range_text(*range_member(o));
        };
        return with_words(
            number(name, std::move(metavar), std::move(help), range, member), OptionKind::number_or_range, set_range,
            [=](Options& o) { range_member(o).reset(); }, range_of);
    }

    /// Adds an option that takes a number, or a word in its place; member(options) is an optional double, and
    /// word_member(options) a string. At most one of both is set.
    template <class Member, class WordMember>
    Option<Options>& number_or_word(const std::string& name, std::string metavar, std::string help, OptionRange range,
                                    Member member, WordMember word_member) {
        const auto set_word = [=, key = option_key(name)](Options& o, const std::string& word) {
            if (word.empty()) throw OptionError(key, "must be a number or a word");
            member(o).reset();
            word_member(o) = word;
        };
        const auto word_of = [=](const Options& o) -> std::optional<OptionValue> {
            if (word_member(o).empty()) return {};
            return word_member(o);
        };
        return with_words(
            number(name, std::move(metavar), std::move(help), range, member), OptionKind::number_or_word, set_word,
            [=](Options& o) { word_member(o).clear(); }, word_of);
    }

    /// Adds an option that takes a length; member(options) is a Length or an optional of one.
    template <class Member>
    Option<Options>& length(const std::string& name, std::string metavar, std::string help, OptionRange range,
                            Member member) {
        const std::string key = option_key(name);
        const auto set = [=](Options& o, const OptionValue& value) {
            const Length length = as_length(value, key);
            require_in_range(range, length.value, key);
            member(o) = length;
        };
        const auto get = [=](const Options& o) -> std::optional<OptionValue> {
            const std::optional<Length> length = member(o);
            return length ? std::optional<OptionValue>(option_value(*length)) : std::nullopt;
        };
        return add({name, OptionKind::length, std::move(metavar), std::move(help), range.text(), set, get});
    }

    /// Adds an option that takes a whole number; member(options) is an integer or an optional of one.
    template <class Member>
    Option<Options>& count(const std::string& name, std::string metavar, std::string help, OptionRange range,
                           Member member) {
        using Number = decltype(number_type(member(std::declval<Options&>())));
        const std::string key = option_key(name);
        const auto set = [=](Options& o, const OptionValue& value) {
            const std::int64_t number = as_count(value, key);
            require_in_range(range, static_cast<double>(number), key);
            member(o) = static_cast<Number>(number);
        };
        const auto get = [=](const Options& o) { return value_of<std::int64_t>(member(o)); };
        return add({name, OptionKind::count, std::move(metavar), std::move(help), range.text(), set, get});
    }

    /// Adds an option that takes a whole number or "auto"; member(options) is an optional, empty for "auto".
    template <class Member>
    Option<Options>& count_or_auto(const std::string& name, const std::string& metavar, std::string help,
                                   OptionRange range, Member member) {
        Option<Options>& option = count(name, metavar + "|auto", std::move(help), range, member);
        option.kind = OptionKind::count_or_auto;
        const auto set_count = option.set;
        const auto get_count = option.get;
        option.set = [=, key = option.key()](Options& o, const OptionValue& value) {
            const auto* word = std::get_if<std::string>(&value);
            if (word && *word != auto_word) throw OptionError(key, "must be a whole number or 'auto'");
            if (word) {
                member(o).reset();
            } else {
                set_count(o, value);
            }
        };
        option.get = [=](const Options& o) { return get_count(o).value_or(auto_word); };
        return option;
    }

    /// Adds a flag that sets the member to `meaning` where it is given.
    template <class Member>
    Option<Options>& flag(const std::string& name, std::string help, bool meaning, Member member) {
        const auto set = [=, key = option_key(name)](Options& o, const OptionValue& value) {
            member(o) = as_flag(value, key) == meaning;
        };
        const auto get = [=](const Options& o) { return std::optional<OptionValue>(member(o) == meaning); };
        return add({name, OptionKind::flag, "", std::move(help), "", set, get});
    }

    /// Adds an option that takes one of the words of `choices`; member(options) is of the enumeration.
    template <class Choice, class Member>
    Option<Options>& choice(const std::string& name, std::string help, const Choices<Choice>& choices, Member member) {
        std::string metavar;
        for (const auto& entry : choices) metavar += (metavar.empty() ? "" : "|") + entry.first;
        const auto set = [=, key = option_key(name)](Options& o, const OptionValue& value) {
            const std::string word = as_word(value, key);
            const auto found =
                std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.first == word; });
            if (found == choices.end()) throw OptionError(key, unknown_choice(word, names_of(choices)));
            member(o) = found->second;
        };
        const auto get = [=](const Options& o) -> std::optional<OptionValue> {
            const auto named =
                std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.second == member(o); });
            if (named == choices.end()) return std::nullopt;
            return named->first;
        };
        return add({name, OptionKind::word, std::move(metavar), std::move(help), "", set, get});
    }

    /// Adds an option that takes a text as it is; member(options) is a string.
    template <class Member>
    Option<Options>& text(const std::string& name, OptionKind kind, std::string metavar, std::string help,
                          Member member) {
        const auto set = [=, key = option_key(name)](Options& o, const OptionValue& value) {
            member(o) = as_word(value, key);
        };
        const auto get = [=](const Options& o) { return std::optional<OptionValue>(member(o)); };
        return add({name, kind, std::move(metavar), std::move(help), "", set, get});
    }

    /// Adds an option that takes several texts; member(options) is a vector of strings.
    template <class Member>
    Option<Options>& list(const std::string& name, OptionKind kind, std::string metavar, std::string help,
                          Member member) {
        const auto set = [=, key = option_key(name)](Options& o, const OptionValue& value) {
            member(o) = as_words(value, key);
        };
        const auto get = [=](const Options& o) { return std::optional<OptionValue>(member(o)); };
        return add({name, kind, std::move(metavar), std::move(help), "", set, get});
    }

    /// Adds an option that takes a word with a grammar of its own. parse(text) returns the value or throws UsageError
    /// with the bare reason; print(value) returns the text that parse reads back; member(options) is an optional.
    template <class Parse, class Print, class Member>
    Option<Options>& spec(const std::string& name, std::string metavar, std::string help, Parse parse, Print print,
                          Member member) {
        const auto set = [=, key = option_key(name)](Options& o, const OptionValue& value) {
            member(o) = parsed(key, as_word_or_number(value, key), parse);
        };
        const auto get = [=](const Options& o) {
            return member(o) ? std::optional<OptionValue>(print(*member(o))) : std::nullopt;
        };
        return add({name, OptionKind::word, std::move(metavar), std::move(help), "", set, get});
    }

    /// Adds an option that takes several words with a grammar as for spec(); member(options) is a vector.
    template <class Parse, class Print, class Member>
    Option<Options>& specs(const std::string& name, std::string metavar, std::string help, Parse parse, Print print,
                           Member member) {
        const auto set = [=, key = option_key(name)](Options& o, const OptionValue& value) {
            member(o).clear();
            for (const std::string& text : as_words_or_number(value, key))
                member(o).push_back(parsed(key, text, parse));
        };
        const auto get = [=](const Options& o) {
            std::vector<std::string> texts;
            for (const auto& entry : member(o)) texts.push_back(print(entry));
            return std::optional<OptionValue>(std::move(texts));
        };
        return add({name, OptionKind::repeated, std::move(metavar), std::move(help), "", set, get});
    }

    /// Adds a row that is complete but for its heading.
    Option<Options>& add(Option<Options> option) {
        option.group = group_;
        table_.push_back(std::move(option));
        return table_.back();
    }

    /// Hands over the table.
    OptionTable<Options> take() { return std::move(table_); }

private:
    std::string group_;
    OptionTable<Options> table_;

    /// Lets an option that takes a number take words, too. `set_word(options, word)` stores one, `forget_word(options)`
    /// drops it for a number, and `word_of(options)` returns the value that stands for one, if there is one.
    template <class SetWord, class ForgetWord, class WordOf>
    static Option<Options>& with_words(Option<Options>& option, OptionKind kind, SetWord set_word,
                                       ForgetWord forget_word, WordOf word_of) {
        option.kind = kind;
        option.set = [=, set_number = option.set](Options& o, const OptionValue& value) {
            if (const auto* word = std::get_if<std::string>(&value)) return set_word(o, *word);
            set_number(o, value);
            forget_word(o);
        };
        option.get = [=, number_of = option.get](const Options& o) {
            const std::optional<OptionValue> word = word_of(o);
            return word ? word : number_of(o);
        };
        return option;
    }

    // These functions are never defined: their result is the type of a number, or of the number in an optional.
    template <class Number>
    static Number number_type(Number);
    template <class Number>
    static Number number_type(std::optional<Number>);

    template <class As, class Member>
    static std::optional<OptionValue> value_of(const Member& member) {
        if constexpr (requires { member.has_value(); }) {
            return member ? std::optional<OptionValue>(static_cast<As>(*member)) : std::nullopt;
        } else {
            return static_cast<As>(member);
        }
    }

    template <class Choice>
    static std::vector<std::string> names_of(const Choices<Choice>& choices) {
        std::vector<std::string> names;
        for (const auto& entry : choices) names.push_back(entry.first);
        return names;
    }

    template <class Parse>
    static auto parsed(const std::string& key, const std::string& text, Parse parse) {
        try {
            return parse(text);
        } catch (const OptionError&) {
            throw;
        } catch (const UsageError& error) {
            throw OptionError(key, error.what());
        }
    }
};

/// Returns a function that follows a chain of pointers to members: member_at(&Case::options, &Options::layer) returns a
/// function from a case to its layer options.
template <class... Members>
auto member_at(Members... members) {
    return [members...](auto& options) -> auto& { return (options.*....*members); };
}

}  // namespace lamina
