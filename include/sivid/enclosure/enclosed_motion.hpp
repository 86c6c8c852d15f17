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
#include <utility>
#include <vector>

namespace sivid {

template <class I>
class tube;

/// What is proved of all states throughout one step.
struct swept_span {
    double from = 0, to = 0; ///< in the model's unit of time
    box states;              ///< contains all of them at all times in [from, to]
};

/// Which sets prove a motion, and up to when [the model's unit of time]: nothing where none of a
/// kind were carried. What is said of a time rests on all that reach it.
struct carried_spans {
    std::optional<double> taylor_models;
    std::optional<double> first_order;
    /// From here on the Taylor models are in fresh variables for the states; before, in those of
    /// the box of starts. Nothing: in these to the end.
    std::optional<double> fresh_starts;
};

/// What says more of an enclosed motion than its spans do.
class motion_between_spans {
public:
    virtual ~motion_between_spans() = default;
    /// A box that contains all states, or channels, at a time within the proved span.
    [[nodiscard]] virtual box at(double t) const = 0;
    [[nodiscard]] virtual box observe_at(double t) const = 0;
    /// A box that contains all states at all times in [from, to], a part of one span.
    [[nodiscard]] virtual box over(double from, double to) const = 0;
    /// The same for any part of the motion; nothing where it is asked span by span.
    [[nodiscard]] virtual std::optional<box> over_spans(double, double) const { return {}; }
};

/// All trajectories of a family, enclosed: the `tube` that `integrate` proves over intervals of
/// doubles, or what `enclose` proves by any set, for tables and pictures. It asks for less than
/// these, and is quick to compile where sivid::compiled is linked to.
class enclosed_motion {
public:
    /// Encloses x' = f(t, x, p, u) from the box `initial` at time `from` to time `to`, or over the
    /// shorter span that can be proved.
    /// @throws std::invalid_argument  for boxes of other sizes, empty or unbounded, or a span that
    ///                                ends before it begins
    /// @param from, to  in the model's unit of time; steps are relative to the span (`for_span`)
    /// @cost  one integration
    enclosed_motion(std::shared_ptr<flow const> f, box const& initial, box const& parameters,
                    double from, double to, enclosure_options const& options = {});

    /// Of spans that somebody else has proved, one after the other.
    enclosed_motion(std::shared_ptr<motion_between_spans const> between,
                    std::vector<swept_span> spans, double end,
                    std::optional<enclosure_failure> const& failure, carried_spans const& carried)
        : between_(std::move(between)),
          end_(end),
          failure_(failure),
          spans_(std::move(spans)),
          carried_(carried) {}

    /// Everything up to this time is proved.
    [[nodiscard]] double end_time() const { return end_; }
    [[nodiscard]] bool complete() const { return !failure_; }
    [[nodiscard]] std::optional<enclosure_failure> const& failure() const { return failure_; }
    /// The proved steps, one after the other.
    [[nodiscard]] std::vector<swept_span> const& spans() const { return spans_; }
    [[nodiscard]] carried_spans const& carried() const { return carried_; }

    /// A box that contains all states at time t.
    /// @throws std::out_of_range  outside the proved span
    [[nodiscard]] box at(double t) const;
    /// A box that contains all channels at time t; an entire side for one that is not defined.
    /// @throws std::out_of_range  outside the proved span
    [[nodiscard]] box observe_at(double t) const;
    /// A box that contains all states at all times in [from, to]: of whole spans what they say, of
    /// a part of one what steps of its own sweep.
    /// @throws std::out_of_range  outside the proved span
    /// @throws std::invalid_argument  for a span that ends before it begins
    /// @cost  that of `at` for each end that lies inside a span
    [[nodiscard]] box over(double from, double to) const;
    /// The proved steps themselves.
    /// @throws std::logic_error  where other sets than those of first order were carried
    [[nodiscard]] tube<interval> const& steps() const;

private:
    std::shared_ptr<tube<interval> const> tube_;
    std::shared_ptr<motion_between_spans const> between_; ///< where there is no tube
    double end_ = 0;
    std::optional<enclosure_failure> failure_;
    std::vector<swept_span> spans_;
    carried_spans carried_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/enclosure/impl/enclosed_motion.ipp>
#endif

#endif
