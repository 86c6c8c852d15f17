// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_VIEW_HPP
#define SIVID_REPORT_DIAGNOSIS_VIEW_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/report/draw/time_plot.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

/// What the page of a diagnosis shows: the diagnosis itself, and what is drawn and said beside it.
/// Single numbers are estimates; what the diagnosis calls proved is printed outward.
namespace sivid::report {

struct diagnosis_report_options {
    std::string dataset{};
    std::string model{};
    std::map<std::string, std::string>
        meanings{};         ///< of effects: "a first-order lag of the rudder"
    double base_fitted = 0; ///< inflation of the best fit of the model as it is; 0: not known
    std::vector<std::string> warnings{};
    std::string date{}, machine{}, command{};
};

/// One scenario: the data, the model's best fit, and that with the effect.
struct compared_scenario {
    std::string name{};
    bool holdout = false; ///< its data are used neither for fits nor for choices
    std::vector<channel_series> channels{};
};

/// What one equation lacks in one scenario, over time: an estimate with its band, proved windows.
struct missing_rate {
    std::string equation{}, scenario{};
    channel_series rate{};
};

/// What the page draws beside the diagnosis.
struct diagnosis_plot_data {
    std::vector<compared_scenario> scenarios{};
    std::vector<missing_rate> missing_rates{};
    std::vector<missing_rate> remaining_rates{}; ///< with the closest candidate
};

/// A diagnosis whose causes include the model as it is (`view_of`).
struct diagnosis_view : diagnosis {
    diagnosis_report_options about{};
    diagnosis_plot_data plots{};
    std::vector<std::string> why{}; ///< why it is open whether there is a gap
};

/// A number of a candidate.
struct shown_estimate {
    named_estimate number{};
    bool verified = false; ///< the value is that of a witness that explains the data; else a fit's
};

/// The parameters of a candidate's effects, then when these begin and end: at the witness where the
/// candidate is proved to explain the data, for what is proved of it is so there, wherever the fit
/// lies.
[[nodiscard]] inline std::vector<shown_estimate> parameters_of(cause const& c) {
    bool const explains = c.verdict == cause_verdict::explains;
    std::vector<shown_estimate> out;
    for (named_estimate const& e : c.parameters) {
        out.push_back({e});
        if (!explains || !c.witness) continue;
        for (named_estimate const& w : c.witness->parameters)
            if (w.name == e.name) out.back().number.value = w.value, out.back().verified = true;
    }
    auto const times = [&](char const* what, std::vector<named_estimate> const& all) {
        for (named_estimate const& e : all) {
            out.push_back({e, explains});
            out.back().number.name = what + e.name;
        }
    };
    times("onset in ", c.onsets);
    times("end in ", c.ends);
    return out;
}

/// The candidate with exactly these effects, in any order; nothing when it was not tried.
[[nodiscard]] inline cause const* find_candidate(diagnosis_view const& v,
                                                 std::vector<std::string> effects) {
    std::sort(effects.begin(), effects.end());
    for (cause const& c : v.causes) {
        auto sorted = c.effects;
        std::sort(sorted.begin(), sorted.end());
        if (sorted == effects) return &c;
    }
    return nullptr;
}

/// The candidate that is the answer; nothing when there is none.
[[nodiscard]] inline cause const* answer_of(diagnosis_view const& v) {
    return v.answer == answer_kind::effects && !v.effects.empty() ? find_candidate(v, v.effects)
                                                                  : nullptr;
}

/// The answer, then its alternatives, then the others in their order; at most so many.
[[nodiscard]] inline std::vector<cause const*> foremost(diagnosis_view const& v, std::size_t most) {
    std::vector<cause const*> out;
    auto const add = [&](cause const* c) {
        if (c != nullptr && out.size() < most &&
            std::find(out.begin(), out.end(), c) == out.end()) {
            out.push_back(c);
        }
    };
    add(answer_of(v));
    for (auto const& o : v.indistinguishable) add(find_candidate(v, o));
    add(find_candidate(v, {})); // the model as it is: what the others are measured by
    for (cause const& c : v.causes) add(&c);
    std::sort(out.begin(), out.end()); // the order of the view: best first
    return out;
}

} // namespace sivid::report

#endif
