// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_WITNESS_CHECKS_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_WITNESS_CHECKS_HPP

#include <sivid/approximate/fit/detail/counterexample.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/run/plain_run.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>
#include <sivid/verifier/claim/detail/stored_claims.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// What a verified run of the witness says of its measurements, by experiment, in the order of
/// time: which it certainly meets, which by more than a millionth of the bound's width, and which
/// it certainly violates. A search marks as violated what it did not show to be met.
struct witness_readings {
    std::vector<std::vector<bool>> met, clearly_met, violated;

    /// One more measurement of an experiment. @param output  empty where the run did not get there
    template <class I>
    void note(std::size_t e, interval const& bound, std::optional<I> const& output) {
        using traits = interval_traits<I>;
        for (auto* const list : {&met, &clearly_met, &violated})
            list->resize(std::max(list->size(), e + 1));
        double const rim = 1e-6 * width(bound);
        met[e].push_back(output && traits::subset(*output, in<I>(bound)));
        clearly_met[e].push_back(output && traits::lower(*output) > bound.lower() + rim &&
                                 traits::upper(*output) < bound.upper() - rim);
        violated[e].push_back(output && traits::disjoint(*output, in<I>(bound)));
    }

    [[nodiscard]] static bool says(std::vector<std::vector<bool>> const& all, std::size_t e,
                                   std::size_t k) {
        return e < all.size() && k < all[e].size() && all[e][k];
    }
};

/// How many readings of a scenario are said to be forced outliers, by instant and channel. A result
/// does not say which of several.
inline std::map<std::pair<double, std::string>, std::size_t>
forced_in(stored_identification const& stored, std::string const& scenario) {
    std::map<std::pair<double, std::string>, std::size_t> result;
    for (auto const& f : stored.forced)
        if (f.scenario == scenario) ++result[{f.time, f.channel}];
    return result;
}

template <class I>
bool all_violated(plain_outputs<I> const& known, record const& samples,
                  std::vector<std::size_t> const& which) {
    using traits = interval_traits<I>;
    return std::all_of(which.begin(), which.end(), [&](std::size_t k) {
        if (k >= known.outputs.size() || !known.outputs[k].defined) return false;
        auto const& b = samples[k].bound;
        return traits::disjoint(known.outputs[k].value, traits::bounds(b.lower(), b.upper()));
    });
}

/// Whether every parameter of every row violates these measurements of an experiment: proved over
/// parts of the rows' hull, as long as `keep_going` says.
template <class I, class KeepGoing>
bool violated_everywhere(identification_problem const& problem, stored_identification const& stored,
                         experiment const& own, plain_run<I>& run,
                         std::vector<std::size_t> const& which, KeepGoing const& keep_going) {
    if (which.empty() || stored.rows.empty()) return true;
    std::vector<box> waiting{intersect(hull_of(stored.rows), problem.prior)};
    while (!waiting.empty()) {
        auto const region = std::move(waiting.back());
        waiting.pop_back();
        bool const needed =
            std::any_of(stored.rows.begin(), stored.rows.end(),
                        [&](auto const& row) { return !is_empty(intersect(row.set, region)); });
        if (!needed || all_violated(run(own.initial, region), run.samples(), which)) continue;
        auto const side = widest_side(region, problem.prior, 1e-12);
        if (!side || !keep_going()) return false;
        auto [low, high] = bisect(region, *side, mid(region[*side]));
        waiting.push_back(std::move(low));
        waiting.push_back(std::move(high));
    }
    return true;
}

} // namespace io_detail

