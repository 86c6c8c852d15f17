// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_VIEW_HPP
#define SIVID_REPORT_DIAGNOSIS_VIEW_HPP

#include <sivid/report/draw/candidate_chart.hpp>
#include <sivid/report/draw/comparison_plot.hpp>
#include <sivid/report/draw/missing_rate_plot.hpp>
#include <sivid/report/identification_view.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// What the page of a diagnosis shows: strings, numbers and plain vectors only, so that any
/// diagnosis can be described. Whoever fills it answers for the proofs: ranges named inflation,
/// hull, missing or shrink are taken as proved and printed outward; single numbers are estimates.
namespace sivid::report {

/// Whether some parameter explains the data used for fitting.
enum class gap_state {
    absent,  ///< proved: one does
    present, ///< proved: none does
    open
};

enum class answer_state {
    nothing,
    effects,
    unexplained, ///< everything planned was tried
    open         ///< some of it was not, and nothing that was explains the data
};

/// A number with a name: its value, what is proved of it, what was allowed.
struct estimate_view {
    std::string name{};
    std::string unit{};
    double value = std::numeric_limits<double>::quiet_NaN();
    range hull{};  ///< proved to contain every value that explains the data; empty: nothing proved
    range prior{}; ///< empty: not stated
    bool verified = false; ///< the value is that of a witness that explains the data; else a fit's
};

/// A product of constants, under its formula.
struct combination_estimate {
    estimate_view product{};
    bool of_effects = false; ///< a parameter of an effect is a factor
};

/// A constant at the end of its prior.
struct end_view {
    std::vector<std::string> effects{}; ///< of the model whose constant it is
    estimate_view constant{};
    bool upper = false;
};

/// How many candidates of a kind were tried, of those planned.
struct tried_view {
    std::size_t tried = 0, planned = 0;
};

struct window_view {
    std::string scenario{};
    double from = 0;
    double to = 0;
};

/// A place where model and robot disagree.
struct place_view {
    std::string kind{}; ///< equation, sensor or input
    std::string name{};
    bool proved = false;
    window_view where{};
    range missing{};                  ///< proved; empty: nothing proved
    std::optional<double> estimate{}; ///< the same, estimated
    std::string unit{};
    std::string law{};
    std::string regime{};
    std::vector<std::string> alternatives{};
};

/// An equation and sensors that cannot hold together.
struct relation_view {
    std::string equation{};
    std::vector<std::string> sensors{};
    bool proved = false;
    std::vector<window_view> windows{};
    std::vector<std::string> assumptions{};
};

/// How well the hold-out data are met, before and after.
struct holdout_view {
    range inflation_before{};
    range inflation_after{};
    /// The same over all parameters that do as well on the fit data; empty: not known.
    range over_fits_before{}, over_fits_after{};
    struct channel {
        std::string name{};
        std::string unit{};
        double rmse_before = std::numeric_limits<double>::quiet_NaN();
        double rmse_after = std::numeric_limits<double>::quiet_NaN();
    };
    std::vector<channel> channels{};
    double covered_before = std::numeric_limits<double>::quiet_NaN(); ///< share of the samples
    double covered_after = std::numeric_limits<double>::quiet_NaN();
    double width_before = std::numeric_limits<double>::quiet_NaN(); ///< in error bounds
    double width_after = std::numeric_limits<double>::quiet_NaN();
};

/// Effects that might be what the model leaves out; without effects it is the model itself.
struct candidate_view {
    std::vector<std::string> effects{};
    candidate_state state = candidate_state::open;
    range inflation{}; ///< proved; empty or [0, infinity): nothing proved
    double fitted = 0; ///< inflation of the best fit found; not proved; 0: no fit
    std::vector<estimate_view> parameters{};
    std::optional<witness_view> witness{};
    std::optional<holdout_view> holdout{};
    std::vector<std::string> assumptions{};
};

/// One scenario: the data, the model's best fit, and that with the effect.
struct compared_scenario {
    std::string name{};
    bool holdout = false; ///< its data are used neither for fits nor for choices
    std::vector<comparison_series> channels{};
};

/// What the gap is in one scenario or channel.
struct share_of_gap {
    std::string name{};
    range inflation{}; ///< proved; empty: nothing proved
    double fitted = std::numeric_limits<double>::quiet_NaN();
};

/// Measurements that alone stand against the model: one parameter explains all others.
struct confined_view {
    std::string channel{};                ///< empty: every one
    std::vector<std::string> scenarios{}; ///< none: every one
    range factor{}; ///< by which these bounds must grow until all data are explained; proved
    /// What they grow with where that is much likelier than a factor, and the share of it (s, of a
    /// rate); proved to explain.
    enum class growth { times, value, rate };
    growth grows = growth::times;
    range coefficient{};
    double together_for = 0; ///< seconds over which its errors go together; 0: not seen
    double step = 0;         ///< of its readings, where that is too coarse for its bounds; else 0
    bool cut_off = false;    ///< a whole step explains all data, half of one does not
    std::string unit{};      ///< of the channel
};

/// What is left of the gap with the candidate that comes closest, when none explains the data.
struct remainder_view {
    std::vector<std::string> effects{}; ///< of that candidate
    range inflation{};                  ///< proved
    double fitted = 0;                  ///< of its best fit; not proved; 0: no fit
    std::vector<place_view> places{};   ///< of the model with these effects
    std::vector<missing_rate_series> missing_rates{};
};

struct next_experiment_view {
    std::string manoeuvre{};
    std::vector<named_value> settings{};
    double separation = 0; ///< predicted, in error bounds
    bool recorded = false; ///< one of the manoeuvres at hand, again with finer bounds
};

struct diagnosis_view {
    std::string dataset{};
    std::string model{};
    std::map<std::string, std::string>
        meanings{}; ///< of effects: "a first-order lag of the rudder"

