// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SERIES_DETAIL_EXPANSION_TAIL_HPP
#define SIVID_ENCLOSURE_SERIES_DETAIL_EXPANSION_TAIL_HPP

#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/series/detail/series_tail.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// What the series of an `expansion` leave out over a step, proved from the sizes of their
/// coefficients (`docs/theory/taylor_models.md`, sections 3.0 and 3.7).
/// @given  of each expansion: neither undefined nor kinked
template <class Entry>
class expansion_tail {
public:
    using scalar = typename Entry::scalar;
    using side_by_side = lane_traits<scalar>;
    using mask = typename side_by_side::mask;

    expansion_tail(flow const& f, expansion<Entry> const& e)
        : flow_(&f),
          columns_(e.columns()),
          series_(e.program(), e.max_order()),
          rho_(f.states()),
          states_(f.states()),
          variations_(f.states() * columns_),
          row_(f.states() + 1) {
        for (std::size_t k = 0; k < f.state_entries(); ++k) row_[f.entries()[k].row + 1] = k + 1;
        for (std::size_t i = 0; i < f.states(); ++i) row_[i + 1] = std::max(row_[i + 1], row_[i]);
    }

    /// Whether this can be tried at all: see `series_tail::covers`.
    [[nodiscard]] bool covers() const { return series_.covers(); }

    /// (3): the states beyond their coefficients up to `order`, at least 1.
    /// @param rest  follow the Jacobian as well
    /// @returns the lanes in which solutions exist on [0, h] and the bounds are proved
    [[nodiscard]] mask bound_states(expansion<Entry> const& e, scalar const& h, std::size_t order,
                                    bool rest) {
        auto const n = flow_->states();
        series_.measure(e.coefficients(), order, h, rest);
        scalar power = h;
        for (std::size_t k = 1; k < order; ++k) power *= h;
        scalar const shared = h * (up / static_cast<double>(order + 1));
        std::vector<scalar> first(n);
        for (std::size_t i = 0; i < n; ++i) {
            first[i] = e.state(i, order).norm() * power * up + Entry::tiny;
            rho_[i] = first[i] * 1.05;
        }
        mask proved{};
        // What acts through a chain of states arrives one state further in each round.
        std::size_t const rounds = std::max<std::size_t>(4, n);
        for (std::size_t round = 1;; ++round) {
            series_.propagate(rho_,
                              [&](std::size_t i) -> Entry const& { return e.input_slope(i); });
            proved = mask(true);
            for (std::size_t i = 0; i < n; ++i) {
                states_[i] = (series_.tail(e.program().output(i)) * shared + Entry::tiny) * up;
                scalar const image = (first[i] + states_[i]) * up;
                proved = proved & (image < rho_[i]);
            }
            if (side_by_side::all(proved) || round == rounds) break;
            for (std::size_t i = 0; i < n; ++i) {
                rho_[i] = side_by_side::select(proved, rho_[i], (first[i] + states_[i]) * 1.1);
            }
        }
        return proved;
    }

    /// (4), and (4') for parameters: the derivatives V beyond their coefficients below L, at
    /// least 2, of all solutions from the expansion's states.
    /// @returns the lanes in which they exist on [0, h] and the bounds are proved
    [[nodiscard]] mask bound_variations(expansion<Entry> const& e, scalar const& h, std::size_t L) {
        mask const exist = bound_states(e, h, L - 1, true);
        if (!side_by_side::any(exist)) return exist;
        auto const n = flow_->states();
        auto const m = columns_;
        std::vector<scalar> own(n * m), image(n * m), ends(n * n);
        add_convolutions(e, h, L, own);
        add_tails(e, h * (up / static_cast<double>(L + 1)), h * (up / static_cast<double>(L)), ends,
                  own);
        for (std::size_t k = 0; k < n * m; ++k) {
            own[k] = own[k] * up + Entry::tiny;
            variations_[k] = own[k];
        }
        mask proved{};
        for (std::size_t round = 1;; ++round) {
            for (std::size_t i = 0; i < n; ++i) map_row(i, own, ends, image);
            proved = mask(true);
            for (std::size_t k = 0; k < n * m; ++k) {
                proved = proved & (image[k] < variations_[k]);
            }
            if (side_by_side::all(proved) || round == 16 + n) break;
            for (std::size_t row = 0; row < n; ++row) {
                // What acts through a chain of states arrives one state further in each round, or
                // at the chain's end where new rows enter at once, whichever way the chain runs.
                std::size_t const i = round % 2 == 0 ? n - 1 - row : row;
                if (round >= 8) map_row(i, own, ends, image);
                for (std::size_t c = 0; c < m; ++c) {
                    auto& v = variations_[i * m + c];
                    v = side_by_side::select(proved, v, image[i * m + c] * 1.1);
                }
            }
        }
        return exist & proved;
    }

