// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_IDENTIFICATION_REPORT_IPP
#define SIVID_REPORT_IMPL_IDENTIFICATION_REPORT_IPP

#include <sivid/report/identification_report.hpp>

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/paving/excluded_between.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/report/draw/paving_plot.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/version.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <memory>
#include <utility>

namespace sivid::report {

namespace detail {

inline std::string brief(double x, rounding way = rounding::nearest) {
    return rounded_text(x, way, {.significant = 2});
}

/// "L * k, Sg / k" or "a + s, b - 2 s": what may move together.
inline std::string motion_text(free_motion const& m, std::vector<unknown_quantity> const& names) {
    bool const scales = m.kind == motion_kind::scaling;
    std::string text;
    for (std::size_t c = 0; c < m.weights.size(); ++c) {
        int const w = m.weights[c];
        if (w == 0) continue;
        auto const size = std::to_string(std::abs(w));
        if (!text.empty()) text += ", ";
        text += names[c].name + (scales ? (w > 0 ? " * k" : " / k") : (w > 0 ? " + " : " - "));
        if (std::abs(w) > 1) text += scales ? "^" + size : size + " ";
        if (!scales) text += "s";
    }
    return text;
}

/// The components that matter, largest first: "L +1, Sg -0.12".
inline std::string direction_text(sensitive_direction const& d,
                                  std::vector<unknown_quantity> const& names) {
    std::vector<std::size_t> order;
    for (std::size_t c = 0; c < d.components.size(); ++c) {
        if (std::abs(d.components[c]) >= 0.05) order.push_back(c);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(d.components[a]) > std::abs(d.components[b]);
    });
    std::string text;
    for (auto const c : order) {
        double const x = d.components[c];
        if (!text.empty()) text += ", ";
        text += names[c].name + (x < 0 ? " -" : " +") + brief(std::abs(x));
    }
    return text;
}

inline std::string name_of(run_reach::cause const& c) {
    return c.start ? "the start of " + c.name : formula_text(c.name);
}

/// A time that was enclosed, rounded down; what was meant is the decimal close to it.
inline std::string at_least_brief(double time) { return brief(time * (1 + 1e-12), rounding::down); }

/// "62 % of it by D33/Iz, 20 % by the start of r"
inline std::string causes_text(run_reach const& r) {
    std::string all;
    for (std::size_t k = 0; k < std::min<std::size_t>(r.causes.size(), 3); ++k) {
        auto const& c = r.causes[k];
        all += (k == 0 ? "" : ", ") + brief(100 * c.share) + (k == 0 ? " % of it by " : " % by ") +
               name_of(c);
    }
    return all;
}

/// Where trajectories end, and why.
inline std::string end_text(run_reach const& r) {
    auto const carried = r.until - r.begin;
    auto words = carried > 0 ? "over all that is left, trajectories are enclosed for " +
                                   at_least_brief(carried) + " of " + brief(r.end - r.begin) + " " +
                                   r.time_unit + " only; there "
                             : std::string{"over all that is left, trajectories are enclosed "
                                           "nowhere; at the start "};
    words += r.state + " is " + brief(r.width) + unit_suffix(r.unit) + " wide";
    return words + (r.causes.empty() ? "" : " (" + causes_text(r) + ")");
}

inline std::string what_ends(run_reach const& r) {
    auto const carried = r.until - r.begin;
    auto words = end_text(r) + ". Scenarios shorter than " +
                 brief(carried > 0 ? carried : r.end - r.begin) + " " + r.time_unit;
    if (!r.causes.empty()) words += ", or a narrower range for " + name_of(r.causes.front()) + ",";
    return words + " may tell more";
}

/// What is left moves measurements less than their bounds are wide.
inline std::string what_hardly_moves(run_reach const& r) {
    auto words =
        "parameters and starts that are left move no measurement" +
        (r.instants < r.measured
             ? " (of " + count_text(r.instants) + " instants among " + count_text(r.measured) + ")"
             : std::string{}) +
        (r.complete() ? ""
                      : " of the first " + at_least_brief(r.until - r.begin) + " " + r.time_unit) +
        " by more than " + rounded_text(r.spread * (1 + 1e-9), rounding::up, {.significant = 2}) +
        " of its error bound: such data hardly tell them apart; smaller bounds, or "
        "motions that depend more on them, would";
    return words + (r.complete() ? "" : ". Beyond that, " + end_text(r));
}

/// Empty where nothing but the boxes' size is in the way.
inline std::string why_of(run_reach const& r, bool ended_by_itself) {
    if (!r.complete() && r.interrupted)
        return "no time was left to see how far trajectories are enclosed: a larger budget may "
               "tell";
    if (r.until > r.begin && r.spread < 1) return what_hardly_moves(r);
    if (!r.complete()) return what_ends(r);
    if (!(r.lost < 1))
        return "trajectories over all that is left blur by " +
               (std::isfinite(r.lost) ? brief(r.lost) : std::string{"any number of"}) +
               " error bounds: more time, or shorter scenarios, may tell more";
    if (ended_by_itself) return {};
    return "trajectories over all that is left are enclosed to the end, and parameters and starts "
           "move measurements by up to " +
           brief(r.moved) + " error bounds: a larger budget may tell more";
}

/// What the equations divide by, and that it is, or may be, zero.
inline std::string divisor_text(divisor const& d) {
    bool const one = d.equations.size() == 1;
    auto const near =
        joined(d.near, ", ", [](auto const& n) { return n.first + " = " + brief(n.second); });
    return std::string{one ? "The equation of " : "The equations of "} + enumeration(d.equations) +
           (one ? " divides by " : " divide by ") +
           (d.formula.empty() ? "a long expression" : d.formula) +
           (d.zeros == zeros::some ? ", which is zero somewhere" : ", which may be zero") +
           " within the prior and the limits of the states" +
           (near.empty() ? "" : " (near " + near + ")") +
           ": no trajectory is enclosed there. A prior, or limits, without it may tell more";
}

/// What no method could exclude; empty where that is not much.
inline std::string proved_inside_text(identification const& found) {
    double const inside = found.paving.inner_volume().lower();
    if (!(inside >= 0.05)) return {};
    return "At least " + at_least_percent(std::min(inside, 1.0)) +
           " of the prior's volume is proved to explain the data: nothing of it can be excluded "
           "by them. Smaller error bounds, further measurements, or motions that depend more on "
           "the parameters would";
}

/// A share of the prior, widened a little where its bounds agree to many digits, so that it reads
/// well; still an enclosure.
inline range shown_share(interval const& volume) {
    range const r = share_of_whole(volume);
    double const more = 5e-4 * r.hi;
    return r.lo == r.hi || r.hi - r.lo > more
               ? r
               : range{std::max(0.0, r.lo - more), std::min(1.0, r.hi + more)};
}

/// Fills the view of one identification step by step.
class report_filler {
public:
    report_filler(identification_problem const& problem, identification const& found,
                  explaining_motion const* motion, identification_report_options const& options)
        : problem_{problem}, found_{found}, motion_{motion}, options_{options} {}

