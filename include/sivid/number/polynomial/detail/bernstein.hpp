// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_BERNSTEIN_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_BERNSTEIN_HPP

#include <sivid/number/taylor_model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace sivid {

namespace number_detail {

/// [e (degree + 1) + k]: coefficient k of \f$ q^e = (2 s - 1)^e \f$, s in [0,1], in the Bernstein
/// basis of that degree. It is the mean of the products of e of D numbers, k of which are 1 and the
/// others -1 (the blossom at the corners), so a ratio of integers of size at most 1.
[[nodiscard]] inline double const* bernstein_of_powers(std::size_t degree) {
    static std::mutex guard;
    static std::array<std::unique_ptr<std::vector<double>>, 256> made;
    std::scoped_lock const lock(guard);
    auto& m = made.at(degree);
    if (m) return m->data();
    m = std::make_unique<std::vector<double>>();
    auto const ways = [](std::size_t n, std::size_t k) {
        double result = 1; // exact up to 2^53, beyond that nothing asks for it
        for (std::size_t i = 1; i <= k; ++i) {
            result = result * static_cast<double>(n - k + i) / static_cast<double>(i);
        }
        return result;
    };
    for (std::size_t e = 0; e <= degree; ++e) {
        for (std::size_t k = 0; k <= degree; ++k) {
            double sum = 0;
            for (std::size_t j = 0; j <= e; ++j) {
                if (j > k || e - j > degree - k) continue;
                double const w = ways(k, j) * ways(degree - k, e - j);
                sum += (e - j) % 2 == 0 ? w : -w;
            }
            m->push_back(sum / ways(degree, e));
        }
    }
    return m->data();
}

/// Most Bernstein coefficients that are worth their time.
inline constexpr std::size_t most_tensor = 4096;
/// So few that all of them are looked at in any case.
inline constexpr std::size_t small_tensor = 256;
/// Terms beyond the linear ones are so small a share of what a polynomial of many variables spans
/// that nothing closer is looked for.
inline constexpr double nearly_line = 1.0 / 16;
/// Polynomials of a higher degree are bounded by their norms: the integers above would be rounded.
inline constexpr std::size_t most_bernstein_degree = 24;

/// side^variables, or a larger number than `most_tensor`
[[nodiscard]] inline std::size_t tensor_size(std::size_t side, std::size_t variables) {
    std::size_t n = 1;
    for (std::size_t v = 0; v < variables && n <= most_tensor; ++v) n *= side;
    return n;
}

/// Turns the coefficients of powers in a tensor of `variables` axes of length `side` into those of
/// the Bernstein basis.
template <class C>
void to_bernstein(C* tensor, std::size_t side, std::size_t count, std::size_t variables) {
    double const* const m = bernstein_of_powers(side - 1);
    std::array<C, most_bernstein_degree + 1> line;
    std::size_t stride = 1;
    for (std::size_t v = 0; v < variables; ++v, stride *= side) {
        for (std::size_t block = 0; block < count; block += stride * side) {
            for (std::size_t base = block; base < block + stride; ++base) {
                for (std::size_t e = 0; e < side; ++e) line[e] = tensor[base + e * stride];
                for (std::size_t k = 0; k < side; ++k) {
                    C sum = line[0] * m[k];
                    for (std::size_t e = 1; e < side; ++e) sum += line[e] * m[e * side + k];
                    tensor[base + k * stride] = sum;
                }
            }
        }
    }
}

/// The largest value of \f$ \pm P \f$ over \f$ [-1,1]^N \f$ for a polynomial of so many variables
/// that it has too many Bernstein coefficients. First variables in which it is monotone on the
/// whole box,
///   \f$ |\partial_v P| \ge |c_v| - \sum_{i \ne v} e_v(i) |c_i| > 0 \f$,
/// are set to the end where it is larger, each of which may decide about others; of those left, the
/// least nonlinear ones are bounded by the sizes of their terms; and the rest by Bernstein.
/// @cost  O(terms N) a variable, then O((D+1)^m m D), m variables with (D+1)^m <= 4096
/// @guarantee  plus `excess()` times the polynomial's norm an upper bound
template <class C>
class largest_value {
    using model = taylor_model<C>;
    using side_by_side = lane_traits<C>;

public:
    largest_value(model const& a, bool negative)
        : space_(a.space()),
          side_(a.degree() + 1),
          c_(a.terms()),
          norm_(a.polynomial_norm()),
          free_(space_.variables(), true),
          left_(space_.variables()),
          slope_(left_),
          rest_(left_) {
        for (std::size_t i = 0; i < a.terms(); ++i) c_[i] = negative ? -a.c(i) : a.c(i);
    }

