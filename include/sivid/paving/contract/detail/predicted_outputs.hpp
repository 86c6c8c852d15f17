// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_PREDICTED_OUTPUTS_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_PREDICTED_OUTPUTS_HPP

#include <sivid/paving/contract/detail/cut_program.hpp>
#include <sivid/paving/contract/detail/misfit_block.hpp>
#include <sivid/paving/contract/detail/start_follower.hpp>
#include <sivid/paving/contract/detail/start_rule.hpp>
#include <sivid/paving/contract/detail/weighted_certificate.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/response/misfit.hpp>
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
/// @param others    uncertain starts of theirs follow the parameters (`start_follower`)
/// @param part      inside the boxes that the responses were computed for (trusted)
/// @guarantee  `ranges` contains the outputs of all such parameters, each from some start; for any
///             weights
/// @cost  a linear program and a certificate for each end of an output that is looked at and that
///        the parameters move
class output_prediction {
    using traits = interval_traits<interval>;

public:
    /// @param known  of each experiment with known starts: ranges that hold already (trusted).
    ///               Only the outputs of the largest misfits are then tightened; empty: all
    output_prediction(response_list const& measured, response_list const& others, box const& part,
                      std::vector<std::vector<interval>> const& known)
        : measured_(&measured),
          others_(&others),
          part_(&part),
          given_(&known),
          known_(measured, part),
          own_(others, part) {
        for (std::size_t s = 0; s < measured.size(); ++s) {
            auto const& r = *measured[s];
            auto const local = expand(r, part);
            auto misfits = misfits_of(r, local, known_.places[s], 1,
                                      [&r](std::size_t) { return r.allowed == 0; });
            scales_.push_back(std::move(misfits.scale));
            blocks_.push_back(std::move(misfits.functions));
        }
    }

    [[nodiscard]] predicted_outputs operator()() const {
        predicted_outputs result;
        cut_program program(known_.count, blocks_);
        for (std::size_t s = 0; s < others_->size() && !result.none; ++s) {
            auto const& r = *(*others_)[s];
            start_follower follower(r, *part_);
            bool const all = s >= given_->size() || (*given_)[s].size() < r.outputs();
            auto found = follower.has_starts()
                             ? from_good_rule(program, r, follower, all, result.none)
                             : tightened(program, r, from_known_start(s), all, result.none);
            result.ranges.push_back(std::move(found.ranges));
            result.about.push_back(std::move(found.about));
        }
        return result;
    }

private:
    /// An output, as linear programs and their certificates see it.
    struct goal {
        double value = 0;
        std::vector<double> slope; ///< by the known unknowns
        /// The output itself, where its start is known.
        std::vector<combined_polynomial::place> const* places = nullptr;
        /// Else it is linear in these, but for `rest`.
        std::vector<std::pair<std::size_t, interval>> linear{};
        interval rest{0.0};
    };
    struct outputs {
        std::vector<goal> goals;
        std::vector<interval> ranges;
    };
    /// Outputs of one experiment over all parameters that meet the measurements.
    struct prediction {
        std::vector<interval> ranges;
        std::vector<double> about;
        double most = 0; ///< misfit
        /// Parameters where an output goes farthest, and about how far.
        std::vector<std::pair<double, std::vector<double>>> ends{};
    };
    [[nodiscard]] goal empty_goal(double value) const {
        return {value, std::vector<double>(known_.count, 0.0)};
    }

    /// As polynomials in the parameters.
    [[nodiscard]] outputs from_known_start(std::size_t s) const {
        auto const& r = *(*others_)[s];
        auto const local = expand(r, *part_);
        outputs result{{}, output_ranges(r, local)};
        if (s < given_->size()) {
            for (std::size_t y = 0; y < std::min(r.outputs(), (*given_)[s].size()); ++y)
                result.ranges[y] = intersect(result.ranges[y], (*given_)[s][y]);
        }
        for (std::size_t y = 0; y < r.outputs(); ++y) {
            auto g = empty_goal(local.value[y]);
            auto const& places = own_.places[s];
            for (std::size_t v = 0; v < places.size(); ++v)
                g.slope[places[v].unknown] += local.slope[v * r.outputs() + y];
            g.places = &places;
            result.goals.push_back(std::move(g));
        }
        return result;
    }
    /// Outputs tightened at their ends, those of the largest misfits first.
    /// @param all     else those whose misfit may be the largest
    /// @param enough  a larger misfit ends it: nobody asks for more
    [[nodiscard]] prediction tightened(cut_program& program, response const& r, outputs of,
                                       bool all, bool& none,
                                       double enough = detail::infinity) const {
        prediction result{std::move(of.ranges), std::vector(r.outputs(), 0.0)};
        struct end {
            double misfit; ///< at most
            std::size_t output;
            double sign;
        };
        std::vector<end> ends;
        auto const misfit_at = [&r](std::size_t y, double sign, double output) {
            double const off = sign * (output - mid(r.bounds[y])) / rad(r.bounds[y]);
            return std::isnan(off) ? 0 : off; // on an exact measurement
        };
        for (std::size_t y = 0; y < r.outputs(); ++y) {
            auto const& range = result.ranges[y];
            for (double const sign : {1.0, -1.0})
                ends.push_back(
                    {misfit_at(y, sign, sign > 0 ? range.upper() : range.lower()), y, sign});
        }
        std::stable_sort(ends.begin(), ends.end(),
                         [](auto const& a, auto const& b) { return a.misfit > b.misfit; });
        bool const some = !all && r.allowed == 0;
        double farthest = 0;
        for (auto const& e : ends) {
            if (none || (some && e.misfit <= farthest)) break;
            auto& range = result.ranges[e.output];
            auto found = tighten(program, r, e.output, of.goals[e.output], e.sign, range, none);
            double const about = misfit_at(e.output, e.sign, found.about);
            result.about[e.output] = std::max(result.about[e.output], about);
            farthest = std::max(farthest, about);
            if (!found.at.empty()) result.ends.emplace_back(about, std::move(found.at));
            double const left =
                misfit_at(e.output, e.sign, e.sign > 0 ? range.upper() : range.lower());
            if (left > enough) break;
        }
        for (std::size_t y = 0; y < r.outputs(); ++y)
            result.most = std::max(result.most, upper(misfit(result.ranges[y], r.bounds[y])));
        return result;
    }
    /// From starts that follow the parameters by the best of a few rules, each of which is about
    /// best where the ones before it did worst.
    [[nodiscard]] prediction from_good_rule(cut_program& program, response const& r,
                                            start_follower& follower, bool all, bool& none) const {
        prediction found;
        std::vector<std::vector<double>> worst;
        auto rule = start_rule_search().propose(follower.forms());
        for (int round = 0;; ++round) {
            auto next = tightened(program, r, from_rule(r, follower, rule), all, none,
                                  round == 0 ? detail::infinity : found.most);
            add_worst(next, follower.parameters(), worst);
            bool const further = round == 0 || next.most < 0.98 * found.most;
            if (round == 0 || next.most < found.most) found = std::move(next);
            if (none || !further || worst.empty() || round == better_rules) return found;
            rule = start_rule_search().best_at(follower.forms(), worst);
        }
    }
    /// Adds the parameters at which outputs go farthest, as far as they differ.
    static void add_worst(prediction& of, std::vector<std::size_t> const& parameters,
                          std::vector<std::vector<double>>& to) {
        std::sort(of.ends.begin(), of.ends.end(),
                  [](auto const& a, auto const& b) { return a.first > b.first; });
        std::size_t added = 0;
        for (auto const& [about, all] : of.ends) {
            std::vector<double> own;
            for (auto const j : parameters) own.push_back(all[j]);
            if (std::find(to.begin(), to.end(), own) != to.end()) continue;
            to.push_back(std::move(own));
            if (++added == points_each) return;
        }
    }

