#include "geometry/coordinate_blocks.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/text.hpp"

namespace lamina::geometry {

namespace {

bool is_separator(const TextRow& row) { return row.values[0] == 999.0 && row.values[1] == 999.0; }

/// Returns whether a row before all coordinates gives the domain, as files of MSES and ISES do: it has four or more
/// numbers, and the next row of numbers has fewer.
bool is_domain_line(const std::vector<TextRow>& rows, std::size_t i) {
    if (rows[i].number_count < 4) return false;
    const auto next = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(i) + 1, rows.end(),
                                   [](const TextRow& r) { return r.kind == RowKind::numbers; });
    return next != rows.end() && next->number_count < 4;
}

class BlockReader {
public:
    BlockReader(const std::vector<TextRow>& rows, const std::string& file) : rows_(rows), file_(file) {}

    CoordinateDocument read() {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (rows_[i].kind == RowKind::numbers) {
                read_numbers(i);
            } else {
                read_other(rows_[i]);
            }
        }
        return std::move(document_);
    }

private:
    const std::vector<TextRow>& rows_;
    const std::string& file_;
    CoordinateDocument document_;
    std::string label_;        ///< text since the last block, the title of the next one
    bool has_points_ = false;  ///< coordinates were read
    bool in_run_ = false;      ///< the row before holds coordinates

    void read_numbers(std::size_t i) {
        const TextRow& row = rows_[i];
        // In the place of the title, "12 34 revised" is one, but "1.0 0.0 revised" is a point with a remark.
        const bool is_title = !has_points_ && label_.empty() && row.has_remark && !row.has_decimal_points;
        if (is_title) {
            label_ = row.text;
            document_.titled = true;
        } else if (is_separator(row)) {
            document_.sections.emplace_back();
            in_run_ = false;
        } else if (has_points_ || !is_domain_line(rows_, i)) {
            add_point(row);
        }
    }

    void add_point(const TextRow& row) {
        if (row.number_count > row.values.size())
            throw InputError({file_, row.line, {}},
                             fmt::format("{} numbers where x and y are expected", row.number_count));
        const Point at{row.values[0], row.values[1]};
        if (!in_exact_range(at))
            throw InputError({file_, row.line, at}, fmt::format("coordinates must be 0 or of a magnitude from {} to {}",
                                                                min_exact_coordinate, max_exact_coordinate));
        document_.csv |= row.has_separators;
        if (row.has_decimal_commas && document_.notes.empty())
            document_.notes.push_back(fmt::format("line {}: decimal commas read as points", row.line));
        CoordinateSection& section = document_.sections.back();
        if (!in_run_) section.push_back({{}, std::exchange(label_, {})});
        section.back().points.push_back({{at, row.line}, row.number_count, row.values[2]});
        has_points_ = true;
        in_run_ = true;
    }

    void read_other(const TextRow& row) {
        if (row.kind == RowKind::text) {
            read_text(row);
        } else if (row.kind == RowKind::comment && document_.first_comment.empty() && !has_points_) {
            document_.first_comment = row.text;
        }
        if (!has_points_) read_heading(row);
        in_run_ = false;
    }

    void read_text(const TextRow& row) {
        const std::string& damage = in_run_ && row.damage.empty() ? row.damage_in_run : row.damage;
        if (!damage.empty()) throw InputError({file_, row.line, {}}, damage);
        if (label_.empty()) label_ = row.text;
        if (!has_points_) document_.titled = true;
    }

    /// Remembers a row without coordinates that may say how to read those that follow.
    void read_heading(const TextRow& row) {
        const std::string text = core::lower_case(row.text);
        document_.heading += text + '\n';
        // OpenVSP writes "1  Sym Flag (0 - No, 1 - Yes)".
        if (text.starts_with("1") && text.find("sym flag") != std::string::npos) document_.symmetry_line = row.line;
    }
};

}  // namespace

CoordinateDocument split_into_blocks(const std::vector<TextRow>& rows, const std::string& file) {
    return BlockReader(rows, file).read();
}

}  // namespace lamina::geometry
