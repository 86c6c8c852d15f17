// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_ANSWER_FORMULAS_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_ANSWER_FORMULAS_HPP

#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/holdout.hpp>
#include <sivid/model/change/changed_formulas.hpp>

namespace sivid {

/// States what the effects that are the answer change in the model; nothing where there are none.
inline void state_change(diagnosis_run& run) {
    run.result.change = {};
    if (run.result.answer != answer_kind::effects) return;
    run.result.change =
        formulas_of(run.base.model, holdout::effects_of(run.candidates[run.answer], run.catalogue));
}

} // namespace sivid

#endif
