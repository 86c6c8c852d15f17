// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_CELL_BOUNDS_HPP
#define SIVID_DECISION_MOTION_DETAIL_CELL_BOUNDS_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/uncertain_input.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// How an output moves between two instants, for all motions of a set.
struct output_course {
    interval direct;           ///< its values
    interval slope;            ///< its derivative; entire where it has none that is known
    interval bend;             ///< half its second derivative; the same
    bool jumps_at_end = false; ///< a held input that it shows may change at the second instant
};

/// Bounds outputs between two instants t_0 < t_1 from what is known at both.
///   By Picard's theorem all motions from X stay in B when \f$ X + [0, h] f(B) \f$ lies inside B;
/// where that fails, it is tried in pieces of the time. On B the Taylor coefficients of the outputs
/// are evaluated; then for each motion
///   \f$ y(t) \in y(t_0) + [0, h] y' \f$ and, where y'' exists,
///   \f$ y(t) \in \mathrm{hull}(y(t_0), y(t_1)) - [0, h^2/4] y''/2 \f$.
/// The last is Rolle's bound of linear interpolation: what hides between samples is of second
/// order.
class cell_bounds {
    using traits = interval_traits<interval>;

public:
    explicit cell_bounds(flow const& f) : flow_(&f), rate_(f.rate(), 2), look_(f.observe(), 2) {
        auto const& model = f.model();
        for (std::size_t y = 0; y < f.channels(); ++y) {
            shows_input_.push_back((model.g.depends(model.observe[y]) & on_input) != 0);
        }
    }

    void set_parameters(box const& p) {
        rate_.set_parameters(p);
        look_.set_parameters(p);
    }

    /// @param at_start  a box that holds all states at `from`
    /// @param at_end    the same at `to`; a guess, no proof rests on it
    /// @given  no input changes its course between `from` and `to`
    /// @returns one course per output; nothing when no B was found: the cell is too long
    [[nodiscard]] std::optional<std::vector<output_course>>
    operator()(double from, double to, box const& at_start, box const& at_end) {
        auto const n = flow_->states();
        interval const times = traits::bounds(from, to);
        auto const inputs = inputs_over(from, from, to);
        std::optional<box> swept;
        for (int pieces = 1; pieces <= 16 && !swept; pieces *= 4)
            swept = sweep(from, to, at_start, at_end, pieces);
        if (!swept || !rates(times, *swept, inputs)) return std::nullopt;
        auto const& b = *swept;
        std::vector<interval> first(n), second(n);
        auto const state = [&](std::size_t i, std::size_t k) -> interval {
            return k == 0 ? b[i] : k == 1 ? first[i] : second[i];
        };
        for (std::size_t i = 0; i < n; ++i) first[i] = rate_.output(i, 0);
        rate_.advance(1, state, inputs);
        for (std::size_t i = 0; i < n; ++i) {
            second[i] = flow_->rate().output_varies(i)
                            ? traits::mul(rate_.output(i, 1), traits::point(0.5))
                            : traits::point(0.0);
        }
        look_.start(times);
        for (std::size_t k = 0; k <= 2; ++k) look_.advance(k, state, inputs);
        bool const smooth =
            !look_.undefined() && !look_.kinked() && !look_.jumped() && !flow_->uncertain();
        bool const twice = smooth && !rate_.undefined() && !rate_.kinked() && !rate_.jumped();
        bool const switches = held_input_changes(to);
        std::vector<output_course> result(flow_->channels());
        for (std::size_t y = 0; y < result.size(); ++y) {
            bool const varies = flow_->observe().output_varies(y);
            auto const order = [&](std::size_t k, bool known) {
                if (!known) return traits::entire();
                auto const value = varies || k == 0 ? look_.output(y, k) : traits::point(0.0);
                return std::isfinite(mag(value)) ? value : traits::entire();
            };
            result[y] = {order(0, !look_.undefined()), order(1, smooth), order(2, twice),
                         shows_input_[y] && switches};
        }
        return result;
    }

    /// The outputs at one instant by natural evaluation: exact where states and inputs are.
    /// @param x  a box that holds all states at t
    [[nodiscard]] std::vector<interval> at(double t, box const& x) {
        look_.evaluate(traits::point(t), x, inputs_over(t, t, t));
        std::vector<interval> result(flow_->channels(), traits::entire());
        for (std::size_t y = 0; y < result.size() && !look_.undefined(); ++y)
            result[y] = look_.output(y, 0);
        return result;
    }