    gap_state gap = gap_state::open;
    range inflation{};              ///< proved
    double fitted = 0;              ///< inflation of the model's best fit, not proved; 0: no fit
    std::vector<std::string> why{}; ///< why it is open whether there is a gap
    std::vector<share_of_gap> scenario_gaps{}, channel_gaps{};
    std::vector<confined_view> confined{};
    std::vector<place_view> places{}; ///< most important first
    std::vector<relation_view> relations{};

    answer_state answer = answer_state::nothing;
    tried_view singles{}, pairs{}, larger{};
    std::vector<std::string> effects{};           ///< the answer
    std::vector<std::string> formulas{};          ///< that a simulator has to take
    std::map<std::string, std::string> symbols{}; ///< in them, by parameters of effects
    std::vector<std::vector<std::string>> indistinguishable{};
    std::vector<candidate_view> candidates{};         ///< best first
    std::vector<estimate_view> constants{};           ///< of the model of the answer, all of them
    std::vector<combination_estimate> combinations{}; ///< of them, told better than its factors
    std::vector<end_view> at_ends{};
    std::vector<std::string> unobservable{};
    std::vector<std::string> absorbed{};  ///< effects that the priors are wide enough to take up
    range shrink_fit{}, shrink_holdout{}; ///< proved shares of the gap; empty: not applicable
    range shrink_over_fits{}; ///< on held-out data, for every parameter that explains the others
    std::optional<remainder_view> remainder{};
    std::optional<next_experiment_view> next{};

    std::vector<missing_rate_series> missing_rates{};
    std::vector<compared_scenario> scenarios{};
    std::string after{}; ///< what the second model there is; empty: with the answer

    std::vector<std::string> assumptions{};
    std::vector<std::string> warnings{};
    bool interrupted = false;
    double seconds = 0;
    std::string version{};
    std::string date{};
    std::string machine{};
    std::string command{};
};

/// The candidate with exactly these effects, in any order; nothing when it was not tried.
[[nodiscard]] inline candidate_view const* find_candidate(diagnosis_view const& v,
                                                          std::vector<std::string> effects) {
    std::sort(effects.begin(), effects.end());
    for (candidate_view const& c : v.candidates) {
        auto sorted = c.effects;
        std::sort(sorted.begin(), sorted.end());
        if (sorted == effects) return &c;
    }
    return nullptr;
}

/// The candidate that is the answer; nothing when there is none.
[[nodiscard]] inline candidate_view const* answer_of(diagnosis_view const& v) {
    return v.answer == answer_state::effects && !v.effects.empty() ? find_candidate(v, v.effects)
                                                                   : nullptr;
}

/// The answer, then its alternatives, then the others in their order; at most so many.
[[nodiscard]] inline std::vector<candidate_view const*> foremost(diagnosis_view const& v,
                                                                 std::size_t most) {
    std::vector<candidate_view const*> out;
    auto const add = [&](candidate_view const* c) {
        if (c != nullptr && out.size() < most &&
            std::find(out.begin(), out.end(), c) == out.end()) {
            out.push_back(c);
        }
    };
    add(answer_of(v));
    for (auto const& o : v.indistinguishable) add(find_candidate(v, o));
    add(find_candidate(v, {})); // the model as it is: what the others are measured by
    for (candidate_view const& c : v.candidates) add(&c);
    std::sort(out.begin(), out.end()); // the order of the view: best first
    return out;
}

} // namespace sivid::report

#endif
