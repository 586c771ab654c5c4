#include "flow/euler/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "flow/boundary_layer.hpp"
#include "flow/euler/wall_flow.hpp"

namespace lamina::flow::euler {

namespace {

// Lengths are multiples of the extent of an element.

/// Least distance between stations. Layers say nothing of changes over less than a few of their thicknesses, and flow
/// without friction stagnates within as much of a trailing edge.
constexpr double station_distance = 0.01;
/// Length over which changes of the displaced flux are smoothed. Shorter waves would grow from step to step, since the
/// flow answers them faster than the layers do.
constexpr double smoothing_length = 0.03;
/// Length of the wake.
constexpr double wake_length = 1;
/// Largest change of the displaced flux in a step, as a share.
constexpr double largest_share = 0.1;
/// Share of the change of a force that a step makes.
constexpr double force_relaxation = 0.3;

/// Returns x with x - length^2 x'' = given, where x' = 0 at both ends: the implicit smoothing of A. Jameson, T. J.
/// Baker, AIAA-83-1929, here along stations at unequal distances. The integral of x is that of `given`.
std::vector<double> smoothed(std::span<const Station> at, std::span<const double> given, double length) {
    const std::size_t n = at.size();
    std::vector<double> above(n), x(n);
    const auto spread = [&](std::size_t i) { return length * length / (at[i + 1].s - at[i].s); };
    const auto width = [&](std::size_t i) { return 0.5 * (at[std::min(i + 1, n - 1)].s - at[i > 0 ? i - 1 : 0].s); };
    for (std::size_t i = 0; i < n; ++i) {
        const double before = i > 0 ? spread(i - 1) : 0, behind = i + 1 < n ? spread(i) : 0;
        const double pivot = width(i) + before + behind - (i > 0 ? before * above[i - 1] : 0);
        above[i] = behind / pivot;
        x[i] = (width(i) * given[i] + (i > 0 ? before * x[i - 1] : 0)) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 0;) x[i] += above[i] * x[i + 1];
    return x;
}

/// Returns the flux that stations displace after a step towards what their layers displace, or after the first step,
/// which takes all of that.
std::vector<double> next_displaced(std::span<const Station> stations, std::span<const StationLayer> layers,
                                   double length, bool is_first) {
    std::vector<double> changes;
    if (is_first) {
        for (const StationLayer& layer : layers) changes.push_back(layer.displaced);
        return changes;
    }
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const double most = largest_share * stations[i].displaced;
        changes.push_back(std::clamp(layers[i].displaced - stations[i].displaced, -most, most));
    }
    changes = smoothed(stations, changes, length);
    for (std::size_t i = 0; i < stations.size(); ++i) changes[i] += stations[i].displaced;
    return changes;
}

/// Returns the numbers of stations at places along them, up to the last station. `picked` are the places of the
/// stations.
std::vector<double> at_places(std::span<const double> places, std::span<const std::size_t> picked,
                              std::span<const double> numbers) {
    std::vector<double> along;
    std::size_t j = 0;  // the station before
    for (std::size_t i = picked[0]; i <= picked.back(); ++i) {
        if (i > picked[j + 1]) ++j;
        const double begin = places[picked[j]], share = (places[i] - begin) / (places[picked[j + 1]] - begin);
        along.push_back(numbers[j] + share * (numbers[j + 1] - numbers[j]));
    }
    return along;
}

Station station_at(double s, const Four& state, double displaced) {
    return {s, length(velocity(state)), state[0], displaced};
}

/// Returns the flux that enters at place i of a chain, between the middles of its neighbours: from nothing before the
/// first place if it `begins` there, and up to the last place itself.
double entering(std::span<const double> displaced, std::size_t i, bool begins) {
    const double before = i > 0 ? 0.5 * (displaced[i - 1] + displaced[i]) : begins ? 0.0 : displaced[0];
    const double behind = i + 1 < displaced.size() ? 0.5 * (displaced[i] + displaced[i + 1]) : displaced[i];
    return behind - before;
}

}  // namespace

DisplacementLayers::DisplacementLayers(const EulerMesh& mesh, const DualMesh& dual, const EulerOptions& options,
                                       std::span<const Four> states)
    : dual_(dual),
      options_(options),
      gas_{total_enthalpy({1, options.mach, 0, 1 / heat_ratio}), options.mach / *options.reynolds},
      triangles_(numbered_triangles(dual, mesh.triangles)),
      sources_(dual.points.size()),
      forces_(dual.points.size()) {
    for (const EulerWall& wall : mesh.walls) {
        Element& e = elements_.emplace_back(make_element(wall));
        lay_wake(e, states);
    }
}

