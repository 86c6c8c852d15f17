// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DATA_TEST_HPP
#define SIVID_PAVING_DATA_TEST_HPP

#include <sivid/paving/experiment_run.hpp>
#include <sivid/paving/local_response.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/paving/set_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// How boxes of parameters are tested against the data.
struct data_test_options {
    run_options run;
    /// How a guessed point is verified: first-order sets with fine steps, which kinks do not stop.
    run_options witness{.enclosure = {.order = 14,
                                      .tolerance = 1e-11,
                                      .relative_tolerance = 1e-3,
                                      .minimum_step = 1e-6},
                        .set = carried_set::doubleton};
    /// Contract boxes by the dependence of the outputs on the parameters, and decide parts of a box
    /// by what was computed for the whole. Without it the test is the report's: enclosure against
    /// measurement, one integration a box.
    bool contract = true;
    /// A part of a box is integrated anew when more than this share of an undecided output's width
    /// is neither affine in the parameters nor shrinks with the part.
    double sharp_enough = 0.5;
};

/// Tests boxes of parameters against all experiments of a problem.
///   outside: in some experiment more than `outliers` measurements certainly fail, whatever the
///   start; inside: in every experiment at least n - `outliers` certainly hold, for the starts
///   given to `set_starts` (any start in the box proves existence).
/// The outlier rule is the consistent reading of the report's Algorithm 2.
class data_test {
public:
    /// Responses of the experiments over a region: for all starts, and for the chosen ones.
    struct knowledge {
        box region;
        std::vector<std::shared_ptr<response const>> all_starts;
        std::vector<std::shared_ptr<response const>> chosen_starts;
    };

    data_test(identification_problem const& problem, data_test_options const& options)
        : problem_(&problem), options_(options) {
        problem.require_valid();
        records_.reserve(problem.experiments.size()); // the runs keep references
        for (auto const& e : problem.experiments) {
            flows_.push_back(std::make_shared<flow const>(problem.model, problem.choice, e.inputs));
            records_.push_back(sorted(e.measurements));
            starts_.push_back(e.initial);
            runs_.push_back(
                make_run(*flows_.back(), e, records_.back(), problem.prior, options.run));
        }
    }

    /// Initial states, one box per experiment within its own, from which existence is proved.
    void set_starts(std::vector<box> starts) { starts_ = std::move(starts); }

    [[nodiscard]] std::size_t integrations() const { return integrations_; }
    [[nodiscard]] std::shared_ptr<flow const> flow_of(std::size_t e) const { return flows_[e]; }
    /// The measurements of an experiment in the order of their times.
    [[nodiscard]] record const& record_of(std::size_t e) const { return records_[e]; }

    [[nodiscard]] assessment<knowledge> operator()(box const& parameters,
                                                   std::shared_ptr<knowledge const> const& known) {
        assessment<knowledge> result{.rest = parameters};
        if (known && options_.contract && subset(parameters, known->region)) {
            double const share = judge(*known, result);
            if (result.verdict != box_verdict::undecided || share <= options_.sharp_enough) {
                result.knowledge = known;
                return result;
            }
        }
        auto found = std::make_shared<knowledge>();
        found->region = parameters;
        result.smear.assign(parameters.size(), 0.0);
        for (std::size_t e = 0; e < flows_.size(); ++e) {
            auto const& all = problem_->experiments[e].initial;
            // What earlier experiments cut off need not be integrated, if it is worth the narrower
            // use.
            if (relative_volume(result.rest, found->region).upper() < 0.5) {
                found->region = result.rest;
            }
            auto answer = run(e, all, found->region);
            auto part = result.rest;
            auto const says = assess(*answer, part);
            if (says.refuted) {
                result.verdict = box_verdict::outside;
                return result;
            }
            if (options_.contract) result.rest = std::move(part);
            add_smear(result, says.smear);
            if (!is_point(all) && starts_differ(e)) {
                // Not worth a run where the parameters alone spread the outputs too far.
                bool const hopeless = says.explained || !says.may_hold;
                found->chosen_starts.push_back(hopeless ? answer
                                                        : run(e, starts_[e], found->region));
            } else {
                found->chosen_starts.push_back(answer);
            }
            found->all_starts.push_back(std::move(answer));
        }
        // `rest` may have shrunk since an experiment was judged.
        auto smear = std::move(result.smear);
        judge(*found, result);
        result.smear = std::move(smear);
        result.knowledge = std::move(found);
        return result;
    }

    /// One experiment at a point, by the options for witnesses.
    [[nodiscard]] std::shared_ptr<response const> run_point(std::size_t e,
                                                            std::vector<double> const& initial,
                                                            std::vector<double> const& parameters) {
        ++integrations_;
        auto const& experiment = problem_->experiments[e];
        auto const point =
            make_run(*flows_[e], experiment, records_[e], problem_->prior, options_.witness);
        return (*point)(point_box(initial), point_box(parameters));
    }
    /// One experiment over a box of starts and parameters.
    [[nodiscard]] std::shared_ptr<response const> run(std::size_t e, box const& initial,
                                                      box const& parameters) {
        ++integrations_;
        return (*runs_[e])(initial, parameters);
    }

private:
    static bool is_point(box const& x) {
        return std::all_of(x.begin(), x.end(), [](interval const& side) {
            return interval_traits<interval>::is_point(side);
        });
    }
    [[nodiscard]] bool starts_differ(std::size_t e) const {
        return !subset(problem_->experiments[e].initial, starts_[e]);
    }
    static void add_smear(assessment<knowledge>& a, std::vector<double> const& more) {
        for (std::size_t j = 0; j < a.smear.size(); ++j) a.smear[j] += more[j];
    }

    /// Contracts and decides by responses alone. @returns the largest non-affine share.
    double judge(knowledge const& known, assessment<knowledge>& a) const {
        bool inside = true;
        double share = 0;
        a.smear.assign(a.rest.size(), 0.0);
        for (std::size_t e = 0; e < known.all_starts.size(); ++e) {
            auto part = a.rest;
            auto const says = assess(*known.all_starts[e], part);
            if (says.refuted) {
                a.verdict = box_verdict::outside;
                return 0;
            }
            bool holds = says.explained;
            if (!holds && known.chosen_starts[e] != known.all_starts[e]) {
                auto copy = a.rest;
                holds = assess(*known.chosen_starts[e], copy).explained;
            }
            inside = inside && holds;
            if (!holds) {
                share = std::max(share, says.sharpness);
                if (known.all_starts[e]->outputs() < known.all_starts[e]->measurements) {
                    share = std::numeric_limits<double>::infinity();
                }
            }
            if (options_.contract) a.rest = std::move(part);
            add_smear(a, says.smear);
        }
        a.verdict = inside ? box_verdict::inside : box_verdict::undecided;
        return share;
    }

    identification_problem const* problem_;
    data_test_options options_;
    std::vector<std::shared_ptr<flow const>> flows_;
    std::vector<record> records_;
    std::vector<box> starts_;
    std::vector<std::unique_ptr<experiment_run>> runs_;
    std::size_t integrations_ = 0;
};

} // namespace sivid

#endif
