#include "flows.hpp"

#include <optional>
#include <string>
#include <vector>

#include <lamina/compressible_flow.hpp>
#include <lamina/flow.hpp>

#include "values.hpp"

namespace lamina::web {

using emscripten::val;

namespace {

/// Returns the places and pressures of an element, from the trailing edge along the upper side and along the lower one
/// back to it. The sides share the stagnation point.
template <class WallPoint>
val pressures_of(const std::string& name, const std::vector<WallPoint>& upper, const std::vector<WallPoint>& lower) {
    std::vector<double> points, cp;
    const auto add = [&](const WallPoint& p) {
        points.insert(points.end(), {p.at.x, p.at.y});
        cp.push_back(p.pressure_coefficient);
    };
    for (auto p = upper.rbegin(); p != upper.rend(); ++p) add(*p);
    for (std::size_t i = 1; i < lower.size(); ++i) add(lower[i]);
    val entry = val::object();
    entry.set("name", name);
    entry.set("points", copied(points.data(), points.size()));
    entry.set("cp", copied(cp.data(), cp.size()));
    return entry;
}

val facts_of(double alpha_deg, double lift, const std::optional<double>& mach, bool compressible) {
    val facts = val::object();
    facts.set("alpha", alpha_deg);
    facts.set("lift", lift);
    facts.set("mach", mach ? val(*mach) : val::null());
    facts.set("critical_cp", mach ? val(critical_pressure_coefficient(*mach)) : val::null());
    facts.set("compressible", compressible);
    facts.set("elements", val::array());
    return facts;
}

}  // namespace

val flow_facts_of(const MeshResult& result, const FlowConditions& conditions) {
    if (result.compressible_flow) {
        const CompressibleFlow& flow = *result.compressible_flow;
        val facts = facts_of(flow.alpha_deg, flow.lift, flow.mach, true);
        for (const auto& [name, upper, lower] : flow.elements)
            facts["elements"].call<void>("push", pressures_of(name, upper.points, lower.points));
        return facts;
    }
    if (!result.flow || result.flow->estimated || conditions.mach.value_or(0) >= 1) return val::null();
    const Flow flow = conditions.mach ? with_compressed_pressures(*result.flow, *conditions.mach) : *result.flow;
    val facts = facts_of(flow.alpha_deg, flow.lift, conditions.mach, false);
    for (const ElementFlow& element : flow.elements)
        facts["elements"].call<void>("push", pressures_of(element.name, element.upper, element.lower));
    return facts;
}

}  // namespace lamina::web
