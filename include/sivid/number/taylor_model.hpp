// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TAYLOR_MODEL_HPP
#define SIVID_NUMBER_TAYLOR_MODEL_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/lanes.hpp>
#include <sivid/number/monomials.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace sivid {

/// A function on \f$ [-1,1]^N \f$ enclosed by a polynomial of total degree D and a radius:
///   \f$ f(q) \in \sum_{|\alpha| \le D} c_\alpha q^\alpha + [-r, r] \f$ for all q.
/// Coefficients are doubles; every rounding and truncation error is in the radius. The arithmetic
/// needs no rounding mode: error bounds hold for any mode (unit 2^-52) and for fused operations.
/// A radius that is not finite means that nothing is known.
/// @tparam C  `double`, or `lanes<W>`: W such functions side by side
/// @ref  Makino and Berz, Int. J. Pure Appl. Math. 4 (2003); rounding bounds: Higham 2002, chapter
/// 3
template <std::size_t N, std::size_t D, class C = double>
struct taylor_model {
    using scalar = C;
    using side_by_side = lane_traits<C>;
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

    std::array<C, terms> c;
    C r;
    std::array<C, D + 1> norms; ///< upper bounds of \f$ \sum_{|\alpha|=k} |c_\alpha| \f$
    C above;                    ///< upper bound of the norms 1 .. D together

    /// The function 0.
    taylor_model() : c{}, r{}, norms{}, above{} {}
    /// For a result that is written at once.
    struct unset {};
    explicit taylor_model(unset) {}

    /// Values beyond this are given up: near the overflow, what happens depends on the rounding mode.
    static constexpr double largest = 1e300;

    /// Forgets everything when an operation on values of size `mass` may have overflowed.
    void give_up_when_huge(C const& mass) {
        r = side_by_side::select((mass < largest) & (r < largest), r,
                                 std::numeric_limits<double>::infinity());
    }

    /// Recomputes the norms; to be called after `c` was written.
    void finish() {
        auto const& first = basis::data.first;
        for (std::size_t k = 0; k <= D; ++k) {
            C sum{};
            for (std::size_t i = first[k]; i < first[k + 1]; ++i) sum += side_by_side::abs(c[i]);
            norms[k] = sum * up;
        }
        above = C(0.0);
        for (std::size_t k = 1; k <= D; ++k) above += norms[k];
        above *= up;
    }
    /// Bound of the polynomial without its constant term.
    [[nodiscard]] C spread() const { return above; }
    /// Bound of the polynomial.
    [[nodiscard]] C polynomial_norm() const { return (norms[0] + above) * up; }
    /// Bound of everything: \f$ |f(q)| \f$.
    [[nodiscard]] C norm() const { return (polynomial_norm() + r) * up; }

    [[nodiscard]] static taylor_model constant(C const& v) {
        taylor_model result;
        result.c[0] = v;
        result.norms[0] = side_by_side::abs(v);
        result.give_up_when_huge(result.norms[0]);
        return result;
    }
    [[nodiscard]] static taylor_model constant(interval const& v) {
        auto result = constant(C(mid(v)));
        result.r = is_empty(v) ? std::numeric_limits<double>::infinity() : rad(v);
        return result;
    }
    /// No variable has an influence, in any lane.
    [[nodiscard]] bool is_constant() const {
        return side_by_side::all(above == C(0.0));
    }
    /// centre + slope * q_v
    [[nodiscard]] static taylor_model variable(std::size_t v, C const& centre, C const& slope) {
        static_assert(D >= 1);
        auto result = constant(centre);
        result.c[basis::data.variable[v]] = slope;
        result.finish();
        return result;
    }
};

