// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_OUTLIER_RULE_HPP
#define SIVID_IO_DATASET_OUTLIER_RULE_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/measurement/outliers_for.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace sivid {

/// How many of the n measurements of an experiment may violate their bounds. Products are exact in
/// decimals: 0.29 of 100 is 29.
class outlier_rule {
public:
    /// So many in every experiment.
    outlier_rule(std::size_t count) : count_{count} {} // NOLINT: a number is a rule

    /// At most the share f: \f$ q = \lfloor f n \rfloor \f$.
    /// @throws std::invalid_argument for a negative share
    [[nodiscard]] static outlier_rule share(exact_decimal f) {
        if (f.is_negative()) throw std::invalid_argument("outlier_rule: a negative share");
        return {kind::share, std::move(f)};
    }

    /// The threshold h of Algorithm 2 of L. Zhu's report, as printed: a box is inside when more
    /// than n (1 - h) measurements certainly hold, outside when at least n h certainly fail. That
    /// is the rule for a budget of \f$ q = \lceil n h \rceil - 1 \f$: inside when at least n - q
    /// hold, outside when more than q fail.
    /// @throws std::invalid_argument unless 0 < h <= 1: with h = 0 every box would be outside
    [[nodiscard]] static outlier_rule threshold(exact_decimal h) {
        if (!h.is_positive() || *exact_decimal::parse("1") < h) {
            throw std::invalid_argument("outlier_rule: the threshold " + h.text() +
                                        " is not above 0 and at most 1");
        }
        return {kind::threshold, std::move(h)};
    }

    /// As many as are violated with at most the rest of the probability `wanted`, if each bound
    /// holds with probability `each`, independently: `outliers_for`.
    /// @throws std::invalid_argument for what is not within 0 to 1
    [[nodiscard]] static outlier_rule chance(exact_decimal each, exact_decimal wanted) {
        outlier_rule rule{kind::chance, std::move(each)};
        rule.wanted_ = std::move(wanted);
        static_cast<void>(rule.of(1)); // refuses
        return rule;
    }

    /// Of n measurements.
    /// @given  n f below 1e18
    [[nodiscard]] std::size_t of(std::size_t n) const {
        if (kind_ == kind::count) return count_;
        if (kind_ == kind::chance) return outliers_for(n, *enclose(number_), *enclose(wanted_));
        auto const product = number_.times(n);
        auto const below = product.floor();
        if (kind_ == kind::share) return below;
        bool const whole = product == *exact_decimal::parse(std::to_string(below));
        return whole ? below - (n > 0 ? 1 : 0) : below;
    }

private:
    enum class kind { count, share, threshold, chance };
    outlier_rule(kind k, exact_decimal number) : kind_{k}, number_{std::move(number)} {}

    kind kind_ = kind::count;
    std::size_t count_ = 0;
    exact_decimal number_, wanted_;
};

} // namespace sivid

#endif
