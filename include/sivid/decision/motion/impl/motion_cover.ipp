// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_IMPL_MOTION_COVER_IPP
#define SIVID_DECISION_MOTION_IMPL_MOTION_COVER_IPP

#include <sivid/decision/motion/detail/motion_cover.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/response/local_response.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

/// The range of one side of a part in the unknown of its response, in [-1, 1].
inline interval normalised(normalised_unknowns::side const& s, interval const& x) {
    using traits = interval_traits<interval>;
    bool undefined = false;
    auto const q =
        traits::div(traits::sub(x, traits::point(s.centre)), traits::point(s.radius), undefined);
    auto const inside = traits::intersect(q, traits::bounds(-1.0, 1.0));
    return undefined || is_empty(inside) ? traits::bounds(-1.0, 1.0) : inside;
}

/// Whether a side is more than the rounding of a decimal.
inline bool can_be_cut(interval const& x) {
    double const at = mid(x);
    return x.lower() < at && at < x.upper() &&
           width(x) > 4 * normalised_unknowns::negligible * std::abs(at);
}

/// The unknowns q of a response over a box, q = middle + reach d for d in \f$ [-1,1]^n \f$.
struct normalised_box {
    std::vector<double> middle, reach;

    normalised_box(response const& of, box const& initial, box const& parameters)
        : middle(of.table->variables, 0.0), reach(of.table->variables, 1.0) {
        add(of.unknowns.initial, initial);
        add(of.unknowns.parameters, parameters);
    }

private:
    void add(std::vector<normalised_unknowns::side> const& sides, box const& x) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            auto const& side = sides[i];
            if (side.radius > 0)
                paving_detail::normalise(side, x[i], middle[side.variable], reach[side.variable]);
        }
    }
};

/// The box of d, as middles and radii, that holds what a set and a part have in common.
struct common_box {
    std::vector<double> at, by;

    explicit common_box(std::size_t variables) : at(variables, 0.0), by(variables, 1.0) {}
    common_box(box const& set, box const& part, response const& known, normalised_box const& d)
        : common_box(d.middle.size()) {
        for (std::size_t j = 0; j < set.size(); ++j) {
            auto const& side = known.unknowns.parameters[j];
            auto const v = side.variable;
            if (side.radius == 0 || !(d.reach[v] > 0)) continue;
            auto const both = traits::intersect(set[j], part[j]);
            if (traits::is_empty(both)) continue;
            bool undefined = false;
            auto const range = traits::intersect(
                traits::div(traits::sub(normalised(side, both), traits::point(d.middle[v])),
                            traits::point(d.reach[v]), undefined),
                traits::bounds(-1.0, 1.0));
            if (undefined || traits::is_empty(range)) continue;
            at[v] = mid(range);
            by[v] = rad(range);
        }
    }

private:
    using traits = interval_traits<interval>;
};

/// Widens the bounds of a view by the affine parts over a box of d, and the rests.
inline void widen(motion_cover::view& v, std::vector<double> const& value, common_box const& d) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    auto const count = v.low.size(), variables = d.at.size();
    for (std::size_t y = 0; y < count; ++y) {
        double middle = value[y], spread = 0, size = std::abs(middle);
        for (std::size_t q = 0; q < variables; ++q) {
            double const s = v.slope[q * count + y];
            middle += s * d.at[q];
            spread += std::abs(s) * d.by[q];
            size += std::abs(s);
        }
        double const error = 1e-15 * (2 * static_cast<double>(variables) + 8) * size;
        double const reached = spread + v.rest[y] + error;
        double const up = (middle + reached) + 1e-15 * std::abs(middle + reached);
        double const down = (middle - reached) - 1e-15 * std::abs(middle - reached);
        v.low[y] = std::min(v.low[y], std::isfinite(down) ? down : -infinity);
        v.high[y] = std::max(v.high[y], std::isfinite(up) ? up : infinity);
    }
}

} // namespace decision_detail

