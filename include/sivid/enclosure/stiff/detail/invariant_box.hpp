// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STIFF_DETAIL_INVARIANT_BOX_HPP
#define SIVID_ENCLOSURE_STIFF_DETAIL_INVARIANT_BOX_HPP

#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// Finds boxes that no solution leaves during a step, however long against the time constants of
/// the problem. A box B that holds the initial states X is proved face by face; the face
/// \f$ x_i = \overline b_i \f$ is closed
///   - when \f$ f_i < 0 \f$ everywhere on it during the step, or
///   - when no solution in B is fast enough: \f$ \overline x_i + h \max(0, \sup f_i(B)) <
///     \overline b_i \f$,
/// and lower faces likewise. A solution that left B would do so first through a face, at a time
/// until which it was in B; there its derivative would point out, or it would have come too far.
/// @ref  Nagumo 1942; Walter, Differential and Integral Inequalities (1970)
template <class I>
class invariant_box {
    using traits = arithmetic_of<I>;
    static_assert(traits::lanes == 1, "faces are decided for one box at a time");

public:
    explicit invariant_box(flow const& f)
        : flow_(&f), rate_(f.rate(), 0), jacobian_(f.rate_jacobian(), 0) {}

    void set_parameters(basic_box<I> const& p) {
        rate_.set_parameters(p);
        jacobian_.set_parameters(p);
    }

    /// @param x       the states at `from`
    /// @param guess   where the search begins
    /// @param margin  a length for each state below which nothing has to be resolved
    /// @returns a box that holds all solutions from `x` over [from, to], if one was found
    [[nodiscard]] std::optional<basic_box<I>> find(double from, double to, basic_box<I> const& x,
                                                   basic_box<I> const& guess,
                                                   std::vector<double> const& margin) {
        auto const n = flow_->states();
        I const times = traits::bounds(from, to);
        I const length = traits::sub(traits::point(to), traits::point(from));
        input_pieces<I> const inputs(*flow_, from, times);
        auto b = hull(x, guess);
        for (std::size_t i = 0; i < n; ++i) {
            b[i] = traits::add(b[i], traits::bounds(-margin[i], margin[i]));
        }
        for (int round = 0; round < 12; ++round) {
            auto const everywhere = rates(times, b, inputs);
            if (!everywhere) return std::nullopt;
            auto const diagonal = own_slopes(times, b, inputs);
            auto next = b;
            bool closed = true;
            for (std::size_t i = 0; i < n; ++i) {
                for (bool const top : {true, false}) {
                    auto face = b;
                    double const bound = top ? traits::upper(b[i]) : traits::lower(b[i]);
                    face[i] = traits::point(bound);
                    auto const there = rates(times, face, inputs);
                    if (!there) return std::nullopt;
                    double const out =
                        top ? traits::upper((*there)[i]) : -traits::lower((*there)[i]);
                    if (out < 0) continue;
                    // As far as a solution comes in the time, seen from outside the box.
                    I const speed = top ? traits::max((*everywhere)[i], traits::point(0.0))
                                        : traits::min((*everywhere)[i], traits::point(0.0));
                    I const reach = traits::add(x[i], traits::mul(length, speed));
                    double const far = top ? traits::upper(reach) : -traits::lower(reach);
                    double const now = top ? bound : -bound;
                    if (far < now) continue;
                    if (!std::isfinite(far) || !std::isfinite(out)) return std::nullopt;
                    closed = false;
                    // Whichever way of closing the face is nearer.
                    double ahead = (round < 4 ? 1.1 : 2.5) * (far - now) + margin[i];
                    double const slope = -traits::upper(diagonal[i]);
                    if (slope > 0) ahead = std::min(ahead, 1.01 * out / slope + margin[i]);
                    double const moved = now + ahead;
                    next[i] = traits::hull(next[i], traits::point(top ? moved : -moved));
                }
            }
            if (closed) return b;
            b = next;
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] std::optional<basic_box<I>> rates(I const& times, basic_box<I> const& x,
                                                    input_pieces<I> const& inputs) {
        rate_.evaluate(times, x, inputs);
        if (rate_.undefined() || rate_.jumped()) return std::nullopt;
        basic_box<I> result(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) result[i] = rate_.output(i, 0);
        return result;
    }
    /// \f$ \partial f_i / \partial x_i \f$: guides the search only.
    [[nodiscard]] basic_box<I> own_slopes(I const& times, basic_box<I> const& x,
                                          input_pieces<I> const& inputs) {
        jacobian_.evaluate(times, x, inputs);
        basic_box<I> result(x.size());
        for (auto const& e : flow_->entries()) {
            if (e.row == e.column) result[e.row] = jacobian_.output(e.output, 0);
        }
        return result;
    }

    flow const* flow_;
    series<I> rate_;
    series<I> jacobian_;
};

} // namespace sivid

#endif