/// The products of two polynomials' coefficients, added to those of a third.
template <std::size_t N, std::size_t D, class C>
class product_kernel {
    using table = monomials<N, D>;
    static constexpr std::size_t terms = table::count;

public:
    /// sum += factor * a * b
    static void accumulate(std::array<C, terms>& sum, std::array<C, terms> const& a,
                           std::array<C, terms> const& b, double factor = 1) {
        if constexpr (std::is_same_v<C, double>) {
            multiply([&](std::size_t k) -> double& { return sum[k]; },
                     [&](std::size_t k) { return a[k]; }, [&](std::size_t k) { return b[k]; },
                     factor, std::make_index_sequence<terms>{});
        } else {
            for (std::size_t p = 0; p < C::parts; ++p) {
                multiply([&, p](std::size_t k) -> auto& { return sum[k].part(p); },
                         [&, p](std::size_t k) { return a[k].part(p); },
                         [&, p](std::size_t k) { return b[k].part(p); }, factor,
                         std::make_index_sequence<terms>{});
            }
        }
    }

private:
    // Unrolled: the positions are constants of the instructions.
    template <class Sum, class A, class B, std::size_t... K>
    [[gnu::always_inline]] static inline void multiply(Sum const& sum, A const& a, B const& b,
                                                       double factor, std::index_sequence<K...>) {
        ((sum(K) += factor * coefficient<table::data.sum[K]>(
              a, b, std::make_index_sequence<table::data.sum[K + 1] - table::data.sum[K]>{})),
         ...);
    }
    template <std::size_t First, class A, class B, std::size_t... P>
    [[gnu::always_inline]] static inline auto coefficient(A const& a, B const& b,
                                                          std::index_sequence<P...>) {
        return (... +
                (a(table::data.pairs[First + P].left) * b(table::data.pairs[First + P].right)));
    }
};

/// Sums of products of Taylor models, with one rounding bound for the whole sum.
template <std::size_t N, std::size_t D, class C = double>
class product_sum {
    using model = taylor_model<N, D, C>;

public:
    /// Adds factor * a * b, the factor a small integer.
    [[gnu::noinline]] void add(model const& a, model const& b, double factor = 1) {
        if (a.is_constant()) return add_multiple(b, a, factor);
        if (b.is_constant()) return add_multiple(a, b, factor);
        double const size = std::abs(factor);
        product_kernel<N, D, C>::accumulate(c_, a.c, b.c, factor);
        // What the product has beyond degree D, and the radii times everything.
        C beyond{};
        for (std::size_t k = 1; k <= D; ++k) {
            C high{};
            for (std::size_t l = D + 1 - k; l <= D; ++l) high += b.norms[l];
            beyond += a.norms[k] * high;
        }
        C const pa = a.polynomial_norm();
        C const pb = b.polynomial_norm();
        radius_ += (beyond + a.r * (pb + b.r) + b.r * pa) * size;
        C const mass = pa * pb * size;
        mass_ += mass;
        own_ += mass * static_cast<double>(monomials<N, D>::data.longest_sum + 1);
        additions_ += 1;
    }
    /// Adds factor * a.
    void add(model const& a, double factor = 1) {
        for (std::size_t i = 0; i < model::terms; ++i) c_[i] += a.c[i] * factor;
        radius_ += a.r * std::abs(factor);
        C const mass = a.polynomial_norm() * std::abs(factor);
        mass_ += mass;
        if (std::abs(factor) != 1) own_ += mass;
        additions_ += 1;
    }
    [[nodiscard]] model result() const {
        model m{typename model::unset{}};
        result_into(m);
        return m;
    }
    void result_into(model& m) const {
        m.c = c_;
        // Each operation errs by a unit of its result: within a product by a unit of its own mass,
        // where its sum joins the total by a unit of the total mass.
        C const rounding = (own_ + mass_ * additions_) * model::unit;
        m.r = (radius_ + rounding) * (model::up + 8 * additions_ * model::unit) + model::tiny;
        m.finish();
        m.give_up_when_huge(mass_);
    }

private:
    /// The same for a factor that does not depend on the variables.
    void add_multiple(model const& a, model const& number, double factor) {
        C const times = number.c[0] * factor;
        for (std::size_t i = 0; i < model::terms; ++i) c_[i] += a.c[i] * times;
        C const norm = a.polynomial_norm();
        double const size = std::abs(factor);
        radius_ += (number.r * (norm + a.r) + a.r * number.norms[0]) * size;
        C const mass = norm * number.norms[0] * size;
        mass_ += mass;
        own_ += mass * 2.0;
        additions_ += 1;
    }

