// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_BERNSTEIN_HPP
#define SIVID_NUMBER_BERNSTEIN_HPP

#include <sivid/number/taylor_model.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace sivid {

namespace number_detail {

/// m[e][k]: coefficient k of \f$ q^e = (2 s - 1)^e \f$, s in [0,1], in the Bernstein basis of
/// degree D. It is the mean of the products of e of D numbers, k of which are 1 and the others -1
/// (the blossom at the corners), so a ratio of small integers of size at most 1.
template <std::size_t D>
inline constexpr auto bernstein_of_power = [] {
    std::array<std::array<double, D + 1>, D + 1> m{};
    for (std::size_t e = 0; e <= D; ++e) {
        for (std::size_t k = 0; k <= D; ++k) {
            double sum = 0;
            for (std::size_t j = 0; j <= e; ++j) {
                if (j > k || e - j > D - k) continue;
                auto const ways = static_cast<double>(binomial(k, j) * binomial(D - k, e - j));
                sum += (e - j) % 2 == 0 ? ways : -ways;
            }
            m[e][k] = sum / static_cast<double>(binomial(D, e));
        }
    }
    return m;
}();

/// Most Bernstein coefficients that are worth their time.
inline constexpr std::size_t most_bernstein_coefficients = 4096;

/// (D+1)^N, or a larger number than `most_bernstein_coefficients`
template <std::size_t N, std::size_t D>
inline constexpr std::size_t bernstein_coefficients = [] {
    std::size_t n = 1;
    for (std::size_t v = 0; v < N && n <= most_bernstein_coefficients; ++v) n *= D + 1;
    return n;
}();

/// Turns the `count` coefficients of powers in a tensor of `variables` axes of length D + 1 into
/// those of the Bernstein basis.
template <std::size_t D, class C, std::size_t Size>
void to_bernstein(std::array<C, Size>& tensor, std::size_t count, std::size_t variables) {
    constexpr std::size_t side = D + 1;
    auto const& m = bernstein_of_power<D>;
    std::array<C, side> line{};
    std::size_t stride = 1;
    for (std::size_t v = 0; v < variables; ++v, stride *= side) {
        for (std::size_t base = 0; base < count; ++base) {
            if ((base / stride) % side != 0) continue;
            for (std::size_t e = 0; e < side; ++e) line[e] = tensor[base + e * stride];
            for (std::size_t k = 0; k < side; ++k) {
                C sum = line[0] * m[0][k];
                for (std::size_t e = 1; e < side; ++e) sum += line[e] * m[e][k];
                tensor[base + k * stride] = sum;
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
template <std::size_t N, std::size_t D, class C>
class largest_value {
    using model = taylor_model<N, D, C>;
    using side_by_side = lane_traits<C>;
    static constexpr std::size_t side = D + 1;
    static constexpr auto const& basis = model::basis::data;
    static constexpr auto terms = static_cast<double>(model::terms);

public:
    largest_value(model const& a, bool negative) : c_(a.c), norm_(a.polynomial_norm()) {
        if (negative) {
            for (auto& c : c_) c = -c;
        }
        free_.fill(true);
    }

    /// Roundings of all that is done here, as a multiple of the norm: the Bernstein stages (see
    /// `bounds`), and sums of at most `terms` coefficients before and after them.
    [[nodiscard]] static constexpr double excess() {
        return (static_cast<double>(N * (2 * side + 8)) + 2 * terms + 8) * model::unit;
    }

    [[nodiscard]] C operator()() {
        measure();
        while (settle()) measure();
        while (left_ > most_free) {
            bound_least();
            measure();
        }
        std::array<std::size_t, model::terms> place{};
        std::size_t count = 1;
        for (std::size_t v = N; v-- > 0;) {
            if (!free_[v]) continue;
            for (std::size_t i = 0; i < model::terms; ++i) {
                place[i] += count * basis.exponents[i][v];
            }
            count *= side;
        }
        std::array<C, most_bernstein_coefficients> tensor{};
        for (std::size_t i = 0; i < model::terms; ++i) tensor[place[i]] += c_[i];
        to_bernstein<D>(tensor, count, left_);
        C most = tensor[0];
        for (std::size_t k = 1; k < count; ++k) most = side_by_side::max(most, tensor[k]);
        return most + bounded_;
    }

private:
    static constexpr std::size_t most_free = [] {
        std::size_t m = 0;
        for (std::size_t n = side; n <= most_bernstein_coefficients; n *= side) ++m;
        return m;
    }();

    /// \f$ \partial_v P = \f$ slope + a number of size at most rest, for each free variable.
    void measure() {
        slope_.fill(C(0.0));
        rest_.fill(C(0.0));
        for (std::size_t i = 1; i < model::terms; ++i) {
            auto const& e = basis.exponents[i];
            std::size_t degree = 0, last = 0;
            for (std::size_t v = 0; v < N; ++v) {
                if (!free_[v] || e[v] == 0) continue;
                degree += e[v];
                last = v;
            }
            if (degree == 1) {
                slope_[last] += c_[i];
            } else if (degree > 1) {
                C const size = side_by_side::abs(c_[i]);
                for (std::size_t v = 0; v < N; ++v) {
                    if (free_[v] && e[v] > 0) rest_[v] += size * static_cast<double>(e[v]);
                }
            }
        }
    }
    /// Sets the variables in which P is monotone, in all lanes, to the better end.
    [[nodiscard]] bool settle() {
        bool some = false;
        // Sums of at most `terms` numbers that add up to at most D norms.
        C const unsure = norm_ * (static_cast<double>(D) * (terms + 8) * 4 * model::unit);
        for (std::size_t v = 0; v < N; ++v) {
            if (!free_[v]) continue;
            if (!side_by_side::all(side_by_side::abs(slope_[v]) > rest_[v] + unsure)) continue;
            auto const rises = slope_[v] > C(0.0);
            for (std::size_t i = 0; i < model::terms; ++i) {
                if (basis.exponents[i][v] % 2 == 1) {
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
        std::size_t least = N;
        double lowest = 0;
        for (std::size_t v = 0; v < N; ++v) {
            if (!free_[v]) continue;
            double weight = 0;
            for (std::size_t l = 0; l < side_by_side::count; ++l) {
                weight += side_by_side::get(rest_[v], l);
            }
            if (least != N && !(weight < lowest)) continue;
            least = v;
            lowest = weight;
        }
        C linear{};
        for (std::size_t i = 0; i < model::terms; ++i) {
            auto const& e = basis.exponents[i];
            if (e[least] == 0) continue;
            std::size_t degree = 0;
            for (std::size_t v = 0; v < N; ++v) degree += free_[v] ? e[v] : 0U;
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

    std::array<C, model::terms> c_; ///< with the signs of the variables that are set
    C norm_;
    std::array<bool, N> free_;
    std::size_t left_ = N;
    std::array<C, N> slope_, rest_;
    C bounded_{};
};

} // namespace number_detail

/// Bounds a Taylor model over \f$ [-1,1]^N \f$ by the Bernstein coefficients of its polynomial,
/// which are exact at the corners; where there would be too many of them, in fewer variables
/// (`number_detail::largest_value`).
/// @cost  O((D+1)^N N D)
/// @ref   Garloff 1986: Bernstein polynomials enclose the range
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] value_bounds<C> bounds(taylor_model<N, D, C> const& a) {
    using model = taylor_model<N, D, C>;
    using side_by_side = lane_traits<C>;
    constexpr std::size_t side = D + 1;
    constexpr std::size_t count = number_detail::bernstein_coefficients<N, D>;
    auto const rough = rough_bounds(a);
    if constexpr (D < 2) {
        return rough;
    } else {
        if (a.is_constant()) return rough;
        C lo, hi;
        // A line's values are bounded by the sum of |coefficients| along it, since |m| <= 1; so
        // are their errors, times (side + 2) units. Summed along the other lines that is the norm,
        // in each stage; the last two operations below add less than four units of it.
        double excess = (static_cast<double>(N * (2 * side + 8)) + 8) * model::unit;
        if constexpr (count > number_detail::most_bernstein_coefficients) {
            using largest = number_detail::largest_value<N, D, C>;
            hi = largest(a, false)();
            lo = -largest(a, true)();
            excess = largest::excess();
        } else {
            std::array<C, count> tensor{};
            auto const& t = model::basis::data;
            for (std::size_t i = 0; i < model::terms; ++i) {
                std::size_t place = 0;
                for (std::size_t v = 0; v < N; ++v) place = place * side + t.exponents[i][v];
                tensor[place] = a.c[i];
            }
            number_detail::to_bernstein<D>(tensor, count, N);
            lo = hi = tensor[0];
            for (std::size_t k = 1; k < count; ++k) {
                lo = side_by_side::min(lo, tensor[k]);
                hi = side_by_side::max(hi, tensor[k]);
            }
        }
        C const norm = a.polynomial_norm();
        C const out =
            (norm * excess + a.r) * model::up + (norm + a.r) * (4 * model::unit) + model::tiny;
        // Where nothing is known of the polynomial the rough bounds say so.
        auto const known = norm < C(model::largest);
        return {side_by_side::select(known, side_by_side::max(lo - out, rough.lower), rough.lower),
                side_by_side::select(known, side_by_side::min(hi + out, rough.upper), rough.upper)};
    }
}

/// The same as an interval.
template <std::size_t N, std::size_t D>
[[nodiscard]] interval range(taylor_model<N, D> const& a) {
    auto const b = bounds(a);
    if (!std::isfinite(b.lower) || !std::isfinite(b.upper))
        return interval_traits<interval>::entire();
    return interval(b.lower, b.upper);
}

} // namespace sivid

#endif
