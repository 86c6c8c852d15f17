// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TAYLOR_MODEL_HPP
#define SIVID_NUMBER_TAYLOR_MODEL_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/monomials.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sivid {

/// A function on \f$ [-1,1]^N \f$ enclosed by a polynomial of total degree D and a radius:
///   \f$ f(q) \in \sum_{|\alpha| \le D} c_\alpha q^\alpha + [-r, r] \f$ for all q.
/// Coefficients are doubles; every rounding and truncation error is in the radius. The arithmetic
/// needs no rounding mode: error bounds hold for any mode (unit 2^-52) and for fused operations.
/// A radius that is not finite means that nothing is known.
/// @ref  Makino and Berz, Int. J. Pure Appl. Math. 4 (2003); rounding bounds: Higham 2002, chapter
/// 3
template <std::size_t N, std::size_t D>
struct taylor_model {
    using basis = monomials<N, D>;
    static constexpr std::size_t variables = N;
    static constexpr std::size_t degree = D;
    static constexpr std::size_t terms = basis::count;
    /// Twice the unit roundoff: an error bound of one operation in any rounding mode.
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    /// Makes a computed sum of at most `terms` + a few dozen non-negative numbers an upper bound.
    static constexpr double up = 1 + (4 * static_cast<double>(terms + D * D) + 64) * unit;
    /// More than all underflow errors of one operation.
    static constexpr double tiny = 1e-290;

    std::array<double, terms> c{};
    double r = 0;
    std::array<double, D + 1> norms{}; ///< upper bounds of \f$ \sum_{|\alpha|=k} |c_\alpha| \f$

    /// Values beyond this are given up: near the overflow, what happens depends on the rounding mode.
    static constexpr double largest = 1e300;

    /// Forgets everything when an operation on values of size `mass` may have overflowed.
    void give_up_when_huge(double mass) {
        if (!(mass < largest) || !(r < largest)) r = std::numeric_limits<double>::infinity();
    }

    /// Recomputes `norms`; to be called after `c` was written.
    void finish() {
        auto const& first = basis::data.first;
        for (std::size_t k = 0; k <= D; ++k) {
            double sum = 0;
            for (std::size_t i = first[k]; i < first[k + 1]; ++i) sum += std::abs(c[i]);
            norms[k] = sum * up;
        }
    }
    /// Bound of the polynomial without its constant term.
    [[nodiscard]] double spread() const {
        double sum = 0;
        for (std::size_t k = 1; k <= D; ++k) sum += norms[k];
        return sum * up;
    }
    /// Bound of the polynomial.
    [[nodiscard]] double polynomial_norm() const { return (norms[0] + spread()) * up; }
    /// Bound of everything: \f$ |f(q)| \f$.
    [[nodiscard]] double norm() const { return (polynomial_norm() + r) * up; }

    [[nodiscard]] static taylor_model constant(double v) {
        taylor_model result;
        result.c[0] = v;
        result.norms[0] = std::abs(v);
        result.give_up_when_huge(std::abs(v));
        return result;
    }
    [[nodiscard]] static taylor_model constant(interval const& v) {
        auto result = constant(mid(v));
        result.r = is_empty(v) ? std::numeric_limits<double>::infinity() : rad(v);
        return result;
    }
    /// centre + slope * q_v
    [[nodiscard]] static taylor_model variable(std::size_t v, double centre, double slope) {
        static_assert(D >= 1);
        auto result = constant(centre);
        result.c[basis::data.variable[v]] = slope;
        result.finish();
        return result;
    }
};

/// Sums of products of Taylor models, with one rounding bound for the whole sum.
template <std::size_t N, std::size_t D>
class product_sum {
    using model = taylor_model<N, D>;

public:
    [[gnu::noinline]] void add(model const& a, model const& b) {
        multiply(a.c.data(), b.c.data(), std::make_index_sequence<model::terms>{});
        // What the product has beyond degree D, and the radii times everything.
        double beyond = 0;
        for (std::size_t k = 1; k <= D; ++k) {
            double high = 0;
            for (std::size_t l = D + 1 - k; l <= D; ++l) high += b.norms[l];
            beyond += a.norms[k] * high;
        }
        double const pa = a.polynomial_norm();
        double const pb = b.polynomial_norm();
        radius_ += beyond + a.r * (pb + b.r) + b.r * pa;
        mass_ += pa * pb;
        additions_ += static_cast<double>(monomials<N, D>::data.longest_sum + 1);
    }
    void add(model const& a) {
        for (std::size_t i = 0; i < model::terms; ++i) c_[i] += a.c[i];
        radius_ += a.r;
        mass_ += a.polynomial_norm();
        additions_ += 1;
    }
    [[nodiscard]] model result() const {
        model m;
        m.c = c_;
        // Each coefficient is a sum of at most `additions_` products; each operation errs by a unit
        // of a partial sum, which the total mass bounds.
        double const rounding = (additions_ + 2) * model::unit * mass_;
        m.r = (radius_ + rounding) * (model::up + 8 * additions_ * model::unit) + model::tiny;
        m.finish();
        m.give_up_when_huge(mass_);
        return m;
    }

private:
    using table = monomials<N, D>;
    // Unrolled: the positions are constants of the instructions.
    template <std::size_t... K>
    void multiply(double const* a, double const* b, std::index_sequence<K...>) {
        ((c_[K] += coefficient<table::data.sum[K]>(
              a, b, std::make_index_sequence<table::data.sum[K + 1] - table::data.sum[K]>{})),
         ...);
    }
    template <std::size_t First, std::size_t... P>
    static double coefficient(double const* a, double const* b, std::index_sequence<P...>) {
        return (... +
                (a[table::data.pairs[First + P].left] * b[table::data.pairs[First + P].right]));
    }

