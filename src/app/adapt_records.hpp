// The records of the rounds of `lamina adapt`: round.json in the folder of each, and the table of all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/adapt_page.hpp"

namespace lamina::app {

/// Returns the round that a folder holds; nothing where it was not finished. Throws UsageError where it is of other
/// options than these digits stand for.
std::optional<AdaptRound> read_round(const std::filesystem::path& folder, const std::string& digits);

/// Writes the record of a finished round into its folder. Throws IoError.
void write_round(const std::filesystem::path& folder, const AdaptRound& round, const std::string& digits);

/// Returns the rounds as a table in CSV.
std::string rounds_table(const std::vector<AdaptRound>& rounds);

}  // namespace lamina::app
