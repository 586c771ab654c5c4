// Turns of elements as functions of time.
#include <lamina/morph.hpp>

#include <cmath>
#include <cstddef>
#include <variant>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "core/text.hpp"

namespace lamina::morphing {

namespace {

constexpr const char* turn_grammar =
    "a turn in time is ELEMENT:pitch:MEAN:AMPLITUDE:FREQUENCY[:X,Y] or ELEMENT:deflect:DEG:DURATION[:X,Y]";

/// Returns the time or the frequency of a text.
double positive_number(const std::string& text) {
    const double number = core::parse_number(text);
    core::require_text(number >= 1e-100 && number <= 1e100, text, "must be from 1e-100 to 1e100");
    return number;
}

double parse_angle(const std::string& text) {
    const double angle = core::parse_number(text);
    core::require_text(std::abs(angle) <= 180, text, "must be from -180 to 180");
    return angle;
}

Point parse_center(const std::string& text) {
    const std::vector<double> numbers = core::parse_numbers(text, ',');
    core::require_text(numbers.size() == 2, text, "two coordinates X,Y belong here");
    return {numbers[0], numbers[1]};
}

/// The time until a turn repeats itself or ends.
struct DurationOfCourse {
    double operator()(const Pitching& pitching) const { return 1 / pitching.frequency; }
    double operator()(const Deflecting& deflecting) const { return deflecting.duration; }
};

/// The angle at a time, in degrees.
struct AngleOfCourse {
    double time;

    double operator()(const Pitching& pitching) const {
        const double turns = pitching.frequency * time;
        const double phase = 2 * core::pi * (turns - std::floor(turns));
        return pitching.mean_deg + pitching.amplitude_deg * core::sin_reproducible(phase);
    }
    double operator()(const Deflecting& deflecting) const {
        if (time >= deflecting.duration) return deflecting.angle_deg;
        return 0.5 * deflecting.angle_deg * (1 - core::cos_reproducible(core::pi * time / deflecting.duration));
    }
};

}  // namespace

}  // namespace lamina::morphing

namespace lamina {

using namespace morphing;

TurnInTime parse_turn_in_time(const std::string& text) {
    const std::vector<std::string> parts = core::split(text, ':');
    const std::size_t n = parts.size();
    if (n < 4 || parts[0].empty()) throw UsageError(turn_grammar);
    TurnInTime turn;
    turn.element = parts[0];
    if (parts[1] == "pitch" && (n == 5 || n == 6))
        turn.course = Pitching{parse_angle(parts[2]), parse_angle(parts[3]), positive_number(parts[4])};
    else if (parts[1] == "deflect" && (n == 4 || n == 5))
        turn.course = Deflecting{parse_angle(parts[2]), positive_number(parts[3])};
    else
        throw UsageError(turn_grammar);
    if (n == (parts[1] == "pitch" ? 6 : 5)) turn.center = parse_center(parts.back());
    return turn;
}

double duration_of(const TurnInTime& turn) { return std::visit(DurationOfCourse{}, turn.course); }

Transformation turn_at(const TurnInTime& turn, double time) {
    return {turn.element, Rotation{-std::visit(AngleOfCourse{time}, turn.course), turn.center}};
}

}  // namespace lamina
