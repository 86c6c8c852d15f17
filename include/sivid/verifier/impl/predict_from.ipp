// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_PREDICT_FROM_IPP
#define SIVID_VERIFIER_IMPL_PREDICT_FROM_IPP

#include <sivid/verifier/predict_from.hpp>

#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>
#include <sivid/verifier/claim/detail/stored_claims.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace sivid {

namespace io_detail {

/// A side that stands for one decimal.
inline bool is_decimal(interval const& x) {
    return !(std::nextafter(x.lower(), HUGE_VAL) < x.upper());
}

/// Parameters that may be feasible, near given coordinates; and proofs.
class feasible_search {
public:
    feasible_search(identification_problem const& data, stored_identification const& stored,
                    double seconds)
        : data_(data), seconds_(seconds) {
        std::string fault;
        if (!stored.witness) return;
        auto const point = witness_motion(data, stored, fault);
        if (!point) return;
        witness_ = mid(point->parameters);
        for (std::size_t e = 0; e < data.experiments.size(); ++e)
            starts_.push_back(point_within(data.experiments[e].initial, mid(point->starts[e])));
    }

    void use(std::vector<product_formula> sides, std::vector<std::size_t> pivots) {
        sides_ = std::move(sides);
        pivots_ = std::move(pivots);
    }

    /// @param point  products or parameters, then what is set
    [[nodiscard]] std::vector<std::vector<double>>
    candidates(std::vector<double> const& point) const {
        auto const n = data_.choice.unknown.size();
        auto const own = pivots_.empty() ? n : pivots_.size();
        std::vector<std::vector<double>> result;
        auto const add = [&](std::vector<double> parameters) {
            for (std::size_t k = own; k < point.size(); ++k) parameters.push_back(point[k]);
            result.push_back(std::move(parameters));
        };
        if (!witness_.empty()) add(witness_);
        if (pivots_.empty()) {
            add({point.begin(), point.begin() + static_cast<std::ptrdiff_t>(n)});
            return result;
        }
        std::vector<std::vector<double>> others;
        if (!witness_.empty()) others.push_back(witness_);
        for (double const share : {0.5, 0.1, 0.9, 0.01, 0.99}) {
            auto& p = others.emplace_back();
            for (auto const& side : data_.prior)
                p.push_back(side.lower() + share * (side.upper() - side.lower()));
        }
        for (auto& p : others) {
            if (solve(p, point)) add(std::move(p));
            if (result.size() > 3) break;
        }
        return result;
    }

    /// Whether the data allow the witness that is stored: they do not contradict themselves then.
    [[nodiscard]] bool witness_is_proved() { return !witness_.empty() && proved(witness_); }

    /// Whether the data allow these parameters: the first ones of the point.
    [[nodiscard]] bool proved(std::vector<double> const& point) {
        auto const n = static_cast<std::ptrdiff_t>(data_.choice.unknown.size());
        std::vector<double> const parameters(point.begin(), point.begin() + n);
        auto const known = known_.find(parameters);
        if (known != known_.end()) return known->second;
        bool within = true;
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            auto const& prior = data_.prior[j];
            within = within && std::isfinite(parameters[j]) &&
                     ((prior.lower() < parameters[j] && parameters[j] < prior.upper()) ||
                      is_decimal(prior));
        }
        bool found = false;
        if (within) {
            certificate_options options;
            options.seconds = seconds_;
            auto const at = point_within(data_.prior, parameters);
            for (auto const& starts : {starts_, std::vector<box>{}}) {
                if (found) break;
                if (starts.empty() && !starts_.empty() && !any_choice()) continue;
                claim_checker<interval> check(data_, starts, options);
                std::vector<box_claim> claim{{at, box_claim::kind::inside}};
                check(claim);
                found = claim.front().found == box_claim::status::proved;
            }
        }
        known_[parameters] = found;
        return found;
    }

private:
    [[nodiscard]] bool any_choice() const {
        return std::any_of(data_.experiments.begin(), data_.experiments.end(),
                           [](experiment const& e) {
                               return !std::all_of(e.initial.begin(), e.initial.end(), is_decimal);
                           });
    }
    /// Gives the pivots of p the values that the products ask for.
    [[nodiscard]] bool solve(std::vector<double>& p, std::vector<double> const& products) const {
        for (std::size_t k = 0; k < pivots_.size(); ++k) {
            double others = 1;
            auto const& exponents = sides_[k].exponents();
            for (std::size_t j = 0; j < p.size(); ++j) {
                if (j != pivots_[k]) others *= std::pow(p[j], exponents[j]);
            }
            double const value = products[k] / others;
            if (!std::isfinite(value) || !contains(data_.prior[pivots_[k]], value)) return false;
            p[pivots_[k]] = value;
        }
        return true;
    }

