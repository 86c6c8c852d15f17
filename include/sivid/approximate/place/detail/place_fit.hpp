// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_PLACE_FIT_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_PLACE_FIT_HPP

#include <sivid/approximate/fit/detail/descent.hpp>
#include <sivid/approximate/fit/detail/minimax.hpp>
#include <sivid/approximate/fit/detail/suspect_samples.hpp>
#include <sivid/approximate/place/detail/missing_rate.hpp>
#include <sivid/approximate/place/detail/sensor_model.hpp>
#include <sivid/model/sampling.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// Variables by name instead of by column, so that one set of places can start from another's fit.
struct place_state {
    std::vector<double> parameters; ///< the model's and the sensors'
    std::vector<std::vector<double>> starts;
    /// [experiment][state, or state count + input][knot]; empty for what holds
    std::vector<std::vector<std::vector<double>>> missing;
};

/// What a set of places explains when it may be wrong.
struct place_fit {
    std::vector<std::size_t> set; ///< indices of places, increasing
    double cost = 0;
    double inflation = std::numeric_limits<double>::infinity();
    double squares = std::numeric_limits<double>::infinity(); ///< sum of squared residuals
    double freedom = 0;                                       ///< effective number of variables
    double score = std::numeric_limits<double>::infinity();   ///< 3 squares + freedom ln n
    place_state state;                                        ///< of the least squares
    /// Standard deviation of each missing rate, as `state.missing`.
    std::vector<std::vector<std::vector<double>>> deviation;
};

/// Fits a problem with some places allowed to be wrong: equations get a piecewise linear missing
/// rate, sensors scale, latency and offset.
class place_fitter {
public:
    place_fitter(identification_problem const& problem, std::vector<place> places)
        : places_(std::move(places)),
          extended_(with_sensor_faults(problem, places_, longest_delay(problem))),
          campaign_(extended_.problem, knots_of(problem)) {
        kept_ = without_suspects(campaign_);
        for (auto const& e : kept_) {
            for (double const w : e) samples_ += w;
        }
    }

    [[nodiscard]] std::vector<place> const& places() const { return places_; }
    [[nodiscard]] sensor_problem const& extended() const { return extended_; }
    [[nodiscard]] approximate_campaign& simulations() { return campaign_; }
    [[nodiscard]] residual_lists const& kept() const { return kept_; }
    void set_scales(std::vector<missing_rate_scale> scales) { scales_ = std::move(scales); }
    [[nodiscard]] std::vector<missing_rate_scale> const& scales() const { return scales_; }

    /// The problem's own parameters and starts, nothing missing.
    [[nodiscard]] place_state plain(std::vector<double> const& parameters,
                                    std::vector<std::vector<double>> const& starts) const {
        place_state state{parameters, starts, {}};
        state.parameters.resize(extended_.problem.prior.size(), 0.0);
        return state;
    }

    [[nodiscard]] place_fit operator()(std::vector<std::size_t> set, place_state const& from) {
        place_fit result;
        result.set = std::move(set);
        result.state = from; // where no simulation succeeds
        release(result.set);
        for (auto const p : result.set) result.cost += places_[p].cost;
        descent down(campaign_, prior());
        descent_point here;
        if (!down.evaluate(vector_of(from), here)) return result;
        down.run(here, 2, kept_, {7, 1e-2});
        if (squares(here.residuals) < 10 * samples_) down.run(here, 2, kept_, {8, 2e-3});
        auto best = here;
        result.squares = squares(here.residuals);
        // Where all residuals are within 1 the squares are within their number.
        bool const possible = result.squares < 1.25 * samples_ + 20;
        if (possible && here.inflation > 0.97) {
            auto polished = here;
            for (double const power : {4.0, 8.0, 16.0, 32.0}) {
                if (best.inflation < 0.97) break;
                down.run(polished, power, {}, {3, 1e-2}, &best);
            }
            if (best.inflation > 1 && best.inflation < 1.2) {
                auto polish = best;
                minimax(campaign_).run(polish, units(), {.rounds = 8, .reached = 0.999});
                if (polish.inflation < best.inflation) best = std::move(polish);
            }
        }
        result.inflation = best.inflation;
        result.state = state_of(here.at);
        if (down.assemble_plain(here, kept_)) measure(down, result);
        result.score = 3 * result.squares + result.freedom * std::log(std::max(samples_, 2.0));
        return result;
    }

    /// Covariances of the missing rates of a fit, per experiment: [knot * targets + target].
    [[nodiscard]] std::vector<Eigen::MatrixXd> covariances(place_fit const& fit) {
        std::vector<Eigen::MatrixXd> result;
        release(fit.set);
        descent down(campaign_, prior());
        descent_point here;
        arrow_vector step;
        auto const none = arrow_vector::like(campaign_.lower(), 0);
        if (!down.evaluate(vector_of(fit.state), here) || !down.assemble_plain(here, kept_) ||
            !down.system().solve(1e-9, none, step)) {
            return result;
        }
        for (std::size_t e = 0; e < campaign_.experiments(); ++e) {
            Eigen::MatrixXd const all = down.system().local_inverse(e);
            auto const n = all.rows() - static_cast<Eigen::Index>(campaign_.free_starts(e));
            result.emplace_back(all.bottomRightCorner(n, n));
        }
        return result;
    }