    std::array<C, model::terms> c_{};
    C radius_{};
    C mass_{};
    C own_{};
    double additions_ = 0;
};

template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator-(taylor_model<N, D, C> a) {
    for (auto& c : a.c) c = -c;
    return a;
}

namespace number_detail {
template <int Sign, std::size_t N, std::size_t D, class C>
taylor_model<N, D, C> sum(taylor_model<N, D, C> const& a, taylor_model<N, D, C> const& b) {
    using model = taylor_model<N, D, C>;
    model result{typename model::unset{}};
    for (std::size_t i = 0; i < model::terms; ++i) {
        result.c[i] = Sign > 0 ? a.c[i] + b.c[i] : a.c[i] - b.c[i];
    }
    C const mass = a.polynomial_norm() + b.polynomial_norm();
    result.r = (a.r + b.r + mass * model::unit) * model::up;
    result.finish();
    result.give_up_when_huge(mass);
    return result;
}
} // namespace number_detail

template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator+(taylor_model<N, D, C> const& a,
                                           taylor_model<N, D, C> const& b) {
    return number_detail::sum<1>(a, b);
}
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator-(taylor_model<N, D, C> const& a,
                                           taylor_model<N, D, C> const& b) {
    return number_detail::sum<-1>(a, b);
}
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator*(taylor_model<N, D, C> const& a,
                                           taylor_model<N, D, C> const& b) {
    product_sum<N, D, C> sum;
    sum.add(a, b);
    return sum.result();
}

/// a times a number from \f$ [m - \rho, m + \rho] \f$.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> scaled(taylor_model<N, D, C> const& a,
                                           std::type_identity_t<C> const& m,
                                           std::type_identity_t<C> const& rho = C(0.0)) {
    using model = taylor_model<N, D, C>;
    C const norm = a.polynomial_norm();
    C const size = model::side_by_side::abs(m);
    model result{typename model::unset{}};
    for (std::size_t i = 0; i < model::terms; ++i) result.c[i] = a.c[i] * m;
    // norm * size first: the unit times a tiny factor would underflow.
    result.r = (a.r * (size + rho) + norm * rho + norm * size * model::unit) * model::up + model::tiny;
    result.finish();
    result.give_up_when_huge(norm * (size + rho));
    return result;
}
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> scaled(taylor_model<N, D, C> const& a, interval const& s) {
    return scaled(a, C(mid(s)), C(rad(s)));
}

/// The same function with an interval \f$ [-w, w] \f$ added.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> widened(taylor_model<N, D, C> a,
                                            std::type_identity_t<C> const& w) {
    a.r = (a.r + w) * taylor_model<N, D, C>::up;
    a.give_up_when_huge(C(0.0));
    return a;
}

/// Lower and upper bounds, in each lane. Not finite where nothing is known.
template <class C>
struct value_bounds {
    C lower, upper;
    /// The least absolute value between them, 0 where they have different signs.
    [[nodiscard]] C least() const {
        using side_by_side = lane_traits<C>;
        return side_by_side::max(side_by_side::max(lower, -upper), C(0.0));
    }
};