    identification_problem data_;
    double seconds_;
    std::vector<double> witness_;
    std::vector<box> starts_;
    std::vector<product_formula> sides_;
    std::vector<std::size_t> pivots_;
    std::map<std::vector<double>, bool> known_;
};

/// Whether states that effects added start where parameters say, or uncertain inputs do.
inline bool starts_follow(identification_problem const& data, box const& initial) {
    return std::any_of(data.model.added_states.begin(), data.model.added_states.end(),
                       [&](added_state const& a) {
                           return !is_decimal(initial[a.state]) ||
                                  std::any_of(data.experiments.begin(), data.experiments.end(),
                                              [&](experiment const& e) {
                                                  return !is_decimal(e.initial[a.state]);
                                              });
                       });
}

/// What is taken for granted besides what the identification says.
inline void state_assumptions(identification_problem const& data, prediction_request const& request,
                              stored_prediction& result) {
    for (auto const& e : data.experiments) {
        auto const own = request.stated_outliers.find(e.name);
        auto const stated = own == request.stated_outliers.end() ? e.outliers : own->second;
        if (e.outliers == 0 && stated == 0) continue;
        auto const count = [](std::size_t n) { return std::to_string(n); };
        auto const of = count(e.outliers) + " of " + count(e.measurements.size()) +
                        " measurements of " + e.name;
        std::string words = "at most " + of + " may violate their bounds";
        if (stated != e.outliers) {
            words += " (the result's budget; the data set says " + count(stated) + ")";
        }
        result.assumptions.push_back(words);
        if (e.outliers > 0)
            result.feasible_with += (result.feasible_with.empty() ? "at most " : ", ") + of +
                                    " may lie outside of their bounds";
    }
    for (auto words : derivation_words(result.direct.model, result.direct.choice)) {
        words.pop_back(); // the full stop
        result.assumptions.push_back(words);
    }
    result.starts_follow = starts_follow(data, request.initial);
    if (result.starts_follow)
        result.assumptions.push_back(
            "states that effects add start anywhere in the ranges that the parameters give them, "
            "each with every parameter: what is proved holds nevertheless, and nothing is refuted");
}

