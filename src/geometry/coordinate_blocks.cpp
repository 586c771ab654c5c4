#include "geometry/coordinate_blocks.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/text.hpp"
#include "geometry/characters.hpp"
#include "geometry/column_names.hpp"

namespace lamina::geometry {

namespace {

/// Returns whether a row before all coordinates gives the domain, as files of MSES and ISES do: it has four or more
/// numbers, and the next row of numbers has fewer.
bool is_domain_line(const TextRows& rows, std::size_t i) {
    if (rows[i].number_count < 4) return false;
    const auto next = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(i) + 1, rows.end(),
                                   [](const TextRow& r) { return r.kind == RowKind::numbers; });
    return next != rows.end() && next->number_count < 4;
}

class BlockReader {
public:
    BlockReader(const TextRows& rows, const std::string& file) : rows_(rows), file_(file) {}

    CoordinateDocument read() {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (is_note_on_a_correction(rows_[i])) {
                document_.notes.push_back(
                    fmt::format("line {}: '{}' taken as a note on a correction", rows_[i].line, rows_[i].words().text));
            } else if (rows_[i].kind == RowKind::numbers) {
                read_numbers(i);
            } else {
                read_other(i);
            }
        }
        return std::move(document_);
    }

private:
    const TextRows& rows_;
    const std::string& file_;
    CoordinateDocument document_;
    std::string label_;         ///< text since the last block, the title of the next one
    std::string column_label_;  ///< RowWords::label of the last row
    bool has_points_ = false;   ///< coordinates were read
    bool noted_commas_ = false;
    bool in_run_ = false;  ///< the row before holds coordinates
    /// Whether a comment, and whether a text or a separator, stands between the last coordinates and this row.
    bool comment_between_ = false, text_between_ = false;
    std::size_t comma_separated_line_ = 0, decimal_comma_line_ = 0;  ///< the last ones; 0: none

    /// Returns whether a row behind the coordinates and other text says what was changed in them.
    bool is_note_on_a_correction(const TextRow& row) const {
        return row.has_arrow && has_points_ && text_between_ && !in_run_;
    }

    void read_numbers(std::size_t i) {
        const TextRow& row = rows_[i];
        // In the place of the title, "12 34 revised" is one, but "1.0 0.0 revised" is a point with a remark.
        const bool is_title = !has_points_ && label_.empty() && row.has_remark && !row.has_decimal_points;
        if (is_title) {
            label_ = row.words().text;
            document_.titled = true;
        } else if (is_separator(row)) {
            document_.sections.emplace_back();
            in_run_ = false;
            text_between_ = true;
        } else if (has_points_ || !is_domain_line(rows_, i)) {
            add_point(i);
        }
    }

