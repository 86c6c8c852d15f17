// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_COMBINED_POLYNOMIAL_HPP
#define SIVID_PAVING_RESPONSE_COMBINED_POLYNOMIAL_HPP

#include <sivid/paving/response/response.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace sivid {

/// A polynomial with enclosed coefficients over \f$ d \in [-1,1]^n \f$, plus an enclosed constant
/// that may differ from point to point.
class combined_polynomial {
    using traits = interval_traits<interval>;

public:
    explicit combined_polynomial(std::size_t unknowns) : n_(unknowns) {}

    void add_constant(interval const& c) { constant_ = traits::add(constant_, c); }
    /// Adds \f$ c \, d_{unknown} \f$.
    void add_linear(std::size_t unknown, interval const& c) {
        powers e(n_, 0);
        e[unknown] = 1;
        add_term(std::move(e), c);
    }
    /// Adds \f$ c \, d_u d_v \f$.
    void add_product(std::size_t u, std::size_t v, interval const& c) {
        powers e(n_, 0);
        ++e[u];
        ++e[v];
        add_term(std::move(e), c);
    }

    /// Where a variable of a response lies: \f$ q_v = middle + reach \cdot d_{unknown} \f$.
    struct place {
        std::size_t unknown = 0;
        interval middle{0.0};
        interval reach{1.0};
    };

    /// Adds \f$ \sum_y weight_y y(q) \f$ of a response's outputs.
    /// @param weights  (output, weight)
    /// @param places   one per variable of the response
    void add(response const& known, std::vector<std::pair<std::size_t, double>> const& weights,
             std::vector<place> const& places) {
        auto const& table = *known.table;
        std::vector<interval> c(table.size(), traits::point(0.0));
        for (auto const& [y, w] : weights) {
            auto const weight = traits::point(w);
            for (std::size_t m = 0; m < table.size(); ++m) {
                auto const own = traits::point(known.coefficients[m * known.outputs() + y]);
                c[m] = traits::add(c[m], traits::mul(weight, own));
            }
            auto const r = known.radius[y];
            add_constant(traits::mul(weight, traits::bounds(-r, r)));
        }
        for (std::size_t v = 0; v < table.variables; ++v) {
            auto const& shift = places[v].middle;
            if (mag(shift) == 0) continue;
            table.shift(v, [&](std::size_t m, std::size_t k) {
                c[m] = traits::add(c[m], traits::mul(shift, c[k]));
            });
        }
        for (std::size_t m = 0; m < table.size(); ++m) {
            powers e(n_, 0);
            for (std::size_t v = 0; v < table.variables; ++v) {
                e[places[v].unknown] = table.exponents[m][v];
                for (std::size_t k = 0; k < table.exponents[m][v]; ++k) {
                    c[m] = traits::mul(c[m], places[v].reach);
                }
            }
            add_term(std::move(e), c[m]);
        }
    }

    /// How the product of two unknowns, u < v, is bounded by a plane: \f$ \pm d_u d_v \ge s d_u \pm
    /// s d_v - 1 \f$ for any \f$ |s| \le 1 \f$ (G. P. McCormick, Mathematical Programming 10,
    /// 1976), here times the size of the product's coefficient: slope = s |c|.
    struct plane {
        std::size_t u = 0, v = 0;
        double slope = 0;
    };
    /// A number that the polynomial nowhere falls below.
    ///   Squares that outweigh the mixed term of their unknowns absorb it, \f$ |c d_u d_v| \le
    ///   |c| (\theta d_u^2 + d_v^2/\theta)/2 \f$; what is left splits into the unknowns.
    /// @param planes  for products that are better bounded so, a guess
    /// @guarantee  for any planes
    /// @cost  O(terms)
    [[nodiscard]] double lower_bound(std::vector<plane> const& planes = {}) const {
        double const least = std::max(lower_bound(true, {}), lower_bound(false, {}));
        return planes.empty() ? least : std::max(least, lower_bound(true, planes));
    }

private:
    using powers = std::vector<std::uint16_t>; // of bytes, g++ 12 warns of a comparison

