// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_DETAIL_SHAPED_PROBLEM_HPP
#define SIVID_PAVING_CURVE_DETAIL_SHAPED_PROBLEM_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/unknown_curve.hpp>
#include <sivid/paving/curve/curve_shapes.hpp>
#include <sivid/paving/curve/detail/curve_family.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sivid {

/// The same question with coefficients of shapes in place of the constants of its curves: the
/// model is linear in them, so that runs over wide boxes stay sharp, and what constants a curve has
/// is found afterwards, without any run.
///   What the shapes leave of a curve is a further input within \f$ \pm e \f$.
class shaped_problem {
public:
    /// @guarantee  a parameter, and a start, that explains the experiments there explains them here
    ///             with its coefficients: shapes hold for all values of their arguments that a
    ///             motion can have that explains an experiment (`proved_motion`)
    /// @returns  nothing where there is no such curve, an argument has no bound, outliers are
    ///           allowed, or delays or effects' states are in the model
    [[nodiscard]] SIVID_DECL static std::optional<shaped_problem>
    of(identification_problem const& problem, std::function<bool()> const& keep_going = {});

    /// Takes the shapes of what curves are left, up to what moves them by less than a share.
    /// @returns false where there are none, or it was told to stop
    [[nodiscard]] SIVID_DECL bool shape(double negligible,
                                        std::function<bool()> const& keep_going = {});
    /// With the coefficients of these shapes as unknowns.
    [[nodiscard]] SIVID_DECL identification_problem posed() const;
    /// Takes what is left of the prior of `posed()`.
    SIVID_DECL void take(box const& rest);
    /// Contracts parameters by coefficients. @returns false when it is proved that nothing is left
    [[nodiscard]] SIVID_DECL bool contract();
    /// Parts of the prior of `posed()` that cover what is left of it: products of parts of each
    /// curve's family, along its line.
    /// @param most  of them
    [[nodiscard]] SIVID_DECL std::vector<box> parts(std::size_t most);
    /// Takes what is left of each of these parts; empty: nothing.
    /// @returns false when it is proved that nothing is left
    [[nodiscard]] SIVID_DECL bool take_parts(std::vector<box> const& left);
    [[nodiscard]] std::vector<box> starts() const {
        std::vector<box> result;
        for (auto const& e : experiments_) result.push_back(e.initial);
        return result;
    }
    /// What is left of the starts.
    void begin_in(std::vector<box> const& starts) {
        for (std::size_t e = 0; e < starts.size(); ++e) experiments_[e].initial = starts[e];
    }
    /// What is left of the prior that was given.
    [[nodiscard]] box const& parameters() const { return parameters_; }

private:
    struct shaped_curve {
        curve_family family;
        std::vector<double> visited; ///< values of its argument
        curve_shapes shapes{};
        box coefficients{}; ///< what is left of them
        std::size_t parts = 1;
    };
    /// Shapes stand for the curves, made of their arguments.
    [[nodiscard]] SIVID_DECL stand_ins instead() const;

    bound_model model_;
    std::vector<experiment> experiments_;
    box parameters_;
    std::vector<shaped_curve> curves_;
    /// Of the parameters, those that stand elsewhere, too.
    std::vector<std::size_t> kept_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/curve/impl/shaped_problem.ipp>
#endif

#endif
