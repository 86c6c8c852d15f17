// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_PLAIN_RUN_HPP
#define SIVID_PAVING_RUN_PLAIN_RUN_HPP

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/trajectory.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/response/misfit.hpp>
#include <sivid/space/box_lanes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// What is known of an experiment's measurements over a region, as affine functions:
///   \f$ y_k \in g_k \cdot r_0 + rest_k \f$ and \f$ y_k \in value_k \f$,
///   \f$ r_0 = (x_0, p) - centre \f$.
template <class I>
struct plain_outputs {
    std::vector<observation<I>> outputs; ///< of the measurements that the run reached, in order
    basic_box<I> deviation;              ///< \f$ r_0 \f$ over the region, states first
    std::vector<double> parameter_centre;
};

/// Runs one experiment by first-order sets in a scalar interval type: what certificates rest on.
/// It shares the model and the Taylor series with identification, but neither the packs of
/// intervals nor the Taylor models.
/// @tparam I  `mp_interval` for 40 digits; `proven_interval` or `interval` for speed
template <class I>
class plain_run {
    using traits = interval_traits<I>;

public:
    /// @param options  their steps are relative to what the experiment lasts (`for_span`)
    plain_run(recorded_model const& model, parameter_choice const& choice, experiment const& e,
              enclosure_options const& options)
        : flow_(std::make_unique<flow>(model, choice, e.inputs)),
          samples_(sorted(e.measurements)),
          begin_(e.begin),
          run_(std::make_unique<trajectory<I>>(*flow_, for_span(options, e.end() - e.begin))),
          look_(std::make_unique<observer<I>>(*flow_)) {}

    [[nodiscard]] record const& samples() const { return samples_; }

    /// All outputs for all starts and parameters of the boxes, up to where the enclosure ends.
    /// @guarantee  every output of every trajectory from the boxes is in the forms given
    [[nodiscard]] plain_outputs<I> operator()(box const& starts, box const& parameters) {
        return outputs_while(box_in<I>(starts), box_in<I>(parameters),
                             [](std::size_t, observation<I> const&) { return true; });
    }

    /// The same up to the first output at which `go_on` says false.
    /// @param go_on  (index of the measurement, `observation<I>`)
    template <class GoOn>
    [[nodiscard]] plain_outputs<I>
    outputs_while(basic_box<I> const& starts, basic_box<I> const& parameters, GoOn const& go_on) {
        plain_outputs<I> result;
        each(starts, parameters, [&](std::size_t k, observation<I> const& o) {
            result.outputs.push_back(o);
            return go_on(k, o);
        });
        result.deviation = run_->ensemble().deviation;
        result.parameter_centre = run_->ensemble().parameter_centre;
        return result;
    }

    /// Hands the output of one measurement after the other to `take`, in the order of time, up to
    /// where the enclosure ends or `take` says false.
    /// @param take  (index of the measurement, `observation<I>`), says whether to go on
    template <class Take>
    void each(basic_box<I> const& starts, basic_box<I> const& parameters, Take const& take) {
        run_->begin(begin_, starts, parameters);
        look_->set_ensemble(run_->ensemble());
        std::vector<observation<I>> seen;
        double seen_at = std::nan("");
        for (std::size_t k = 0; k < samples_.size(); ++k) {
            auto const& m = samples_[k];
            while (run_->time() < m.time) {
                if (!run_->step(m.time)) return;
            }
            if (seen_at != m.time) seen = (*look_)(run_->set());
            seen_at = m.time;
            if (!take(k, seen[m.channel])) return;
        }
    }

private:
    std::unique_ptr<flow> flow_;
    record samples_;
    double begin_;
    std::unique_ptr<trajectory<I>> run_;
    std::unique_ptr<observer<I>> look_;
};

/// What one experiment says of a part of a region.
enum class run_finding {
    explained, ///< at least n - q measurements hold, for all starts and parameters of the part
    refuted,   ///< more than q measurements fail, for all of them
    open
};