void DisplacementLayers::lay_wake(Element& e, std::span<const Four> states) const {
    constexpr double edge_share = 0.4;  // stations closer to each other than so many edges are long say nothing new
    const double spacing = station_distance * e.extent;
    e.wake = trace_wake(dual_, triangles_, states, e.wake_start, wake_length * e.extent, 2 * spacing);
    double last = 0;
    for (std::size_t k = 0; k < e.wake.size(); ++k) {
        const WakePoint& p = e.wake[k];
        e.wake_s.push_back(k > 0 ? e.wake_s[k - 1] + distance(e.wake[k - 1].at, p.at)
                                 : distance(e.wake_start.at, p.at));
        const double edge = distance(dual_.points[p.a], dual_.points[p.b]);
        if (e.wake_s[k] - last < std::max(spacing, edge_share * edge)) continue;
        e.wake_picked.push_back(k);
        last = e.wake_s[k];
    }
    e.wake_displaced.assign(e.wake_picked.size(), 0);
    e.wake_forces.assign(e.wake_picked.size(), {});
}

/// Returns the stations of the wake. The first one is the trailing edge, of which they know nothing yet.
std::vector<Station> DisplacementLayers::wake_stations(const Element& e, std::span<const Four> states) const {
    std::vector<Station> stations{{}};
    for (std::size_t j = 0; j < e.wake_picked.size(); ++j) {
        const WakePoint& p = e.wake[e.wake_picked[j]];
        stations.push_back(station_at(e.wake_s[e.wake_picked[j]], (1 - p.share) * states[p.a] + p.share * states[p.b],
                                      e.wake_displaced[j]));
    }
    return stations;
}

DisplacementLayers::Element DisplacementLayers::make_element(const EulerWall& wall) const {
    Element e;
    Box box;
    for (const VertexId v : wall.outline) {
        e.outline.push_back(dual_.number_of[v.index()]);
        box.include(dual_.points[e.outline.back()]);
    }
    e.sides_end = wall.sides_end;
    e.extent = std::max(box.width(), box.height());
    e.displaced.assign(wall.sides_end + 1, 0);
    const auto at = [&](std::size_t place) { return dual_.points[vertex(e, place)]; };
    for (std::size_t place = e.sides_end; place <= e.outline.size(); ++place)
        e.wake_start.corners.push_back(vertex(e, place));
    e.wake_start.at = midpoint(at(0), at(e.sides_end));
    e.wake_start.direction = unit(unit(at(0) - at(1)) + unit(at(e.sides_end) - at(e.sides_end - 1)));
    return e;
}

void DisplacementLayers::update(std::span<const Four> states) {
    std::fill(sources_.begin(), sources_.end(), 0.0);
    std::fill(forces_.begin(), forces_.end(), Point{});
    for (Element& element : elements_) update(element, states);
    is_first_ = false;
}

void DisplacementLayers::update(Element& e, std::span<const Four> states) {
    constexpr std::size_t least_stations = 4;
    if (e.wake_picked.size() < least_stations) return;
    std::vector<Station> wake = wake_stations(e, states);
    std::vector<WallState> along;
    for (const std::uint32_t v : e.outline) along.push_back({dual_.points[v], velocity(states[v]), states[v][3]});
    const std::size_t stagnation = find_stagnation(along, e.sides_end);
    std::array<Side, 2> sides{make_side(e, states, stagnation, true, wake[1]),
                              make_side(e, states, stagnation, false, wake[1])};
    if (sides[0].layers.empty() || sides[1].layers.empty()) return;
    e.sides = std::move(sides);
    double end = 0;
    for (const Side& side : e.sides) {
        const std::vector<double> displaced =
            next_displaced(side.stations, side.layers, smoothing_length * e.extent, is_first_);
        end += displaced.back();
        enter_side(e, side, displaced);
    }
    std::vector<double> displaced = lead_wake(e, wake);
    displaced[0] = end;
    enter_wake(e, displaced);
    turn_wake(e, wake, states);
}

