// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SERIES_TAYLOR_EXPANSION_HPP
#define SIVID_ENCLOSURE_SERIES_TAYLOR_EXPANSION_HPP

/// @file
/// Taylor models as the numbers of expansions and of inputs with errors.

#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/uncertain_input.hpp>
#include <sivid/model/series/taylor_arithmetic.hpp>
#include <sivid/number/polynomial/detail/series_columns.hpp>
#include <sivid/number/taylor_model.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// Taylor coefficients of the solution of \f$ V' = \partial_x f \, V + [0, \partial_p f] \f$,
/// \f$ V(0) = [1, 0] \f$, as single Taylor models, all columns at once. Columns that no entry of
/// the Jacobian has are those of the identity and are left out.
class variation_columns {
public:
    using model = taylor_model<double>;

    variation_columns() = default;
    /// @param entries  of the flow's, the first ones, that the program computes
    /// @param columns  of V: by states, or by states and parameters
    variation_columns(flow const& f, tape const& program, std::size_t entries, std::size_t columns,
                      std::size_t orders, model_shape<double> const& s)
        : lane_(columns, none), rows_(f.states()) {
        auto const n = f.states();
        std::vector<bool> used(columns, false);
        for (std::size_t m = 0; m < entries; ++m) {
            auto const& e = f.entries()[m];
            used[e.column] = true;
            auto& row = rows_[e.row];
            bool const varies = program.output_varies(e.output);
            (e.column < n ? row.products : row.addends).push_back({e.column, e.output, m, varies});
        }
        for (std::size_t c = 0; c < columns; ++c) {
            if (used[c]) lane_[c] = lanes_++;
        }
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns; ++c) {
                if (used[c] && f.sensitive(i, c)) {
                    rows_[i].columns.push_back(c);
                } else if (used[c]) {
                    rows_[i].zeros.push_back(lane_[c]);
                }
            }
        }
        for (std::size_t m = 0; m < entries; ++m) factors_.emplace_back(orders, s);
        v_ = series_columns(n, lanes_, orders, s);
        sum_ = columns_sum(v_.groups(), s);
    }

    /// Coefficients 0 .. order.
    /// @param a  of the program, up to order - 1
    template <class Series>
    void expand(Series const& a, std::size_t order) {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            for (auto const& e : rows_[i].products) {
                std::size_t const orders = e.varies ? order : std::min<std::size_t>(order, 1);
                for (std::size_t k = 0; k < orders; ++k) {
                    factors_[e.factor].put(k, a.output(e.output, k));
                }
            }
            for (std::size_t c = 0; c < lane_.size(); ++c) {
                if (lane_[c] == none) continue;
                v_.put(i, lane_[c], 0, model::constant(i == c ? 1.0 : 0.0));
            }
        }
        for (std::size_t k = 0; k < order; ++k) {
            for (std::size_t i = 0; i < rows_.size(); ++i) {
                auto const& row = rows_[i];
                if (row.columns.empty()) continue;
                sum_.start(k + 1, row.products.size() + 1);
                for (auto const& e : row.addends) {
                    if (k == 0 || e.varies) sum_.add(lane_[e.column], a.output(e.output, k));
                }
                for (auto const& e : row.products) {
                    sum_.add_convolution(factors_[e.factor], v_, e.column, k, e.varies ? k : 0);
                }
                sum_.divide_into(v_, i, k + 1, k + 1);
                for (auto const lane : row.zeros) v_.put(i, lane, k + 1, zero_);
            }
        }
    }

    /// The columns in which a row of V varies.
    [[nodiscard]] std::vector<std::size_t> const& columns(std::size_t i) const {
        return rows_[i].columns;
    }
    /// \f$ V_{ic}^{[k]} \f$, c one of `columns(i)`.
    void get_into(model& a, std::size_t i, std::size_t c, std::size_t k) const {
        v_.get_into(a, i, lane_[c], k);
    }

private:
    static constexpr std::size_t none = ~std::size_t{0};
    struct entry {
        std::size_t column = 0;
        std::size_t output = 0;
        std::size_t factor = 0;
        bool varies = false;
    };
    struct row_of_v {
        std::vector<entry> products; ///< by states
        std::vector<entry> addends;  ///< by parameters
        std::vector<std::size_t> columns;
        std::vector<std::size_t> zeros; ///< lanes in which the row stays 0
    };

    std::vector<std::size_t> lane_; ///< of each column
    std::size_t lanes_ = 0;
    std::vector<row_of_v> rows_;
    std::vector<column_multiplier> factors_;
    series_columns v_;
    columns_sum sum_;
    model zero_;
};

namespace enclosure_detail {
template <>
struct columns_of<taylor_model<double>> {
    using type = variation_columns;
    static type make(flow const& f, tape const& program, std::size_t entries, std::size_t columns,
                     std::size_t orders, size_of_values<taylor_model<double>> const& values) {
        return {f, program, entries, columns, orders, *values.shape};
    }
};
} // namespace enclosure_detail

template <class C>
struct set_scalar<taylor_model<C>> {
    using model = taylor_model<C>;
    using scalar = C;
    static C mag(model const& a) { return a.norm(); }
    static C upper(model const& a) {
        return a.c(0) + (a.above() + a.r()) + a.norm() * (8 * model::unit);
    }
    static C middle(model const& a) { return a.c(0); }
    /// @given  m is the middle
    static C beside(model const& a, C const&) { return (a.above() + a.r()) * a.shape().up; }
    static model widened(model const& a, C const& w) { return sivid::widened(a, w); }
};

} // namespace sivid

#endif
