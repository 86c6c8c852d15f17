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

    /// What the polynomial is nowhere below: a total of what has no unknown any more, each
    /// unknown's own part, and mixed terms of two.
    struct parts {
        interval total;
        std::vector<interval> slope;
        std::vector<double> square; ///< at least so large
        struct mixed_term {
            std::size_t u, v;
            double size;
        };
        std::vector<mixed_term> mixed;

        /// For a term of at most this size.
        void lose(double size) { total = traits::sub(total, traits::bounds(0.0, size)); }
    };
    /// Slopes of the planes by (u, v).
    using tilt_map = std::map<std::pair<std::size_t, std::size_t>, double>;

    [[nodiscard]] double lower_bound(bool absorb, std::vector<plane> const& planes) const {
        parts p{constant_,
                std::vector<interval>(n_, traits::point(0.0)),
                std::vector<double>(n_, 0.0),
                {}};
        tilt_map tilts;
        for (auto const& t : planes) tilts[{t.u, t.v}] = t.slope;
        for (auto const& [e, c] : terms_) {
            if (!is_bounded(c)) return -HUGE_VAL;
            take_term(e, c, tilts, p);
        }
        for (auto const& m : p.mixed) {
            if (!absorb || !absorb_in_squares(m, p)) p.lose(m.size);
        }
        for (std::size_t v = 0; v < n_; ++v) {
            p.total = traits::add(p.total, least_of_parabola(mag(p.slope[v]), p.square[v]));
        }
        return is_empty(p.total) ? -HUGE_VAL : lower(p.total);
    }
    static void take_term(powers const& e, interval const& c, tilt_map const& tilts, parts& p) {
        std::size_t degree = 0;
        bool even = true;
        for (auto const k : e) {
            degree += k;
            even = even && k % 2 == 0;
        }
        if (degree == 0) {
            p.total = traits::add(p.total, c);
            return;
        }
        auto const used_from = [&e](std::size_t first) {
            auto const at = std::find_if(e.begin() + static_cast<std::ptrdiff_t>(first), e.end(),
                                         [](std::uint16_t k) { return k > 0; });
            return static_cast<std::size_t>(at - e.begin());
        };
        auto const u = used_from(0);
        if (degree == 1) {
            p.slope[u] = traits::add(p.slope[u], c);
        } else if (degree == 2 && e[u] == 2) {
            p.square[u] = lower(c);
        } else if (degree == 2) {
            auto const v = used_from(u + 1);
            auto const tilt = tilts.find({u, v});
            bool const signed_term = lower(c) > 0 || upper(c) < 0;
            if (tilt != tilts.end() && signed_term)
                take_by_plane(u, v, c, tilt->second, p);
            else
                p.mixed.push_back({u, v, mag(c)});
        } else if (!even || !(lower(c) >= 0)) {
            p.lose(mag(c));
        }
    }
    /// c d_u d_v by a plane.
    /// @given  c of one sign
    static void take_by_plane(std::size_t u, std::size_t v, interval const& c, double tilt,
                              parts& p) {
        // c = +-least and what is beyond it
        bool const rises = lower(c) > 0;
        double const least = rises ? lower(c) : -upper(c);
        auto const s = traits::point(std::clamp(tilt, -least, least));
        p.slope[u] = traits::add(p.slope[u], s);
        p.slope[v] = traits::add(p.slope[v], rises ? s : traits::neg(s));
        p.lose(mag(c)); // least + (mag(c) - least)
    }
    /// @returns false when the squares do not outweigh the mixed term
    [[nodiscard]] static bool absorb_in_squares(parts::mixed_term const& m, parts& p) {
        auto& of_u = p.square[m.u];
        auto& of_v = p.square[m.v];
        if (!(of_u > 0 && of_v > 0)) return false;
        double const theta = std::sqrt(of_u / of_v);
        auto const half = traits::mul(traits::point(0.5), traits::point(m.size));
        bool undefined = false;
        auto const from_u = traits::mul(half, traits::point(theta));
        auto const from_v = traits::div(half, traits::point(theta), undefined);
        bool const fits = theta > 0 && !undefined && std::isfinite(mag(from_v)) &&
                          upper(from_u) <= of_u && upper(from_v) <= of_v;
        if (!fits) return false;
        of_u = lower(traits::sub(traits::point(of_u), from_u));
        of_v = lower(traits::sub(traits::point(of_v), from_v));
        return true;
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
