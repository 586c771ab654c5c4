#include "geometry/coordinate_blocks.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/text.hpp"
#include "geometry/characters.hpp"
#include "geometry/column_names.hpp"
#include "geometry/label_column.hpp"

namespace lamina::geometry {

namespace {

/// Returns the start of a text for a message.
std::string shown(const std::string& text) {
    constexpr std::size_t most_shown = 60;  // bytes
    return text.size() <= most_shown ? text : printable(std::string_view(text).substr(0, most_shown)) + "...";
}

class BlockReader {
public:
    BlockReader(std::string_view text, const std::string& file) : rows_(text, file), file_(file) {
        document_.sections.clear();
    }

    CoordinateDocument read() {
        while (const std::optional<TextRow> row = rows_.next()) {
            document_.has_rows = true;
            if (is_note_on_a_correction(*row)) {
                read_note(*row);
            } else if (row->kind == RowKind::numbers) {
                read_numbers(*row);
            } else {
                read_other(*row);
            }
        }
        end_section();
        return std::move(document_);
    }

private:
    LabelledRowReader rows_;
    const std::string& file_;
    CoordinateDocument document_;
    // The section that is being read: a vector would take thrice its size while it grows.
    std::deque<RowPoint> points_;
    std::deque<CoordinateBlock> blocks_;
    std::string titles_;
    std::string label_;         ///< text since the last block, the title of the next one
    std::string column_label_;  ///< TextRow::label of the last row
    bool has_points_ = false;   ///< coordinates were read
    bool noted_commas_ = false;
    std::size_t corrections_ = 0;  ///< notes on them
    bool in_run_ = false;          ///< the row before holds coordinates
    /// Whether a comment, and whether a text or a separator, stands between the last coordinates and this row.
    bool comment_between_ = false, text_between_ = false;
    std::size_t comma_separated_line_ = 0, decimal_comma_line_ = 0;  ///< the last ones; 0: none

    /// Returns whether a row behind the coordinates and other text says what was changed in them.
    bool is_note_on_a_correction(const TextRow& row) const {
        return row.has_arrow && has_points_ && text_between_ && !in_run_;
    }

    void read_note(const TextRow& row) {
        constexpr std::size_t most_notes = 100;  // nobody reads more, and a file may have a million
        if (++corrections_ <= most_notes)
            document_.notes.push_back(fmt::format("line {}: '{}' taken as a note on a correction", row.line, row.text));
    }

    void read_numbers(const TextRow& row) {
        // In the place of the title, "12 34 revised" is one, but "1.0 0.0 revised" is a point with a remark.
        const bool is_title = !has_points_ && label_.empty() && row.has_remark && !row.has_decimal_points;
        if (is_title) {
            label_ = row.text;
            document_.titled = true;
        } else if (is_separator(row)) {
            end_section();
            in_run_ = false;
            text_between_ = true;
        } else if (has_points_ || !is_domain_line(row)) {
            add_point(row);
        }
    }

    /// Returns whether a row before all coordinates gives the domain, as files of MSES and ISES do: it has four or more
    /// numbers, and the next row of numbers has fewer.
    bool is_domain_line(const TextRow& row) const {
        if (row.number_count < 4) return false;
        LabelledRowReader ahead = rows_;
        while (const std::optional<TextRow> next = ahead.next())
            if (next->kind == RowKind::numbers) return next->number_count < 4;
        return false;
    }

    void end_section() {
        CoordinateSection& section = document_.sections.emplace_back();
        section.points.assign(points_.begin(), points_.end());
        points_.clear();
        section.blocks.assign(blocks_.begin(), blocks_.end());
        blocks_.clear();
        section.titles = std::exchange(titles_, {});
    }

