// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_PREDICT_FROM_IPP
#define SIVID_VERIFIER_IMPL_PREDICT_FROM_IPP

#include <sivid/verifier/predict_from.hpp>

#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/result/same_problem.hpp>
#include <sivid/model/structure/homogeneity.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>
#include <sivid/verifier/claim/detail/restated.hpp>
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

    /// From now on points are of products.
    void use(reduction const& map) { map_ = &map; }

    /// @param point  products or parameters, then what is set
    [[nodiscard]] std::vector<std::vector<double>>
    candidates(std::vector<double> const& point) const {
        auto const own = static_cast<std::ptrdiff_t>(map_ != nullptr ? map_->sides().size()
                                                                     : data_.prior.size());
        std::vector<double> const at(point.begin(), point.begin() + own);
        std::vector<std::vector<double>> result;
        auto const add = [&](std::vector<double> parameters) {
            parameters.insert(parameters.end(), point.begin() + own, point.end());
            result.push_back(std::move(parameters));
        };
        if (!witness_.empty()) add(witness_);
        if (map_ == nullptr) {
            add(at);
            return result;
        }
        if (!witness_.empty()) add(with_products(witness_, at));
        for (double const share : {0.5, 0.1, 0.9}) {
            std::vector<double> factors;
            for (auto const& side : data_.prior)
                factors.push_back(side.lower() + share * (side.upper() - side.lower()));
            add(with_products(factors, at));
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
        certificate_options options;
        options.seconds = seconds_;
        for (auto const& starts : {starts_, std::vector<box>{}}) {
            if (!within || found || (starts.empty() && !starts_.empty() && !any_choice())) continue;
            claim_checker<interval> check(data_, starts, options);
            std::vector<box_claim> claim{
                {point_within(data_.prior, parameters), box_claim::kind::inside}};
            check(claim);
            found = claim.front().found == box_claim::status::proved;
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
    /// The factors with what the products ask for in place of the pivots.
    [[nodiscard]] std::vector<double> with_products(std::vector<double> const& factors,
                                                    std::vector<double> const& products) const {
        auto near = data_.prior;
        for (std::size_t j = 0; j < near.size(); ++j) {
            bool const pivot = std::ranges::any_of(
                map_->sides(), [j](reduction::side const& s) { return s.parameter == j; });
            if (!pivot) near[j] = interval(factors[j]);
        }
        return map_->approximate_preimage(near, products);
    }

    identification_problem data_;
    double seconds_;
    std::vector<double> witness_;
    std::vector<box> starts_;
    reduction const* map_ = nullptr;
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

/// Why equations, or margins, may see parameters otherwise than through products; else empty.
///   Shown by dimensional analysis: to scale a factor against the pivots changes none of them.
inline std::string seen_otherwise(reduction const& map, identification_problem const& data,
                                  bound_model const& asked) {
    for (std::size_t j = 0; j < data.prior.size(); ++j) {
        std::vector<int> weights(asked.parameters.size(), 0);
        bool pivot = false, used = false;
        for (auto const& s : map.sides()) {
            pivot = pivot || s.parameter == j;
            if (!s.product || s.parameter == j) continue;
            weights[s.parameter] = -s.product->exponents[j];
            used = used || s.product->exponents[j] != 0;
        }
        if (pivot) continue;
        weights[j] = 1;
        auto const& name = data.choice.unknown[j];
        if (used && contains(data.prior[j], 0.0)) return name + " may be 0";
        if (!is_scale_invariant(asked, weights))
            return name + " may act otherwise than through the products";
    }
    return {};
}

/// Whether parameters of a prior reach a box of products.
enum class reach { all, some, none };

/// @guarantee  all: with some of the factors as they are, the pivots reach each of its points;
///             none: no parameter has its products there
[[nodiscard]] inline reach reach_of(reduction const& map, box const& prior, box const& r) {
    auto const near = map.backward(prior, r);
    if (is_empty(near)) return reach::none;
    auto const factors = point_box(mid(near));
    for (std::size_t k = 0; k < r.size(); ++k) {
        auto const& s = map.sides()[k];
        auto pivot = r[k];
        if (s.product) {
            auto others = *s.product;
            others.exponents[s.parameter] = 0;
            bool undefined = false;
            pivot = interval_traits<interval>::div(r[k], others.over(factors), undefined);
            if (undefined) return reach::some;
        }
        if (!subset(pivot, prior[s.parameter])) return reach::some;
    }
    return reach::all;
}

/// Boxes within boxes of products, of which parameters of a prior reach every point: as many as
/// halving finds.
/// @param tested  boxes, at most so many more than there are
[[nodiscard]] inline std::vector<box> reached_within(reduction const& map, box const& prior,
                                                     std::vector<box> boxes, std::size_t tested) {
    std::vector<box> result;
    tested += boxes.size();
    for (std::size_t at = 0; at < boxes.size(); ++at) {
        auto const r = boxes[at]; // a copy: there will be more
        auto const found = reach_of(map, prior, r);
        if (found == reach::all) result.push_back(r);
        if (found != reach::some || boxes.size() + 2 > tested) continue;
        auto const side = widest_side(r, map.problem().prior);
        if (!side) continue;
        auto const [low, high] = bisect(r, *side, mid(r[*side]));
        boxes.push_back(low);
        boxes.push_back(high);
    }
    return result;
}

/// The products that the data leave, where these tell the motions of the prediction and its
/// margins, too.
inline void pose_in_products(identification_problem const& data, restated const& known,
                             std::vector<node_id> const& margins, further_unknowns const& further,
                             std::shared_ptr<feasible_search> const& search,
                             stored_prediction& result) {
    auto const& direct = result.direct;
    auto const& map = *known.map;
    result.not_in_products = seen_otherwise(
        map, data,
        sivid::bind(followed_outputs(direct.model, margins).model, direct.choice, direct.inputs));
    result.in_products = result.not_in_products.empty();
    if (!result.in_products) return;
    auto& problem = result.problem;
    if (!direct.model.has_memory()) problem.measured = measured_by(map.problem(), search);
    auto& unknown = problem.choice.unknown;
    auto const& fixed = map.problem().choice.fixed; // the factors that products stand for
    problem.choice.fixed.insert(fixed.begin(), fixed.end());
    unknown = map.problem().choice.unknown;
    unknown.insert(unknown.end(), further.names.begin(), further.names.end());
    for (auto const& name : further.names) problem.choice.fixed.erase(name);
    result.sides = map.side_names();
    result.sides.insert(result.sides.end(), further.names.begin(), further.names.end());
    auto const& rows = known.found.products->paving.boxes();
    problem.sets = further.beside(rows);
    if (!map.fills()) {
        problem.reached.emplace();
        std::vector<box> own;
        for (auto const& row : rows) own.push_back(row.set);
        for (auto const& r : reached_within(map, data.prior, std::move(own), 1000))
            problem.reached->push_back(further.beside(r));
    }
    search->use(map);
}

/// What the boxes say of the witness, and boxes of parameters of those of products.
inline std::string boxes_fault(stored_identification const& stored, restated const& known) {
    auto const met_by = [](std::vector<paved_box> const& rows, box const& x) {
        return std::ranges::any_of(
            rows, [&x](paved_box const& row) { return !is_empty(intersect(row.set, x)); });
    };
    auto const& products = stored.products;
    for (auto const& row : stored.rows)
        if (products && !met_by(products->rows, known.map->forward(row.set)))
            return "a box of parameters has products in no box of products";
    if (!stored.witness) return {};
    box at(stored.parameters.size());
    for (std::size_t j = 0; j < at.size(); ++j) {
        auto const own = stored.witness->parameters.find(stored.parameters[j].name);
        if (own == stored.witness->parameters.end()) return "the witness lacks a parameter";
        at[j] = interval(own->second);
    }
    if (!met_by(stored.rows, at)) return "the witness lies in no box";
    if (products && !met_by(products->rows, known.map->forward(at)))
        return "the witness lies in no box of products";
    return {};
}

/// Refuses a result that is not one of this problem, or contradicts itself. That its claims are
/// true is for a check to say.
/// @throws input_error
inline restated consistent(identification_problem const& data, stored_identification const& stored,
                           std::filesystem::path const& file) {
    using outcome = check_finding::outcome;
    auto const refuse = [&](std::string const& what,
                            std::string const& remedy = "identify the data anew") {
        throw input_error{{.file = file.string()}, what, remedy};
    };
    auto const contradicts = [&](std::string const& fault) {
        if (!fault.empty()) refuse("the result contradicts itself: " + fault);
    };
    require_same_problem(data, stored, file);
    for (auto const& e : data.experiments) {
        if (e.outliers >= e.measurements.size() && !e.measurements.empty())
            refuse("all measurements of " + in_quotes(e.name) +
                   " may violate their bounds: nothing is known from them");
    }
    if (stored.problem.empty())
        refuse("the result does not say which problem was identified: an earlier version wrote it");
    if (stored.problem != problem_digest(data))
        refuse("this is not the problem that was identified: the model, its constants, effects, "
               "data or budgets of outliers differ (SHA-256)",
               "give the model and the data set that were identified, or identify anew");
    if (!stored.stated.contains("/files"))
        refuse("the result does not state the SHA-256 of its tables");
    auto const inputs = input_assumption(data.experiments);
    if (std::ranges::find(stored.assumptions, inputs) == stored.assumptions.end())
        contradicts("it does not assume '" + inputs + "'");
    auto known = restate(data, stored);
    contradicts(known.fault);
    known.found.assumptions = stored.assumptions; // others are the program's
    contradicts(boxes_fault(stored, known));
    for (auto const& found : compared_groups(stored, known, members_of(data, known.found, {})))
        if (found.found == outcome::refuted) contradicts(found.detail);
    if (stored.verdict == verdict::inconsistent)
        refuse("no parameter is left: the model contradicts the data",
               "ask `diagnose` what the model lacks");
    return known;
}

} // namespace io_detail

SIVID_DECL std::unique_ptr<stored_prediction>
predict_from(identification_problem const& data, stored_identification const& stored,
             recorded_model const& model, std::vector<node_id> const& margins,
             prediction_request const& request, std::filesystem::path const& file) {
    auto const known =
        std::make_shared<io_detail::restated const>(io_detail::consistent(data, stored, file));
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
    if (known->map) io_detail::pose_in_products(data, *known, margins, further, search, *result);
    if (!result->in_products) io_detail::pose_in_parameters(data, stored, further, search, *result);
    if (problem.sets.empty())
        throw input_error{
            {.file = file.string()}, "no parameter is left", "identify the data anew"};
    result->feasible.direct = &result->direct;
    result->feasible.candidates = [search, known](std::vector<double> const& p) {
        return search->candidates(p);
    };
    if (result->starts_follow) return result;
    result->feasible.proved = [search](std::vector<double> const& p) { return search->proved(p); };
    return result;
}

} // namespace sivid

#endif
