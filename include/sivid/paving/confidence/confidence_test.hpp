// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONFIDENCE_CONFIDENCE_TEST_HPP
#define SIVID_PAVING_CONFIDENCE_CONFIDENCE_TEST_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/confidence/sign_perturbed_sums.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/dense.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Tests boxes of parameters, then of the starts that have a width, for membership in a region of
/// `sign_perturbed_sums`.
class confidence_test {
public:
    static constexpr bool concurrent = true;

    /// Responses of the experiments over a region.
    struct knowledge {
        box region;
        response_list responses;
    };
    /// An unknown: a parameter, or the start of one experiment in a state.
    struct unknown {
        std::optional<std::size_t> experiment;
        std::size_t index = 0;
    };

    /// @param problem  of whose bounds the middles matter, of outliers nothing
    confidence_test(identification_problem const& problem, feasibility_test_options const& options)
        : problem_(unbounded(problem)), options_(options), runs_(problem_, options) {
        for (auto const& e : problem.experiments) records_.push_back(sorted(e.measurements));
        std::vector<interval> sides(problem_.prior.begin(), problem_.prior.end());
        for (std::size_t j = 0; j < sides.size(); ++j) unknowns_.push_back({std::nullopt, j});
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e) {
            auto const& initial = problem_.experiments[e].initial;
            for (std::size_t i = 0; i < initial.size(); ++i) {
                if (normalised_unknowns({}, box{initial[i]}).variables == 0) continue;
                unknowns_.push_back({e, i});
                sides.push_back(initial[i]);
            }
        }
        prior_ = box(std::move(sides));
    }
    confidence_test(confidence_test const&) = delete;
    confidence_test& operator=(confidence_test const&) = delete;

    /// What boxes are tested against; before, all are undecided.
    void set_sums(sign_perturbed_sums sums) { sums_.emplace(std::move(sums)); }
    [[nodiscard]] std::vector<unknown> const& unknowns() const { return unknowns_; }
    [[nodiscard]] box const& prior() const { return prior_; }
    [[nodiscard]] identification_problem const& problem() const { return problem_; }
    /// In the order of the sums: by experiment, in the order of time.
    [[nodiscard]] record const& record_of(std::size_t e) const { return records_[e]; }

    [[nodiscard]] assessment<knowledge> judge(box const& x,
                                              std::shared_ptr<knowledge const> const& known) const {
        assessment<knowledge> result{.rest = x};
        bool const sees = known && subset(x, known->region);
        result.blind = !sees || assess(*known, result) > options_.sharp_enough;
        if (!result.blind) result.knowledge = known;
        return result;
    }
    [[nodiscard]] std::vector<assessment<knowledge>> learn(std::vector<box> const& boxes) {
        std::vector<assessment<knowledge>> results(boxes.size());
        std::vector<std::shared_ptr<knowledge>> found;
        for (auto const& x : boxes) found.push_back(std::make_shared<knowledge>(knowledge{x, {}}));
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e) run(e, found);
        for (std::size_t n = 0; n < boxes.size(); ++n) {
            results[n].rest = boxes[n];
            results[n].cost = problem_.experiments.size();
            (void)assess(*found[n], results[n]);
            results[n].knowledge = std::move(found[n]);
        }
        return results;
    }
    [[nodiscard]] std::size_t at_once() const { return runs_.at_once(); }
    [[nodiscard]] bool cancelled() const { return runs_.cancelled(); }

    /// Where an unknown lies: the side of a response's box, and its place among the d of a part.
    using places = std::vector<std::optional<std::pair<normalised_unknowns::side, std::size_t>>>;
    /// The outputs over a part of a region, by experiment, and by what unknowns; nothing where one
    /// was not reached.
    [[nodiscard]] std::optional<output_forms> outputs_over(knowledge const& known, box const& part,
                                                           places& at) const;

private:
    /// With bounds that end no run: weights must not depend on them.
    static identification_problem unbounded(identification_problem problem) {
        for (auto& e : problem.experiments) {
            e.outliers = e.measurements.size();
            for (auto& m : e.measurements) m.bound = interval(-1e300, 1e300);
        }
        return problem;
    }
    /// An experiment's starts, and the parameters, in a box of unknowns.
    void run(std::size_t e, std::vector<std::shared_ptr<knowledge>> const& found) {
        std::vector<box> starts, parameters;
        bool common = true;
        for (auto const& f : found) {
            starts.push_back(problem_.experiments[e].initial);
            parameters.push_back(problem_.prior);
            for (std::size_t s = 0; s < unknowns_.size(); ++s) {
                auto const& u = unknowns_[s];
                if (!u.experiment) parameters.back()[u.index] = f->region[s];
                if (u.experiment == e) starts.back()[u.index] = f->region[s];
                common = common && u.experiment != e;
            }
        }
        auto const together = common ? runs_.run(e, starts[0], parameters) : response_list{};
        for (std::size_t n = 0; n < found.size(); ++n)
            found[n]->responses.push_back(common ? together[n]
                                                 : runs_.run(e, starts[n], parameters[n]));
    }
    /// Decides and contracts. @returns which share is blurred
    double assess(knowledge const& known, assessment<knowledge>& a) const;
    void contract(rank_verdict const& says, places const& at, assessment<knowledge>& a) const;

    identification_problem problem_;
    feasibility_test_options options_;
    std::vector<unknown> unknowns_;
    box prior_;
    std::vector<record> records_;
    std::optional<sign_perturbed_sums> sums_;
    feasibility_test runs_;
};