SIVID_DECL motion_cover::motion_cover(prediction_problem const& problem,
                                      followed_outputs const& outputs, std::vector<double> times,
                                      run_options const& options)
    : problem_(&problem),
      around_((problem.require_valid(), problem.around())),
      times_(std::move(times)),
      flow_(outputs.model, problem.choice, problem.inputs),
      options_(options),
      cells_(flow_) {
    if (times_.size() < 2 || times_.front() != 0 || times_.back() != problem.end)
        throw std::invalid_argument("motion_cover: the grid goes from 0 to the end");
    for (double const t : times_) {
        for (std::size_t y = 0; y < flow_.channels(); ++y)
            samples_.push_back({t, y, interval_traits<interval>::entire()});
    }
    experiment_ = {"prediction", problem.inputs, 0, problem.initial, samples_, 0};
    run_ = make_run(flow_, experiment_, samples_, problem.initial, around_, options);
}

SIVID_DECL motion_cover::part motion_cover::whole() const {
    std::vector<std::size_t> all(problem_->sets.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return {problem_->initial, around_, std::move(all), nullptr};
}

SIVID_DECL motion_cover::part motion_cover::point(std::vector<double> const& start,
                                                  std::vector<double> const& parameters) const {
    return {point_within(problem_->initial, start), point_within(around_, parameters), {}, nullptr};
}

SIVID_DECL void motion_cover::learn(std::vector<part*> const& parts) {
    std::vector<bool> done(parts.size(), false);
    for (std::size_t first = 0; first < parts.size(); ++first) {
        if (done[first]) continue;
        auto const& initial = parts[first]->initial;
        std::vector<part*> group;
        std::vector<box> parameters;
        for (std::size_t k = first; k < parts.size(); ++k) {
            if (done[k] || ends_of(parts[k]->initial) != ends_of(initial)) continue;
            done[k] = true;
            group.push_back(parts[k]);
            parameters.push_back(parts[k]->parameters);
        }
        // A point among sets has no use for their polynomials, which cost most of the time.
        bool const points = std::all_of(parameters.begin(), parameters.end(), [&](box const& p) {
            return normalised_unknowns(initial, p).variables == 0;
        });
        if (points && !points_) {
            auto options = options_;
            // A box that creeps is halved; a point that creeps is stiff, and goes on.
            options.minimum_step = std::min(options.minimum_step, enclosure_options{}.minimum_step);
            points_ = make_run(flow_, experiment_, samples_, initial, parameters.front(), options);
        }
        auto const answers = (*(points ? points_ : run_))(initial, parameters);
        integrations_ += parameters.size();
        for (std::size_t k = 0; k < group.size(); ++k) {
            auto known = std::make_shared<knowledge>();
            known->initial = group[k]->initial;
            known->parameters = group[k]->parameters;
            known->answer = answers[k];
            known->reached = answers[k]->outputs() / flow_.channels();
            // Cut short by the budget: what the whole tells of its part holds as well.
            if (group[k]->known && known->reached < group[k]->known->reached) continue;
            follow(*known);
            group[k]->known = std::move(known);
        }
    }
}

/// What the outputs do between the instants that were reached.
SIVID_DECL void motion_cover::follow(knowledge& k) {
    k.complete = k.reached == times_.size();
    if (k.reached == 0) return;
    auto const n = flow_.states();
    auto const ranges = output_ranges(*k.answer, k.parameters);
    auto const states_at = [&](std::size_t instant) {
        box x(n);
        for (std::size_t i = 0; i < n; ++i) x[i] = ranges[instant * flow_.channels() + i];
        return x;
    };
    cells_.set_parameters(k.parameters);
    k.start = cells_.at(times_.front(), k.initial);
    k.courses.resize(k.reached - 1);
    for (std::size_t c = 0; c + 1 < k.reached; ++c) {
        auto course = cells_(times_[c], times_[c + 1], states_at(c), states_at(c + 1));
        k.complete = k.complete && course.has_value();
        if (course) k.courses[c] = std::move(*course);
    }
}

SIVID_DECL motion_cover::view motion_cover::look(part const& p, bool roughly) const {
    view v;
    if (!p.known) return v;
    auto const& known = *p.known->answer;
    auto const variables = known.table->variables;
    decision_detail::normalised_box const unknowns(known, p.initial, p.parameters);
    auto const local = expand(known, unknowns.middle, unknowns.reach);
    auto const count = p.known->reached * flow_.channels();
    auto const all = known.outputs();
    v.reached = p.known->reached;
    v.rest.assign(local.rest.begin(), local.rest.begin() + static_cast<std::ptrdiff_t>(count));
    v.curvature = local.curvature;
    v.slope.resize(variables * count);
    for (std::size_t q = 0; q < variables; ++q)
        std::copy_n(local.slope.begin() + static_cast<std::ptrdiff_t>(q * all), count,
                    v.slope.begin() + static_cast<std::ptrdiff_t>(q * count));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    v.low.assign(count, infinity);
    v.high.assign(count, -infinity);
    if (p.sets.empty() || roughly)
        decision_detail::widen(v, local.value, decision_detail::common_box(variables));
    for (std::size_t k = 0; k < p.sets.size() && !roughly; ++k) {
        decision_detail::common_box const common(problem_->sets[p.sets[k]], p.parameters, known,
                                                 unknowns);
        decision_detail::widen(v, local.value, common);
    }
    return v;
}

SIVID_DECL void motion_cover::segments(part const& p, view const& v, std::size_t output,
                                       std::vector<double>& low, std::vector<double>& high) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    low.assign(2 * times_.size() - 1, -infinity);
    high.assign(2 * times_.size() - 1, infinity);
    auto const m = flow_.channels();
    for (std::size_t k = 0; k < v.reached; ++k) {
        low[2 * k] = v.low[k * m + output];
        high[2 * k] = v.high[k * m + output];
    }
    using traits = interval_traits<interval>;
    // What holds throughout a cell holds at its ends, and may be sharper: constants are exact.
    auto const also = [&](std::size_t s, interval const& direct) {
        if (!(direct.lower() <= high[s] && low[s] <= direct.upper())) return;
        low[s] = std::max(low[s], direct.lower());
        high[s] = std::min(high[s], direct.upper());
    };
    if (v.reached > 0) also(0, p.known->start[output]);
    for (std::size_t k = 0; k + 1 < v.reached; ++k) {
        auto const& course = p.known->courses[k];
        if (course.empty()) continue;
        also(2 * k, course[output].direct);
        if (!course[output].jumps_at_end) also(2 * k + 2, course[output].direct);
    }
    for (std::size_t k = 0; k + 1 < v.reached; ++k) {
        auto const& course = p.known->courses[k];
        if (course.empty()) continue;
        if (!std::isfinite(low[2 * k]) || !std::isfinite(high[2 * k]) ||
            !std::isfinite(low[2 * k + 2]) || !std::isfinite(high[2 * k + 2]))
            continue;
        auto const range = cell_bounds::between(course[output], times_[k], times_[k + 1],
                                                traits::bounds(low[2 * k], high[2 * k]),
                                                traits::bounds(low[2 * k + 2], high[2 * k + 2]));
        low[2 * k + 1] = range.lower();
        high[2 * k + 1] = range.upper();
    }
}

