// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_DETAIL_FRACTION_COEFFICIENTS_HPP
#define SIVID_MODEL_GRAPH_DETAIL_FRACTION_COEFFICIENTS_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/number/elementary/detail/integers.hpp>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

namespace sivid::model_detail {

/// A quotient of 64-bit integers in lowest terms.
struct small_fraction {
    std::int64_t above = 0, below = 1;

    static std::optional<small_fraction> of(std::int64_t a, std::int64_t b) {
        auto const common = std::gcd(a, b);
        if (common == 0) return std::nullopt;
        small_fraction r{a / common, b / common};
        if (r.below < 0) r = {-r.above, -r.below};
        return r;
    }
    /// @returns nothing where integers would overflow
    static std::optional<small_fraction> product(small_fraction x, small_fraction y) {
        auto const a = limited(detail::checked_product(x.above, y.above)),
                   b = limited(detail::checked_product(x.below, y.below));
        if (!a || !b) return std::nullopt;
        return of(*a, *b);
    }
    static std::optional<small_fraction> sum(small_fraction x, small_fraction y) {
        auto const a = detail::checked_product(x.above, y.below),
                   b = detail::checked_product(y.above, x.below),
                   below = limited(detail::checked_product(x.below, y.below));
        if (!a || !b || !below) return std::nullopt;
        auto const above = limited(detail::checked_sum(*a, *b));
        if (!above) return std::nullopt;
        return of(*above, *below);
    }

private:
    static std::optional<std::int64_t> limited(std::optional<std::int64_t> x) {
        return x && *x > -(std::int64_t{1} << 62) ? x : std::nullopt;
    }
};

/// Fractions as coefficients and all other nodes as factors, which are taken for independent: what
/// is 0 then is 0 for all values of the leaves.
class fraction_coefficients {
public:
    using value = small_fraction;
    using result = std::optional<small_fraction>;

    explicit fraction_coefficients(graph const& g) : g_(&g) {}

    [[nodiscard]] graph const& g() const { return *g_; }
    /// Multiples of 1/1024, and not too large.
    [[nodiscard]] result known(node_id i) const {
        if (!g_->is_literal(i)) return std::nullopt;
        auto const& literal = g_->value((*g_)[i]).enclosure;
        double const scaled = literal.lower() * 1024;
        if (!is_point(literal) || !(std::abs(scaled) < 1e9) || scaled != std::round(scaled)) {
            return std::nullopt;
        }
        return small_fraction::of(static_cast<std::int64_t>(scaled), 1024);
    }
    [[nodiscard]] bool is_variable(node_id) const { return true; }
    [[nodiscard]] small_fraction whole(node_id) const { return one(); } // never asked for
    [[nodiscard]] small_fraction one() const { return {1, 1}; }
    [[nodiscard]] bool is_zero(small_fraction v) const { return v.above == 0; }
    [[nodiscard]] result neg(small_fraction v) const { return product(v, {-1, 1}); }
    [[nodiscard]] result sum(small_fraction v, small_fraction w) const {
        return small_fraction::sum(v, w);
    }
    [[nodiscard]] result product(small_fraction v, small_fraction w) const {
        return small_fraction::product(v, w);
    }
    [[nodiscard]] result quotient(small_fraction v, small_fraction w) const {
        auto const inverse = small_fraction::of(w.below, w.above);
        return inverse && w.above != 0 ? product(v, *inverse) : std::nullopt;
    }
    [[nodiscard]] result power(small_fraction v, int n) const {
        result r = one();
        for (int k = 0; k < n && r; ++k) r = product(*r, v);
        return r;
    }

private:
    graph const* g_;
};

} // namespace sivid::model_detail

#endif