    /// Chooses the variables of a set of places.
    void release(std::vector<std::size_t> const& set) {
        std::vector<bool> free(extended_.problem.prior.size(), false);
        for (std::size_t j = 0; j < extended_.original; ++j) free[j] = true;
        targets_.clear();
        for (auto const p : set) {
            for (auto const j : extended_.faults[p]) free[j] = true;
            auto const inputs = extended_.problem.model.rate.size();
            auto const first = places_[p].members.front();
            if (!places_[p].is_sensor()) {
                targets_.push_back(places_[p].kind == place_kind::input ? inputs + first : first);
            }
        }
        auto held = mid(extended_.problem.prior);
        for (std::size_t j = extended_.original; j < held.size(); ++j) held[j] = 0;
        campaign_.hold(std::move(held));
        campaign_.release(targets_, free);
    }
    /// What has a missing rate (or input): states, and state count + inputs.
    [[nodiscard]] std::vector<std::size_t> const& targets() const { return targets_; }
    [[nodiscard]] regularisation prior() const {
        regularisation smooth;
        std::vector<missing_rate_scale> own;
        for (auto const i : targets_) own.push_back(scales_[i]);
        for (std::size_t e = 0; e < campaign_.experiments(); ++e) {
            smooth.push_back(missing_rate_prior(campaign_.knots(e), own, campaign_.free_starts(e)));
        }
        return smooth;
    }

    [[nodiscard]] arrow_vector vector_of(place_state const& s) const {
        auto z = campaign_.variables(s.parameters, s.starts);
        for (std::size_t e = 0; e < campaign_.experiments(); ++e) {
            auto at = static_cast<Eigen::Index>(campaign_.free_starts(e));
            for (std::size_t k = 0; k < campaign_.knots(e).size(); ++k) {
                for (auto const i : targets_) {
                    bool const known = !s.missing.empty() && !s.missing[e][i].empty();
                    z.local[e][at++] = known ? s.missing[e][i][k] : 0;
                }
            }
        }
        return z;
    }
    [[nodiscard]] place_state state_of(arrow_vector const& z) const {
        place_state s;
        s.parameters = campaign_.parameters(z);
        auto const n = target_count();
        for (std::size_t e = 0; e < campaign_.experiments(); ++e) {
            s.starts.push_back(campaign_.start(e, z));
            auto const d = campaign_.disturbance(e, z);
            s.missing.push_back(by_target(d, campaign_.knots(e).size(), n));
        }
        return s;
    }

    /// States and inputs.
    [[nodiscard]] std::size_t target_count() const {
        return extended_.problem.model.rate.size() + extended_.problem.model.about.inputs.size();
    }

private:
    /// Six gaps between samples, or a sixteenth of a long record: a sensor that is later than that
    /// is better found by an effect of the catalogue. A quarter of a short one.
    [[nodiscard]] static double longest_delay(identification_problem const& problem) {
        auto const seen = sampling_of(problem.experiments);
        return std::min(seen.span(6, 1.0 / 16), 0.25 * seen.record);
    }
    [[nodiscard]] static std::vector<std::vector<double>>
    knots_of(identification_problem const& problem) {
        std::vector<std::vector<double>> knots;
        for (auto const& e : problem.experiments) knots.push_back(missing_rate_knots(e));
        return knots;
    }
    [[nodiscard]] std::vector<std::vector<double>>
    by_target(std::vector<double> const& d, std::size_t knots, std::size_t states) const {
        std::vector<std::vector<double>> result(states);
        auto const count = targets_.size();
        for (std::size_t c = 0; c < count; ++c) {
            for (std::size_t k = 0; k < knots; ++k) result[targets_[c]].push_back(d[k * count + c]);
        }
        return result;
    }
    [[nodiscard]] double squares(residual_lists const& r) const {
        double sum = 0;
        for (std::size_t e = 0; e < r.size(); ++e) {
            for (std::size_t k = 0; k < r[e].size(); ++k) sum += kept_[e][k] * r[e][k] * r[e][k];
        }
        return sum;
    }
    /// Ranges of the variables; of missing rates, their scale.
    [[nodiscard]] arrow_vector units() const {
        auto unit = campaign_.upper();
        unit.for_each([](double& u, double lo) { u = std::isfinite(lo) ? u - lo : 0; },
                      campaign_.lower());
        for (std::size_t e = 0; e < campaign_.experiments(); ++e) {
            auto at = static_cast<Eigen::Index>(campaign_.free_starts(e));
            for (std::size_t k = 0; k < campaign_.knots(e).size(); ++k) {
                for (auto const i : targets_) unit.local[e][at++] = scales_[i].size;
            }
        }
        return unit;
    }
    /// Effective number of variables, n - tr(H^-1 R), and deviations of the missing rates.
    void measure(descent& down, place_fit& result) const {
        auto& system = down.system();
        arrow_vector step;
        auto const none = arrow_vector::like(campaign_.lower(), 0);
        if (!system.solve(1e-9, none, step)) return;
        auto const smooth = prior();
        result.freedom = static_cast<double>(campaign_.free_parameters().size());
        auto const n = target_count();
        for (std::size_t e = 0; e < campaign_.experiments(); ++e) {
            Eigen::MatrixXd const inverse = system.local_inverse(e);
            Eigen::MatrixXd const r = smooth[e].selfadjointView<Eigen::Lower>();
            result.freedom += static_cast<double>(inverse.rows()) - inverse.cwiseProduct(r).sum();
            std::vector<double> own;
            for (auto k = static_cast<Eigen::Index>(campaign_.free_starts(e)); k < inverse.rows();
                 ++k) {
                own.push_back(std::sqrt(std::max(inverse(k, k), 0.0)));
            }
            result.deviation.push_back(by_target(own, campaign_.knots(e).size(), n));
        }
    }

    std::vector<place> places_;
    sensor_problem extended_;
    approximate_campaign campaign_;
    residual_lists kept_;
    double samples_ = 0;
    std::vector<missing_rate_scale> scales_;
    std::vector<std::size_t> targets_;
};

} // namespace sivid

#endif
