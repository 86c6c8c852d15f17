// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_RESPONSE_JUDGEMENT_HPP
#define SIVID_PAVING_JUDGE_DETAIL_RESPONSE_JUDGEMENT_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

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
    exclusion_proof proof = {}; ///< of the contraction, or that nothing is left
};

struct judgement_options {
    bool contract = true;  ///< the part; and look for starts that depend on the parameters
    bool cut = true;       ///< contract by linear programs over all measurements, too
    bool any_start = true; ///< a parameter may have any start: else none is looked for
};

/// Decides and contracts a part by responses alone; nothing is integrated.
/// @param all     by experiment, for all starts
/// @param chosen  the same for starts from which existence is proved; may be those of `all`
/// @guarantee  outside: no parameter of the part is feasible for any starts; inside: all are, for
///             the chosen starts or for others that depend on the parameter; `rest` keeps every
///             feasible parameter
[[nodiscard]] SIVID_DECL response_judgement judge_by_responses(response_list const& all,
                                                               response_list const& chosen,
                                                               box part,
                                                               judgement_options const& options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/judge/impl/response_judgement.ipp>
#endif

#endif
