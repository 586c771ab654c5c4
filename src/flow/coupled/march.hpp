// Layers led downstream, station by station.
#pragma once

#include <functional>
#include <optional>

#include "flow/coupled/interval.hpp"
#include "flow/coupled/solver.hpp"

namespace lamina::flow::coupled {

/// The law by which the speed at a station answers the displaced flux there: speed = `speed` + `answer` (flux -
/// `flux`).
struct SpeedLaw {
    double speed, answer, flux;
};

/// The kind of an interval.
enum class IntervalKind { first, laminar, transition, turbulent, wake };

bool is_turbulent(IntervalKind kind);

/// Limits of Station::shear in turbulent layers.
inline constexpr double least_shear = 1e-7, largest_shear = 0.4;

/// Keeps the numbers of a station in the range that the closures are made for.
void keep_in_range(Station& b, IntervalKind kind);

/// Returns the kind of the interval that ends at station k of a stretch with these layers.
IntervalKind kind_of(const Stretch& stretch, std::size_t k);

/// Returns the equations of an interval of this kind; there is no first station where it is the first.
Equations equations_of(IntervalKind kind, const Station& a, const Station& b, const std::optional<double>& trip,
                       const LayerConditions& conditions);

/// Leads the layers along a stretch. Its stations have their places, and numbers to begin with; the first one of a wake
/// is known. Finds where layers become turbulent. Where `prescribed`, speeds are those of the laws without an answer,
/// as long as layers stay attached; beyond that the shape factor is prescribed, and the speeds follow (XFOIL, section
/// 4).
void lead_layers(Stretch& stretch, std::vector<Station>& stations, const LayerConditions& conditions, bool prescribed,
                 const std::function<SpeedLaw(std::size_t)>& law);

/// Returns the first station of a wake behind two sides.
Station first_of_wake(const Station& upper, const Station& lower, const Station& wake);

}  // namespace lamina::flow::coupled