    void add_point(const TextRow& row) {
        if (row.number_count > max_columns)
            throw InputError({file_, row.line, {}},
                             fmt::format("{} numbers where x and y are expected", row.number_count));
        if (!has_points_) {
            if (!row.has_fractions) document_.first_row = row.text;
            document_.has_leading_zeros = row.has_leading_zeros;
        } else if (row.has_leading_zeros) {
            document_.has_leading_zeros = false;
        }
        document_.csv |= row.has_separators;
        require_one_meaning_of_commas(row);
        require_one_unit(row);
        if (row.has_label && !has_points_) read_about_labels(row);
        if (row.has_decimal_commas && !std::exchange(noted_commas_, true))
            document_.notes.push_back(fmt::format("line {}: decimal commas read as points", row.line));
        if (!in_run_ || row.label != column_label_) begin_block(row);
        column_label_ = row.label;
        const std::span<const double> numbers(row.values.data(), row.number_count);
        points_.push_back({{{numbers[0], numbers[1]}, static_cast<std::uint32_t>(row.line)},
                           static_cast<std::uint16_t>(row.number_count),
                           document_.numbers.add(numbers.subspan(2))});
        has_points_ = true;
        in_run_ = true;
        comment_between_ = text_between_ = false;
    }

    void begin_block(const TextRow& row) {
        if (label_.empty()) label_ = row.label;
        blocks_.push_back({static_cast<std::uint32_t>(points_.size()), static_cast<std::uint32_t>(titles_.size()),
                           static_cast<std::uint32_t>(label_.size()), comment_between_ && !text_between_});
        titles_ += std::exchange(label_, {});
    }

    /// Throws InputError where commas separate numbers in some rows and are decimal signs in others. Commas within
    /// quotes and between semicolons are clear in each row.
    void require_one_meaning_of_commas(const TextRow& row) {
        if (row.has_comma_separators) comma_separated_line_ = row.line;
        if (row.has_decimal_commas && !row.has_separators) decimal_comma_line_ = row.line;
        if (comma_separated_line_ > 0 && decimal_comma_line_ > 0)
            throw InputError({file_, row.line, {}},
                             fmt::format("commas separate numbers on line {}, but are decimal signs on line {}",
                                         comma_separated_line_, decimal_comma_line_));
    }

    /// Throws InputError where the numbers of the file have different units.
    void require_one_unit(const TextRow& row) {
        const std::string_view unit = row.unit;
        if (unit.empty() || unit == document_.unit) return;
        if (!document_.unit.empty())
            throw InputError({file_, row.line, {}},
                             fmt::format("the unit is {} here, but {} before", unit, document_.unit));
        document_.unit = unit;
        document_.notes.push_back(fmt::format("line {}: the unit is {}, also that of the mesh", row.line, unit));
    }

    /// Says that the first column holds labels, and forgets its name.
    void read_about_labels(const TextRow& row) {
        document_.notes.push_back(fmt::format("line {}: first column ignored, it holds labels", row.line));
        std::vector<std::string>& names = document_.column_names;
        if (names.size() == row.number_count + std::size_t{1}) names.erase(names.begin());
    }

    void read_other(const TextRow& row) {
        if (row.kind == RowKind::text) {
            read_text(row);
            text_between_ = true;
        } else if (row.kind == RowKind::comment && document_.first_comment.empty() && !has_points_) {
            document_.first_comment = row.text;
        }
        comment_between_ |= row.kind == RowKind::comment;
        if (!has_points_) read_heading(row);
        in_run_ = false;
    }

    void read_text(const TextRow& row) {
        if (document_.fraction_line == 0 && has_fraction(row.text)) {
            document_.fraction_line = row.line;
            document_.fraction_text = shown(row.text);
        }
        if (in_run_ && announces_points(row)) return;
        if (in_run_ && row.damage.empty() && !row.damage_in_run.empty() && first_row_may_be_title(row))
            make_first_row_title();
        const std::string& damage = in_run_ && row.damage.empty() ? row.damage_in_run : row.damage;
        if (!damage.empty()) throw InputError({file_, row.line, {}}, damage);
        if (label_.empty()) label_ = row.text;
        if (!has_points_) document_.titled = true;
    }

    /// Returns whether the first point of a text is that of a number.
    static bool has_fraction(const std::string& text) {
        const std::size_t point = text.find('.');
        return point != std::string::npos && point + 1 < text.size() && is_digit(text[point + 1]);
    }

    /// Returns whether the only row of coordinates so far has whole numbers alone, as a title may have, and words and
    /// no title stand beside it.
    bool first_row_may_be_title(const TextRow& next) const {
        constexpr std::ptrdiff_t min_letters = 3;
        return !document_.titled && document_.sections.empty() && points_.size() == 1 && !document_.first_row.empty() &&
               std::count_if(next.text.begin(), next.text.end(), is_letter) >= min_letters;
    }