    /// As affine functions of the parameters, from a start that follows these.
    [[nodiscard]] outputs from_rule(response const& r, start_follower& follower,
                                    start_rule const& rule) const {
        outputs result;
        auto const affine = follower(rule);
        for (std::size_t y = 0; y < r.outputs(); ++y) {
            auto g = empty_goal(affine ? affine->value[y] : mid(r.bounds[y]));
            auto range =
                affine ? traits::bounds(-affine->rest[y], affine->rest[y]) : traits::entire();
            g.rest = traits::add(traits::point(g.value), range);
            for (std::size_t j = 0; affine && j < follower.parameters().size(); ++j) {
                auto const& slope = affine->slope[j * r.outputs() + y];
                auto const unknown = follower.parameters()[j];
                g.slope[unknown] = mid(slope);
                g.linear.emplace_back(unknown, slope);
                range = traits::add(range, traits::mul(slope, traits::bounds(-1.0, 1.0)));
            }
            result.goals.push_back(std::move(g));
            result.ranges.push_back(traits::add(traits::point(result.goals.back().value), range));
        }
        return result;
    }

    /// About what an output can reach, and where; no parameters: not looked for.
    struct output_end {
        double about;
        std::vector<double> at{};
    };
    /// Cuts an output's range off at one end.
    [[nodiscard]] output_end tighten(cut_program& program, response const& r, std::size_t y,
                                     goal const& of, double sign, interval& range,
                                     bool& none) const {
        std::vector<double> along(of.slope);
        double spread = 0;
        for (auto& slope : along) {
            spread += std::abs(slope);
            slope *= sign;
        }
        double const end = sign > 0 ? range.upper() : range.lower();
        if (!std::isfinite(end) || !(spread > worth_a_program * rad(r.bounds[y]))) return {end};
        auto const cut = program(along);
        if (cut.weights.empty()) return {end};
        std::vector<measurement_weight> weights;
        for (auto const& w : cut.weights)
            weights.push_back({w.block, w.function, w.value * scales_[w.block][w.function]});
        if (cut.empty) {
            none = certified_empty(*measured_, known_, weights);
            return {end};
        }
        combined_polynomial start(known_.count);
        if (of.places != nullptr) start.add(r, {{y, -sign}}, *of.places);
        for (auto const& [unknown, slope] : of.linear)
            start.add_linear(unknown, traits::mul(traits::point(-sign), slope));
        double const most = measured_sum(*measured_, known_, weights, std::move(start)).reach();
        if (most < detail::infinity) {
            auto const below = traits::bounds(-detail::infinity, most);
            range = traits::intersect(range,
                                      traits::add(sign > 0 ? below : traits::neg(below), of.rest));
            none = none || is_empty(range); // its own range was proved, too
        }
        double about = of.value;
        for (std::size_t v = 0; v < cut.point.size(); ++v) about += of.slope[v] * cut.point[v];
        return {about, cut.point};
    }

    /// In error bounds: outputs that move by less are left at their ranges.
    static constexpr double worth_a_program = 0.01;
    static constexpr int better_rules = 3; ///< for starts, after the first one
    static constexpr std::size_t points_each = 8;

    response_list const* measured_;
    response_list const* others_;
    box const* part_;
    std::vector<std::vector<interval>> const* given_;
    shared_unknowns known_, own_;
    std::vector<minimax_block> blocks_; ///< in units of e
    std::vector<std::vector<double>> scales_;
};

} // namespace sivid

#endif
