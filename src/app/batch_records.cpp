#include "app/batch_records.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>

#include "app/fingerprint.hpp"

namespace lamina::app {

namespace {

namespace fs = std::filesystem;

/// The contents of a file in few words.
struct FileContents {
    std::uintmax_t bytes = 0;
    std::uint64_t hash = no_text;
};

/// Returns the contents of a file; nothing where it cannot be read.
std::optional<FileContents> contents_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    FileContents contents;
    std::string block(std::size_t{1} << 20, '\0');
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
        const std::string_view read(block.data(), static_cast<std::size_t>(in.gcount()));
        contents.bytes += read.size();
        contents.hash = hashed(contents.hash, read);
    }
    if (in.bad()) return {};
    return contents;
}

/// Adds a file to a list, or the files of a folder in the order of their names.
void add_files(const fs::path& path, std::vector<fs::path>& files) {
    if (!fs::is_directory(path)) {
        files.push_back(path);
        return;
    }
    std::vector<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) inside.push_back(entry.path());
    std::sort(inside.begin(), inside.end());
    for (const fs::path& file : inside) add_files(file, files);
}

/// Returns whether a file still has the contents that an entry of files_report() names.
bool is_unchanged(const Json& entry) {
    const fs::path file = entry["file"].get<std::string>();
    std::error_code failed;
    if (fs::file_size(file, failed) != entry["bytes"].get<std::uintmax_t>() || failed) return false;
    const std::optional<FileContents> contents = contents_of(file);
    return contents && text_of(contents->hash) == entry["fnv1a"].get<std::string>();
}

// Types of the values of a record.
bool is_text(const Json& value) { return value.is_string(); }
bool is_number(const Json& value) { return value.is_number(); }
bool is_count(const Json& value) { return value.is_number_unsigned(); }
bool is_list(const Json& value) { return value.is_array(); }

/// Returns whether an object has a value of this type under a key.
bool holds(const Json& object, const char* key, bool (*is_type)(const Json&)) {
    const auto found = object.find(key);
    return found != object.end() && is_type(*found);
}

bool is_file(const Json& value) {
    return value.is_object() && holds(value, "file", is_text) && holds(value, "bytes", is_count) &&
           holds(value, "fnv1a", is_text);
}

/// Returns whether a record has all that a job which is done has, so that it can be read without a look at types. A
/// journal may come from another version, or from an editor.
bool is_complete(const Json& record) {
    for (const char* key : {"fingerprint", "outcome", "error", "hash"})
        if (!holds(record, key, is_text)) return false;
    for (const char* key : {"exit_code", "points", "triangles", "quadrilaterals", "seconds"})
        if (!holds(record, key, is_number)) return false;
    if (!holds(record, "warnings", is_list) || !holds(record, "files", is_list)) return false;
    const Json &files = record["files"], quality = record.value("quality", Json());
    return std::all_of(files.begin(), files.end(), is_file) && quality.is_object() &&
           std::all_of(quality.begin(), quality.end(), is_number);
}

/// Returns whether a spreadsheet takes a text for a formula. Negative numbers are none.
bool is_formula(const std::string& text) {
    if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return false;
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + (text.front() == '+' ? 1 : 0), end, number);
    return read.ec != std::errc{} || read.ptr != end;
}

/// Returns a field of CSV. An apostrophe before what would be a formula makes it a text.
std::string csv_field(std::string text) {
    if (is_formula(text)) text.insert(0, 1, '\'');
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
    return '"' + text + '"';
}

std::string csv_field(const Json& value) {
    return csv_field(value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump());
}

}  // namespace

std::string id_of(const BatchJob& job) {
    std::string id = job.name;
    for (const auto& [option, value] : job.swept) id += fmt::format(" {}={}", option, value);
    return id;
}

Json files_report(const MeshCase& mesh_case, const MeshDestination& destination) {
    std::vector<fs::path> files;
    for (const RunFile& file : files_written(mesh_case, destination)) add_files(file.path, files);
    Json report = Json::array();
    for (const fs::path& file : files) {
        const std::optional<FileContents> contents = contents_of(file);
        if (!contents) throw IoError(file.string(), "cannot be read back");
        report.push_back({{"file", file.string()}, {"bytes", contents->bytes}, {"fnv1a", text_of(contents->hash)}});
    }
    return report;
}

std::string line_of(const Json& record) { return record.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::map<std::string, Json> read_journal(const fs::path& journal) {
    std::map<std::string, Json> records;
    std::ifstream in(journal);
    for (std::string line; std::getline(in, line);) {
        const Json record = Json::parse(line, nullptr, false);
        if (record.is_object() && record.contains("job") && record["job"].is_string())
            records[record["job"].get<std::string>()] = record;
    }
    return records;
}

bool still_holds(const Json& record, const std::string& digits) {
    if (!is_complete(record) || record["fingerprint"] != digits || record["outcome"] != "done") return false;
    return std::all_of(record["files"].begin(), record["files"].end(), is_unchanged);
}

std::string table_of(const std::vector<BatchJob>& jobs, const std::vector<Json>& records) {
    std::string text = "name";
    if (!jobs.empty())
        for (const auto& [option, value] : jobs.front().swept) text += "," + option;
    text +=
        ",outcome,exit_code,error,warnings,points,triangles,quadrilaterals,min_angle,max_angle,median_first_height,"
        "seconds,hash\n";
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const Json& record = records[i];
        text += csv_field(jobs[i].name);
        for (const auto& [option, value] : jobs[i].swept) text += "," + csv_field(value);
        for (const char* key : {"outcome", "exit_code", "error"}) text += "," + csv_field(record.value(key, Json()));
        text += fmt::format(",{}", record.value("warnings", Json::array()).size());
        for (const char* key : {"points", "triangles", "quadrilaterals"})
            text += "," + csv_field(record.value(key, Json()));
        const Json quality = record.value("quality", Json::object());
        for (const char* key : {"min_angle", "max_angle", "median_first_height"})
            text += "," + csv_field(quality.value(key, Json()));
        for (const char* key : {"seconds", "hash"}) text += "," + csv_field(record.value(key, Json()));
        text += "\n";
    }
    return text;
}

}  // namespace lamina::app
