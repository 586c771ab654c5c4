// Norms of interpolation errors, and the sizes with which they are least.
#pragma once

namespace lamina::adaptation {

/// The L^p norm, and the errors of linear interpolation in it.
class ErrorNorm {
public:
    explicit ErrorNorm(double p);

    /// Returns the edge h = lambda^(-p / (2 p + 2)). Of all sizes with as many triangles, multiples of these have the
    /// least integral of (lambda h^2)^p, for some 1 / h^2 triangles per unit of area; lambda is a second derivative.
    double size(double lambda) const;
    /// Returns p.
    double power() const { return p_; }
    /// Returns the mean p-th power of the error with which x^2 / 2 is interpolated linearly between points 1 apart.
    double power_on_line() const { return power_on_line_; }
    /// Returns that mean on equilateral triangles with edges of 1, whatever the direction of x.
    double power_on_triangle() const { return power_on_triangle_; }

private:
    double p_, power_on_line_, power_on_triangle_;
};

}  // namespace lamina::adaptation
