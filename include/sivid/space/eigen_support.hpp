// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_EIGEN_SUPPORT_HPP
#define SIVID_SPACE_EIGEN_SUPPORT_HPP

/// @file
/// Interval scalars in Eigen: sums, products (with double matrices too), norms, inverse, LU and
/// Householder QR compile and enclose. Include this header before matrices of intervals are used.
///
/// What the decompositions mean for a matrix set [A]: for every A in it, the factors that the same
/// sequence of pivots and signs gives for A lie in the computed ones. A pivot that may be zero
/// makes results unbounded, and one that is certainly zero (all A singular) makes them empty.
/// Rank-revealing decompositions decide by thresholds and are not for intervals.

#include <sivid/number/elementary.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include <concepts>
#include <limits>
#include <type_traits>

namespace sivid {

/// Interval types with operators, one interval each.
template <class I>
concept interval_field = interval_scalar<I> && interval_traits<I>::lanes == 1 &&
                         requires(I a, I const& b) {
    { b + b } -> std::convertible_to<I>;
    { b - b } -> std::convertible_to<I>;
    { b* b } -> std::convertible_to<I>;
    { b / b } -> std::convertible_to<I>;
    { -b } -> std::convertible_to<I>;
    a += b;
    a -= b;
    a *= b;
    a /= b;
};

} // namespace sivid

namespace Eigen {

template <sivid::interval_field I>
struct NumTraits<I> {
    using Real = I;
    using NonInteger = I;
    using Nested = I;
    using Literal = double;
    // NOLINTBEGIN(readability-identifier-naming): Eigen's names
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1, // otherwise abs would be the identity
        RequireInitialization = 1,
        ReadCost = 2,
        AddCost = 4,
        MulCost = 10
    };
    // NOLINTEND(readability-identifier-naming)
    /// Nothing is negligible.
    static I epsilon() { return sivid::interval_traits<I>::point(0.0); }
    static I dummy_precision() { return sivid::interval_traits<I>::point(0.0); }
    static I highest() {
        return sivid::interval_traits<I>::point(std::numeric_limits<double>::max());
    }
    static I lowest() {
        return sivid::interval_traits<I>::point(std::numeric_limits<double>::lowest());
    }
    static constexpr int digits10() { return 15; }
};

// Matrices of doubles are exact.
template <sivid::interval_field I, class BinaryOp>
struct ScalarBinaryOpTraits<I, double, BinaryOp> {
    using ReturnType = I;
};
template <sivid::interval_field I, class BinaryOp>
struct ScalarBinaryOpTraits<double, I, BinaryOp> {
    using ReturnType = I;
};

namespace internal {

/// Boost.Interval claims to be convertible from everything, which makes `matrix * vector` ambiguous
/// with `matrix * scalar`. Only numbers are scalars.
template <sivid::interval_field I, class T>
struct promote_scalar_arg<I, T, false> : std::enable_if<std::is_arithmetic_v<T>, I> {};

/// |t|^2 is a square, not a product of two independent factors.
template <sivid::interval_field I>
struct abs2_impl<I> {
    static I run(I const& x) { return sivid::interval_traits<I>::sqr(x); }
};

/// |t| by the traits, whatever `abs` means for the type.
template <sivid::interval_field I>
struct scalar_abs_op<I> {
    using result_type = I;
    I operator()(I const& x) const { return sivid::interval_traits<I>::abs(x); }
};
template <sivid::interval_field I>
struct scalar_abs2_op<I> {
    using result_type = I;
    I operator()(I const& x) const { return sivid::interval_traits<I>::sqr(x); }
};

/// Pivots are chosen by the least magnitude, a double. Zero only if the entry is exactly zero: an
/// entry that may be zero has to be divided by, so that the result becomes unbounded.
template <sivid::interval_field I>
struct scalar_score_coeff_op<I> {
    using result_type = double;
    double operator()(I const& x) const {
        double const lo = sivid::interval_traits<I>::lower(x),
                     hi = sivid::interval_traits<I>::upper(x);
        if (lo > 0.0) return lo;
        if (hi < 0.0) return -hi;
        return lo == 0.0 && hi == 0.0 ? 0.0 : std::numeric_limits<double>::denorm_min();
    }
};

/// Products of interval matrices with double matrices: Eigen's blocked kernels want one scalar.
template <class Lhs, class Rhs>
concept mixed_interval_product = (sivid::interval_field<typename Lhs::Scalar> &&
                                  std::same_as<typename Rhs::Scalar, double>) ||
                                 (sivid::interval_field<typename Rhs::Scalar> &&
                                  std::same_as<typename Lhs::Scalar, double>);

template <class Lhs, class Rhs, class Derived>
struct promoted_product : generic_product_impl_base<Lhs, Rhs, Derived> {
    using Scalar = typename Product<Lhs, Rhs>::Scalar;

    template <class Destination>
    static void scaleAndAddTo( // NOLINT(readability-identifier-naming): Eigen's name
        Destination& to, Lhs const& lhs, Rhs const& rhs, Scalar const& alpha) {
        auto const left = lhs.template cast<Scalar>().eval();
        auto const right = rhs.template cast<Scalar>().eval();
        to += alpha * (left * right);
    }
};
template <class Lhs, class Rhs>
    requires mixed_interval_product<Lhs, Rhs>
struct generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct>
    : promoted_product<Lhs, Rhs,
                       generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct>> {
};
template <class Lhs, class Rhs>
    requires mixed_interval_product<Lhs, Rhs>
struct generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemvProduct>
    : promoted_product<Lhs, Rhs,
                       generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemvProduct>> {
};

} // namespace internal

} // namespace Eigen

#endif