inline std::optional<output_forms>
confidence_test::outputs_over(knowledge const& known, box const& part, places& at) const {
    at.assign(unknowns_.size(), std::nullopt);
    output_forms all;
    Eigen::Index rows = 0, columns = 1;
    for (auto const& r : known.responses) rows += static_cast<Eigen::Index>(r->measurements);
    all.forms = Eigen::MatrixXd::Zero(rows, 1 + static_cast<Eigen::Index>(part.size()));
    all.rest.resize(rows);
    all.radius.resize(rows);
    Eigen::Index row = 0;
    for (std::size_t e = 0; e < known.responses.size(); ++e) {
        auto const& r = *known.responses[e];
        if (r.outputs() < r.measurements) return std::nullopt;
        auto const variables = r.table->variables;
        std::vector<double> middle(variables, 0.0), reach(variables, 1.0);
        std::vector<std::size_t> whose(variables, 0);
        for (std::size_t s = 0; s < part.size(); ++s) {
            auto const& [only, index] = unknowns_[s];
            if (only && *only != e) continue;
            auto const& side = only ? r.unknowns.initial[index] : r.unknowns.parameters[index];
            if (side.radius == 0) continue;
            if (!at[s]) at[s].emplace(side, static_cast<std::size_t>(columns++));
            auto const& one = at[s]->first; // one unknown, whichever the experiment
            if (one.centre != side.centre || one.radius != side.radius) return std::nullopt;
            paving_detail::normalise(side, part[s], middle[side.variable], reach[side.variable]);
            whose[side.variable] = at[s]->second;
        }
        auto const local = expand(r, std::move(middle), std::move(reach));
        for (std::size_t y = 0; y < r.outputs(); ++y, ++row) {
            all.forms(row, 0) = local.value[y];
            all.rest[row] = local.rest[y];
            all.radius[row] = r.radius[y];
            for (std::size_t v = 0; v < variables; ++v)
                all.forms(row, static_cast<Eigen::Index>(whose[v])) =
                    local.slope[v * r.outputs() + y];
        }
    }
    all.forms.conservativeResize(Eigen::NoChange, columns);
    return all;
}

inline double confidence_test::assess(knowledge const& known, assessment<knowledge>& a) const {
    places at;
    auto const outputs = outputs_over(known, a.rest, at);
    if (!outputs || !sums_) return 1;
    auto const says = (*sums_)(*outputs);
    a.verdict = says.verdict;
    if (says.verdict != box_verdict::undecided) return 0;
    contract(says, at, a);
    return a.verdict == box_verdict::outside ? 0 : says.blur;
}

inline void confidence_test::contract(rank_verdict const& says, places const& at,
                                      assessment<knowledge>& a) const {
    using traits = interval_traits<interval>;
    auto const n = says.sum.rows() - 1;
    Eigen::MatrixXd const slopes = says.sum.bottomRows(n).transpose();
    a.smear.assign(at.size(), 0.0);
    for (std::size_t s = 0; s < at.size(); ++s)
        if (at[s]) a.smear[s] = slopes.col(static_cast<Eigen::Index>(at[s]->second) - 1).norm();
    if (n == 0 || !std::isfinite(says.reach) || !says.sum.allFinite()) return;
    Eigen::VectorXd const sizes = says.sum.cwiseAbs().colwise().sum();
    double const errors = 4 * 0x1p-52 * static_cast<double>(sizes.size() + n + 8);
    std::vector<linear_constraint> constraints;
    auto const r = slopes.rows();
    Eigen::MatrixXd rows = Eigen::MatrixXd::Identity(r, r);
    if (r == n && approximate_inverse(slopes).allFinite()) {
        rows.conservativeResize(2 * r, r);
        rows.bottomRows(r) = approximate_inverse(slopes);
    }
    for (Eigen::VectorXd const u : rows.rowwise()) { // |u . S_0| <= |u| reach
        Eigen::VectorXd const gradient = slopes.transpose() * u;
        double const half = u.norm() * says.reach + u.cwiseAbs().dot(says.rest + errors * sizes);
        auto const target = traits::bounds(-half * (1 + 1e-12), half * (1 + 1e-12));
        constraints.push_back({{gradient.begin(), gradient.end()},
                               traits::sub(target, traits::point(u.dot(says.sum.row(0))))});
    }
    box d(static_cast<std::size_t>(n));
    for (std::size_t v = 0; v < d.size(); ++v) d[v] = traits::bounds(-1.0, 1.0);
    if (!sivid::contract(d, constraints)) a.verdict = box_verdict::outside;
    for (std::size_t s = 0; s < at.size() && a.verdict != box_verdict::outside; ++s) {
        if (!at[s]) continue;
        auto const& [side, place] = *at[s];
        double middle = 0, reach = 1;
        paving_detail::normalise(side, a.rest[s], middle, reach);
        auto const q =
            traits::add(traits::point(middle), traits::mul(traits::point(reach), d[place - 1]));
        auto const p =
            traits::add(traits::point(side.centre), traits::mul(traits::point(side.radius), q));
        a.rest[s] = traits::intersect(a.rest[s], p);
        if (is_empty(a.rest[s])) a.verdict = box_verdict::outside;
    }
}

} // namespace sivid

#endif
