// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_OBSERVATION_HPP
#define SIVID_ENCLOSURE_OBSERVATION_HPP

#include <sivid/enclosure/set/doubleton.hpp>
#include <sivid/enclosure/uncertain_input.hpp>
#include <sivid/model/series/series.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// An output over an ensemble as an affine function of its deviations:
///   \f$ y \in gradient \cdot r_0 + rest \f$ for each \f$ r_0 \f$, and \f$ y \in value \f$ for all.
template <class I>
struct observation {
    I value;
    std::vector<double> gradient; ///< by initial state, then by parameter
    I rest;
    bool defined = true; ///< false: the output function is not defined on the whole set
};

/// Evaluates the outputs of a flow on carried sets.
template <class I>
class observer {
    using traits = arithmetic_of<I>;

public:
    explicit observer(flow const& f)
        : flow_(&f),
          at_set_(f.observe_jacobian(), 0),
          direct_(f.observe(), 0),
          at_centre_(f.observe(), 0) {}

    void set_ensemble(ensemble<I> const& e) {
        ensemble_ = &e;
        at_set_.set_parameters(e.parameters);
        direct_.set_parameters(e.parameters);
        at_centre_.set_parameters(point_box<I>(e.parameter_centre));
    }

    /// All channels at the set's time, for all inputs within their error bounds; a held input has
    /// its new value at a knot.
    /// @guarantee  mean-value form about the set's centre, intersected with the direct evaluation;
    ///             that alone where an output may jump between the set and its centre
    [[nodiscard]] std::vector<observation<I>> operator()(doubleton<I> const& set) {
        auto const n = flow_->states();
        auto const columns = n + flow_->parameters();
        I const t = traits::point(set.time);
        evaluate(at_set_, t, set.hull_and_centre(), set.time);
        // Slopes go from the centre: no output may jump on the way, and where one does, only what
        // it is on the set itself counts.
        evaluate(direct_, t, set.hull_and_centre(), set.time);
        bool const jumps = direct_.jumped();
        if (jumps) evaluate(direct_, t, set.hull, set.time);
        evaluate(at_centre_, t, point_box<I>(set.centre), set.time);
        std::vector<observation<I>> result(flow_->channels());
        std::vector<interval_matrix<I>> slopes(result.size(), interval_matrix<I>(1, columns));
        std::vector<interval_matrix<I>> axes(result.size(), interval_matrix<I>(1, n));
        for (auto const& e : flow_->observe_entries()) {
            I const d = at_set_.output(e.output, 0);
            auto& slope = slopes[e.row];
            if (e.column >= n) {
                slope(0, e.column) = traits::add(slope(0, e.column), d);
                continue;
            }
            auto const row = static_cast<Eigen::Index>(e.column);
            for (std::size_t c = 0; c < columns; ++c) {
                auto const factor = set.shape(row, static_cast<Eigen::Index>(c));
                slope(0, c) = traits::add(slope(0, c), traits::mul(d, traits::point(factor)));
            }
            for (std::size_t k = 0; k < n; ++k) {
                auto const factor = set.axes(row, static_cast<Eigen::Index>(k));
                axes[e.row](0, k) =
                    traits::add(axes[e.row](0, k), traits::mul(d, traits::point(factor)));
            }
        }
        auto const& r0 = ensemble_->deviation;
        for (std::size_t y = 0; y < result.size(); ++y) {
            auto& o = result[y];
            o.defined = !at_set_.undefined() && !at_centre_.undefined();
            o.rest = traits::add(at_centre_.output(y, 0), product(axes[y], set.remainder)[0]);
            o.gradient.resize(columns);
            I sum = o.rest;
            for (std::size_t c = 0; c < columns; ++c) {
                o.gradient[c] = traits::mid(slopes[y](0, c));
                auto const g = traits::point(o.gradient[c]);
                o.rest = traits::add(o.rest, traits::mul(traits::sub(slopes[y](0, c), g), r0[c]));
            }
            sum = o.rest;
            for (std::size_t c = 0; c < columns; ++c) {
                sum = traits::add(sum, traits::mul(traits::point(o.gradient[c]), r0[c]));
            }
            o.value = traits::intersect(sum, direct_.output(y, 0));
            if (jumps) { // no mean value across a jump of an output
                o.value = o.rest = direct_.output(y, 0);
                o.gradient.assign(columns, 0.0);
            }
        }
        return result;
    }

    /// The channels over a box of states and a range of times, directly.
    [[nodiscard]] basic_box<I> over(double start, I const& times, basic_box<I> const& states) {
        evaluate(direct_, times, states, start);
        basic_box<I> result(flow_->channels());
        for (std::size_t y = 0; y < result.size(); ++y) {
            result[y] = direct_.undefined() ? traits::entire() : direct_.output(y, 0);
        }
        return result;
    }

private:
    void evaluate(series<I>& s, I const& t, basic_box<I> const& x, double start) {
        auto const errors = largest_input_errors(*flow_, start, traits::lower(t), traits::upper(t));
        auto const inputs = widened(input_pieces<I>(*flow_, start, t), *flow_, errors);
        s.evaluate(t, x, inputs);
    }

    flow const* flow_;
    series<I> at_set_;
    series<I> direct_;
    series<I> at_centre_;
    ensemble<I> const* ensemble_ = nullptr;
};

} // namespace sivid

#endif
