// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_WORDS_HPP
#define SIVID_PAVING_STATIC_WORDS_HPP

#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/static/flat_paving.hpp>
#include <sivid/paving/static_problem.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// What a set inversion found, in sentences: its verdict, measurements that no parameter meets,
/// ends of the prior that it reaches, and formulas without a value that leave boxes open.
/// @param found  of `invert_static` for the problem
[[nodiscard]] inline std::vector<std::string> static_words(static_problem const& problem,
                                                           flat_paving const& found) {
    auto const& names = problem.choice.unknown;
    auto const reading = [&](std::size_t k) {
        auto const& m = problem.measurements[k];
        return problem.model.about.channels[m.channel].name + " at " + nearest_text(m.time, 6);
    };
    std::vector<std::string> words;
    auto const known = proved_verdict(found);
    words.push_back(
        known == verdict::consistent     ? "proved: parameters of the prior explain the data"
        : known == verdict::inconsistent ? "proved: no parameter of the prior explains the data"
                                         : "not decided: " + std::to_string(found.open.size()) +
                                               " boxes are left, of none it is proved that it "
                                               "explains the data");
    for (auto const k : found.forced)
        words.push_back("proved outlier: " + reading(k) +
                        ", every parameter that explains the data violates it");
    for (auto const& e : found.ends())
        words.push_back(names[e.side] + (e.proved ? " reaches" : " may reach") + " the " +
                        std::string(to_string(e.end)) +
                        " end of its prior: what lies beyond was not looked at");
    for (auto const& u : found.undefined) {
        std::string where;
        for (std::size_t j = 0; j < names.size(); ++j)
            where += (j == 0 ? "" : ", ") + names[j] + " in [" +
                     to_decimal_lower(u.where[j].lower(), 4) + ", " +
                     to_decimal_upper(u.where[j].upper(), 4) + "]";
        words.push_back(reading(u.measurement) + " may have no value in " + where +
                        ": such boxes stay open however small they are; write the formula so that "
                        "it has one, or leave them out of the prior");
    }
    return words;
}

} // namespace sivid

#endif