/// Every parameter of every row violates the measurements that are said to be forced outliers.
///   Of several readings of one channel at one instant so many must be violated, each by all
///   parameters, as are stated there.
/// @param hits  by experiment and sample: what a verified witness certainly meets; may be empty
/// @cost  runs over parts of the rows' hull until each shows the violations, or the time is up
template <class I>
[[nodiscard]] check_finding check_forced(identification_problem const& problem,
                                         stored_identification const& stored,
                                         std::vector<std::vector<bool>> const& hits,
                                         enclosure_options const& how, double seconds) {
    using outcome = check_finding::outcome;
    std::string const what = "proved outliers";
    work_limit const in_time(seconds);
    std::size_t known = 0;
    auto const& channels = problem.model.about.channels;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& own = problem.experiments[e];
        plain_run<I> run(problem.model, problem.choice, own, how);
        auto const& samples = run.samples();
        std::vector<std::size_t> which;                                        // shown together
        std::vector<std::pair<std::vector<std::size_t>, std::size_t>> unclear; // one by one
        for (auto const& [where, count] : io_detail::forced_in(stored, own.name)) {
            known += count;
            std::size_t readings = 0;
            std::vector<std::size_t> missed; // by the witness, or perhaps
            for (std::size_t k = 0; k < samples.size(); ++k) {
                if (where != std::pair{samples[k].time, channels[samples[k].channel].name})
                    continue;
                ++readings;
                if (!io_detail::witness_readings::says(hits, e, k)) missed.push_back(k);
            }
            if (readings < count)
                return {what, outcome::refuted, "no such measurement in " + own.name};
            if (missed.size() < count)
                return {what, outcome::refuted, "the witness meets one in " + own.name};
            if (missed.size() > count) {
                unclear.emplace_back(std::move(missed), count);
            } else {
                which.insert(which.end(), missed.begin(), missed.end());
            }
        }
        auto const violated = [&](std::vector<std::size_t> const& these) {
            return io_detail::violated_everywhere(problem, stored, own, run, these, in_time);
        };
        bool const proved =
            violated(which) && std::ranges::all_of(unclear, [&](auto const& group) {
                auto const found = std::ranges::count_if(
                    group.first, [&](std::size_t place) { return violated({place}); });
                return static_cast<std::size_t>(found) >= group.second;
            });
        if (!proved) return {what, outcome::undecided, "no proof within the budget"};
    }
    if (known < stored.forced.size())
        return {what, outcome::refuted, "one in no scenario of the data set"};
    if (known == 0) return {what, outcome::nothing, ""};
    return {what, outcome::verified, "every box violates those stated"};
}