    void make_first_row_title() {
        document_.notes.push_back(fmt::format("line {}: '{}' taken as a title, not as coordinates: text follows",
                                              points_[0].line, document_.first_row));
        label_ = std::exchange(document_.first_row, {});
        points_.clear();
        blocks_.clear();
        document_.titled = true;
        document_.has_leading_zeros = has_points_ = in_run_ = false;
    }

    /// Returns whether a row among coordinates is a lone number that tells how many rows of them follow, as before each
    /// element of some files.
    bool announces_points(const TextRow& row) const {
        constexpr double min_points = 3;
        const double count = row.values[0];
        if (row.number_count != 1 || row.has_remark || row.has_fractions || count < min_points) return false;
        std::size_t following = 0;
        LabelledRowReader ahead = rows_;
        for (auto next = ahead.next(); next && next->kind != RowKind::text; next = ahead.next())
            if (next->kind == RowKind::numbers) ++following;
        return count == static_cast<double>(following);
    }

    /// Remembers what may be the names of columns, and the unit beside or below them.
    void read_names(const TextRow& row) {
        if (are_units(row.names)) {
            for (const std::string& name : row.names)
                if (document_.unit.empty()) document_.unit = unit_of_text(name);
            return;
        }
        document_.column_names = row.names;
        document_.names_line = row.line;
        document_.names_have_separators = row.has_separators;
        const std::vector<std::string> units = units_of_names(row.names);
        if (units.size() > 1)
            throw InputError({file_, row.line, {}},
                             fmt::format("the header names different units, {} and {}: x and y need the same one",
                                         units[0], units[1]));
        document_.unit = units.empty() || units[0] == "%" ? std::string() : units[0];
    }

    /// Remembers a row without coordinates that may say how to read those that follow.
    void read_heading(const TextRow& row) {
        const std::string text = core::lower_case(row.text);
        document_.heading += text + '\n';
        if (!row.names.empty() && !text.starts_with("zone")) read_names(row);  // Tecplot's line below the names
        // OpenVSP writes "1  Sym Flag (0 - No, 1 - Yes)".
        if (text.starts_with("1") && text.find("sym flag") != std::string::npos) document_.symmetry_line = row.line;
    }
};

}  // namespace

const double* FurtherNumbers::add(std::span<const double> numbers) {
    constexpr std::size_t block_size = 4096;
    if (numbers.empty()) return nullptr;
    if (blocks_.empty() || blocks_.back().size() + numbers.size() > blocks_.back().capacity())
        blocks_.emplace_back().reserve(std::max(block_size, numbers.size()));
    std::vector<double>& block = blocks_.back();
    const double* const place = block.data() + block.size();
    block.insert(block.end(), numbers.begin(), numbers.end());
    return place;
}

void CoordinateSection::set_title(std::size_t i, const std::string& title) {
    blocks[i].title = static_cast<std::uint32_t>(titles.size());
    blocks[i].title_size = static_cast<std::uint32_t>(title.size());
    titles += title;
}

void CoordinateSection::remove_first_point() {
    if (block(0).size() == 1) blocks.erase(blocks.begin());
    points.erase(points.begin());
    for (CoordinateBlock& b : blocks) b.first = b.first > 0 ? b.first - 1 : 0;
}

void CoordinateSection::remove_blocks(const std::vector<bool>& removed) {
    std::size_t kept_blocks = 0, kept_points = 0;
    for (std::size_t i = 0, first = 0, end = 0; i < blocks.size(); ++i, first = end) {
        end = i + 1 < blocks.size() ? blocks[i + 1].first : points.size();
        if (removed[i]) continue;
        blocks[kept_blocks] = blocks[i];
        blocks[kept_blocks++].first = static_cast<std::uint32_t>(kept_points);
        for (std::size_t p = first; p < end; ++p) points[kept_points++] = points[p];
    }
    blocks.resize(kept_blocks);
    points.resize(kept_points);
}

CoordinateDocument read_blocks(std::string_view text, const std::string& file) {
    return BlockReader(text, file).read();
}

}  // namespace lamina::geometry