namespace paving_detail {

/// \f$ r_0 \f$ contracted by the open measurements, at most `spare` of which may fail. In each
/// coordinate a feasible point satisfies all but `spare` of the bounds, so it is at least the
/// (spare + 1)-th largest lower one.
/// @param columns  the coordinates of r_0 that are not 0
/// @returns  nothing where no point is left
template <class I>
[[nodiscard]] std::optional<basic_box<I>>
contracted(plain_outputs<I> const& known, record const& samples,
           std::vector<std::size_t> const& open, basic_box<I> d,
           std::vector<std::size_t> const& columns, std::size_t spare) {
    using traits = interval_traits<I>;
    std::vector<I> terms(columns.size());
    for (int sweep = 0; sweep < 3; ++sweep) {
        std::vector<std::vector<double>> lows(columns.size()), highs(columns.size());
        for (auto const k : open) {
            auto const& o = known.outputs[k];
            auto const& bound = samples[k].bound;
            I const rest = traits::sub(o.rest, traits::bounds(bound.lower(), bound.upper()));
            for (std::size_t n = 0; n < columns.size(); ++n) {
                terms[n] = traits::mul(traits::point(o.gradient[columns[n]]), d[columns[n]]);
            }
            for (std::size_t n = 0; n < columns.size(); ++n) {
                if (o.gradient[columns[n]] == 0) continue;
                I others = rest; // rest - bound + the other terms; g_c r_c is its negative
                for (std::size_t other = 0; other < columns.size(); ++other) {
                    if (other != n) others = traits::add(others, terms[other]);
                }
                typename traits::mask undefined{};
                auto const g = traits::point(o.gradient[columns[n]]);
                auto const allowed = traits::div(traits::neg(others), g, undefined);
                if (undefined) continue;
                lows[n].push_back(traits::lower(allowed));
                highs[n].push_back(-traits::upper(allowed));
            }
        }
        bool shrank = false;
        for (std::size_t n = 0; n < columns.size(); ++n) {
            double const low = largest_after(std::move(lows[n]), spare, -HUGE_VAL);
            double const high = -largest_after(std::move(highs[n]), spare, -HUGE_VAL);
            if (low > high) return std::nullopt;
            auto& own = d[columns[n]];
            I const less = traits::intersect(own, traits::bounds(low, high));
            if (traits::is_empty(less)) return std::nullopt;
            shrank = shrank || traits::width(less) < 0.9 * traits::width(own);
            own = less;
        }
        if (!shrank) break;
    }
    return d;
}

} // namespace paving_detail

/// What one experiment says of a part of a region, and the deviations that are left of the part.
template <class I>
struct run_judgement {
    run_finding finding = run_finding::open;
    basic_box<I> left; ///< \f$ r_0 \f$, states first, where the finding is open
};

/// Judges deviations, a part of the region's, by what is known of the region.
/// @param outliers  how many measurements may fail
/// @guarantee  no point beyond `left` has at most `outliers` measurements that fail
template <class I>
[[nodiscard]] run_judgement<I> judge_deviations(plain_outputs<I> const& known,
                                                record const& samples, basic_box<I> d,
                                                std::size_t outliers) {
    using traits = interval_traits<I>;
    std::vector<std::size_t> columns;
    for (std::size_t c = 0; c < d.size(); ++c) {
        if (traits::mag(d[c]) != 0) columns.push_back(c);
    }
    std::size_t hits = 0, misses = 0;
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < known.outputs.size(); ++k) {
        auto const& o = known.outputs[k];
        if (!o.defined) continue;
        I y = o.rest;
        for (auto const c : columns) {
            if (o.gradient[c] == 0) continue;
            y = traits::add(y, traits::mul(traits::point(o.gradient[c]), d[c]));
        }
        y = traits::intersect(y, o.value);
        if (traits::is_empty(y)) continue; // says nothing: never for a sound enclosure
        if (lies_in(y, samples[k].bound)) {
            ++hits;
        } else if (sivid::misses(y, samples[k].bound)) {
            ++misses;
        } else {
            open.push_back(k);
        }
    }
    if (misses > outliers) return {run_finding::refuted, {}};
    if (hits + outliers >= samples.size()) return {run_finding::explained, {}};
    auto left =
        paving_detail::contracted(known, samples, open, std::move(d), columns, outliers - misses);
    if (!left) return {run_finding::refuted, {}};
    return {run_finding::open, std::move(*left)};
}

/// Decides a part of a region by what is known of the region.
/// @param part      parameters, a subset of the region's; all starts of the region count
/// @param outliers  how many measurements may fail
template <class I>
[[nodiscard]] run_finding decide(plain_outputs<I> const& known, record const& samples,
                                 box const& part, std::size_t outliers) {
    using traits = interval_traits<I>;
    auto d = known.deviation;
    auto const states = d.size() - part.size();
    for (std::size_t j = 0; j < part.size(); ++j) {
        auto const own = traits::sub(traits::bounds(part[j].lower(), part[j].upper()),
                                     traits::point(known.parameter_centre[j]));
        d[states + j] = traits::intersect(d[states + j], own);
    }
    return judge_deviations(known, samples, std::move(d), outliers).finding;
}

} // namespace sivid

#endif