namespace io_detail {

/// Regions to be refuted: the whole prior, or parts of the boxes, where that is hardest, and of the
/// prior in turn.
inline std::vector<box_claim> regions_to_refute(identification_problem const& problem,
                                                stored_identification const& stored,
                                                std::size_t sample, std::uint64_t seed) {
    if (sample == 0) return {{problem.prior, box_claim::kind::outside}};
    std::vector<box_claim> claims;
    std::mt19937_64 random(seed);
    auto const share = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (std::size_t k = 0; k < sample; ++k) {
        auto part = problem.prior;
        if (k % 2 == 0 && !stored.rows.empty()) {
            part = intersect(stored.rows[random() % stored.rows.size()].set, problem.prior);
        }
        shrink_to_share(part, problem.prior, share);
        if (!is_empty(part)) claims.push_back({std::move(part), box_claim::kind::outside});
    }
    return claims;
}

/// All ways to hand out what is left beyond `now`, from scenario e on.
/// @returns false where there are more than `most`
inline bool hand_out(std::vector<std::size_t>& now, std::size_t e, std::size_t left,
                     std::size_t most, std::vector<std::vector<std::size_t>>& all) {
    auto const own = now[e];
    bool few = true;
    for (std::size_t k = e + 1 == now.size() ? left : 0; k <= left && few; ++k) {
        now[e] = own + k;
        if (e + 1 < now.size()) {
            few = hand_out(now, e + 1, left - k, most, all);
        } else {
            all.push_back(now);
            few = all.size() <= most;
        }
    }
    now[e] = own;
    return few;
}

/// What has to hold where so many outliers are needed as a result says.
struct fewest_problems {
    std::vector<identification_problem> impossible; ///< one outlier less than needed
    std::vector<identification_problem> possible; ///< as many as suffice, where budgets are larger
    bool complete = true; ///< whether every way to share one less in all is among the impossible
};

/// @param fault  set where the numbers do not even fit the budgets: nothing is returned then
inline std::optional<fewest_problems> problems_of_fewest(identification_problem const& problem,
                                                         stored_identification const& stored,
                                                         std::string& fault) {
    auto const wrong = [&fault](std::string words) {
        fault = std::move(words);
        return std::nullopt;
    };
    std::size_t budgets = 0;
    for (auto const& e : problem.experiments) budgets += e.outliers;
    if (stored.fewest->most != budgets) return wrong("not as many as the scenarios' budgets");
    if (stored.verdict != verdict::consistent)
        return wrong("the verdict does not say that they suffice");
    fewest_problems result;
    std::vector<std::size_t> least; // by scenario
    std::size_t alone = 0;
    for (auto const& e : problem.experiments) {
        auto const own = stored.fewest_alone.find(e.name);
        if (own == stored.fewest_alone.end() || own->second.most > e.outliers ||
            e.outliers > e.measurements.size())
            return wrong("no number, or too large a one, for " + e.name);
        auto single = problem;
        single.experiments = {e};
        if (own->second.most < e.outliers) {
            single.experiments[0].outliers = own->second.most;
            result.possible.push_back(single);
        }
        alone += least.emplace_back(own->second.least);
        if (own->second.least == 0) continue;
        single.experiments[0].outliers = own->second.least - 1;
        result.impossible.push_back(std::move(single));
    }
    if (stored.fewest_alone.size() != problem.experiments.size())
        return wrong("of a scenario that the data set lacks");
    std::vector<std::vector<std::size_t>> fewer; // by what each needs alone where there are none
    result.complete = stored.fewest->least <= alone ||
                      hand_out(least, 0, stored.fewest->least - 1 - alone, 32, fewer);
    if (!result.complete) fewer.clear();
    for (auto const& counts : fewer) {
        auto& p = result.impossible.emplace_back(problem);
        for (std::size_t e = 0; e < counts.size(); ++e) {
            auto& own = p.experiments[e];
            own.outliers = std::min(counts[e], own.measurements.size());
        }
    }
    return result;
}

} // namespace io_detail

/// Whether so many outliers are needed as a result says.
///   That they suffice is the verdict with these budgets, and for a scenario by itself a fit that
///   is proved to explain it where it is to need fewer than its budget. One less than a scenario
///   needs by itself must exclude the prior; so must one less in all, however these are handed out
///   to the scenarios: one may make up for another. Fits look for fewer first.
/// @param sample  so many regions for each claim; 0: the whole prior
/// @cost  validated runs until each region is refuted, or the time is up
template <class I>
[[nodiscard]] check_finding
check_fewest(identification_problem const& problem, stored_identification const& stored,
             certificate_options how, double seconds, std::size_t sample, std::uint64_t seed) {
    using outcome = check_finding::outcome;
    std::string const what = "outliers needed";
    if (!stored.fewest) return {what, outcome::nothing, ""};
    std::string fault;
    auto const posed = io_detail::problems_of_fewest(problem, stored, fault);
    if (!posed) return {what, outcome::refuted, fault};
    auto const& impossible = posed->impossible;
    auto const& possible = posed->possible;
    auto const found_by_fit = [&](identification_problem const& p) {
        counterexample_options fits;
        fits.seconds = 0.3 * seconds / static_cast<double>(impossible.size() + possible.size());
        fits.keep_going = how.keep_going;
        fits.confirms = [&](approximate_fit const& f) {
            return io_detail::judge_point<I>(p, f, true) == run_finding::explained;
        };
        return find_explaining_point(p, {p.prior}, fits);
    };
    if (std::any_of(impossible.begin(), impossible.end(), found_by_fit)) {
        return {what, outcome::refuted, "fewer suffice: a fit found, and validated runs prove"};
    }
    std::string unshown;
    for (auto const& p : possible) {
        auto const& own = p.experiments[0];
        if (found_by_fit(p)) continue;
        unshown += "; not shown that " + std::to_string(own.outliers) + " suffice for " + own.name;
    }
    std::size_t proved = 0, all = 0;
    for (auto const& p : impossible) {
        auto claims = io_detail::regions_to_refute(p, stored, sample, seed);
        how.seconds = seconds / static_cast<double>(impossible.size());
        claim_checker<I>(p, {}, how)(claims);
        for (auto const& c : claims) {
            ++all;
            proved += c.found == box_claim::status::proved ? 1 : 0;
            if (c.found == box_claim::status::refuted) {
                return {what, outcome::refuted, "fewer suffice"};
            }
        }
    }
    std::string detail =
        std::to_string(proved) + " of " + std::to_string(all) + " regions refuted with one less";
    if (!posed->complete)
        detail += "; the total is not checked from below: too many ways to share it";
    return {what,
            proved < all || !posed->complete || !unshown.empty() ? outcome::undecided
            : sample == 0 || all == 0                            ? outcome::verified
                                                                 : outcome::sampled,
            detail + unshown};
}

