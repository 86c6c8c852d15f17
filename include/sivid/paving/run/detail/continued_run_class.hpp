// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_CONTINUED_RUN_CLASS_HPP
#define SIVID_PAVING_RUN_DETAIL_CONTINUED_RUN_CLASS_HPP

#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace sivid {

/// Families of trajectories of one experiment that go on from where they are whenever an output at
/// a later time is asked for: what the past cost is not paid again.
class continued_run {
public:
    using family = std::size_t;

    virtual ~continued_run() = default;
    /// Starts all trajectories from a box of starts for a box of parameters.
    [[nodiscard]] virtual family begin(box const& initial, box const& parameters) = 0;
    virtual void end(family f) = 0;
    [[nodiscard]] virtual normalised_unknowns const& unknowns(family f) const = 0;
    [[nodiscard]] virtual std::shared_ptr<monomial_table const> table(family f) const = 0;
    /// Carries families on to one time and looks at some channels there.
    /// @given  no family is beyond `time`
    /// @returns by family and channel asked for; nothing for a family whose enclosure failed, now
    ///          or before
    [[nodiscard]] virtual std::vector<std::vector<output_polynomial>>
    read(std::vector<family> const& which, double time,
         std::vector<std::size_t> const& channels) = 0;
    /// How many families are carried at the cost of one.
    [[nodiscard]] virtual std::size_t at_once() const { return 1; }
};

} // namespace sivid

#endif