    /// Roundings of all that is done here, as a multiple of the norm: the Bernstein stages (see
    /// `bounds`), and sums of at most `terms` coefficients before and after them.
    [[nodiscard]] static double excess(model const& a) {
        auto const n = a.shape().variables;
        return (static_cast<double>(n * (2 * (a.degree() + 1) + 8) + 2 * a.terms()) + 8) *
               model::unit;
    }

    [[nodiscard]] C operator()() {
        measure();
        while (settle()) measure();
        while (tensor_size(side_, left_) > most_tensor) {
            bound_least();
            measure();
        }
        std::size_t const count = tensor_size(side_, left_);
        scratch<C> tensor(count);
        for (std::size_t i = 0; i < space_.terms(); ++i) {
            std::size_t place = 0;
            for (std::size_t v = 0; v < space_.variables(); ++v) {
                if (free_[v]) place = place * side_ + space_.exponents(i)[v];
            }
            tensor[place] += c_[i];
        }
        to_bernstein(tensor.data(), side_, count, left_);
        C most = tensor[0];
        for (std::size_t k = 1; k < count; ++k) most = side_by_side::max(most, tensor[k]);
        return most + bounded_;
    }

private:
    /// \f$ \partial_v P = \f$ slope + a number of size at most rest, for each free variable.
    void measure() {
        auto const n = space_.variables();
        for (std::size_t v = 0; v < n; ++v) slope_[v] = rest_[v] = C(0.0);
        for (std::size_t i = 1; i < space_.terms(); ++i) {
            auto const* const e = space_.exponents(i);
            std::size_t degree = 0, last = 0;
            for (std::size_t v = 0; v < n; ++v) {
                if (!free_[v] || e[v] == 0) continue;
                degree += e[v];
                last = v;
            }
            if (degree == 1) {
                slope_[last] += c_[i];
            } else if (degree > 1) {
                C const size = side_by_side::abs(c_[i]);
                for (std::size_t v = 0; v < n; ++v) {
                    if (free_[v] && e[v] > 0) rest_[v] += size * static_cast<double>(e[v]);
                }
            }
        }
    }
    /// Sets the variables in which P is monotone, in all lanes, to the better end.
    [[nodiscard]] bool settle() {
        bool some = false;
        // Sums of at most `terms` numbers that add up to at most D norms.
        C const unsure =
            norm_ * (static_cast<double>((side_ - 1) * (space_.terms() + 8) * 4) * model::unit);
        for (std::size_t v = 0; v < space_.variables(); ++v) {
            if (!free_[v]) continue;
            if (!side_by_side::all(side_by_side::abs(slope_[v]) > rest_[v] + unsure)) continue;
            auto const rises = slope_[v] > C(0.0);
            for (std::size_t i = 0; i < space_.terms(); ++i) {
                if (space_.exponents(i)[v] % 2 == 1) {
                    c_[i] = side_by_side::select(rises, c_[i], -c_[i]);
                }
            }
            free_[v] = false;
            --left_;
            some = true;
        }
        return some;
    }
    /// Bounds the terms with the least nonlinear variable by their sizes.
    void bound_least() {
        std::size_t const none = space_.variables();
        std::size_t least = none;
        double lowest = 0;
        for (std::size_t v = 0; v < none; ++v) {
            if (!free_[v]) continue;
            double weight = 0;
            for (std::size_t l = 0; l < side_by_side::count; ++l) {
                weight += side_by_side::get(rest_[v], l);
            }
            if (least != none && !(weight < lowest)) continue;
            least = v;
            lowest = weight;
        }
        C linear{};
        for (std::size_t i = 0; i < space_.terms(); ++i) {
            auto const* const e = space_.exponents(i);
            if (e[least] == 0) continue;
            std::size_t degree = 0;
            for (std::size_t v = 0; v < none; ++v) degree += free_[v] ? e[v] : 0U;
            if (degree == 1) {
                linear += c_[i];
            } else {
                bounded_ += side_by_side::abs(c_[i]);
            }
            c_[i] = C(0.0);
        }
        bounded_ += side_by_side::abs(linear);
        free_[least] = false;
        --left_;
    }

    monomial_space const& space_;
    std::size_t side_;
    scratch<C> c_; ///< with the signs of the variables that are set
    C norm_;
    std::vector<bool> free_;
    std::size_t left_;
    scratch<C> slope_, rest_;
    C bounded_{};
};

} // namespace number_detail