DisplacementLayers::Side DisplacementLayers::make_side(const Element& e, std::span<const Four> states,
                                                       std::size_t stagnation, bool is_upper,
                                                       const Station& first_of_wake) const {
    Side side;
    side.places.resize(is_upper ? stagnation + 1 : e.sides_end - stagnation + 1);
    std::iota(side.places.begin(), side.places.end(), is_upper ? 0 : stagnation);
    if (is_upper) std::reverse(side.places.begin(), side.places.end());
    std::vector<Station> along;
    std::vector<EdgePoint> edge;
    for (std::size_t i = 0; i < side.places.size(); ++i) {
        const std::uint32_t v = vertex(e, side.places[i]);
        const double way = i > 0 ? distance(dual_.points[v], dual_.points[vertex(e, side.places[i - 1])]) : 0.0;
        side.s.push_back(i > 0 ? side.s.back() + way : 0.0);
        along.push_back(station_at(side.s[i], states[v], e.displaced[side.places[i]]));
        edge.push_back({side.s[i], i > 0 ? along[i].speed / options_.mach : 0.0});
    }
    // The layers of incompressible flow are laminar at first, and say what is displaced in the beginning.
    const std::vector<LayerPoint> plain = boundary_layer(edge, {.viscosity = 1 / *options_.reynolds});
    std::size_t turbulent = 0;
    while (turbulent < plain.size() && plain[turbulent].state == BoundaryLayerState::laminar) ++turbulent;
    constexpr std::size_t least_places = 4;
    if (turbulent + least_places > plain.size()) return side;
    constexpr double largest_shape = 2.5;
    if (is_first_)
        for (std::size_t i = 0; i < along.size(); ++i)
            along[i].displaced =
                along[i].density * along[i].speed * std::min(plain[i].displacement, largest_shape * plain[i].momentum);
    for (std::size_t i = 0; i < turbulent; ++i) side.laminar_friction.push_back(plain[i].skin_friction);
    side.picked = {turbulent};
    pick_stations(e, along, first_of_wake, side);
    const Station& first = side.stations.front();
    side.layers = march(side.stations, plate_layer(plain[turbulent].momentum, edge_of(first, first.speed, gas_)), gas_,
                        {.answer_length = smoothing_length * e.extent});
    return side;
}

/// Picks places at some distance from each other and takes the means of the flow between the middles of their ways. At
/// the trailing edge the flow is that between the stations before and behind it.
void DisplacementLayers::pick_stations(const Element& e, std::span<const Station> along, const Station& first_of_wake,
                                       Side& side) const {
    const double least = station_distance * e.extent, end = along.back().s;
    for (std::size_t i = side.picked[0] + 1; i < along.size() && end - along[i].s >= least; ++i)
        if (along[i].s - along[side.picked.back()].s >= least) side.picked.push_back(i);
    side.picked.push_back(along.size() - 1);
    side.stations.push_back(along[side.picked[0]]);
    for (std::size_t j = 1; j + 1 < side.picked.size(); ++j) {
        Station station = along[side.picked[j]];
        const double first = 0.5 * (along[side.picked[j - 1]].s + station.s),
                     last = 0.5 * (station.s + along[side.picked[j + 1]].s);
        double width = 0, speed = 0, density = 0;
        for (std::size_t i = side.picked[j - 1] + 1; i < side.picked[j + 1]; ++i) {
            const double left = std::max(first, 0.5 * (along[i - 1].s + along[i].s)),
                         right = std::min(last, 0.5 * (along[i].s + along[i + 1].s)),
                         part = std::max(right - left, 0.0);
            width += part;
            speed += part * along[i].speed;
            density += part * along[i].density;
        }
        station.speed = speed / width;
        station.density = density / width;
        side.stations.push_back(station);
    }
    const Station& before = side.stations.back();
    const double share = (end - before.s) / (end - before.s + first_of_wake.s);
    side.stations.push_back({end, before.speed + share * (first_of_wake.speed - before.speed),
                             before.density + share * (first_of_wake.density - before.density),
                             along.back().displaced});
}

/// Leads the wake from the layers at the trailing edge on. Completes the first station, and returns the flux that they
/// all displace next.
std::vector<double> DisplacementLayers::lead_wake(Element& e, std::vector<Station>& stations) const {
    const Side &upper = e.sides[0], &lower = e.sides[1];
    const StationLayer &u = upper.layers.back(), &l = lower.layers.back();
    const Station &us = upper.stations.back(), &ls = lower.stations.back();
    stations[0] = {0, 0.5 * (us.speed + ls.speed), 0.5 * (us.density + ls.density), us.displaced + ls.displaced};
    const double momentum = u.layer.momentum + l.layer.momentum;
    const ShearLayer half{0.5 * momentum,
                          (u.layer.momentum * u.layer.shape + l.layer.momentum * l.layer.shape) / momentum,
                          0.5 * (u.layer.entrainment + l.layer.entrainment)};
    e.wake_layers = march(stations, half, gas_,
                          {.kind = LayerKind::wake,
                           .layers = 2,
                           .answer_length = is_first_ ? 0 : smoothing_length * e.extent,
                           .first_speed = 0.5 * (u.speed + l.speed)});
    return next_displaced(stations, e.wake_layers, smoothing_length * e.extent, is_first_);
}

