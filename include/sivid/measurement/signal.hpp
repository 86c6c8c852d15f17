// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_SIGNAL_HPP
#define SIVID_MEASUREMENT_SIGNAL_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// How a sampled input behaves between its samples; exact as stated, enclosures rely on it.
enum class interpolation {
    linear, ///< the straight line between neighbouring samples
    hold    ///< the earlier sample, until the next one
};

/// A recorded input: doubles at strictly increasing times, with a stated behaviour in between.
///   On piece k, \f$ t \in [t_k, t_{k+1}] \f$: \f$ u(t) = u_k + s_k (t - t_k) \f$ with
///   \f$ s_k = (u_{k+1} - u_k)/(t_{k+1} - t_k) \f$ (linear) or \f$ s_k = 0 \f$ (hold).
/// With error bounds \f$ e_k \f$ of the samples the true input is any measurable function within
/// \f$ u(t) \pm e(t) \f$, where e runs between its samples as u does: along the straight line
/// from \f$ e_k \f$ to \f$ e_{k+1} \f$, which covers every line between true samples, or held at
/// \f$ e_k \f$. Before the first and after the last sample the nearest one's bound holds.
class sampled_signal {
public:
    sampled_signal();
    sampled_signal(sampled_signal const&);
    sampled_signal(sampled_signal&&) noexcept;
    sampled_signal& operator=(sampled_signal const&);
    sampled_signal& operator=(sampled_signal&&) noexcept;
    ~sampled_signal();

    /// @param errors  a bound for each sample, 0 or more; none, or all 0: the samples are exact
    /// @given  as many values as times, at least one, finite, times strictly increasing (checked).
    sampled_signal(std::vector<double> times, std::vector<double> values, interpolation kind,
                   std::vector<double> errors = {});

    [[nodiscard]] std::vector<double> const& times() const { return times_; }
    [[nodiscard]] std::vector<double> const& values() const { return values_; }
    /// Bounds of the samples' errors; empty when they are exact.
    [[nodiscard]] std::vector<double> const& errors() const { return errors_; }
    [[nodiscard]] bool exact() const { return errors_.empty(); }
    /// The same samples without their errors: one of the signals that are possible.
    [[nodiscard]] sampled_signal nominal() const { return {times_, values_, kind_}; }
    [[nodiscard]] interpolation kind() const { return kind_; }

    /// The piece that governs a step which starts at `t` and goes forward; the last piece extends
    /// to the right, the first one to the left.
    [[nodiscard]] std::size_t piece(double t) const {
        auto const after = std::upper_bound(times_.begin(), times_.end(), t);
        auto const k = after == times_.begin() ? 0 : after - times_.begin() - 1;
        auto const last = times_.size() < 2 ? 0 : times_.size() - 2;
        if (kind_ == interpolation::hold) return static_cast<std::size_t>(k);
        return std::min(static_cast<std::size_t>(k), last);
    }

    /// First knot strictly after `t`, or +infinity.
    [[nodiscard]] double next_knot(double t) const {
        auto const after = std::upper_bound(times_.begin(), times_.end(), t);
        return after == times_.end() ? HUGE_VAL : *after;
    }

    /// Slope of piece `k`, enclosed.
    template <class I>
    [[nodiscard]] I slope(std::size_t k) const {
        using traits = interval_traits<I>;
        if (kind_ == interpolation::hold || k + 1 >= times_.size()) return traits::point(0.0);
        if (values_[k] == values_[k + 1]) return traits::point(0.0);
        typename traits::mask undefined{};
        return traits::div(traits::sub(traits::point(values_[k + 1]), traits::point(values_[k])),
                           traits::sub(traits::point(times_[k + 1]), traits::point(times_[k])),
                           undefined);
    }

    /// Encloses the polynomial of piece `k` over the times `t`, inside the piece or not.
    template <class I>
    [[nodiscard]] I value(std::size_t k, I const& t) const {
        using traits = interval_traits<I>;
        I const start = traits::point(values_[k]);
        if (kind_ == interpolation::hold || k + 1 >= times_.size()) return start;
        return traits::add(start,
                           traits::mul(slope<I>(k), traits::sub(t, traits::point(times_[k]))));
    }

    /// An upper bound of e(t) at a time of piece `k`; between two times of a piece e is at most the
    /// straight line between their bounds.
    [[nodiscard]] double error_bound(std::size_t k, double t) const {
        if (errors_.empty()) return 0;
        double const here = errors_[k];
        if (kind_ == interpolation::hold || k + 1 >= times_.size() || t <= times_[k]) return here;
        double const next = errors_[k + 1];
        if (t >= times_[k + 1] || here == next) return next;
        double const share = (t - times_[k]) / (times_[k + 1] - times_[k]);
        // A handful of roundings, each within a unit of the larger bound.
        double const unit = 16 * std::numeric_limits<double>::epsilon();
        double const line = here + share * (next - here) + std::max(here, next) * unit;
        return std::min(line + std::numeric_limits<double>::min(), std::max(here, next));
    }

    /// The signal in plain floating point, for simulation and plots.
    [[nodiscard]] double approximate(double t) const { return approximate_on(piece(t), t); }
    /// The same on the polynomial of piece `k`.
    [[nodiscard]] double approximate_on(std::size_t k, double t) const {
        if (kind_ == interpolation::hold || k + 1 >= times_.size()) return values_[k];
        double const s = (t - times_[k]) / (times_[k + 1] - times_[k]);
        return values_[k] + s * (values_[k + 1] - values_[k]);
    }

private:
    std::vector<double> times_;
    std::vector<double> values_;
    std::vector<double> errors_;
    interpolation kind_ = interpolation::linear;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/measurement/impl/signal.ipp>
#endif

#endif
