// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_EFFECTS_HPP
#define SIVID_IO_DATASET_EFFECTS_HPP

#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// "effects" of a data set or a mapping: for an effect "off", or priors of its parameters.
/// @throws input_error
[[nodiscard]] inline std::vector<dataset_effect> read_dataset_effects(json_value const& list) {
    std::vector<dataset_effect> result;
    for (std::size_t i = 0; i < list.members().size(); ++i) {
        auto const& entry = list.members()[i];
        dataset_effect effect{list.name_of(i), false, {}, entry.place()};
        if (entry.type() == json_value::kind::string) {
            if (entry.string() != "off")
                entry.fail(text_of("found ", in_quotes(entry.string())),
                           "write \"off\", or {PARAMETER: [lower, upper]}");
            effect.off = true;
        } else {
            for (std::size_t k = 0; k < entry.members().size(); ++k) {
                auto const range = mapping_entries::range(entry.members()[k]);
                effect.priors.push_back({entry.name_of(k), range.lower.text(), range.upper.text()});
            }
        }
        result.push_back(std::move(effect));
    }
    return result;
}

/// The effects of a catalogue that a data set leaves on, with its priors where it states some.
/// @given  `data` outlives what is returned: its texts are the bounds' decimals
/// @throws input_error  for an effect or a parameter that the catalogue lacks, and for priors that
///                      reach 0, or beyond it, where the catalogue's own does not: rate limits, or
///                      times, widths and delays, are not made for that
[[nodiscard]] inline std::vector<effect> chosen_effects(std::vector<effect> catalogue,
                                                        dataset const& data) {
    auto const as_decimal = [](std::string const& text) {
        bool const negative = text.front() == '-';
        return decimal{text.c_str() + (negative ? 1 : 0), text.size() - (negative ? 1 : 0),
                       negative};
    };
    for (auto const& chosen : data.effects) {
        auto const fail = [&](std::string const& problem, std::string const& remedy) {
            throw input_error{chosen.place, problem, remedy};
        };
        auto const e = std::find_if(catalogue.begin(), catalogue.end(),
                                    [&](auto const& x) { return x.name == chosen.name; });
        if (e == catalogue.end()) {
            fail(text_of("unknown effect ", in_quotes(chosen.name)),
                 text_of("this program tries: ", joined_names(catalogue)));
        }
        for (auto const& prior : chosen.priors) {
            auto const p = std::find_if(e->parameters.begin(), e->parameters.end(),
                                        [&](auto const& x) { return x.name == prior.parameter; });
            if (p == e->parameters.end()) {
                fail(text_of("the effect has no parameter ", in_quotes(prior.parameter)),
                     text_of("it has: ", joined(e->parameters, ", ",
                                                [](auto const& x) { return in_quotes(x.name); })));
            }
            auto const lower = as_decimal(prior.lower), upper = as_decimal(prior.upper);
            if ((nearest(p->lower) >= 0 && nearest(lower) < 0) ||
                (nearest(p->upper) <= 0 && nearest(upper) > 0))
                fail(text_of("the prior of ", in_quotes(prior.parameter),
                             " reaches beyond 0, for which the effect is not made"),
                     "keep its sign");
            if ((nearest(p->lower) > 0 && !(nearest(lower) > 0)) ||
                (nearest(p->upper) < 0 && !(nearest(upper) < 0)))
                fail(text_of("the prior of ", in_quotes(prior.parameter),
                             " reaches 0, for which the effect is not made"),
                     "let it end before 0");
            p->lower = lower;
            p->upper = upper;
        }
    }
    std::erase_if(catalogue, [&](effect const& e) {
        return std::any_of(data.effects.begin(), data.effects.end(),
                           [&](auto const& x) { return x.off && x.name == e.name; });
    });
    return catalogue;
}

} // namespace sivid

#endif // SIVID_IO_DATASET_EFFECTS_HPP
