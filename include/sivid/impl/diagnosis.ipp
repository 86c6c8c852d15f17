// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_DIAGNOSIS_IPP
#define SIVID_IMPL_DIAGNOSIS_IPP

#include <sivid/diagnosis/candidate/impl/effect_hulls.ipp>
#include <sivid/diagnosis/candidate/impl/episode_hulls.ipp>
#include <sivid/diagnosis/candidate/impl/input_slices.ipp>
#include <sivid/diagnosis/candidate/impl/late_channels.ipp>
#include <sivid/diagnosis/candidate/impl/proposed_faults.ipp>
#include <sivid/diagnosis/candidate/impl/sliced_input.ipp>
#include <sivid/diagnosis/gap/impl/confined_gap.ipp>
#include <sivid/diagnosis/impl/diagnose.ipp>
#include <sivid/diagnosis/impl/diagnosis_run.ipp>
#include <sivid/diagnosis/impl/identify_remembering.ipp>
#include <sivid/diagnosis/impl/manoeuvre.ipp>

#endif