SIVID_DECL std::size_t motion_cover::variable_of(part const& p, std::size_t side) const {
    if (!p.known) return none;
    auto const n = problem_->initial.size();
    auto const& unknowns = p.known->answer->unknowns;
    auto const& s = side < n ? unknowns.initial[side] : unknowns.parameters[side - n];
    return s.radius > 0 ? s.variable : none;
}

SIVID_DECL std::vector<double> motion_cover::lost_by_sides(part const& p, view const& v) const {
    if (v.reached == 0) return {};
    auto const& known = *p.known->answer;
    auto const& table = *known.table;
    auto const at = (v.reached - 1) * flow_.channels();
    std::vector<double> by_variable(table.variables, 0.0);
    std::size_t degree = 0;
    for (std::size_t m = table.size(); m-- > 1;) { // by degree, from the highest
        auto const& e = table.exponents[m];
        auto const own = std::accumulate(e.begin(), e.end(), std::size_t{0});
        if (degree > 0 && own < degree) break;
        double size = 0;
        for (std::size_t i = 0; i < flow_.states(); ++i)
            size += std::abs(known.coefficients[m * known.outputs() + at + i]) /
                    flow_.model().about.states[i].limit;
        if (!(size > 0)) continue;
        degree = own;
        for (std::size_t q = 0; q < table.variables; ++q)
            by_variable[q] += size * (1 - std::ldexp(1.0, -e[q]));
    }
    std::vector<double> lost(sides(), 0.0);
    for (std::size_t side = 0; side < sides(); ++side) {
        auto const q = variable_of(p, side);
        if (q != none && share(p, side) > 0) lost[side] = by_variable[q];
    }
    return lost;
}