    /// \f$ |x_i(h) - \sum_{k \le order} h^k x_k| \f$ of the last `bound_states`
    [[nodiscard]] scalar const& state(std::size_t i) const { return states_[i]; }
    /// \f$ |V_{ic}(s) - \sum_{k<L} s^k V_k| \f$, s in [0, h], of the last `bound_variations`
    [[nodiscard]] scalar const& variation(std::size_t i, std::size_t c) const {
        return variations_[i * columns_ + c];
    }

private:
    /// What the coefficients of A and of V leave of A V beyond order L - 1, divided by L.
    void add_convolutions(expansion<Entry> const& e, scalar const& h, std::size_t L,
                          std::vector<scalar>& own) const {
        auto const& program = e.program();
        // |V_k| h^k, the sums of the last ones of them, and all together.
        std::vector<scalar> size(L), above(L);
        scalar const once = h * (up / static_cast<double>(L));
        for (std::size_t l = 0; l < flow_->states(); ++l) {
            for (std::size_t c = 0; c < columns_; ++c) {
                if (!flow_->sensitive(l, c)) continue;
                scalar power = scalar(1.0);
                for (std::size_t k = 0; k < L; ++k) {
                    size[k] = e.variation(l, c, k).norm() * power;
                    power *= h;
                }
                above[0] = scalar(0.0); // [k]: the last k
                for (std::size_t k = 1; k < L; ++k) above[k] = above[k - 1] + size[L - k];
                scalar const whole = (above[L - 1] + size[0]) * up;
                for (std::size_t k = 0; k < flow_->state_entries(); ++k) {
                    auto const& a = flow_->entries()[k];
                    if (a.column != l) continue;
                    auto const slot = program.output(a.output);
                    scalar sum{};
                    if (program.output_varies(a.output)) {
                        // A_a V_b with a <= L - 2, b <= L - 1, a + b >= L - 1.
                        for (std::size_t j = 0; j + 1 < L; ++j) {
                            sum += series_.size(slot, j) * above[j + 1];
                        }
                        sum += series_.tail(slot) * whole;
                    } else {
                        sum += series_.whole(slot) * above[1];
                    }
                    own[a.row * columns_ + c] += sum * once;
                }
            }
        }
    }
    /// |A| h, divided by L + 1, and what the coefficients of B leave, by L.
    void add_tails(expansion<Entry> const& e, scalar const& again, scalar const& once,
                   std::vector<scalar>& ends, std::vector<scalar>& own) const {
        auto const n = flow_->states();
        auto const& entries = flow_->entries();
        auto const& program = e.program();
        for (std::size_t k = 0; k < flow_->state_entries(); ++k) {
            auto const& a = entries[k];
            auto const slot = program.output(a.output);
            scalar sum = series_.whole(slot);
            if (program.output_varies(a.output)) sum += series_.tail(slot);
            ends[a.row * n + a.column] += sum * again;
        }
        for (std::size_t k = flow_->state_entries(); k < entries.size() && columns_ > n; ++k) {
            auto const& b = entries[k]; // by a parameter
            if (!program.output_varies(b.output)) continue;
            own[b.row * columns_ + b.column] += series_.tail(program.output(b.output)) * once;
        }
    }
    /// Row i of own + ends |V|, rounded up, with the present bounds of |V|.
    void map_row(std::size_t i, std::vector<scalar> const& own, std::vector<scalar> const& ends,
                 std::vector<scalar>& image) const {
        auto const n = flow_->states();
        auto const m = columns_;
        std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(i * m), m,
                    image.begin() + static_cast<std::ptrdiff_t>(i * m));
        for (std::size_t k = row_[i]; k < row_[i + 1]; ++k) {
            auto const l = flow_->entries()[k].column;
            auto const& e = ends[i * n + l];
            for (std::size_t c = 0; c < m; ++c) image[i * m + c] += e * variations_[l * m + c];
        }
        for (std::size_t c = 0; c < m; ++c) image[i * m + c] *= up;
    }

    /// Makes computed sums of a few dozen non-negative numbers upper bounds.
    static constexpr double up = 1 + 1e-12;

    flow const* flow_;
    std::size_t columns_;
    series_tail<Entry> series_;
    std::vector<scalar> rho_, states_, variations_;
    std::vector<std::size_t> row_; ///< where the Jacobian's rows begin among the flow's entries
};

} // namespace sivid

#endif
