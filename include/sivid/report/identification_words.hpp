// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_WORDS_HPP
#define SIVID_REPORT_IDENTIFICATION_WORDS_HPP

#include <sivid/report/identification_view.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// The sentences of an identification's page. They say no more than the view's proven ranges do.
namespace sivid::report {

/// "Sv = 0.22 m^2, L = 0.3 m"
/// The values are exact: a witness can be checked again from the text.
inline std::string values_text(std::vector<named_estimate> const& all) {
    std::string out;
    for (named_estimate const& v : all) {
        out += (out.empty() ? std::string{} : std::string{", "}) + v.name + " = " +
               given_text(v.value) + unit_suffix(v.unit);
    }
    return out;
}

/// What is left of the prior's range, between the ends of the hull, too, as a share of its width;
/// rounded up; NaN when there is no such number.
inline double share_of_prior(parameter_view const& p) {
    if (!is_finite(p.prior) || is_empty(p.hull) || !(p.prior.hi > p.prior.lo)) return std::nan("");
    double const share = (p.hull.hi - p.hull.lo) / (p.prior.hi - p.prior.lo);
    return std::clamp(share * (1 + 1e-15) - p.excluded_between, 0.0, 1.0);
}

/// How much of a parameter's prior is excluded where its hull does not show it: between its ends,
/// or only together with other parameters. Empty where the hull shows it, "nothing excluded" only
/// where nothing is.
inline std::string exclusion_note(identification_view const& v, parameter_view const& p) {
    if (is_empty(p.hull)) return {};
    if (p.excluded_between > 0)
        return "at least " + at_least_percent(p.excluded_between) +
               " of the prior's range is excluded in between";
    if (p.hull.lo > p.prior.lo || p.hull.hi < p.prior.hi) return {};
    if (v.excluded > 0)
        return "no value excluded by itself; with the other parameters at least " +
               at_least_percent(v.excluded) + " of the prior's volume";
    return "nothing excluded";
}

/// True when the proof left (nearly) all of the parameter's prior.
inline bool is_unresolved(parameter_view const& p) { return share_of_prior(p) > 0.99; }

inline std::string headline(identification_view const& v) {
    switch (v.verdict) {
    case outcome::proved:
        return "Proved: the model can explain the data";
    case outcome::refuted:
        return "Proved: the model cannot explain the data";
    default:
        return "Not decided";
    }
}

inline std::string verdict_sentence(identification_view const& v) {
    if (!v.sentence.empty()) return v.sentence;
    switch (v.verdict) {
    case outcome::proved:
        return "A parameter vector that explains the data exists, and all that do are enclosed "
               "below.";
    case outcome::refuted:
        return "No parameter vector of the prior explains the data.";
    default:
        return "Neither was a parameter vector proved to explain the data, nor was the whole prior "
               "excluded.";
    }
}

/// How many outliers the data need; both numbers are proved.
inline std::string fewest_outliers_sentence(std::uint64_t least, std::uint64_t most) {
    if (most == 0) return "No outlier is needed to explain the data.";
    auto const number = [](std::uint64_t n) {
        return count_text(n) + (n == 1 ? " measurement" : " measurements");
    };
    if (least == most) {
        return "Every parameter vector of the prior violates at least " + number(least) +
               ", and some violates no more: so many outliers are needed, and suffice.";
    }
    return (least == 0 ? std::string{"It is open whether outliers are needed"}
                       : "Every parameter vector of the prior violates at least " + number(least)) +
           "; " + number(most) + " as outliers suffice.";
}

/// The measurements that a verdict is about.
inline std::string measurements_meant(std::vector<scenario_view> const& scenarios) {
    std::size_t budget = 0, samples = 0;
    for (scenario_view const& s : scenarios) {
        budget += s.outlier_budget;
        samples += s.measurements;
    }
    if (samples == 0) return "the data";
    if (budget == 0) return "all " + count_text(samples) + " measurements";
    return "the " + count_text(samples) + " measurements but for the outliers allowed (" +
           count_text(budget) + " in all)";
}

/// Whether a parameter vector explains the data, and which.
inline std::vector<std::string> existence_statements(identification_view const& v) {
    std::string const which = measurements_meant(v.scenarios);
    if (v.verdict == outcome::refuted)
        return {"No parameter vector in the prior has a motion that meets " + which +
                ": every part of the prior was excluded by a proof."};
    if (v.verdict != outcome::proved)
        return {"It is open whether a parameter vector in the prior has a motion that meets " +
                which + "."};
    std::string const at =
        v.witness && !v.witness->parameters.empty()
            ? " The one that was checked is " + values_text(v.witness->parameters) + "."
            : "";
    std::vector<std::string> out{"There is a parameter vector in the prior whose motion meets " +
                                 which + "." + at};
    if (!v.inside_box.empty()) {
        out.push_back("So does every one with " + v.inside_box +
                      ": it is the largest box of parameters that was proved to.");
    }
    return out;
}

inline std::string volume_statement(identification_view const& v) {
    std::string text =
        v.volume_outer.hi >= 1
            ? "Nothing (or nearly nothing) of the prior's volume could be excluded."
            : "At most " + at_most_percent(v.volume_outer.hi) +
                  " of the prior's volume can explain the data; all the rest is excluded "
                  "by proof.";
    if (is_finite(v.volume_inner) && v.volume_inner.lo > 0) {
        text += " At least " + at_least_percent(v.volume_inner.lo) +
                " of it is proved to explain the data.";
    }
    return text;
}

/// Where the parameter vectors lie that explain the data.
inline std::vector<std::string> range_statements(identification_view const& v) {
    std::vector<std::string> out;
    std::string hulls;
    std::string unresolved;
    for (parameter_view const& p : v.parameters) {
        std::string const text =
            p.name + " in " + outward_text_within(p.hull, p.prior) + unit_suffix(p.unit);
        std::string& list = is_unresolved(p) ? unresolved : hulls;
        list += (list.empty() ? "" : ", ") + (is_unresolved(p) ? p.name : text);
        if (p.excluded_between > 0) list += " (" + exclusion_note(v, p) + ")";
    }
    if (!hulls.empty()) {
        out.push_back("Every parameter vector that explains the data has " + hulls + ".");
    }
    for (combination_view const& c : v.combinations) {
        bool const all = !is_empty(c.prior) && c.hull.lo <= c.prior.lo && c.hull.hi >= c.prior.hi;
        out.push_back((all ? "Both ends of its range over the prior are left of "
                           : "Every parameter vector that explains the data has ") +
                      formula_text(c.formula) + " in " + outward_text(c.hull) +
                      unit_suffix(c.unit) + "." + (c.note.empty() ? "" : " " + c.note));
    }
    if (!unresolved.empty()) {
        out.push_back("For " + unresolved +
                      " taken alone, nothing (or nearly nothing) of the prior could be excluded.");
    }
    if (is_finite(v.volume_outer)) out.push_back(volume_statement(v));
    return out;
}

/// What was proved, sentence by sentence.
inline std::vector<std::string> plain_statements(identification_view const& v) {
    auto out = existence_statements(v);
    if (v.verdict != outcome::refuted) {
        auto const ranges = range_statements(v);
        out.insert(out.end(), ranges.begin(), ranges.end());
    }
    auto const forced = std::count_if(v.outliers.begin(), v.outliers.end(),
                                      [](outlier_view const& o) { return o.proved; });
    if (forced > 0) {
        out.push_back(std::string{forced == 1 ? "One measurement is"
                                              : count_text(static_cast<std::uint64_t>(forced)) +
                                                    " measurements are"} +
                      " proved to be outliers: no parameter vector that explains the data meets " +
                      (forced == 1 ? "it." : "them."));
    }
    out.insert(out.end(), v.proved.begin(), v.proved.end());
    return out;
}

} // namespace sivid::report

#endif
