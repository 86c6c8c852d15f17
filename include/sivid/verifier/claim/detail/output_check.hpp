// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_OUTPUT_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_OUTPUT_CHECK_HPP

#include <sivid/io/identification_csv.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/run/plain_run.hpp>
#include <sivid/verifier/claim/detail/identification_consistency.hpp>
#include <sivid/verifier/proof/detail/certificate.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <map>
#include <optional>
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

/// A row of outputs.csv behind the measurement. No end where the cell is empty.
struct output_row {
    interval model; ///< at most what the cells state
    std::string_view state;
};

/// @returns nothing for a cell that is no number
inline std::optional<interval> stated_bounds(std::string_view low, std::string_view high) {
    auto const infinity = std::numeric_limits<double>::infinity();
    std::array ends{-infinity, infinity};
    if (!low.empty()) {
        auto const value = parse_decimal(low);
        if (!value) return std::nullopt;
        ends[0] = value->upper();
    }
    if (!high.empty()) {
        auto const value = parse_decimal(high);
        if (!value) return std::nullopt;
        ends[1] = value->lower();
    }
    if (ends[0] > ends[1]) return std::nullopt;
    return interval_traits<interval>::bounds(ends[0], ends[1]);
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
    std::map<std::pair<double, std::string>, std::ptrdiff_t> forced; // of one scenario
    for (std::size_t e = 0; e < rows.size(); ++e) {
        auto const& name = problem.experiments[e].name;
        auto const samples = sorted(problem.experiments[e].measurements);
        forced.clear();
        for (auto const& f : stored.forced)
            if (f.scenario == name) ++forced[{f.time, f.channel}];
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

/// The box of a map by names; nothing where one is missing or too many are there.
template <class Names>
std::optional<box> box_by_names(std::map<std::string, interval> const& sides, Names const& names) {
    if (sides.size() != names.size()) return std::nullopt;
    std::vector<interval> result;
    for (auto const& name : names) {
        auto const found = sides.find(name);
        if (found == sides.end()) return std::nullopt;
        result.push_back(found->second);
    }
    return box(std::move(result));
}

/// Whether a side lies in another one that was printed and read.
inline bool within_printed(interval const& side, interval const& printed) {
    return side.lower() >= printed.lower() - cost_of_rounding(printed.lower(), 8) &&
           side.upper() <= printed.upper() + cost_of_rounding(printed.upper(), 8);
}
inline bool within_printed(box const& x, box const& printed) {
    for (std::size_t j = 0; j < x.size(); ++j)
        if (!within_printed(x[j], printed[j])) return false;
    return true;
}

/// The parameters and starts of the motion that outputs.csv shows.
struct shown_boxes {
    box parameters;
    std::vector<box> starts;
};

/// Whether the motion is of the kind it is said to be: of the witness, or of a box that the result
/// calls inside; and of this problem.
inline std::optional<shown_boxes> boxes_of_shown(identification_problem const& problem,
                                                 stored_identification const& stored,
                                                 std::string& fault) {
    auto const& shown = *stored.shown;
    auto const own = box_by_names(shown.parameters, problem.choice.unknown);
    if (!own || leaves(*own, problem.prior)) fault = "its parameters are not those of the prior";
    std::vector<std::string> states;
    for (auto const& s : problem.model.about.states) states.push_back(s.name);
    shown_boxes result;
    for (auto const& e : problem.experiments) {
        auto const found = shown.initial.find(e.name);
        auto const start =
            found == shown.initial.end() ? std::nullopt : box_by_names(found->second, states);
        if (!start || leaves(*start, e.initial))
            fault = "its start in " + e.name + " is not allowed";
        if (start) result.starts.push_back(*start);
    }
    if (!fault.empty()) return std::nullopt;
    result.parameters = *own;
    if (shown.source == to_string(motion_source::witness)) {
        auto const points = [](std::map<std::string, double> const& values) {
            std::map<std::string, interval> sides;
            for (auto const& [name, x] : values) sides[name] = interval(x);
            return sides;
        };
        auto const same = [](auto const& a, auto const& b) {
            return std::ranges::equal(a, b, [](auto const& x, auto const& y) {
                return x.first == y.first && x.second.lower() == y.second.lower() &&
                       x.second.upper() == y.second.upper();
            });
        };
        bool is_witness =
            stored.witness && same(shown.parameters, points(stored.witness->parameters));
        for (auto const& [name, start] : shown.initial) {
            if (!is_witness) break;
            auto const of = stored.witness->initial.find(name);
            is_witness = of != stored.witness->initial.end() && same(start, points(of->second));
        }
        if (!is_witness) fault = "its parameters are not the witness's";
    } else if (shown.source == to_string(motion_source::inside_box)) {
        bool const is_inside = std::ranges::any_of(stored.rows, [&](paved_box const& row) {
            return row.verdict == box_verdict::inside && within_printed(result.parameters, row.set);
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
            bool const unbounded =
                std::isinf(rows[k].model.lower()) && std::isinf(rows[k].model.upper());
            all = all && (unbounded || (there && traits::subset(known.outputs[k].value, stated)));
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
    auto const none = [](io_detail::output_row const& row) {
        return std::isinf(row.model.lower()) && std::isinf(row.model.upper());
    };
    std::size_t stated = 0;
    for (auto const& own : rows)
        stated += own.size() - static_cast<std::size_t>(std::ranges::count_if(own, none));
    if (stored.shown->source.empty() && stated > 0)
        return {what, outcome::refuted, "outputs of no motion"};
    if (!stored.shown->source.empty()) {
        auto const boxes = io_detail::boxes_of_shown(problem, stored, fault);
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
