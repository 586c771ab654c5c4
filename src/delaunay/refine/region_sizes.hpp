// The sizes in a part of a domain: a size field, or any function of the caller.
#pragma once

#include <cmath>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "core/text.hpp"

namespace lamina::delaunay {

/// Refers to a size field or to a function, which has to live on.
class RegionSizes {
public:
    explicit RegionSizes(const SizeField& field) : field_(&field) {}
    explicit RegionSizes(const SizeFunction& function) : function_(&function) {}

    /// Returns the size at p. Throws InputError where a function returns no positive number.
    double operator()(Point p) const { return field_ ? (*field_)(p) : checked_value(p); }
    /// Returns a bound of the growth of sizes per unit of distance, which functions do not have.
    double gradation() const { return field_ ? field_->gradation() : HUGE_VAL; }
    bool is_uniform() const { return field_ && field_->is_uniform(); }
    /// Returns the field; nullptr for a function.
    const SizeField* field() const { return field_; }

private:
    double checked_value(Point p) const {
        const double size = (*function_)(p);
        if (!(size > 0)) throw InputError({.at = p}, core::concat("the size function returns ", size));
        return size;
    }

    const SizeField* field_ = nullptr;
    const SizeFunction* function_ = nullptr;
};

}  // namespace lamina::delaunay
