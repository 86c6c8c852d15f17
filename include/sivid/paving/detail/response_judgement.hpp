// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DETAIL_RESPONSE_JUDGEMENT_HPP
#define SIVID_PAVING_DETAIL_RESPONSE_JUDGEMENT_HPP

#include <sivid/paving/cut_contraction.hpp>
#include <sivid/paving/explaining_starts.hpp>
#include <sivid/paving/local_response.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// What the responses of all experiments say of a part of their box.
struct response_judgement {
    box_verdict verdict = box_verdict::undecided;
    box rest; ///< outside it nothing of the part is feasible
    std::vector<double> smear = {};
    /// Largest share of an undecided output's width that does not shrink with the part; infinite
    /// where outputs were not reached.
    double share = 0;
};

/// Decides and contracts a part by responses alone; nothing is integrated.
/// @param all       by experiment, for all starts
/// @param chosen    the same for starts from which existence is proved; may be those of `all`
/// @param contract  contract the part, and look for starts that depend on the parameters
/// @param cut       contract by linear programs over all measurements, too
/// @guarantee  outside: no parameter of the part is feasible for any starts; inside: all are, for
///             the chosen starts or for others that depend on the parameter; `rest` keeps every
///             feasible parameter
[[nodiscard]] inline response_judgement judge_by_responses(response_list const& all,
                                                           response_list const& chosen, box part,
                                                           bool contract, bool cut) {
    response_judgement result{.rest = std::move(part)};
    auto& rest = result.rest;
    std::vector<std::size_t> open; // experiments that are not explained so far
    result.smear.assign(rest.size(), 0.0);
    for (std::size_t e = 0; e < all.size(); ++e) {
        auto narrowed = rest;
        auto const says = assess(*all[e], narrowed);
        if (says.refuted) {
            result.verdict = box_verdict::outside;
            return result;
        }
        bool holds = says.explained;
        if (!holds && chosen[e] != all[e]) {
            auto copy = rest;
            holds = assess(*chosen[e], copy).explained;
        }
        if (!holds) {
            open.push_back(e);
            result.share = std::max(result.share, says.sharpness);
            if (all[e]->outputs() < all[e]->measurements) {
                result.share = std::numeric_limits<double>::infinity();
            }
        }
        if (contract) rest = std::move(narrowed);
        for (std::size_t j = 0; j < rest.size(); ++j) result.smear[j] += says.smear[j];
    }
    bool const inside = std::all_of(open.begin(), open.end(), [&](std::size_t e) {
        return contract && explaining_starts(*all[e], rest)().has_value();
    });
    result.verdict = inside ? box_verdict::inside : box_verdict::undecided;
    if (!inside && contract && cut && !cut_contraction()(all, rest)) {
        result.verdict = box_verdict::outside;
        result.share = 0;
    }
    return result;
}

} // namespace sivid

#endif