namespace io_detail {

/// A row of outputs.csv behind the measurement. No end where the cell is empty.
struct output_row {
    interval model; ///< at most what the cells state
    std::string_view state;
};

/// @returns nothing for a cell that is no number
inline std::optional<interval> stated_bounds(std::string_view low, std::string_view high) {
    auto const end = [](std::string_view cell, double none) {
        return cell.empty() ? std::optional{interval(none)} : parse_decimal(cell);
    };
    auto const lower = end(low, -HUGE_VAL), upper = end(high, HUGE_VAL);
    if (!lower || !upper || lower->upper() > upper->lower()) return std::nullopt;
    return interval_traits<interval>::bounds(lower->upper(), upper->lower());
}

/// The rows of outputs.csv, which must be those of the measurements, every one and in their order.
/// @param fault  receives what is wrong
inline std::vector<std::vector<output_row>> output_rows(identification_problem const& problem,
                                                        std::string_view text, std::string& fault) {
    std::size_t number = 0;
    auto const next = [&]() -> std::optional<std::string_view> {
        auto const end = text.find('\n');
        if (end == std::string_view::npos) return std::nullopt;
        auto const line = text.substr(0, end);
        text.remove_prefix(end + 1);
        ++number;
        return line;
    };
    std::vector<std::vector<output_row>> all;
    if (next() != output_headings) fault = "outputs.csv has other columns";
    auto const measured = measurement_cells(problem);
    for (std::size_t e = 0; e < measured.size() && fault.empty(); ++e) {
        auto& rows = all.emplace_back();
        for (auto const& cells : measured[e]) {
            auto const line = next();
            auto const where = "line " + std::to_string(number) + " of outputs.csv";
            if (!line) {
                fault = "outputs.csv lacks measurements of " + problem.experiments[e].name;
                break;
            }
            if (!line->starts_with(cells + ",")) {
                fault = where + " is not the measurement of the data set";
                break;
            }
            auto const rest = line->substr(cells.size() + 1);
            auto const first = rest.find(','), second = rest.find(',', first + 1);
            std::optional<interval> model;
            if (first != std::string_view::npos && second != std::string_view::npos)
                model = stated_bounds(rest.substr(0, first),
                                      rest.substr(first + 1, second - first - 1));
            if (!model) {
                fault = where + " states no range";
                break;
            }
            rows.push_back({*model, rest.substr(second + 1)});
        }
    }
    if (fault.empty() && !text.empty()) fault = "outputs.csv has more rows than measurements";
    return all;
}

/// What is wrong with the marks of outliers; `open` receives whether a mark is neither shown nor
/// refuted by the witness's runs.
inline std::string state_fault(identification_problem const& problem,
                               stored_identification const& stored,
                               std::vector<std::vector<output_row>> const& rows,
                               witness_readings const& witness, bool& open) {
    auto const& channels = problem.model.about.channels;
    for (std::size_t e = 0; e < rows.size(); ++e) {
        auto const& name = problem.experiments[e].name;
        auto const samples = sorted(problem.experiments[e].measurements);
        auto forced = forced_in(stored, name);
        for (std::size_t k = 0; k < rows[e].size(); ++k) {
            auto const state = rows[e][k].state;
            bool const met = witness.says(witness.met, e, k);
            bool const clearly = witness.says(witness.clearly_met, e, k);
            bool const violated = witness.says(witness.violated, e, k);
            if (state == "forced_outlier") {
                --forced[{samples[k].time, channels[samples[k].channel].name}];
            } else if (state == "witness_outlier") {
                if (!stored.witness) return "an outlier of a witness, but there is none";
                if (clearly)
                    return "the witness meets a measurement of " + name + " marked as its outlier";
                open = open || !violated;
            } else if (!state.empty()) {
                return "an unknown state in outputs.csv";
            } else if (stored.witness) {
                if (violated)
                    return "the witness violates a measurement of " + name + " that is not marked";
                open = open || !met;
            }
        }
        for (auto const& [where, missing] : forced)
            if (missing != 0) return "other proved outliers of " + name + " than result.json's";
    }
    return {};
}

/// Whether the motion that outputs.csv shows is of the kind it is said to be: of the witness, or of
/// a box that the result calls inside; and of this problem.
inline std::optional<named_motion> shown_motion_of(identification_problem const& problem,
                                                   stored_identification const& stored,
                                                   std::string& fault) {
    auto const& shown = *stored.shown;
    auto result = motion_by_names(problem, shown.parameters, shown.initial, fault);
    if (!result) return std::nullopt;
    if (shown.source == to_string(motion_source::witness)) {
        auto const same = [](box const& a, box const& b) { return subset(a, b) && subset(b, a); };
        std::string none;
        auto const w = stored.witness ? witness_motion(problem, stored, none) : std::nullopt;
        if (!w || !same(w->parameters, result->parameters) ||
            !std::ranges::equal(w->starts, result->starts, same))
            fault = "its parameters are not the witness's";
    } else if (shown.source == to_string(motion_source::inside_box)) {
        bool const is_inside = std::ranges::any_of(stored.rows, [&](paved_box const& row) {
            return row.verdict == box_verdict::inside &&
                   std::ranges::equal(result->parameters, row.set, within_stated);
        });
        if (!is_inside) fault = "its parameters lie in no inside box";
    }
    if (!fault.empty()) return std::nullopt;
    return result;
}

/// What a row states and a few floats more: an enclosure at a point is hardly wider than rounding.
template <class I>
I stated_with_rounding(interval const& x) {
    auto const more = [](double end) { return std::isfinite(end) ? cost_of_rounding(end, 64) : 0; };
    return interval_traits<I>::bounds(x.lower() - more(x.lower()), x.upper() + more(x.upper()));
}

/// Whether the outputs over the boxes lie within the rows: by runs over ever smaller parts, the
/// largest first.
/// @returns  refuted where a part has an output that is certainly outside
template <class I, class KeepGoing>
check_finding::outcome enclosed_by(std::vector<output_row> const& rows, plain_run<I>& run,
                                   box const& starts, box const& parameters,
                                   KeepGoing const& keep_going) {
    using traits = interval_traits<I>;
    using outcome = check_finding::outcome;
    auto result = outcome::verified;
    std::deque<box> waiting{parameters};
    while (!waiting.empty()) {
        auto const part = std::move(waiting.front());
        waiting.pop_front();
        auto const known = run(starts, part);
        bool all = true;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            auto const stated = stated_with_rounding<I>(rows[k].model);
            bool const there = k < known.outputs.size() && known.outputs[k].defined;
            if (there && traits::disjoint(known.outputs[k].value, stated)) return outcome::refuted;
            all = all && (is_entire(rows[k].model) ||
                          (there && traits::subset(known.outputs[k].value, stated)));
        }
        if (all) continue;
        if (!keep_going()) return outcome::undecided;
        auto const side = widest_side(part, parameters, 1.0 / 64);
        if (!side) {
            result = outcome::undecided;
            continue;
        }
        auto [low, high] = bisect(part, *side, mid(part[*side]));
        waiting.push_back(std::move(low));
        waiting.push_back(std::move(high));
    }
    return result;
}

} // namespace io_detail

