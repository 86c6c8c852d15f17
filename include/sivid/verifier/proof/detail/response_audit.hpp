// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_RESPONSE_AUDIT_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_RESPONSE_AUDIT_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run/plain_run.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace sivid {

/// Encloses the outputs that a response states for a start and parameters.
/// @given  points of the boxes that it is of
[[nodiscard]] inline std::vector<interval>
outputs_at(response const& r, std::vector<double> const& start, std::vector<double> const& p) {
    using traits = interval_traits<interval>;
    std::vector<interval> q(r.table->variables, interval(0.0));
    bool undefined = false;
    auto const place = [&](auto const& sides, std::vector<double> const& x) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            auto const& s = sides[i];
            if (s.radius == 0) continue;
            q[s.variable] = traits::div(traits::sub(traits::point(x[i]), traits::point(s.centre)),
                                        traits::point(s.radius), undefined);
        }
    };
    place(r.unknowns.initial, start);
    place(r.unknowns.parameters, p);
    std::vector<interval> y;
    for (double const radius : r.radius) y.push_back(traits::bounds(-radius, radius));
    for (std::size_t m = 0; m < r.table->size(); ++m) {
        auto term = traits::point(1.0);
        for (std::size_t v = 0; v < q.size(); ++v) {
            for (unsigned k = 0; k < r.table->exponents[m][v]; ++k) term = traits::mul(term, q[v]);
        }
        for (std::size_t k = 0; k < y.size(); ++k) {
            double const c = r.coefficients[m * r.outputs() + k];
            y[k] = traits::add(y[k], traits::mul(traits::point(c), term));
        }
    }
    return y;
}

/// Holds responses against another integrator: at a point of their boxes the outputs by sets of
/// first order, in the arithmetic of I, must meet what the response states for the point. Of two
/// enclosures of one number that share none, one is wrong.
///   It proves nothing; it makes a defect show that all Taylor models have in common.
/// @cost  one run of a point each time
template <class I>
class response_audit {
public:
    response_audit(identification_problem const& problem, enclosure_options const& options)
        : problem_(&problem), options_(options), runs_(problem.experiments.size()) {}

    /// @returns false for a contradiction
    [[nodiscard]] bool operator()(response const& r, std::size_t e, box const& region) {
        auto const& own = problem_->experiments[e];
        if (!runs_[e]) {
            runs_[e] =
                std::make_unique<plain_run<I>>(problem_->model, problem_->choice, own, options_);
        }
        auto const start = drawn(own.initial), p = drawn(region);
        auto const seen = (*runs_[e])(point_box(start), point_box(p)).outputs;
        auto const stated = outputs_at(r, start, p);
        for (std::size_t k = 0; k < std::min(seen.size(), stated.size()); ++k) {
            auto const& value = seen[k].value;
            if (!seen[k].defined) continue;
            if (interval_traits<I>::lower(value) > stated[k].upper() ||
                interval_traits<I>::upper(value) < stated[k].lower()) {
                return false;
            }
        }
        return true;
    }

private:
    /// A point of a box: each coordinate an end or anywhere between.
    [[nodiscard]] std::vector<double> drawn(box const& x) {
        std::vector<double> point;
        for (auto const& side : x) {
            double const share = std::uniform_real_distribution<double>(-0.5, 1.5)(random_);
            double const at =
                side.lower() + std::clamp(share, 0.0, 1.0) * (side.upper() - side.lower());
            point.push_back(std::clamp(at, side.lower(), side.upper()));
        }
        return point;
    }

    identification_problem const* problem_;
    enclosure_options options_;
    std::vector<std::unique_ptr<plain_run<I>>> runs_;
    std::mt19937_64 random_{1};
};

} // namespace sivid

#endif