void DisplacementLayers::enter_side(Element& e, const Side& side, std::span<const double> displaced) {
    std::vector<double> along;
    for (std::size_t i = 0; i < side.picked[0]; ++i)  // laminar layers displace little
        along.push_back(displaced[0] * side.s[i] / side.s[side.picked[0]]);
    const std::vector<double> turbulent = at_places(side.s, side.picked, displaced);
    along.insert(along.end(), turbulent.begin(), turbulent.end());
    for (std::size_t i = 0; i < along.size(); ++i) {
        e.displaced[side.places[i]] = along[i];
        sources_[vertex(e, side.places[i])] += entering(along, i, true);
    }
}

void DisplacementLayers::enter_wake(Element& e, std::span<const double> displaced) {
    std::vector<double> places{0};  // the trailing edge, and the points
    places.insert(places.end(), e.wake_s.begin(), e.wake_s.end());
    std::vector<std::size_t> picked{0};
    for (const std::size_t k : e.wake_picked) picked.push_back(k + 1);
    const std::vector<double> along = at_places(places, picked, displaced);
    for (const std::uint32_t corner : {vertex(e, 0), vertex(e, e.sides_end)})
        sources_[corner] += 0.5 * entering(along, 0, false);
    for (std::size_t k = 0; k <= e.wake_picked.back(); ++k) {
        const WakePoint& p = e.wake[k];
        const double mass = entering(along, k + 1, false);
        sources_[p.a] += (1 - p.share) * mass;
        sources_[p.b] += p.share * mass;
    }
    std::copy(displaced.begin() + 1, displaced.end(), e.wake_displaced.begin());
}

/// Lets the wake push the flow where it is curved.
void DisplacementLayers::turn_wake(Element& e, std::span<const Station> stations, std::span<const Four> states) {
    std::vector<Point> directions{e.wake_start.direction};
    for (const std::size_t k : e.wake_picked) {
        const WakePoint& p = e.wake[k];
        directions.push_back(unit(velocity((1 - p.share) * states[p.a] + p.share * states[p.b])));
    }
    for (std::size_t j = 0; j < e.wake_picked.size(); ++j) {
        const WakePoint& p = e.wake[e.wake_picked[j]];
        const std::size_t i = j + 1;  // of the station
        const StationLayer& layer = e.wake_layers[i];
        const double turn = 0.5 * cross(directions[i - 1], directions[std::min(i + 1, e.wake_picked.size())]);
        const double missing = 2 * layer.layer.momentum * (1 + layer.shape);
        const Point force =
            turn * missing * stations[i].density * stations[i].speed * stations[i].speed * perpendicular(directions[i]);
        e.wake_forces[j] = e.wake_forces[j] + force_relaxation * (force - e.wake_forces[j]);
        forces_[p.a] = forces_[p.a] + (1 - p.share) * e.wake_forces[j];
        forces_[p.b] = forces_[p.b] + p.share * e.wake_forces[j];
    }
}

void DisplacementLayers::add_fluxes(std::span<const Four> states, std::vector<Four>& sums) const {
    for (std::size_t v = 0; v < sums.size(); ++v) {
        if (sources_[v] == 0 && forces_[v] == Point{}) continue;
        // The gas enters with the velocity and the total enthalpy that are there.
        const Four& state = states[v];
        const Point force = forces_[v];
        sums[v] = sums[v] - sources_[v] * Four{1, state[1], state[2], total_enthalpy(state)} -
                  Four{0, force.x, force.y, dot(force, velocity(state))};
    }
}

std::vector<WallLayers> DisplacementLayers::walls() const {
    std::vector<WallLayers> walls;
    for (const Element& e : elements_) {
        WallLayers& wall = walls.emplace_back();
        wall.layers.resize(e.sides_end + 1);
        for (const Side& side : e.sides) {
            for (std::size_t i = 0; i < side.laminar_friction.size(); ++i)
                wall.layers[side.places[i]].friction = side.laminar_friction[i];
            for (std::size_t j = 0; j < side.layers.size(); ++j) {
                const StationLayer& l = side.layers[j];
                const std::size_t last = j + 1 < side.layers.size() ? side.picked[j + 1] : side.picked[j] + 1;
                // A place between two stations has the layer of the first one.
                for (std::size_t i = side.picked[j]; i < last; ++i)
                    wall.layers[side.places[i]] = {
                        l.layer.momentum, l.shape,
                        l.friction * l.density * (l.speed / options_.mach) * (l.speed / options_.mach)};
            }
        }
        if (e.wake_layers.empty()) continue;
        const StationLayer& end = e.wake_layers.back();
        wall.wake_momentum = 2 * end.layer.momentum;
        wall.wake_shape = end.layer.shape;
        wall.wake_speed = end.speed / options_.mach;
        wall.wake_density = end.density;
    }
    return walls;
}

}  // namespace lamina::flow::euler
