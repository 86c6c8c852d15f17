// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_OPENING_WORDS_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_OPENING_WORDS_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/detail/residuals.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/model/problem.hpp>

#include <cmath>
#include <cstddef>
#include <string>

namespace sivid {

/// The channel and experiment of the largest residual of a fit, outlier budgets aside.
[[nodiscard]] inline std::string most_missed(identification_problem const& p,
                                             approximate_fit const& fit) {
    double most = -1;
    std::string text;
    for (std::size_t e = 0; e < fit.residuals.size(); ++e) {
        double const limit = relaxed_maximum(fit.residuals[e], p.experiments[e].outliers);
        if (!(limit > most)) continue;
        auto const data = sorted(p.experiments[e].measurements);
        for (std::size_t k = 0; k < data.size(); ++k) {
            if (std::abs(fit.residuals[e][k]) != limit) continue;
            most = limit;
            text = "channel " + p.model.about.channels[data[k].channel].name + " in " +
                   p.experiments[e].name;
        }
    }
    return text;
}

/// One sentence: whether there is a gap, and where. What is proved is said to be, and nothing else.
/// @param p, fit  of the model without effects
[[nodiscard]] inline std::string opening_words(diagnosis const& d, identification_problem const& p,
                                               approximate_fit const& fit) {
    if (d.gap == gap_verdict::none) {
        return "no gap: parameters are proved to explain the data";
    }
    std::string text = d.gap == gap_verdict::certified
                           ? "a gap is proved"
                           : "no parameter was found that explains the data";
    if (!d.where.empty()) {
        for (std::size_t k = 0; k < d.where.size(); ++k) {
            auto const& w = d.where[k];
            text += (k == 0 ? ": " : ", ") + w.kind + " " + w.name;
            if (w.proved) text += " (proved)";
        }
        return text;
    }
    std::string proved;
    for (auto const& r : d.relations) {
        if (!r.proved) continue;
        proved += (proved.empty() ? "equation " : " or ") + r.equation;
    }
    if (!proved.empty()) return text + ": " + proved + " or its sensors (proved)";
    auto const missed = most_missed(p, fit);
    return missed.empty() ? text : text + "; missed most: " + missed;
}

} // namespace sivid

#endif