/// Bounds by the norms alone: cheap, and wide when terms of high degree cancel.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] value_bounds<C> rough_bounds(taylor_model<N, D, C> const& a) {
    using model = taylor_model<N, D, C>;
    C const w = (a.spread() + a.r) * model::up;
    // Two subtractions, each off by less than two units of |c_0| + w.
    C const out = w + (model::side_by_side::abs(a.c[0]) + w) * (8 * model::unit) + model::tiny;
    return {a.c[0] - out, a.c[0] + out};
}
template <std::size_t N, std::size_t D>
[[nodiscard]] interval rough_range(taylor_model<N, D> const& a) {
    auto const b = rough_bounds(a);
    if (!std::isfinite(b.lower) || !std::isfinite(b.upper)) return interval_traits<interval>::entire();
    return interval(b.lower, b.upper);
}

/// One of the functions that lie side by side.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D> lane_of(taylor_model<N, D, C> const& a, std::size_t lane) {
    using side_by_side = lane_traits<C>;
    taylor_model<N, D> result;
    for (std::size_t i = 0; i < a.c.size(); ++i) result.c[i] = side_by_side::get(a.c[i], lane);
    for (std::size_t k = 0; k <= D; ++k) result.norms[k] = side_by_side::get(a.norms[k], lane);
    result.above = side_by_side::get(a.above, lane);
    result.r = side_by_side::get(a.r, lane);
    return result;
}
/// a where the mask is set, else b.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> select(typename lane_traits<C>::mask const& m,
                                           taylor_model<N, D, C> const& a,
                                           taylor_model<N, D, C> const& b) {
    using side_by_side = lane_traits<C>;
    if (side_by_side::all(m)) return a;
    taylor_model<N, D, C> result;
    for (std::size_t i = 0; i < a.c.size(); ++i) {
        result.c[i] = side_by_side::select(m, a.c[i], b.c[i]);
    }
    for (std::size_t k = 0; k <= D; ++k) {
        result.norms[k] = side_by_side::select(m, a.norms[k], b.norms[k]);
    }
    result.above = side_by_side::select(m, a.above, b.above);
    result.r = side_by_side::select(m, a.r, b.r);
    return result;
}

/// Re-expresses a model in other variables and degree: variable v becomes variable v of M >= N;
/// terms beyond degree E go into the radius.
template <std::size_t M, std::size_t E, std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<M, E, C> converted(taylor_model<N, D, C> const& a) {
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
    taylor_model<M, E, C> result;
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (image[i] < target::count) result.c[image[i]] = a.c[i];
    }
    C cut{};
    for (std::size_t k = E + 1; k <= D; ++k) cut += a.norms[k];
    result.r = (a.r + cut) * taylor_model<N, D, C>::up;
    result.finish();
    return result;
}

/// Forgets the last variable: for each q, all values over \f$ [-1,1] \f$ of that variable.
template <std::size_t N, std::size_t E, std::size_t D, class C>
[[nodiscard]] taylor_model<N, E, C> without_last_variable(taylor_model<N + 1, D, C> const& a) {
    using model = taylor_model<N, D, C>;
    using side_by_side = lane_traits<C>;
    // Where each monomial with the last variable absent stands among those of N variables.
    static constexpr auto place = [] {
        auto const& wide = monomials<N + 1, D>::data;
        std::array<std::size_t, monomials<N + 1, D>::count> map{};
        for (std::size_t k = 0; k < map.size(); ++k) {
            map[k] = model::terms;
            if (wide.exponents[k][N] != 0) continue;
            for (std::size_t i = 0; i < model::terms; ++i) {
                bool same = true;
                for (std::size_t v = 0; v < N && same; ++v) {
                    same = wide.exponents[k][v] == model::basis::data.exponents[i][v];
                }
                if (same) map[k] = i;
            }
        }
        return map;
    }();
    model small;
    C moved{};
    for (std::size_t k = 0; k < place.size(); ++k) {
        if (place[k] < model::terms) {
            small.c[place[k]] = a.c[k];
        } else {
            moved += side_by_side::abs(a.c[k]);
        }
    }
    small.r = (a.r + moved * a.up) * a.up;
    small.finish();
    return converted<N, E>(small);
}

} // namespace sivid

#endif
