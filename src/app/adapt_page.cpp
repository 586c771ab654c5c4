#include "app/adapt_page.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace lamina::app {

namespace {

constexpr double chart_width = 420, chart_height = 260, chart_margin = 60;

/// Returns the text as it stands between tags.
std::string markup_of(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

/// The part of a line that a chart shows, never empty.
struct Range {
    double low = HUGE_VAL, high = -HUGE_VAL;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void widen() {
        const double room = high > low ? 0.08 * (high - low) : std::max(0.01 * std::abs(high), 1e-12);
        low -= room;
        high += room;
    }
    double share(double value) const { return (value - low) / (high - low); }
};

/// Returns a chart of a coefficient against the number of vertices. Rounds are numbered dots on a line.
std::string chart(const char* name, std::span<const AdaptRound> rounds, double SolvedForces::*coefficient) {
    Range x, y;
    for (const AdaptRound& round : rounds) {
        x.include(static_cast<double>(round.vertices));
        y.include(round.forces.*coefficient);
    }
    const std::string ends = fmt::format(
        "<text x=\"{}\" y=\"{}\">{:.0f}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.0f} vertices"
        "</text><text x=\"4\" y=\"{}\">{:.6g}</text><text x=\"4\" y=\"{}\">{:.6g}</text>",
        chart_margin, chart_height - 8, x.low, chart_width, chart_height - 8, x.high, chart_height - chart_margin / 2,
        y.low, chart_margin / 2, y.high);
    x.widen();
    y.widen();
    std::string line, dots;
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const double px =
            chart_margin + (chart_width - chart_margin) * x.share(static_cast<double>(rounds[i].vertices));
        const double py = (chart_height - chart_margin / 2) * (1 - y.share(rounds[i].forces.*coefficient));
        line += fmt::format("{:.1f},{:.1f} ", px, py);
        dots +=
            fmt::format("<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"4\"/><text x=\"{0:.1f}\" y=\"{2:.1f}\">{3}</text>",
                        px, py, py - 7, i);
    }
    return fmt::format(
        "<figure><figcaption>{}</figcaption><svg viewBox=\"0 0 {} {}\" width=\"{}\"><polyline points=\"{}\" "
        "fill=\"none\" "
        "stroke=\"#8ac\"/>{}{}</svg></figure>\n",
        name, chart_width + 40, chart_height, chart_width + 40, line, dots, ends);
}

}  // namespace

std::string adapt_page(const std::string& title, std::span<const AdaptRound> rounds) {
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{0}</title>\n<style>body{{font:15px "
        "sans-serif;margin:2em}}figure{{display:inline-block;margin:0 2em 1em "
        "0}}svg{{font-size:12px}}td,th{{padding:.2em "
        ".8em;text-align:right}}</style>\n<h1>{0}</h1>\n",
        markup_of(title));
    text += chart("CL", rounds, &SolvedForces::cl) + chart("CD", rounds, &SolvedForces::cd);
    text += "<table><tr><th>round<th>vertices<th>cells<th>iterations<th>CL<th>CD<th>steady<th>mesh</tr>\n";
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const auto& [vertices, cells, forces, seconds] = rounds[i];
        text += fmt::format(
            "<tr><td>{0}<td>{1}<td>{2}<td>{3}<td>{4:.6f}<td>{5:.7f}<td>{6}<td><a "
            "href=\"round_{0}/mesh.html\">look</a></tr>\n",
            i, vertices, cells, optional_text(forces.iterations), forces.cl, forces.cd, forces.steady ? "yes" : "no");
    }
    return text + "</table>\n</html>\n";
}

}  // namespace lamina::app