SIVID_DECL std::vector<double> motion_cover::curved_by_sides(part const& p, view const& v) const {
    std::vector<double> curved(sides(), 0.0);
    for (std::size_t side = 0; side < sides(); ++side) {
        auto const q = variable_of(p, side);
        if (q < v.curvature.size() && share(p, side) > 0) curved[side] = v.curvature[q];
    }
    return curved;
}

SIVID_DECL std::size_t motion_cover::most(std::vector<double> const& scores) {
    auto const best = std::max_element(scores.begin(), scores.end());
    return best != scores.end() && *best > 0 ? static_cast<std::size_t>(best - scores.begin())
                                             : none;
}

SIVID_DECL motion_cover::part
motion_cover::with_sets(box initial, box parameters, std::vector<std::size_t> const& of,
                        std::shared_ptr<knowledge const> known) const {
    part result{std::move(initial), parameters, {}, std::move(known)};
    bool any = false;
    for (auto const s : of) {
        auto const common = intersect(problem_->sets[s], parameters);
        if (is_empty(common)) continue;
        result.sets.push_back(s);
        result.parameters = any ? hull(result.parameters, common) : common;
        any = true;
    }
    return result;
}

SIVID_DECL std::vector<motion_cover::part> motion_cover::split(part const& p,
                                                               std::size_t side) const {
    auto const n = problem_->initial.size();
    bool const start = side < n;
    auto const& x = start ? p.initial[side] : p.parameters[side - n];
    if (!decision_detail::can_be_cut(x)) return {};
    double const at = mid(x);
    std::vector<part> result;
    if (start) {
        auto const [below, above] = bisect(p.initial, side, at);
        result.push_back({below, p.parameters, p.sets, p.known});
        result.push_back({above, p.parameters, p.sets, p.known});
        return result;
    }
    auto const [below, above] = bisect(p.parameters, side - n, at);
    for (auto const& half : {below, above}) {
        auto next = with_sets(p.initial, half, p.sets, p.known);
        if (!next.sets.empty()) result.push_back(std::move(next));
    }
    return result;
}

SIVID_DECL double motion_cover::share(part const& p, std::size_t side) const {
    auto const n = problem_->initial.size();
    auto const& x = side < n ? p.initial[side] : p.parameters[side - n];
    if (!decision_detail::can_be_cut(x)) return 0;
    return width(x) / width(side < n ? problem_->initial[side] : around_[side - n]);
}

SIVID_DECL double motion_cover::widest_share(part const& p) const {
    double widest = 0;
    for (std::size_t side = 0; side < sides(); ++side) widest = std::max(widest, share(p, side));
    return widest;
}

SIVID_DECL std::vector<motion_cover::part> motion_cover::split(part const& p) const {
    std::vector<double> shares(sides());
    for (std::size_t side = 0; side < sides(); ++side) shares[side] = share(p, side);
    auto const widest = most(shares);
    return widest == none ? std::vector<part>{} : split(p, widest);
}

} // namespace sivid

#endif