    void add_point(std::size_t i) {
        const TextRow& row = rows_[i];
        if (row.number_count > max_columns)
            throw InputError({file_, row.line, {}},
                             fmt::format("{} numbers where x and y are expected", row.number_count));
        if (!has_points_) {
            if (!row.has_fractions) document_.first_row = row.words().text;
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
        CoordinateSection& section = document_.sections.back();
        if (in_run_ && row.words().label != column_label_) in_run_ = false;
        if (!in_run_) {
            if (label_.empty()) label_ = row.words().label;
            section.push_back({{}, std::exchange(label_, {}), comment_between_ && !text_between_});
            section.back().points.reserve(rows_of_run(i));
        }
        column_label_ = row.words().label;
        section.back().points.push_back({{{row.values[0], row.values[1]}, row.line}, row.number_count, row.values});
        has_points_ = true;
        in_run_ = true;
        comment_between_ = text_between_ = false;
    }

    /// Returns how many rows of numbers follow each other from a row on that may be points of one run.
    std::size_t rows_of_run(std::size_t i) const {
        const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end = std::find_if(first, rows_.end(), [&](const TextRow& row) {
            return row.kind != RowKind::numbers || is_separator(row) || row.words().label != first->words().label;
        });
        return static_cast<std::size_t>(end - first);
    }

    /// Throws InputError where commas separate numbers in some rows and are decimal signs in others. Commas within quotes
    /// and between semicolons are clear in each row.
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
        const std::string_view unit = row.words().unit;
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

    void read_other(std::size_t i) {
        const TextRow& row = rows_[i];
        if (row.kind == RowKind::text) {
            read_text(i);
            text_between_ = true;
        } else if (row.kind == RowKind::comment && document_.first_comment.empty() && !has_points_) {
            document_.first_comment = row.words().text;
        }
        comment_between_ |= row.kind == RowKind::comment;
        if (!has_points_) read_heading(row);
        in_run_ = false;
    }

    void read_text(std::size_t i) {
        const TextRow& row = rows_[i];
        if (in_run_ && announces_points(i)) return;
        if (in_run_ && row.words().damage.empty() && !row.words().damage_in_run.empty() && first_row_may_be_title(row))
            make_first_row_title();
        const std::string& damage =
            in_run_ && row.words().damage.empty() ? row.words().damage_in_run : row.words().damage;
        if (!damage.empty()) throw InputError({file_, row.line, {}}, damage);
        if (label_.empty()) label_ = row.words().text;
        if (!has_points_) document_.titled = true;
    }

    /// Returns whether the only row of coordinates so far has whole numbers alone, as a title may have, and words and
    /// no title stand beside it.
    bool first_row_may_be_title(const TextRow& next) const {
        constexpr std::ptrdiff_t min_letters = 3;
        const CoordinateSection& section = document_.sections.back();
        return !document_.titled && document_.sections.size() == 1 && section.size() == 1 &&
               section[0].points.size() == 1 && !document_.first_row.empty() &&
               std::count_if(next.words().text.begin(), next.words().text.end(), is_letter) >= min_letters;
    }

    void make_first_row_title() {
        CoordinateSection& section = document_.sections.back();
        document_.notes.push_back(fmt::format("line {}: '{}' taken as a title, not as coordinates: text follows",
                                              section[0].points[0].line, document_.first_row));
        label_ = std::exchange(document_.first_row, {});
        section.clear();
        document_.titled = true;
        document_.has_leading_zeros = has_points_ = in_run_ = false;
    }

    /// Returns whether a row among coordinates is a lone number that tells how many rows of them follow, as before each
    /// element of some files.
    bool announces_points(std::size_t i) const {
        constexpr double min_points = 3;
        const TextRow& row = rows_[i];
        const double count = row.values[0];
        if (row.number_count != 1 || row.has_remark || row.has_fractions || count < min_points) return false;
        std::size_t following = 0;
        for (++i; i < rows_.size() && rows_[i].kind != RowKind::text; ++i)
            if (rows_[i].kind == RowKind::numbers) ++following;
        return count == static_cast<double>(following);
    }

    /// Remembers what may be the names of columns, and the unit beside or below them.
    void read_names(const TextRow& row) {
        if (are_units(row.words().names)) {
            for (const std::string& name : row.words().names)
                if (document_.unit.empty()) document_.unit = unit_of_text(name);
            return;
        }
        document_.column_names = row.words().names;
        document_.names_line = row.line;
        document_.names_have_separators = row.has_separators;
        document_.unit = unit_of_names(row.words().names);
    }

    /// Remembers a row without coordinates that may say how to read those that follow.
    void read_heading(const TextRow& row) {
        const std::string text = core::lower_case(row.words().text);
        document_.heading += text + '\n';
        if (!row.words().names.empty() && !text.starts_with("zone")) read_names(row);  // Tecplot's line below the names
        // OpenVSP writes "1  Sym Flag (0 - No, 1 - Yes)".
        if (text.starts_with("1") && text.find("sym flag") != std::string::npos) document_.symmetry_line = row.line;
    }
};

}  // namespace

CoordinateDocument split_into_blocks(const TextRows& rows, const std::string& file) {
    return BlockReader(rows, file).read();
}

}  // namespace lamina::geometry
