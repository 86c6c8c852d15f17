// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_PLAIN_START_RULE_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_PLAIN_START_RULE_HPP

#include <sivid/paving/contract/detail/start_rule.hpp>
#include <sivid/paving/run/plain_run.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sivid {

/// Starts that follow the parameters of a part by an affine rule, found and proved by the affine
/// forms of a plain run. What `explaining_starts` is for polynomials; it shares only the guess.
/// @tparam I  the interval type of the run
template <class I>
class plain_start_rule {
    using traits = interval_traits<I>;

public:
    /// @param starts  that the run was made over
    /// @param part    a subset of the region that it was made over
    plain_start_rule(plain_outputs<I> const& known, record const& samples, box const& starts,
                     box const& part)
        : plain_start_rule(known, samples, starts, part, starts) {}

    /// @param choice  rules are looked for among these starts; where they are not among those of
    ///   the run its forms extrapolate, which may guide but proves nothing
    plain_start_rule(plain_outputs<I> const& known, record const& samples, box const& starts,
                     box const& part, box const& choice)
        : known_(&known), samples_(&samples), starts_(&starts) {
        auto const& d = known.deviation;
        for (std::size_t c = 0; c < starts.size(); ++c) {
            if (is_decimal(choice[c])) {
                fixed_.push_back({c, 0, 0, d[c]});
                continue;
            }
            I const own = traits::sub(traits::bounds(choice[c].lower(), choice[c].upper()),
                                      centre_of(starts[c]));
            double const middle = traits::mid(own);
            double const reach = traits::mag(traits::sub(own, traits::point(middle)));
            free_.push_back({c, middle, reach, d[c]});
        }
        for (std::size_t j = 0; j < part.size(); ++j) {
            auto const c = starts.size() + j;
            I const own = traits::intersect(
                d[c], traits::sub(traits::bounds(part[j].lower(), part[j].upper()),
                                  traits::point(known.parameter_centre[j])));
            double const middle = traits::mid(own);
            double const reach = traits::mag(traits::sub(own, traits::point(middle)));
            parameters_.push_back({c, middle, reach, own});
        }
    }

    /// A decimal's enclosure: not a start to choose.
    [[nodiscard]] static bool is_decimal(interval const& x) { return rad(x) <= 1e-13 * mag(x); }

    /// A rule that should explain all but q measurements, if there seems to be one.
    /// @param by_rests  counts what is not affine; else only its middle
    /// @param bounds    half-widths of measurements by which outputs may be off, 1 to explain them
    [[nodiscard]] std::optional<start_rule> search(std::size_t q, bool by_rests,
                                                   double bounds = 1) const {
        if (free_.empty() || known_->outputs.size() + q < samples_->size()) return std::nullopt;
        auto const n = known_->outputs.size();
        misfit_forms f;
        f.parameters = parameters_.size();
        f.starts = free_.size();
        f.by_parameter.assign(f.parameters * n, 0.0);
        f.by_start.assign(f.starts * n, 0.0);
        for (std::size_t k = 0; k < n; ++k) {
            auto const& o = known_->outputs[k];
            auto const& bound = (*samples_)[k].bound;
            double const e = std::max(rad(bound), std::numeric_limits<double>::min());
            double offset = traits::mid(o.rest) - mid(bound);
            for (std::size_t j = 0; j < f.parameters; ++j) {
                double const g = o.gradient[parameters_[j].column];
                f.by_parameter[j * n + k] = g * parameters_[j].reach / e;
                offset += g * parameters_[j].middle;
            }
            for (std::size_t i = 0; i < f.starts; ++i) {
                double const g = o.gradient[free_[i].column];
                f.by_start[i * n + k] = g * free_[i].reach / e;
                offset += g * free_[i].middle;
            }
            double const lost = by_rests ? 0.5 * traits::width(o.rest) / e : 0;
            bool const usable = o.defined && std::isfinite(offset) && std::isfinite(lost);
            f.offset.push_back(usable ? offset / e : 0);
            f.margin.push_back(usable ? std::max(bounds - lost, -1e9) : -1e9);
        }
        return start_rule_search()(f, q);
    }

    /// @guarantee  true: for every parameter of the part the rule's start lies in the run's starts,
    ///   and with it all but q measurements hold
    [[nodiscard]] bool proves(start_rule const& rule, std::size_t q) const {
        for (std::size_t i = 0; i < free_.size(); ++i) {
            if (!stays(i, rule)) return false;
        }
        std::size_t held = 0;
        for (std::size_t k = 0; k < known_->outputs.size(); ++k) {
            auto const& o = known_->outputs[k];
            auto const& bound = (*samples_)[k].bound;
            if (o.defined && lies_in(value(o, rule), bound)) ++held;
        }
        return held + q >= samples_->size();
    }