    /// The values of an output between the instants.
    /// @param start, end  that at both of them, for the motions in question
    [[nodiscard]] static interval between(output_course const& c, double from, double to,
                                          interval const& start, interval const& end) {
        interval const h =
            traits::bounds(0.0, traits::sub(traits::point(to), traits::point(from)).upper());
        auto result = c.direct;
        if (is_bounded(c.slope)) {
            auto const way = traits::mul(h, c.slope);
            result = meet(result, traits::add(start, way));
            if (!c.jumps_at_end) result = meet(result, traits::sub(end, way));
        }
        if (is_bounded(c.bend) && !c.jumps_at_end) {
            auto const most = traits::mul(traits::mul(h, h), traits::point(0.25));
            auto const sag = traits::mul(traits::bounds(0.0, most.upper()), c.bend);
            result = meet(result, traits::sub(traits::hull(start, end), sag));
        }
        return result;
    }

private:
    static bool is_bounded(interval const& x) { return std::isfinite(mag(x)); }
    static interval wider(interval const& x, double by) {
        return traits::add(x, traits::bounds(-by, by));
    }
    /// A length that does not matter for a state.
    [[nodiscard]] double little(std::size_t i, interval const& x) const {
        return 1e-9 * std::max(flow_->small(i), mag(x));
    }
    /// Both hold; an empty meet would be a fault elsewhere and must not prove anything.
    static interval meet(interval const& a, interval const& b) {
        auto const both = traits::intersect(a, b);
        return traits::is_empty(both) ? traits::hull(a, b) : both;
    }
    /// The inputs over [begin, end], of pieces that begin at or before `from`.
    [[nodiscard]] input_pieces<interval> inputs_over(double from, double begin, double end) const {
        return widened(input_pieces<interval>(*flow_, from, traits::bounds(begin, end)), *flow_,
                       largest_input_errors(*flow_, from, begin, end));
    }

    /// A box that holds all motions from `at_start` over [from, to], piece by piece.
    [[nodiscard]] std::optional<box> sweep(double from, double to, box const& at_start,
                                           box const& at_end, int pieces) {
        auto const n = flow_->states();
        std::optional<box> all;
        auto x = at_start;
        double begin = from;
        for (int k = 1; k <= pieces; ++k) {
            double const end = k == pieces ? to : from + (to - from) * k / pieces;
            if (!(end > begin)) continue;
            auto const times = traits::bounds(begin, end);
            auto const inputs = inputs_over(from, begin, end);
            interval const length = traits::sub(traits::point(end), traits::point(begin));
            interval const since = traits::bounds(0.0, length.upper());
            auto b = pieces == 1 ? hull(x, at_end) : x;
            for (std::size_t i = 0; i < n; ++i)
                b[i] = wider(b[i], 0.1 * width(b[i]) + little(i, b[i]));
            bool proved = false;
            for (int round = 0; round < 12 && !proved; ++round) {
                if (!rates(times, b, inputs)) return std::nullopt;
                proved = true;
                auto image = b;
                for (std::size_t i = 0; i < n; ++i) {
                    image[i] = traits::add(x[i], traits::mul(since, rate_.output(i, 0)));
                    if (!std::isfinite(mag(image[i]))) return std::nullopt;
                    bool const inside =
                        b[i].lower() < image[i].lower() && image[i].upper() < b[i].upper();
                    proved = proved && inside;
                }
                if (proved) {
                    b = image;
                } else {
                    auto const more = hull(b, image);
                    for (std::size_t i = 0; i < n; ++i)
                        b[i] = wider(more[i], 0.2 * width(image[i]) + little(i, image[i]));
                }
            }
            if (!proved || (k < pieces && !rates(times, b, inputs))) return std::nullopt;
            if (k < pieces) {
                for (std::size_t i = 0; i < n; ++i)
                    x[i] = traits::intersect(
                        b[i], traits::add(x[i], traits::mul(length, rate_.output(i, 0))));
                if (is_empty(x)) return std::nullopt;
            }
            all = all ? hull(*all, b) : b;
            begin = end;
        }
        return all;
    }
    template <class Inputs>
    bool rates(interval const& times, box const& b, Inputs const& inputs) {
        rate_.evaluate(times, b, inputs);
        return !rate_.undefined();
    }
    [[nodiscard]] bool held_input_changes(double at) const {
        for (auto const i : flow_->sampled_inputs()) {
            auto const& u = flow_->input(i);
            if (u.kind() == interpolation::hold &&
                std::binary_search(u.times().begin(), u.times().end(), at))
                return true;
        }
        return false;
    }

    flow const* flow_;
    series<interval> rate_, look_;
    std::vector<bool> shows_input_;
};

} // namespace sivid

#endif