/// What the experiments without outliers say of the parameters that were identified; further sides
/// of a box are other constants. Nothing is prepared before somebody asks, and nothing said unless
/// the witness is proved: of data that nothing explains everything would follow.
inline std::function<measured_responses(box const&, std::function<bool()> const&)>
measured_by(identification_problem problem, std::shared_ptr<feasible_search> witness) {
    struct kept {
        identification_problem problem;
        std::shared_ptr<feasible_search> witness;
        std::function<bool()> keep_going;
        std::optional<feasibility_test> test, sharp;
        [[nodiscard]] bool ready() {
            if (!test && witness && witness->witness_is_proved()) make(test, 0);
            witness = nullptr; // it has said what it knows
            return test.has_value();
        }
        void make(std::optional<feasibility_test>& of, std::size_t degree) {
            feasibility_test_options options;
            options.degree = degree;
            options.keep_going = [this] { return !keep_going || keep_going(); };
            of.emplace(problem, options);
        }
        /// By polynomials of a higher degree where remainders would hide measurements.
        [[nodiscard]] response run(std::size_t e, box const& parameters) {
            auto const& initial = problem.experiments[e].initial;
            auto first = *test->run(e, initial, parameters);
            auto const degree = sharp_degree(first.unknowns.variables);
            bool blurred = first.outputs() < first.measurements;
            for (std::size_t y = 0; y < first.outputs(); ++y)
                blurred = blurred || !(first.radius[y] <= 0.01 * width(first.bounds[y]));
            if (!blurred || degree <= suggested_degree(first.unknowns.variables)) return first;
            if (!sharp) make(sharp, degree);
            auto second = *sharp->run(e, initial, parameters);
            return second.outputs() < first.outputs() ? first : second; // ended early
        }
    };
    auto const data = std::make_shared<kept>();
    data->problem = std::move(problem);
    data->witness = std::move(witness);
    return [data](box const& parameters, std::function<bool()> const& keep_going) {
        data->keep_going = keep_going;
        measured_responses result;
        if (!data->ready()) return result;
        auto const own = static_cast<std::ptrdiff_t>(data->problem.prior.size());
        box const first(std::vector<interval>(parameters.begin(), parameters.begin() + own));
        for (std::size_t e = 0; e < data->problem.experiments.size(); ++e) {
            auto const& run = data->problem.experiments[e];
            if (run.outliers > 0) continue;
            auto answer = std::make_shared<response>(data->run(e, first));
            auto& sides = answer->unknowns.parameters;
            for (auto at = parameters.begin() + own; at != parameters.end(); ++at)
                sides.push_back({.centre = mid(*at)});
            result.known.push_back(std::move(answer));
            result.starts.push_back(run.initial);
        }
        return result;
    };
}

/// Constants that a request gives ranges: unknowns of the prediction behind those identified.
struct further_unknowns {
    std::vector<std::string> names;
    std::vector<interval> ranges;

    [[nodiscard]] box beside(box const& own) const {
        std::vector<interval> sides(own.begin(), own.end());
        sides.insert(sides.end(), ranges.begin(), ranges.end());
        return box(std::move(sides));
    }
    /// What an identification leaves of its unknowns, each with all of these.
    [[nodiscard]] std::vector<box> beside(std::vector<paved_box> const& rows) const {
        std::vector<box> left;
        for (auto const& row : rows)
            if (row.verdict != box_verdict::outside) left.push_back(beside(row.set));
        return left;
    }
};

/// Sets constants to what is requested: those of one value are fixed, the others become unknowns.
/// @throws std::invalid_argument  for constants that cannot be set
inline further_unknowns set_constants(std::map<std::string, interval> const& requested,
                                      std::vector<std::string> const& identified,
                                      prediction_problem& direct) {
    further_unknowns result;
    for (auto const& [name, range] : requested) {
        static_cast<void>(index_of(direct.model.about.constants, name, "constant"));
        if (std::find(identified.begin(), identified.end(), name) != identified.end())
            throw std::invalid_argument(
                "the constant '" + name +
                "' is one that the data identify: the prediction is for all its values that they "
                "leave; to fix it, identify with it fixed");
        if (is_empty(range) || !std::isfinite(mag(range)))
            throw std::invalid_argument("the range of the constant '" + name + "' is not bounded");
        if (width(range) <= normalised_unknowns::negligible * mag(range)) {
            direct.choice.fixed[name] = range;
            continue;
        }
        direct.choice.fixed.erase(name);
        direct.choice.unknown.push_back(name);
        result.names.push_back(name);
        result.ranges.push_back(range);
    }
    return result;
}