    [[nodiscard]] identification_view view() {
        add_result();
        add_parameters();
        add_combinations();
        add_inside_box();
        add_witness();
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e)
            view_.scenarios.push_back(scenario(e));
        add_warnings();
        add_meanings();
        add_pavings();
        return std::move(view_);
    }

private:
    static constexpr std::size_t most_pavings = 6; ///< projections on pairs of parameters

    [[nodiscard]] model_description const& about() const { return problem_.model.about; }
    [[nodiscard]] std::vector<std::string> const& names() const { return problem_.choice.unknown; }
    [[nodiscard]] std::string unit_of(std::size_t j) const {
        return about().constants[index_of(about().constants, names()[j], "constant")].unit;
    }

    /// @param assumption  as `input_assumption` words it, with what is bridged after a semicolon
    [[nodiscard]] static std::string sentence_of(std::string const& assumption) {
        auto const end = std::min(assumption.find("; "), assumption.size());
        auto const bridged =
            end == assumption.size()
                ? std::string{}
                : " Samples are missing, and nobody knows what the input did there: " +
                      assumption.substr(end + 2) + ".";
        if (assumption.starts_with("inputs exact")) {
            return "The recorded inputs are exact, at their samples and in between as the data set "
                   "states." +
                   bridged;
        }
        if (assumption.starts_with("inputs within their stated errors")) {
            return "At every time the true inputs lie within their stated errors of the recorded "
                   "ones, in whatever way they vary there; inputs without a stated error are "
                   "exact." +
                   bridged;
        }
        return assumption;
    }

