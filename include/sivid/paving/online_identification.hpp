// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_ONLINE_IDENTIFICATION_HPP
#define SIVID_PAVING_ONLINE_IDENTIFICATION_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/online/online_update.hpp>

#include <memory>
#include <vector>

namespace sivid {

namespace paving_detail {
class online_identifier;
}

/// Identification while the measurements arrive.
///   `add` updates hulls, verdict, paving and witness; nothing begins again. What was excluded
///   stays excluded: with q outliers allowed to an experiment, now and later, a parameter that
///   violates more than q measurements does so for ever. What was proved inside is tested by the
///   new measurements. Trajectories go on from the last measurement; those at earlier times cost a
///   run from the begin. Inputs are given in advance.
/// @guarantee  as of `identify`, for all measurements added so far, in whichever order
/// @cost  of one `add`: carries the regions on and judges the boxes that the measurement concerns;
///        it does not grow with the number of measurements while the hulls rest. New integrations
///        are needed where what is left has become much smaller than what is carried.
class online_identification {
public:
    /// @param problem  its measurements, which may be none, are the first update
    /// @throws std::invalid_argument  as `identify` does, and where states that effects added start
    ///         at what parameters say
    explicit online_identification(identification_problem problem, online_options options = {});
    ~online_identification();
    online_identification(online_identification const&) = delete; // its parts refer to each other
    online_identification& operator=(online_identification const&) = delete;

    /// @throws std::invalid_argument for a measurement of no experiment, channel or finite time, or
    ///         with an empty bound; then nothing has changed
    online_update const& add(std::vector<online_sample> const& samples);
    online_update const& add(online_sample const& sample) { return add(std::vector{sample}); }

    /// Uses idle time: judges and splits what the last update left open.
    online_update const& refine();

    /// With all measurements added so far.
    [[nodiscard]] identification_problem const& problem() const;
    [[nodiscard]] online_update const& last() const;

    /// All that is known, in the form of `identify`.
    /// @cost  draws the paving of the prior; looks for a witness if there is none
    [[nodiscard]] identification result();

private:
    std::unique_ptr<paving_detail::online_identifier> work_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/online_identification.ipp>
#endif

#endif
