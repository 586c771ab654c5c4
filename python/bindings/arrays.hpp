// Arrays of numpy over vectors of C++: views without copies, and the vectors of arguments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::python {

namespace nb = nanobind;

/// An array that Python may read but not write.
template <class Scalar>
using ReadOnlyArray = nb::ndarray<nb::numpy, const Scalar, nb::device::cpu>;

/// An argument of `columns` numbers in each row; the package hands over arrays that are contiguous.
template <class Scalar, int columns>
using RowsArgument = nb::ndarray<const Scalar, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;
using PointsArgument = RowsArgument<double, 2>;

/// An argument of one number each.
template <class Scalar>
using ListArgument = nb::ndarray<const Scalar, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

/// Returns a view of items that `owner` keeps alive: one row per item, and a column for each of its numbers. Items of
/// one number make a list.
template <class Scalar, class Item>
ReadOnlyArray<Scalar> view(const std::vector<Item>& items, nb::handle owner) {
    static_assert(std::is_standard_layout_v<Item> && sizeof(Item) % sizeof(Scalar) == 0);
    constexpr std::size_t columns = sizeof(Item) / sizeof(Scalar);
    static const Scalar nothing{};
    const std::size_t shape[] = {items.size(), columns};
    const void* data = items.empty() ? static_cast<const void*>(&nothing) : items.data();
    return ReadOnlyArray<Scalar>(const_cast<void*>(data), columns == 1 ? 1 : 2, shape, owner);
}

/// Returns an array that owns the items.
template <class Scalar, class Item>
ReadOnlyArray<Scalar> owning_array(std::vector<Item> items) {
    auto kept = std::make_unique<std::vector<Item>>(std::move(items));
    const nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<std::vector<Item>*>(p); });
    return view<Scalar>(*kept.release(), owner);
}

inline std::vector<Point> points_of(const PointsArgument& array) {
    std::vector<Point> points(array.shape(0));
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {array.data()[2 * i], array.data()[2 * i + 1]};
    return points;
}

/// Returns triangles, quadrilaterals or segments of the rows of an array.
template <class Cell, int columns>
std::vector<Cell> cells_of(const RowsArgument<std::uint32_t, columns>& array) {
    std::vector<Cell> cells(array.shape(0));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t* row = array.data() + columns * i;
        if constexpr (columns == 2) {
            cells[i] = {VertexId(row[0]), VertexId(row[1])};
        } else {
            for (int k = 0; k < columns; ++k) cells[i].v[k] = VertexId(row[k]);
        }
    }
    return cells;
}

}  // namespace lamina::python
