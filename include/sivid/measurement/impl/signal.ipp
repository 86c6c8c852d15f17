// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_IMPL_SIGNAL_IPP
#define SIVID_MEASUREMENT_IMPL_SIGNAL_IPP

#include <sivid/measurement/signal.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/needed_given.hpp>

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
        throw std::invalid_argument(
            "sampled_signal: needs as many values as times, at least one" +
            needed_given(std::max<std::size_t>(times_.size(), 1), values_.size()));
    }
    for (std::size_t i = 0; i < times_.size(); ++i) {
        if (!std::isfinite(times_[i]) || !std::isfinite(values_[i])) {
            throw std::invalid_argument("sampled_signal: times and values must be finite; sample " +
                                        std::to_string(i) + " (counted from 0) is " +
                                        nearest_text(values_[i]) + " at " +
                                        nearest_text(times_[i]));
        }
        if (i > 0 && !(times_[i - 1] < times_[i])) {
            throw std::invalid_argument("sampled_signal: times must increase strictly; " +
                                        nearest_text(times_[i]) + " follows " +
                                        nearest_text(times_[i - 1]));
        }
    }
    if (!errors_.empty() && errors_.size() != values_.size()) {
        throw std::invalid_argument("sampled_signal: needs as many error bounds as values" +
                                    needed_given(values_.size(), errors_.size()));
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