    void add_result() {
        view_.dataset = options_.dataset;
        view_.model = about().name;
        view_.time_unit = about().time_unit;
        view_.verdict = found_.verdict == verdict::consistent     ? outcome::proved
                        : found_.verdict == verdict::inconsistent ? outcome::refuted
                                                                  : outcome::undecided;
        view_.volume_inner = shown_share(found_.paving.inner_volume());
        view_.volume_outer = shown_share(found_.paving.outer_volume());
        view_.excluded = std::max(0.0, 1 - found_.paving.outer_volume().upper());
        for (std::string const& a : found_.assumptions) view_.assumptions.push_back(sentence_of(a));
        std::size_t budget = 0;
        for (experiment const& e : problem_.experiments) budget += e.outliers;
        view_.assumptions.push_back(
            budget == 0 ? "Every measurement lies within its stated bound of the true value."
                        : "Every measurement lies within its stated bound of the true value, but "
                          "for the outliers allowed.");
        view_.assumptions.push_back("The constants that are not listed as parameters have exactly "
                                    "their stated values.");
        for (auto& words : derivation_words(problem_.model, problem_.choice)) {
            view_.assumptions.push_back(std::move(words));
        }
        view_.assumptions.insert(view_.assumptions.end(), options_.further_assumptions.begin(),
                                 options_.further_assumptions.end());
        if (found_.fewest) {
            view_.proved.push_back(
                fewest_outliers_sentence(found_.fewest->total.least, found_.fewest->total.most));
        }
        view_.statistics = {
            found_.seconds, found_.boxes, found_.integrations,
            std::string{to_string(found_.reason)} +
                (found_.by_clock ? " by the clock: a faster machine may say more" : "")};
        view_.tried = found_.journal;
        view_.statistics.why = reach_words(problem_, found_);
        view_.footer = {"sivid " + std::string{version}, options_.date, options_.machine,
                        options_.command};
    }

    void add_parameters() {
        for (std::size_t j = 0; j < names().size(); ++j) {
            auto const meaning = options_.meanings.find(names()[j]);
            view_.parameters.push_back({names()[j], unit_of(j), problem_.prior[j], found_.hull[j],
                                        meaning == options_.meanings.end() ? "" : meaning->second,
                                        excluded_between(found_.paving, found_.hull, j)});
        }
    }

    void add_combinations() {
        for (combination_hull const& c : found_.combinations) {
            std::vector<std::string> members;
            for (std::size_t const j : found_.entangled) {
                if (c.what.exponents[j] != 0) members.push_back(names()[j]);
            }
            std::string note;
            if (members.size() > 1) {
                note = enumeration(members) + " are known only through " +
                       (found_.combinations.size() == 1 ? formula_text(c.what.formula)
                                                        : std::string{"such combinations"}) +
                       " on these data: the model's equations contain them in no other way, so "
                       "that no measurement can tell them apart.";
            }
            view_.combinations.push_back(
                {c.what.formula, c.what.unit, c.hull, c.what.over(problem_.prior), note});
        }
    }

    /// In products where the search ran there.
    void add_inside_box() {
        auto const p = found_.products ? paving_of_products() : paving_of_parameters();
        auto const* const box = p.paving->largest(box_verdict::inside);
        if (box == nullptr) return;
        std::vector<std::string> sides;
        for (std::size_t k = 0; k < box->size(); ++k) {
            auto const range = inward_text((*box)[k]);
            if (!range) return;
            auto const unit = unit_text(p.sides[k].unit);
            sides.push_back(p.sides[k].label + " in " + *range + (unit.empty() ? "" : " " + unit));
        }
        view_.inside_box = enumeration(sides);
    }

