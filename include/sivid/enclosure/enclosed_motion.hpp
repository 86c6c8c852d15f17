// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_ENCLOSED_MOTION_HPP
#define SIVID_ENCLOSURE_ENCLOSED_MOTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/space/box.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace sivid {

template <class I>
class tube;

/// What is proved of all states throughout one step.
struct swept_span {
    double from = 0, to = 0; ///< [s]
    box states;              ///< contains all of them at all times in [from, to]
};

/// All trajectories of a family, enclosed: the `tube` that `integrate` proves over intervals of
/// doubles, for tables and pictures. It asks for less than a tube, and is quick to compile where
/// sivid::compiled is linked to.
class enclosed_motion {
public:
    /// Encloses x' = f(t, x, p, u) from the box `initial` at time `from` to time `to`, or over the
    /// shorter span that can be proved.
    /// @throws std::invalid_argument  for boxes of other sizes, empty or unbounded, or a span that
    ///                                ends before it begins
    /// @cost  one integration
    enclosed_motion(std::shared_ptr<flow const> f, box const& initial, box const& parameters,
                    double from, double to, enclosure_options const& options = {});

    /// Everything up to this time is proved.
    [[nodiscard]] double end_time() const { return end_; }
    [[nodiscard]] bool complete() const { return !failure_; }
    [[nodiscard]] std::optional<enclosure_failure> const& failure() const { return failure_; }
    /// The proved steps, one after the other.
    [[nodiscard]] std::vector<swept_span> const& spans() const { return spans_; }

    /// A box that contains all states at time t.
    /// @throws std::out_of_range  outside the proved span
    [[nodiscard]] box at(double t) const;
    /// A box that contains all channels at time t; an entire side for one that is not defined.
    /// @throws std::out_of_range  outside the proved span
    [[nodiscard]] box observe_at(double t) const;
    [[nodiscard]] tube<interval> const& steps() const { return *tube_; }

private:
    std::shared_ptr<tube<interval> const> tube_;
    double end_ = 0;
    std::optional<enclosure_failure> failure_;
    std::vector<swept_span> spans_;
};

/// `explain_failure` for the sets that an `enclosed_motion` carries: what could help it.
/// @returns nothing when the enclosure reaches `to`
/// @cost  see there
[[nodiscard]] SIVID_DECL std::optional<advised_failure>
explain_enclosed_motion(flow const& f, box const& initial, box const& parameters, double from,
                        double to, enclosure_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/enclosure/impl/enclosed_motion.ipp>
#endif

#endif
