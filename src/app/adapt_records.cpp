#include "app/adapt_records.hpp"

#include <cstddef>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/files.hpp>

#include "app/fingerprint.hpp"
#include "app/report.hpp"

namespace lamina::app {

namespace {

constexpr const char* record_name = "round.json";

Json json_of(const AdaptRound& round, const std::string& digits) {
    Json json{{"fingerprint", digits}, {"vertices", round.vertices}, {"cells", round.cells},
              {"CL", round.forces.cl}, {"CD", round.forces.cd},      {"steady", round.forces.steady},
              {"iterations", Json()},  {"log10_residual", Json()},   {"seconds", round.seconds}};
    if (round.forces.iterations) json["iterations"] = *round.forces.iterations;
    if (round.forces.residual) json["log10_residual"] = *round.forces.residual;
    return json;
}

}  // namespace

std::optional<AdaptRound> read_round(const std::filesystem::path& folder, const std::string& digits) {
    AdaptRound round;
    const bool exists = read_record(folder / record_name, "round", digits, [&](const Json& json) {
        round.vertices = json.at("vertices");
        round.cells = json.at("cells");
        round.forces.cl = json.at("CL");
        round.forces.cd = json.at("CD");
        round.forces.steady = json.at("steady");
        if (!json.at("iterations").is_null()) round.forces.iterations = json.at("iterations").get<std::size_t>();
        if (!json.at("log10_residual").is_null()) round.forces.residual = json.at("log10_residual").get<double>();
        round.seconds = json.at("seconds");
    });
    return exists ? std::optional(round) : std::nullopt;
}

void write_round(const std::filesystem::path& folder, const AdaptRound& round, const std::string& digits) {
    write_file(folder / record_name, to_text(json_of(round, digits)));
}

std::string rounds_table(const std::vector<AdaptRound>& rounds) {
    std::string text = "round,vertices,cells,iterations,steady,CL,CD,log10_residual,seconds\n";
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const auto& [vertices, cells, forces, seconds] = rounds[i];
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{:.1f}\n", i, vertices, cells, optional_text(forces.iterations),
                        forces.steady ? "yes" : "no", forces.cl, forces.cd, optional_text(forces.residual), seconds);
    }
    return text;
}

}  // namespace lamina::app
