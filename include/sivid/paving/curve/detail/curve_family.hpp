// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_DETAIL_CURVE_FAMILY_HPP
#define SIVID_PAVING_CURVE_DETAIL_CURVE_FAMILY_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/recorded_map.hpp>
#include <sivid/model/structure/unknown_curve.hpp>
#include <sivid/paving/curve/curve_shapes.hpp>
#include <sivid/paving/curve/detail/parallelepiped.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// The curves that are left of g(z, p): their parameters in cells, as thin as what is known of
/// coefficients leaves them.
///   Constants of a curve trade against each other along a line over which it hardly changes. What
///   a record tells of its first coefficients leaves a thin tube about that line, whose curves
///   differ in other ways than all: their own shapes are fewer and narrower.
class curve_family {
public:
    /// @param curve  of `model`, whose inputs are leaves
    /// @param prior  of all parameters
    /// @param range  of z
    SIVID_DECL curve_family(bound_model const& model, unknown_curve const& curve, box const& prior,
                            interval const& range);

    [[nodiscard]] unknown_curve const& curve() const { return curve_; }
    /// What is left of the curve's own parameters, in a box.
    [[nodiscard]] box const& parameters() const { return parameters_; }
    /// The shapes in which these curves differ most (principal components), orthogonal over the
    /// values of z that are visited, so that what is seen of a curve tells one coefficient after
    /// the other.
    /// @param visited     values of z, for the weights alone
    /// @param negligible  what moves the curve by less than this share becomes error
    /// @param keep_going  asked now and then; may be empty
    /// @returns nothing where few smooth shapes do not do, or it was told to stop
    /// @cost  a Taylor model of degree 6 of g for some thousand pairs of cells of p and z
    [[nodiscard]] SIVID_DECL std::optional<curve_shapes>
    shapes(std::vector<double> const& visited, double negligible,
           std::function<bool()> const& keep_going = {}) const;
    /// Cuts off what has other coefficients than these, or other parameters.
    /// @param within  the curve's own parameters
    /// @param shapes  of this family, or of one that holds it
    /// @returns false when it is proved that nothing is left
    [[nodiscard]] SIVID_DECL bool contract(box const& within, curve_shapes const& shapes,
                                           box const& coefficients);
    /// Coefficients over parts of the family, one after the other along its line.
    /// @param count  of them, at most
    [[nodiscard]] SIVID_DECL std::vector<box> parts(curve_shapes const& shapes, std::size_t count);
    /// Cuts off of each of these parts what has other coefficients.
    /// @param left  for each; empty: nothing
    /// @returns false when it is proved that nothing is left
    [[nodiscard]] SIVID_DECL bool contract_parts(curve_shapes const& shapes,
                                                 std::vector<box> const& left);

private:
    /// Whether the curve is not linear in a parameter, as far as a few values show.
    [[nodiscard]] SIVID_DECL bool is_bent(std::size_t j) const;
    /// What coefficients and parameters in these boxes leave of a cell.
    [[nodiscard]] SIVID_DECL std::optional<paving_detail::parallelepiped>
    contracted(paving_detail::parallelepiped cell, curve_shapes const& shapes,
               box const& coefficients) const;
    /// The longest side of a cell, and its length as a share of the prior.
    [[nodiscard]] SIVID_DECL std::pair<std::size_t, double>
    longest_side(paving_detail::parallelepiped const& cell) const;
    /// @returns false when nothing is left
    [[nodiscard]] SIVID_DECL bool measure();
    [[nodiscard]] std::size_t part_begin(std::size_t part, std::size_t count) const {
        return part * cells_.size() / count;
    }

    unknown_curve curve_;
    recorded_map g_;
    interval range_;
    box prior_, parameters_;
    std::vector<paving_detail::parallelepiped> cells_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/curve/impl/curve_family.ipp>
#endif

#endif