    std::array<double, model::terms> c_{};
    double radius_ = 0;
    double mass_ = 0;
    double additions_ = 0;
};

template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> operator-(taylor_model<N, D> a) {
    for (auto& c : a.c) c = -c;
    return a;
}

namespace number_detail {
template <int Sign, std::size_t N, std::size_t D>
taylor_model<N, D> sum(taylor_model<N, D> const& a, taylor_model<N, D> const& b) {
    using model = taylor_model<N, D>;
    model result;
    for (std::size_t i = 0; i < model::terms; ++i) {
        result.c[i] = Sign > 0 ? a.c[i] + b.c[i] : a.c[i] - b.c[i];
    }
    double const rounding = model::unit * (a.polynomial_norm() + b.polynomial_norm());
    result.r = (a.r + b.r + rounding) * model::up;
    result.finish();
    result.give_up_when_huge(a.polynomial_norm() + b.polynomial_norm());
    return result;
}
} // namespace number_detail

template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> operator+(taylor_model<N, D> const& a,
                                           taylor_model<N, D> const& b) {
    return number_detail::sum<1>(a, b);
}
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> operator-(taylor_model<N, D> const& a,
                                           taylor_model<N, D> const& b) {
    return number_detail::sum<-1>(a, b);
}
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> operator*(taylor_model<N, D> const& a,
                                           taylor_model<N, D> const& b) {
    product_sum<N, D> sum;
    sum.add(a, b);
    return sum.result();
}

/// a times a number from \f$ [m - \rho, m + \rho] \f$.
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> scaled(taylor_model<N, D> a, double m, double rho = 0) {
    using model = taylor_model<N, D>;
    double const norm = a.polynomial_norm();
    double const size = std::abs(m);
    for (auto& c : a.c) c *= m;
    // norm * size first: the unit times a tiny factor would underflow.
    a.r = (a.r * (size + rho) + norm * rho + norm * size * model::unit) * model::up + model::tiny;
    a.finish();
    a.give_up_when_huge(norm * (size + rho));
    return a;
}
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> scaled(taylor_model<N, D> const& a, interval const& s) {
    return scaled(a, mid(s), rad(s));
}

/// The same function with an interval \f$ [-w, w] \f$ added.
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> widened(taylor_model<N, D> a, double w) {
    a.r = (a.r + w) * taylor_model<N, D>::up;
    a.give_up_when_huge(0);
    return a;
}

/// Bounds by the norms alone: cheap, and wide when terms of high degree cancel.
template <std::size_t N, std::size_t D>
[[nodiscard]] interval rough_range(taylor_model<N, D> const& a) {
    using traits = interval_traits<interval>;
    double const w = (a.spread() + a.r) * taylor_model<N, D>::up;
    if (!std::isfinite(w) || !std::isfinite(a.c[0])) return traits::entire();
    return traits::add(traits::point(a.c[0]), traits::bounds(-w, w));
}

/// Re-expresses a model in other variables and degree: variable v becomes variable v of M >= N;
/// terms beyond degree E go into the radius.
template <std::size_t M, std::size_t E, std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<M, E> converted(taylor_model<N, D> const& a) {
    static_assert(M >= N);
    using target = monomials<M, E>;
    static constexpr auto image = [] {
        std::array<std::size_t, monomials<N, D>::count> map{};
        for (std::size_t i = 0; i < map.size(); ++i) {
            map[i] = target::count;
            if (monomials<N, D>::data.degree[i] > E) continue;
            for (std::size_t k = 0; k < target::count; ++k) {
                bool same = target::data.degree[k] == monomials<N, D>::data.degree[i];
                for (std::size_t v = 0; v < N && same; ++v) {
                    same = target::data.exponents[k][v] == monomials<N, D>::data.exponents[i][v];
                }
                if (same) map[i] = k;
            }
        }
        return map;
    }();
    taylor_model<M, E> result;
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (image[i] < target::count) result.c[image[i]] = a.c[i];
    }
    double cut = 0;
    for (std::size_t k = E + 1; k <= D; ++k) cut += a.norms[k];
    result.r = (a.r + cut) * taylor_model<N, D>::up;
    result.finish();
    return result;
}

/// Forgets the last variable: for each q, all values over \f$ [-1,1] \f$ of that variable.
template <std::size_t N, std::size_t E, std::size_t D>
[[nodiscard]] taylor_model<N, E> without_last_variable(taylor_model<N + 1, D> const& a) {
    auto const& t = monomials<N + 1, D>::data;
    auto kept = a;
    double moved = 0;
    for (std::size_t i = 0; i < kept.terms; ++i) {
        if (t.exponents[i][N] == 0) continue;
        moved += std::abs(kept.c[i]);
        kept.c[i] = 0;
    }
    kept.finish();
    using model = taylor_model<N, D>;
    model small;
    for (std::size_t i = 0; i < model::terms; ++i) {
        for (std::size_t k = 0; k < kept.terms; ++k) {
            bool same = t.exponents[k][N] == 0;
            for (std::size_t v = 0; v < N && same; ++v) {
                same = t.exponents[k][v] == model::basis::data.exponents[i][v];
            }
            if (same) small.c[i] = kept.c[k];
        }
    }
    small.r = (a.r + moved * kept.up) * kept.up;
    small.finish();
    return converted<N, E>(small);
}

} // namespace sivid

#endif