    /// The starts of the rule for the middle of the part; others as in the middle of the run's.
    [[nodiscard]] std::vector<double> middle(start_rule const& rule) const {
        auto result = mid(*starts_);
        for (std::size_t i = 0; i < free_.size(); ++i) {
            result[free_[i].column] += free_[i].middle + free_[i].reach * rule.middle[i];
        }
        return result;
    }

    /// A box of starts around those of the rule, off the bounds of `initial`.
    [[nodiscard]] box around(start_rule const& rule, box const& initial) const {
        auto result = initial;
        auto const at = middle(rule);
        for (std::size_t i = 0; i < free_.size(); ++i) {
            auto const& own = free_[i];
            double const middle = at[own.column];
            // Wider, so that rules for other linearisations lie within, too.
            double const reach =
                1.5 * own.reach * reach_of(rule, i) + 0x1p-10 * rad(initial[own.column]);
            auto& side = result[own.column];
            double const off = 0x1p-40 * rad(side);
            side = interval_traits<interval>::intersect(
                interval_traits<interval>::bounds(middle - reach, middle + reach),
                interval_traits<interval>::bounds(std::nextafter(side.lower() + off, HUGE_VAL),
                                                  std::nextafter(side.upper() - off, -HUGE_VAL)));
        }
        return result;
    }

private:
    /// An unknown as middle + reach * [-1, 1] about the centre of the run.
    struct unknown {
        std::size_t column = 0;
        double middle = 0, reach = 0;
        I range;
    };

    /// Where a run puts the centre of a side of its starts.
    [[nodiscard]] static I centre_of(interval const& side) {
        return traits::point(traits::mid(traits::bounds(side.lower(), side.upper())));
    }

    /// Sum of the sizes of a start's slopes, about.
    [[nodiscard]] double reach_of(start_rule const& rule, std::size_t i) const {
        double sum = 0;
        for (std::size_t j = 0; j < parameters_.size(); ++j) {
            sum += std::abs(rule.slope[i * parameters_.size() + j]);
        }
        return sum;
    }

    /// Whether a start of the rule stays in its side of the run's starts.
    [[nodiscard]] bool stays(std::size_t i, start_rule const& rule) const {
        auto const n = parameters_.size();
        I s = traits::point(rule.middle[i]);
        for (std::size_t j = 0; j < n; ++j) {
            double const size = std::abs(rule.slope[i * n + j]);
            s = traits::add(s, traits::bounds(-size, size));
        }
        I const moved = traits::add(traits::point(free_[i].middle),
                                    traits::mul(traits::point(free_[i].reach), s));
        auto const& side = (*starts_)[free_[i].column];
        I const centre = centre_of(side);
        I const below = traits::sub(traits::point(side.lower()), centre);
        I const above = traits::sub(traits::point(side.upper()), centre);
        return traits::upper(below) <= traits::lower(moved) &&
               traits::upper(moved) <= traits::lower(above);
    }

    /// Encloses an output over the part when the starts follow the rule.
    [[nodiscard]] I value(observation<I> const& o, start_rule const& rule) const {
        I y = o.rest;
        auto const slope = [&o](std::size_t c) { return traits::point(o.gradient[c]); };
        for (auto const& u : fixed_) {
            if (o.gradient[u.column] != 0)
                y = traits::add(y, traits::mul(slope(u.column), u.range));
        }
        std::vector<I> by_start;
        for (std::size_t i = 0; i < free_.size(); ++i) {
            auto const& own = free_[i];
            by_start.push_back(traits::mul(slope(own.column), traits::point(own.reach)));
            y = traits::add(y, traits::mul(by_start[i], traits::point(rule.middle[i])));
            y = traits::add(y, traits::mul(slope(own.column), traits::point(own.middle)));
        }
        for (std::size_t j = 0; j < parameters_.size(); ++j) {
            auto const& p = parameters_[j];
            y = traits::add(y, traits::mul(slope(p.column), traits::point(p.middle)));
            I change = traits::mul(slope(p.column), traits::point(p.reach));
            for (std::size_t i = 0; i < free_.size(); ++i) {
                auto const k = traits::point(rule.slope[i * parameters_.size() + j]);
                change = traits::add(change, traits::mul(by_start[i], k));
            }
            y = traits::add(y, traits::mul(change, traits::bounds(-1.0, 1.0)));
        }
        return y;
    }

    plain_outputs<I> const* known_;
    record const* samples_;
    box const* starts_;
    std::vector<unknown> free_, fixed_, parameters_;
};

} // namespace sivid

#endif
