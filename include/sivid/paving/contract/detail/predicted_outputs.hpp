// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_PREDICTED_OUTPUTS_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_PREDICTED_OUTPUTS_HPP

#include <sivid/paving/contract/detail/cut_certificate.hpp>
#include <sivid/paving/contract/detail/cut_program.hpp>
#include <sivid/paving/contract/detail/misfit_block.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// What the parameters of a box that meet some measurements say of other experiments.
struct predicted_outputs {
    std::vector<std::vector<interval>> ranges; ///< per experiment and output
    /// About the largest size of each misfit; `ranges` may say more because of nonlinear terms.
    std::vector<std::vector<double>> about;
    bool none = false; ///< no parameter of the box meets the measurements
};

/// Encloses the outputs of other experiments over all parameters of a box that meet the
/// measurements of some, all of these together: for each end of an output a linear program proposes
/// weights of measurements, and their sum proves how far the output goes,
///   \f$ y(d) \le \sum_i w_i b_i - \min_d (\sum_i w_i y_i(d) - y(d)) \f$ with the ends b_i.
/// Correlated parameters, which a box cannot describe, are so described by the data.
/// @param measured  those that are met, without outliers; ones that allow some are left out
/// @param others    at the starts that are given
/// @param part      inside the boxes that the responses were computed for (trusted)
/// @guarantee  `ranges` contains the outputs of all such parameters from these starts; for any
///             weights
/// @cost  two linear programs and certificates for each output that the parameters move
class output_prediction {
    using traits = interval_traits<interval>;

public:
    output_prediction(response_list const& measured, response_list const& others,
                      std::vector<std::vector<double>> const& starts, box const& part)
        : measured_(&measured),
          others_(&others),
          starts_(&starts),
          part_(&part),
          known_(measured, part),
          own_(others, part, fixed_starts()),
          count_(known_.count) {
        for (std::size_t s = 0; s < measured.size(); ++s) {
            auto const& r = *measured[s];
            auto const local = expand(r, part);
            auto misfits = misfits_of(r, local, known_.places[s], 1,
                                      [&r](std::size_t) { return r.allowed == 0; });
            scales_.push_back(std::move(misfits.scale));
            blocks_.push_back(std::move(misfits.functions));
        }
        // Their starts are points: unknowns without reach, behind those of the measured ones.
        for (auto& places : own_.places) {
            for (auto& p : places) {
                if (p.unknown >= part.size()) p.unknown = count_++;
            }
        }
    }

    [[nodiscard]] predicted_outputs operator()() const {
        predicted_outputs result;
        cut_program program(count_, blocks_);
        for (std::size_t s = 0; s < others_->size() && !result.none; ++s) {
            auto const& r = *(*others_)[s];
            auto const local = expand_at_start(s);
            auto ranges = output_ranges(r, local);
            std::vector<double> about(ranges.size(), 0.0);
            for (std::size_t y = 0; y < ranges.size() && !result.none; ++y) {
                for (double const sign : {1.0, -1.0}) {
                    auto const likely = tighten(program, s, y, sign, local, ranges[y], result.none);
                    auto const off = sign * (likely - mid(r.bounds[y])) / rad(r.bounds[y]);
                    about[y] = std::max(about[y], off);
                }
            }
            result.ranges.push_back(std::move(ranges));
            result.about.push_back(std::move(about));
        }
        return result;
    }

private:
    /// Where a start lies in its side, well inside.
    [[nodiscard]] double at_start(std::size_t s, std::size_t i) const {
        constexpr double within = 1 - 1e-12; // in the decimal box, not only in its enclosure
        auto const& side = (*others_)[s]->unknowns.initial[i];
        double const q = ((*starts_)[s][i] - side.centre) / side.radius;
        return std::isfinite(q) ? std::clamp(q, -within, within) : 0;
    }
    [[nodiscard]] std::vector<box> fixed_starts() const {
        std::vector<box> result;
        for (std::size_t s = 0; s < others_->size(); ++s) {
            auto const& initial = (*others_)[s]->unknowns.initial;
            box points(initial.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                double const q = initial[i].radius > 0 ? at_start(s, i) : 0;
                points[i] = interval(initial[i].centre + q * initial[i].radius);
            }
            result.push_back(std::move(points));
        }
        return result;
    }
    [[nodiscard]] local_response expand_at_start(std::size_t s) const {
        auto const& r = *(*others_)[s];
        unknowns_of_part inner(r, *part_);
        for (std::size_t i = 0; i < r.unknowns.initial.size(); ++i) {
            auto const& side = r.unknowns.initial[i];
            if (side.radius == 0) continue;
            inner.middle[side.variable] = at_start(s, i);
            inner.reach[side.variable] = 0;
        }
        return expand(r, std::move(inner.middle), std::move(inner.reach));
    }

    /// Cuts an output's range off at one end.
    /// @returns  about what it can reach
    [[nodiscard]] double tighten(cut_program& program, std::size_t s, std::size_t y, double sign,
                                 local_response const& local, interval& range, bool& none) const {
        auto const& r = *(*others_)[s];
        auto const& places = own_.places[s];
        std::vector<double> goal(count_, 0.0);
        double spread = 0;
        for (std::size_t v = 0; v < places.size(); ++v) {
            double const slope = local.slope[v * r.outputs() + y];
            if (places[v].unknown < part_->size()) goal[places[v].unknown] = sign * slope;
            spread += std::abs(slope);
        }
        double const end = sign > 0 ? range.upper() : range.lower();
        if (!std::isfinite(end) || !(spread > worth_a_program * rad(r.bounds[y]))) return end;
        auto const cut = program(goal);
        if (cut.weights.empty()) return end;
        std::vector<measurement_weight> weights;
        for (auto const& w : cut.weights)
            weights.push_back({w.block, w.function, w.value * scales_[w.block][w.function]});
        if (cut.empty) {
            none = certified_empty(*measured_, known_, weights);
            return end;
        }
        combined_polynomial start(count_);
        start.add(r, {{y, -sign}}, places);
        measured_sum const sum(*measured_, known_, weights, std::move(start));
        double const least = sum.outputs.lower_bound();
        if (std::isfinite(least)) {
            double const most = upper(traits::sub(sum.most, traits::point(least)));
            auto const below = traits::bounds(-detail::infinity, most);
            range = traits::intersect(range, sign > 0 ? below : traits::neg(below));
            none = none || is_empty(range); // its own range was proved, too
        }
        double about = local.value[y];
        for (std::size_t v = 0; v < cut.point.size(); ++v) about += sign * goal[v] * cut.point[v];
        return about;
    }

    /// In error bounds: outputs that move by less are left at their ranges.
    static constexpr double worth_a_program = 0.01;

    response_list const* measured_;
    response_list const* others_;
    std::vector<std::vector<double>> const* starts_;
    box const* part_;
    shared_unknowns known_, own_;
    std::size_t count_;
    std::vector<minimax_block> blocks_; ///< in units of e
    std::vector<std::vector<double>> scales_;
};

} // namespace sivid

#endif