/// The parameters that the data leave, as they were paved.
inline void pose_in_parameters(identification_problem const& data,
                               stored_identification const& stored, further_unknowns const& further,
                               std::shared_ptr<feasible_search> const& search,
                               stored_prediction& result) {
    auto& problem = result.problem;
    if (!problem.model.has_memory()) problem.measured = measured_by(data, search);
    problem.sets = further.beside(stored.rows);
    result.sides = problem.choice.unknown;
}

/// The products that the data leave, where these tell the motions of the prediction and its
/// margins, and are all that the equations of the data see.
inline void pose_in_products(identification_problem const& data,
                             stored_identification::product_boxes const& stored,
                             std::vector<node_id> const& margins, further_unknowns const& further,
                             std::shared_ptr<feasible_search> const& search,
                             stored_prediction& result) {
    auto const& direct = result.direct;
    identification_problem asked;
    asked.model = followed_outputs(direct.model, margins).model;
    asked.choice = direct.choice;
    asked.prior = direct.sets.front();
    experiment scenario;
    scenario.inputs = direct.inputs;
    scenario.initial = direct.initial;
    asked.experiments = {scenario};
    auto formulas = stored.sides;
    formulas.insert(formulas.end(), further.names.begin(), further.names.end());
    auto const rebuilt = rebuild_products<interval>(asked, formulas);
    result.not_in_products = !rebuilt.malformed.empty() ? rebuilt.malformed : rebuilt.unproved;
    auto const seen = rebuild_products<interval>(data, stored.sides);
    if (result.not_in_products.empty()) result.not_in_products = seen.unproved;
    result.in_products = result.not_in_products.empty();
    if (!result.in_products) return;
    auto& problem = result.problem;
    if (!direct.model.has_memory()) problem.measured = measured_by(seen.problem, search);
    problem.choice = rebuilt.problem.choice;
    result.sides = formulas;
    problem.sets = further.beside(stored.rows);
    if (share_a_factor(rebuilt))
        problem.reached = reached_within(rebuilt, asked.prior, problem.sets, 1000);
    auto const own = static_cast<std::ptrdiff_t>(stored.sides.size());
    search->use({rebuilt.sides.begin(), rebuilt.sides.begin() + own},
                {rebuilt.pivots.begin(), rebuilt.pivots.begin() + own});
}

} // namespace io_detail

SIVID_DECL std::unique_ptr<stored_prediction>
predict_from(identification_problem const& data, stored_identification const& stored,
             recorded_model const& model, std::vector<node_id> const& margins,
             prediction_request const& request, std::filesystem::path const& file) {
    io_detail::require_consistent(data, stored, file);
    auto result = std::make_unique<stored_prediction>();
    auto& direct = result->direct;
    direct.model = model;
    direct.choice = data.choice;
    direct.inputs = request.inputs;
    direct.initial = request.initial;
    direct.end = request.end;
    for (auto const& a : stored.assumptions)
        result->assumptions.push_back("of the identification: " + a);
    auto const further = io_detail::set_constants(request.set, data.choice.unknown, direct);
    io_detail::state_assumptions(data, request, *result);
    auto& problem = result->problem;
    problem = direct;
    direct.sets = {further.beside(data.prior)};

    auto const search =
        std::make_shared<io_detail::feasible_search>(data, stored, request.proof_seconds);
    if (stored.products)
        io_detail::pose_in_products(data, *stored.products, margins, further, search, *result);
    if (!result->in_products) io_detail::pose_in_parameters(data, stored, further, search, *result);
    if (problem.sets.empty())
        throw input_error{
            {.file = file.string()}, "no parameter is left", "identify the data anew"};
    result->feasible.direct = &result->direct;
    result->feasible.candidates = [search](std::vector<double> const& p) {
        return search->candidates(p);
    };
    if (result->starts_follow) return result;
    result->feasible.proved = [search](std::vector<double> const& p) { return search->proved(p); };
    return result;
}

} // namespace sivid

#endif
