// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TAYLOR_MODEL_FUNCTIONS_HPP
#define SIVID_NUMBER_TAYLOR_MODEL_FUNCTIONS_HPP

#include <sivid/number/bernstein.hpp>
#include <sivid/number/taylor_model.hpp>
#include <sivid/number/univariate_taylor.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sivid {

namespace number_detail {

/// A model of which nothing is known.
template <class Model>
Model unknown(bool& undefined) {
    undefined = true;
    Model m;
    m.r = std::numeric_limits<double>::infinity();
    return m;
}

/// The product of two polynomials without any bound: a guess, to be verified by its residual.
template <std::size_t N, std::size_t D>
taylor_model<N, D> approximate_product(taylor_model<N, D> const& a, taylor_model<N, D> const& b) {
    auto p = a * b;
    p.r = 0;
    return p;
}

/// Range by the norms where they decide on the sign, else by Bernstein.
template <std::size_t N, std::size_t D>
interval range_for_sign(taylor_model<N, D> const& a) {
    auto const rough = rough_range(a);
    double const half = 0.5 * std::abs(a.c[0]);
    return rough.lower() > half || rough.upper() < -half ? rough : range(a);
}

} // namespace number_detail

/// \f$ 1/s \f$, defined where the range of s does not touch 0.
///   A polynomial w close to 1/s is found by Horner's rule in \f$ s/s_0 - 1 \f$; its error is
///   proved from the residual: \f$ |1/s - w| \le \|1 - s w\| / \min |s| \f$.
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> reciprocal(taylor_model<N, D> const& s, bool& undefined) {
    using model = taylor_model<N, D>;
    auto const bounds = number_detail::range_for_sign(s);
    double const least = mig(bounds);
    if (!(least > 0) || !std::isfinite(s.norm())) return number_detail::unknown<model>(undefined);
    double const centre = s.c[0];
    if (centre == 0) return number_detail::unknown<model>(undefined);
    auto t = scaled(s, -1 / centre); // -(s/s0 - 1), made exact by the residual below
    t.c[0] = 0;
    t.r = 0;
    t.finish();
    auto w = model::constant(1.0);
    for (std::size_t k = 0; k < D; ++k) {
        w = number_detail::approximate_product(t, w);
        w.c[0] += 1;
        w.finish();
    }
    w = scaled(w, 1 / centre);
    w.r = 0;
    auto residual = s * w;
    residual = model::constant(1.0) - residual;
    w.r = residual.norm() / least * model::up + model::tiny;
    return w;
}

/// \f$ \sqrt{s} \f$, defined where the range of s is positive.
///   A polynomial w is found by the binomial series; \f$ |\sqrt s - w| \le \|s - w^2\| /
///   (\sqrt{\min s} + \min w) \f$ where that is positive; else the range is the answer.
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> sqrt(taylor_model<N, D> const& s, bool& undefined) {
    using model = taylor_model<N, D>;
    auto const bounds = number_detail::range_for_sign(s);
    double const least = bounds.lower();
    if (!(least > 0) || !(s.c[0] > 0) || !std::isfinite(s.norm())) {
        return number_detail::unknown<model>(undefined);
    }
    // sqrt(s0) (1 + t)^(1/2), t = s/s0 - 1, by Horner with binomial coefficients
    double const centre = s.c[0];
    auto t = scaled(s, 1 / centre);
    t.c[0] = 0;
    t.r = 0;
    t.finish();
    auto w = model::constant(1.0);
    for (std::size_t k = D; k > 0; --k) {
        double const ratio = (1.5 - static_cast<double>(k)) / static_cast<double>(k);
        w = number_detail::approximate_product(t, w);
        for (auto& c : w.c) c *= ratio;
        w.c[0] += 1;
        w.finish();
    }
    double const root = std::sqrt(centre);
    for (auto& c : w.c) c *= root;
    w.r = 0;
    w.finish();
    auto const residual = s - w * w;
    bool ignored = false;
    double const smallest =
        interval_traits<interval>::sqrt(interval_traits<interval>::point(least), ignored).lower();
    double const below = smallest + rough_range(w).lower(); // of sqrt(s) + w
    if (!(below > 0)) {
        return model::constant(interval_traits<interval>::sqrt(bounds, ignored));
    }
    w.r = residual.norm() / below * model::up + model::tiny;
    return w;
}

/// An elementary function by its Taylor polynomial about the centre of s and Lagrange's remainder:
///   \f$ f(s) \in \sum_{k \le D} f^{[k]}(s_0) \tilde s^k + f^{[D+1]}(range) \tilde s^{D+1} \f$.
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> apply(univariate f, taylor_model<N, D> const& s, bool& undefined) {
    using model = taylor_model<N, D>;
    using traits = interval_traits<interval>;
    if (!std::isfinite(s.norm())) return number_detail::unknown<model>(undefined);
    bool cut = false;
    auto const at_centre = taylor_coefficients<D>(f, traits::point(s.c[0]), cut);
    auto const on_range = taylor_coefficients<D + 1>(f, range(s), cut);
    if (cut) return number_detail::unknown<model>(undefined);
    auto t = s;
    t.c[0] = 0;
    t.finish();
    auto result = model::constant(at_centre[D]);
    for (std::size_t k = D; k-- > 0;) result = result * t + model::constant(at_centre[k]);
    // The derivative first: a power of a tiny size alone could underflow.
    double rest = mag(on_range[D + 1]);
    double const size = t.norm();
    for (std::size_t k = 0; k <= D; ++k) rest *= size * model::up;
    return widened(result, rest * model::up + model::tiny);
}

/// Encloses a function of bounded range by its range alone.
template <std::size_t N, std::size_t D>
[[nodiscard]] taylor_model<N, D> from_range(interval const& values) {
    return taylor_model<N, D>::constant(values);
}

} // namespace sivid

#endif