/// Bounds a Taylor model over \f$ [-1,1]^N \f$ by the Bernstein coefficients of its polynomial,
/// which are exact at the corners; where there would be too many of them, in fewer variables
/// (`number_detail::largest_value`), or by the norms where they are close.
/// @cost  O((D+1)^N N D)
/// @ref   Garloff 1986: Bernstein polynomials enclose the range
template <class C>
[[nodiscard]] value_bounds<C> bounds(taylor_model<C> const& a) {
    using model = taylor_model<C>;
    using side_by_side = lane_traits<C>;
    auto const rough = rough_bounds(a);
    if (a.degree() < 2 || a.degree() > number_detail::most_bernstein_degree || a.is_constant()) {
        return rough;
    }
    std::size_t const n = a.shape().variables;
    std::size_t const side = a.degree() + 1;
    std::size_t const count = number_detail::tensor_size(side, n);
    C lo, hi;
    // A line's values are bounded by the sum of |coefficients| along it, since |m| <= 1; so
    // are their errors, times (side + 2) units. Summed along the other lines that is the norm,
    // in each stage; the last two operations below add less than four units of it.
    double excess = (static_cast<double>(n * (2 * side + 8)) + 8) * model::unit;
    if (count > number_detail::small_tensor) {
        // Of what is nearly a line the rough bounds are close, and cost nothing. Lanes of which
        // nothing is known, and those that stand idle, ask for nothing.
        auto const bent = a.spread() - a.norms()[1];
        auto const line = bent <= (a.spread() + a.r()) * number_detail::nearly_line;
        if (side_by_side::all(line | !(a.polynomial_norm() < C(model::largest)))) return rough;
        using largest = number_detail::largest_value<C>;
        hi = largest(a, false)();
        lo = -largest(a, true)();
        excess = largest::excess(a);
    } else {
        number_detail::scratch<C> tensor(count);
        for (std::size_t i = 0; i < a.terms(); ++i) {
            auto const* const e = a.space().exponents(i);
            std::size_t place = 0;
            for (std::size_t v = 0; v < n; ++v) place = place * side + e[v];
            tensor[place] = a.c(i);
        }
        number_detail::to_bernstein(tensor.data(), side, count, n);
        lo = hi = tensor[0];
        for (std::size_t k = 1; k < count; ++k) {
            lo = side_by_side::min(lo, tensor[k]);
            hi = side_by_side::max(hi, tensor[k]);
        }
    }
    C const norm = a.polynomial_norm();
    C const out =
        (norm * excess + a.r()) * a.shape().up + (norm + a.r()) * (4 * model::unit) + model::tiny;
    // Where nothing is known of the polynomial the rough bounds say so.
    auto const known = norm < C(model::largest);
    return {side_by_side::select(known, side_by_side::max(lo - out, rough.lower), rough.lower),
            side_by_side::select(known, side_by_side::min(hi + out, rough.upper), rough.upper)};
}

/// The lanes whose polynomial has values of both signs, at the two corners where its linear part is
/// largest and least: there no bounds decide its sign. No proof rests on it.
/// @given  a degree of 1 or more
/// @cost  O(terms N)
template <class C>
[[nodiscard]] typename lane_traits<C>::mask changes_sign(taylor_model<C> const& a) {
    using side_by_side = lane_traits<C>;
    auto const& space = a.space();
    auto const n = space.variables();
    number_detail::scratch<C> corner(n);
    for (std::size_t v = 0; v < n; ++v)
        corner[v] = side_by_side::select(a.c(space.variable(v)) < C(0.0), C(-1.0), C(1.0));
    C even{}, odd{};
    for (std::size_t i = 0; i < a.terms(); ++i) {
        C term = a.c(i);
        auto const* const e = space.exponents(i);
        for (std::size_t v = 0; v < n; ++v)
            if (e[v] % 2 == 1) term = term * corner[v];
        (space.degree_of(i) % 2 == 0 ? even : odd) += term;
    }
    C const up = even + odd, down = even - odd;
    return ((up > C(0.0)) & (down < C(0.0))) | ((up < C(0.0)) & (down > C(0.0)));
}

/// Its bounds as an interval.
[[nodiscard]] inline interval range(taylor_model<double> const& a) {
    auto const b = bounds(a);
    if (!std::isfinite(b.lower) || !std::isfinite(b.upper))
        return interval_traits<interval>::entire();
    return interval(b.lower, b.upper);
}

} // namespace sivid

#endif