    void add_witness() {
        if (!found_.witness) return;
        named_witness w;
        for (std::size_t j = 0; j < names().size(); ++j) {
            w.parameters.push_back({names()[j], unit_of(j), found_.witness->parameters[j]});
        }
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e) {
            named_witness::start start{problem_.experiments[e].name, {}};
            for (std::size_t i = 0; i < about().states.size(); ++i) {
                start.states.push_back(
                    {about().states[i].name, about().states[i].unit, found_.witness->starts[e][i]});
            }
            w.starts.push_back(std::move(start));
        }
        view_.witness = std::move(w);
    }

    void add_warnings() {
        for (std::size_t e = 0; motion_ != nullptr && e < problem_.experiments.size(); ++e) {
            if (auto const& why = motion_->tubes[e]->failure()) {
                view_.warnings.push_back(
                    "The drawn enclosure of scenario " + problem_.experiments[e].name +
                    " ends early: " +
                    why->message(about().states[why->component].name, about().time_unit) + ".");
            }
        }
    }

    void add_meanings() {
        if (found_.witness) {
            view_.reference_meaning = "plain numeric integration at the witness";
        } else if (found_.guess) {
            view_.reference_meaning = "plain numeric integration at the best fit found, about "
                                      "which nothing is proved";
        }
        if (motion_ == nullptr) return;
        if (motion_->source == motion_source::inside_box) {
            std::vector<std::string> sides;
            for (std::size_t j = 0; j < names().size(); ++j)
                sides.push_back(names()[j] + " in " + outward_text(motion_->parameters[j]) +
                                unit_suffix(unit_of(j)));
            view_.tube_meaning = "all motions of a box of parameters that is proved to explain the "
                                 "data, about " +
                                 joined(sides);
        } else {
            view_.tube_meaning = motion_->source == motion_source::witness
                                     ? "the motion of the witness"
                                     : "the motion of the best fit found, which is not proved to "
                                       "explain the data";
        }
    }

    [[nodiscard]] named_paving paving_of_parameters() const {
        named_paving p{.paving = &found_.paving};
        for (std::size_t j = 0; j < names().size(); ++j) {
            p.sides.push_back({names()[j], unit_of(j), problem_.prior[j]});
            p.hull.push_back(found_.hull[j]);
        }
        if (found_.witness) p.witness = found_.witness->parameters;
        return p;
    }

    /// In the coordinates that the search ran in.
    [[nodiscard]] named_paving paving_of_products() const {
        auto const& map = found_.products->map;
        named_paving p{.paving = &found_.products->paving};
        auto const hull = map.forward(found_.hull);
        for (std::size_t k = 0; k < map.sides().size(); ++k) {
            auto const& side = map.sides()[k];
            range const prior = map.problem().prior[k];
            p.sides.push_back(
                side.product ? axis{formula_text(side.product->formula), side.product->unit, prior}
                             : axis{names()[side.parameter], unit_of(side.parameter), prior});
            p.hull.push_back(hull[k]);
        }
        if (found_.witness) p.witness = mid(map.forward(point_box(found_.witness->parameters)));
        return p;
    }

    /// Those of products, and of parameters that are known only through one, come first.
    void add_pavings() {
        view_.pavings = projections(paving_of_parameters(), found_.entangled, most_pavings);
        if (!found_.products) return;
        std::vector<std::size_t> products;
        auto const& sides = found_.products->map.sides();
        for (std::size_t k = 0; k < sides.size(); ++k)
            if (sides[k].product) products.push_back(k);
        view_.product_pavings = projections(paving_of_products(), products, most_pavings);
    }

    /// What the page shows of one experiment: its measurements, the tube, the motion in the plane.
    [[nodiscard]] scenario_view scenario(std::size_t e) const {
        experiment const& s = problem_.experiments[e];
        record const samples = sorted(s.measurements);
        scenario_view out{
            .name = s.name, .measurements = samples.size(), .outlier_budget = s.outliers};
        auto const outputs = motion_ != nullptr ? motion_->outputs[e] : std::vector<interval>{};
        std::vector<channel_series> all;
        for (auto const& c : about().channels)
            all.push_back({.name = c.name, .unit = c.unit, .time_unit = about().time_unit});
        for (std::size_t i = 0; i < samples.size(); ++i) {
            measured_sample m{
                .time = samples[i].time, .value = samples[i].bound, .state = state_of(e, i)};
            if (i < outputs.size() && is_finite(range{outputs[i]})) m.enclosure = outputs[i];
            all[samples[i].channel].measured.push_back(m);
        }
        std::vector<std::size_t> measured;
        for (std::size_t c = 0; c < all.size(); ++c) {
            if (!all[c].measured.empty()) measured.push_back(c);
        }
        add_tube(e, all);
        auto const line = add_reference(e, all);
        if (options_.plane) out.plane = plane(all, samples, line);
        for (std::size_t const c : measured) out.channels.push_back(std::move(all[c]));
        return out;
    }

    [[nodiscard]] sample_state state_of(std::size_t e, std::size_t i) const {
        for (forced_outlier const& f : found_.forced) {
            if (f.experiment == e && f.measurement == i) return sample_state::forced_outlier;
        }
        bool const violated = found_.witness && e < found_.witness->violated.size() &&
                              i < found_.witness->violated[e].size() &&
                              found_.witness->violated[e][i];
        return violated ? sample_state::suspect : sample_state::regular;
    }

    void add_tube(std::size_t e, std::vector<channel_series>& all) const {
        if (motion_ == nullptr) return;
        observer<interval> look(*motion_->flows[e]);
        ensemble<interval> const family(motion_->starts[e], motion_->parameters);
        look.set_ensemble(family);
        for (auto const& step : motion_->tubes[e]->steps()) {
            if (options_.keep_going && !options_.keep_going()) return;
            auto const y = look.over(step.from, interval(step.from, step.to), step.swept);
            for (std::size_t c = 0; c < all.size(); ++c) {
                if (is_finite(range{y[c]})) all[c].tube.push_back({step.from, step.to, y[c]});
            }
        }
    }

    /// The line that is not validated. @returns its times and channels
    [[nodiscard]] approximate_trajectory add_reference(std::size_t e,
                                                       std::vector<channel_series>& all) const {
        approximate_trajectory line;
        bool const guessed = found_.guess && !found_.guess->parameters.empty();
        if (motion_ == nullptr || (!found_.witness && !guessed)) return line;
        auto const& s = problem_.experiments[e];
        std::vector<double> times;
        for (int k = 0; k <= 240; ++k) times.push_back(s.begin + (s.end() - s.begin) * k / 240);
        auto const& point = found_.witness ? found_.witness->parameters : found_.guess->parameters;
        auto const& start = found_.witness ? found_.witness->starts[e] : found_.guess->starts[e];
        try {
            auto const& f = *motion_->flows[e];
            line = simulate(std::make_shared<approximate_model const>(f.model()), f.inputs(), start,
                            point, s.begin, times, {1e-9, options_.keep_going});
        } catch (std::exception const&) {
            return {}; // a missing line is no loss: nothing rests on it
        }
        for (std::size_t k = 0; k < line.outputs.size(); ++k) {
            for (std::size_t c = 0; c < all.size(); ++c)
                all[c].reference.push_back({line.times[k], line.outputs[k][c]});
        }
        return line;
    }

    [[nodiscard]] std::optional<plane_series> plane(std::vector<channel_series> const& all,
                                                    record const& samples,
                                                    approximate_trajectory const& line) const {
        auto const channel = [&](std::string const& name) {
            auto const found = std::find_if(
                all.begin(), all.end(), [&](channel_series const& c) { return c.name == name; });
            return static_cast<std::size_t>(found - all.begin());
        };
        auto const x = channel(options_.plane->x), y = channel(options_.plane->y);
        if (x == all.size() || y == all.size()) return std::nullopt;
        plane_series out{.x_name = all[x].name, .y_name = all[y].name, .unit = all[x].unit};
        for (std::size_t k = 0; k < std::min(all[x].tube.size(), all[y].tube.size()); ++k)
            out.tube.push_back({all[x].tube[k].value, all[y].tube[k].value});
        for (std::size_t i = 0; i < samples.size(); ++i) {
            for (std::size_t k = i + 1; samples[i].channel == x && k < samples.size() &&
                                        samples[k].time == samples[i].time;
                 ++k) {
                if (samples[k].channel == y)
                    out.measured.push_back({samples[i].bound, samples[k].bound});
            }
        }
        auto const heading = channel(options_.plane->heading);
        for (std::size_t k = 0; k < line.outputs.size(); ++k) {
            auto const& now = line.outputs[k];
            out.reference.push_back({now[x], now[y]});
            if (heading < all.size() && k % 30 == 15)
                out.poses.push_back({now[x], now[y], now[heading]});
        }
        bool const nothing = out.measured.empty() && out.tube.empty();
        return nothing ? std::nullopt : std::optional{std::move(out)};
    }

    identification_problem const& problem_;
    identification const& found_;
    explaining_motion const* motion_;
    identification_report_options const& options_;
    identification_view view_;
};

} // namespace detail