/// outputs.csv has a row for every measurement, marks the outliers of this result, and encloses the
/// outputs of the motion that result.json names.
/// @param witness  what a verified run of the witness says; may be empty
/// @tparam Exact   in which a point is followed once more where Fast does not prove it
/// @cost  a validated run of each experiment, more over parts of a box where one proves nothing
template <class Exact, class Fast>
[[nodiscard]] check_finding
check_outputs(identification_problem const& problem, stored_identification const& stored,
              io_detail::witness_readings const& witness, enclosure_options how, double seconds) {
    using outcome = check_finding::outcome;
    std::string const what = "outputs";
    if (!stored.shown) {
        if (stored.outputs.empty()) return {what, outcome::nothing, ""};
        return {what, outcome::undecided, "the result does not say of which motion outputs.csv is"};
    }
    if (sha256(stored.outputs) != stored.shown->digest)
        return {what, outcome::refuted,
                "outputs.csv is not the one that the result was written with"};
    std::string fault;
    auto const rows = io_detail::output_rows(problem, stored.outputs, fault);
    bool open = false;
    if (fault.empty()) fault = io_detail::state_fault(problem, stored, rows, witness, open);
    if (!fault.empty()) return {what, outcome::refuted, fault};
    std::ptrdiff_t stated = 0;
    for (auto const& own : rows)
        stated += std::ranges::count_if(own, [](auto const& row) { return !is_entire(row.model); });
    if (stored.shown->source.empty() && stated > 0)
        return {what, outcome::refuted, "outputs of no motion"};
    if (!stored.shown->source.empty()) {
        auto const boxes = io_detail::shown_motion_of(problem, stored, fault);
        if (!boxes) return {what, outcome::refuted, "the motion of outputs.csv: " + fault};
        work_limit const in_time(seconds);
        for (std::size_t e = 0; e < rows.size(); ++e) {
            auto own = problem.experiments[e];
            own.inputs = nominal(std::move(own.inputs));
            how.tolerance = 1e-15; // fewer steps than the tubes of the table, and finer ones
            plain_run<Fast> fast(problem.model, problem.choice, own, how);
            auto says =
                io_detail::enclosed_by(rows[e], fast, boxes->starts[e], boxes->parameters, in_time);
            if (says == outcome::undecided && width(boxes->parameters) == 0 && in_time()) {
                plain_run<Exact> exact(problem.model, problem.choice, own, how);
                says = io_detail::enclosed_by(rows[e], exact, boxes->starts[e], boxes->parameters,
                                              in_time);
            }
            if (says == outcome::verified) continue;
            return {what, says,
                    (says == outcome::refuted ? "they leave what outputs.csv states in "
                                              : "no proof within the budget of those in ") +
                        own.name};
        }
    }
    if (open) return {what, outcome::undecided, "no proof which the witness meets"};
    return {what, outcome::verified,
            std::to_string(stated) + " enclosures of " +
                (stored.shown->source.empty() ? "no motion" : "the " + stored.shown->source)};
}

} // namespace sivid

#endif
