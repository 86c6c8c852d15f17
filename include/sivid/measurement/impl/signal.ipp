// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_IMPL_SIGNAL_IPP
#define SIVID_MEASUREMENT_IMPL_SIGNAL_IPP

#include <sivid/measurement/signal.hpp>

#include <algorithm>

namespace sivid {

SIVID_DECL sampled_signal::sampled_signal() = default;
SIVID_DECL sampled_signal::sampled_signal(sampled_signal const&) = default;
SIVID_DECL sampled_signal::sampled_signal(sampled_signal&&) noexcept = default;
SIVID_DECL sampled_signal& sampled_signal::operator=(sampled_signal const&) = default;
SIVID_DECL sampled_signal& sampled_signal::operator=(sampled_signal&&) noexcept = default;
SIVID_DECL sampled_signal::~sampled_signal() = default;

SIVID_DECL sampled_signal::sampled_signal(std::vector<double> times, std::vector<double> values,
                                          interpolation kind, std::vector<double> errors)
    : times_(std::move(times)),
      values_(std::move(values)),
      errors_(std::move(errors)),
      kind_(kind) {
    if (times_.empty() || times_.size() != values_.size()) {
        throw std::invalid_argument("sampled_signal: needs as many values as times, at least one");
    }
    for (std::size_t i = 0; i < times_.size(); ++i) {
        if (!std::isfinite(times_[i]) || !std::isfinite(values_[i])) {
            throw std::invalid_argument("sampled_signal: times and values must be finite");
        }
        if (i > 0 && !(times_[i - 1] < times_[i])) {
            throw std::invalid_argument("sampled_signal: times must increase strictly");
        }
    }
    if (!errors_.empty() && errors_.size() != values_.size()) {
        throw std::invalid_argument("sampled_signal: needs as many error bounds as values");
    }
    for (double const e : errors_) {
        if (!(e >= 0) || !std::isfinite(e)) {
            throw std::invalid_argument(
                "sampled_signal: error bounds must be finite and not negative");
        }
    }
    // Exact: by that others know that states may rest.
    if (std::all_of(errors_.begin(), errors_.end(), [](double e) { return e == 0; }))
        errors_.clear();
}

} // namespace sivid

#endif