SIVID_DECL std::vector<std::string> identifiability_words(identifiability const& found) {
    auto const count = [](std::size_t n, std::string const& what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    std::vector<std::string> lines;
    auto const n = found.unknowns.size();
    std::string ranks =
        count(found.outputs, "measured output") + " and " + count(n, "unknown") + ": rank ";
    if (found.least_rank == found.most_rank) {
        ranks += std::to_string(found.least_rank) + ", proved";
    } else {
        ranks += "at least " + std::to_string(found.least_rank) + " and at most " +
                 std::to_string(found.most_rank) + ", proved; " +
                 std::to_string(found.approximate_rank) + " in floating point";
    }
    if (found.missing > 0) ranks += "; " + count(found.missing, "output") + " not reached";
    lines.push_back(std::move(ranks));
    for (auto const& m : found.free) {
        auto const moving =
            std::count_if(m.weights.begin(), m.weights.end(), [](int w) { return w != 0; });
        lines.push_back("free: " + detail::motion_text(m, found.unknowns) +
                        (moving == 1 ? ": it does not act on the outputs" : "") +
                        (m.proved ? " (by the equations)" : " (numerically, not proved)"));
    }
    for (auto const& m : found.nearly_free) {
        lines.push_back("hardly noticed: " + detail::motion_text(m, found.unknowns) +
                        " across the prior moves no output by more than " +
                        rounded_text(m.noticed, rounding::up, {.significant = 2}) +
                        " of its error bound (to first order)");
    }
    if (!found.fixed.empty())
        lines.push_back("these act through " + joined(found.fixed, ", ", &fixed_formula::formula) +
                        " alone");
    if (!found.nearly_fixed.empty())
        lines.push_back("these act nearly through " +
                        joined(found.nearly_fixed, ", ", &fixed_formula::formula) + " alone");
    std::size_t const told = std::min(found.approximate_rank, found.directions.size());
    for (std::size_t k = told - std::min<std::size_t>(told, 3); k < told; ++k) {
        auto const& d = found.directions[k];
        lines.push_back("along " + detail::direction_text(d, found.unknowns) +
                        " of the prior's width an output moves by " + detail::brief(d.noticed) +
                        " error bounds (to first order)");
    }
    return lines;
}

SIVID_DECL std::vector<std::string> reach_words(std::vector<run_reach> const& reach,
                                                bool ended_by_itself) {
    constexpr std::size_t most = 6;
    std::vector<std::string> result;
    for (auto const& r : reach) {
        if (&r - reach.data() == most && reach.size() > most) {
            result.push_back(count_text(reach.size() - most) +
                             " further scenarios: see \xE2\x80\x9Creach\xE2\x80\x9D in the "
                             "result file");
            break;
        }
        auto const words = detail::why_of(r, ended_by_itself);
        if (!words.empty()) result.push_back(r.scenario + ": " + words);
    }
    return result;
}

SIVID_DECL std::vector<std::string> reach_words(identification_problem const& problem,
                                                identification const& found) {
    std::vector<std::string> result;
    if (!found.excludes_little()) return result;
    if (auto words = detail::proved_inside_text(found); !words.empty())
        result.push_back(std::move(words));
    if (found.reach.empty() && found.reason == stop_reason::time_budget &&
        !problem.model.has_memory())
        result.push_back("No time was left to see why: a larger budget may tell");
    for (auto const& d : found.divisors) result.push_back(detail::divisor_text(d));
    for (auto& words : reach_words(found.reach, is_complete(found.reason)))
        result.push_back(std::move(words));
    return result;
}

SIVID_DECL identification_view view_of(identification_problem const& problem,
                                       identification const& found, explaining_motion const* motion,
                                       identification_report_options const& options) {
    return detail::report_filler(problem, found, motion, options).view();
}

SIVID_DECL comparison_row comparison_of(std::string name, identification const& found, bool chosen,
                                        std::string note) {
    return {std::move(name),
            found.seconds,
            found.boxes,
            found.integrations,
            detail::shown_share(found.paving.inner_volume()),
            detail::shown_share(found.paving.outer_volume()),
            std::move(note),
            chosen};
}

} // namespace sivid::report

#endif