    void add_term(powers e, interval const& c) {
        auto const [known_term, is_new] = terms_.emplace(std::move(e), c);
        if (!is_new) known_term->second = traits::add(known_term->second, c);
    }

    /// Enclosed sum of what has no unknown, with one bound of each unknown's own part.
    [[nodiscard]] double lower_bound(bool absorb, std::vector<plane> const& planes) const {
        auto total = constant_;
        std::vector<interval> slope(n_, traits::point(0.0));
        std::vector<double> square(n_, 0.0); // at least so large
        struct mixed_term {
            std::size_t u, v;
            double size;
        };
        std::vector<mixed_term> mixed;
        std::map<std::pair<std::size_t, std::size_t>, double> tilts;
        for (auto const& p : planes) tilts[{p.u, p.v}] = p.slope;
        auto const lose = [&](double size) {
            total = traits::sub(total, traits::bounds(0.0, size));
        };
        for (auto const& [e, c] : terms_) {
            if (!is_bounded(c)) return -HUGE_VAL;
            std::size_t degree = 0;
            bool even = true;
            for (auto const k : e) {
                degree += k;
                even = even && k % 2 == 0;
            }
            if (degree == 0) {
                total = traits::add(total, c);
                continue;
            }
            auto const is_used = [](std::uint16_t k) { return k > 0; };
            auto const u =
                static_cast<std::size_t>(std::find_if(e.begin(), e.end(), is_used) - e.begin());
            if (degree == 1) {
                slope[u] = traits::add(slope[u], c);
            } else if (degree == 2 && e[u] == 2) {
                square[u] = lower(c);
            } else if (degree == 2) {
                auto const v = static_cast<std::size_t>(
                    std::find(e.begin() + static_cast<std::ptrdiff_t>(u) + 1, e.end(), 1) -
                    e.begin());
                auto const tilt = tilts.find({u, v});
                bool const rises = lower(c) > 0;
                if (tilt == tilts.end() || !(rises || upper(c) < 0)) {
                    mixed.push_back({u, v, mag(c)});
                    continue;
                }
                // c = +-least and what is beyond it
                double const least = rises ? lower(c) : -upper(c);
                auto const s = traits::point(std::clamp(tilt->second, -least, least));
                slope[u] = traits::add(slope[u], s);
                slope[v] = traits::add(slope[v], rises ? s : traits::neg(s));
                lose(mag(c)); // least + (mag(c) - least)
            } else {
                if (!even || !(lower(c) >= 0)) lose(mag(c));
            }
        }
        for (auto const& [u, v, size] : mixed) {
            double const theta =
                absorb && square[u] > 0 && square[v] > 0 ? std::sqrt(square[u] / square[v]) : 0.0;
            auto const half = traits::mul(traits::point(0.5), traits::point(size));
            bool undefined = false;
            auto const from_u = traits::mul(half, traits::point(theta));
            auto const from_v = traits::div(half, traits::point(theta), undefined);
            bool const fits = theta > 0 && !undefined && std::isfinite(mag(from_v)) &&
                              upper(from_u) <= square[u] && upper(from_v) <= square[v];
            if (!fits) {
                lose(size);
                continue;
            }
            square[u] = lower(traits::sub(traits::point(square[u]), from_u));
            square[v] = lower(traits::sub(traits::point(square[v]), from_v));
        }
        for (std::size_t v = 0; v < n_; ++v) {
            total = traits::add(total, least_of_parabola(mag(slope[v]), square[v]));
        }
        return is_empty(total) ? -HUGE_VAL : lower(total);
    }

    /// Encloses the least value of \f$ b d^2 - a |d| \f$ for \f$ |d| \le 1 \f$.
    [[nodiscard]] static interval least_of_parabola(double a, double b) {
        if (!(a < 2 * b)) return traits::sub(traits::point(b), traits::point(a));
        bool undefined = false;
        auto const four_b = traits::mul(traits::point(4.0), traits::point(b));
        auto const square = traits::mul(traits::point(a), traits::point(a));
        return traits::neg(traits::div(square, four_b, undefined));
    }

    std::size_t n_;
    interval constant_ = traits::point(0.0);
    std::map<powers, interval> terms_;
};

} // namespace sivid

#endif
