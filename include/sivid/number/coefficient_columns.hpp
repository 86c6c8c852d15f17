// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_COEFFICIENT_COLUMNS_HPP
#define SIVID_NUMBER_COEFFICIENT_COLUMNS_HPP

#include <sivid/number/detail/taylor_model_class.hpp>
#include <sivid/number/lanes.hpp>
#include <sivid/number/monomials.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// Rows of a matrix of series in time of single Taylor models, with the columns side by side: what
/// multiplies such a row multiplies all columns at once, eight in a few vector registers.
template <std::size_t N, std::size_t D>
class coefficient_columns {
public:
    using model = taylor_model<N, D>;
    static constexpr std::size_t at_once = 8;
    /// Of each coefficient in time: its coefficients; for d = 1 .. D the norms of degrees that with
    /// d exceed D, together; the polynomial's norm; the radius; the norms 0 .. D and 1 .. D
    /// together.
    static constexpr std::size_t first_beyond = model::terms;
    static constexpr std::size_t whole_norm = first_beyond + D;
    static constexpr std::size_t radius = whole_norm + 1;
    static constexpr std::size_t first_norm = radius + 1;
    static constexpr std::size_t above = first_norm + D + 1;
    static constexpr std::size_t count = above + 1;

    coefficient_columns() = default;
    /// @param orders  0 .. orders - 1 of each series will be kept
    coefficient_columns(std::size_t rows, std::size_t columns, std::size_t orders)
        : orders_(orders),
          groups_((columns + at_once - 1) / at_once),
          blocks_(rows * groups_ * orders_ * count) {}

    /// How many times eight columns there are.
    [[nodiscard]] std::size_t groups() const { return groups_; }
    /// Coefficient k of eight columns of a row; that of k - 1 stands `step` numbers before it.
    [[nodiscard]] double* at(std::size_t row, std::size_t group, std::size_t k) {
        return blocks_[((row * groups_ + group) * orders_ + k) * count].data();
    }
    [[nodiscard]] double const* at(std::size_t row, std::size_t group, std::size_t k) const {
        return blocks_[((row * groups_ + group) * orders_ + k) * count].data();
    }
    static constexpr std::size_t step = count * at_once;

    void put(std::size_t row, std::size_t column, std::size_t k, model const& a) {
        double* const p = at(row, column / at_once, k) + column % at_once;
        for (std::size_t i = 0; i < model::terms; ++i) p[i * at_once] = a.c[i];
        double beyond = 0;
        for (std::size_t d = 1; d <= D; ++d) {
            beyond += a.norms[D + 1 - d];
            p[(first_beyond + d - 1) * at_once] = beyond * model::up;
        }
        p[whole_norm * at_once] = a.polynomial_norm();
        p[radius * at_once] = a.r;
        for (std::size_t d = 0; d <= D; ++d) p[(first_norm + d) * at_once] = a.norms[d];
        p[above * at_once] = a.above;
    }
    [[nodiscard]] model get(std::size_t row, std::size_t column, std::size_t k) const {
        model a{typename model::unset{}};
        double const* const p = at(row, column / at_once, k) + column % at_once;
        for (std::size_t i = 0; i < model::terms; ++i) a.c[i] = p[i * at_once];
        a.r = p[radius * at_once];
        for (std::size_t d = 0; d <= D; ++d) a.norms[d] = p[(first_norm + d) * at_once];
        a.above = p[above * at_once];
        return a;
    }

private:
    struct alignas(64) block : std::array<double, at_once> {};
    std::size_t orders_ = 0;
    std::size_t groups_ = 0;
    std::vector<block> blocks_;
};

/// A series in time of single Taylor models, as what multiplies `coefficient_columns`.
template <std::size_t N, std::size_t D>
class column_factor {
public:
    using model = taylor_model<N, D>;
    /// Of each coefficient in time: its coefficients, norms 1 .. D, the bound of everything, the
    /// radius, the polynomial's norm.
    static constexpr std::size_t first_norm = model::terms;
    static constexpr std::size_t everything = first_norm + D;
    static constexpr std::size_t radius = everything + 1;
    static constexpr std::size_t whole_norm = radius + 1;
    static constexpr std::size_t count = whole_norm + 1;
    /// Far above what the least double loses, far below what matters: `radius` has that much more,
    /// so that a rounding bound may underflow beside it.
    static constexpr double floor = 1e-300;

    column_factor() = default;
    explicit column_factor(std::size_t orders) : numbers_(orders * count) {}
    void put(std::size_t k, model const& a) {
        double* const p = numbers_.data() + k * count;
        for (std::size_t i = 0; i < model::terms; ++i) p[i] = a.c[i];
        for (std::size_t d = 1; d <= D; ++d) p[first_norm + d - 1] = a.norms[d];
        p[everything] = a.polynomial_norm() + a.r;
        p[radius] = a.r + floor;
        p[whole_norm] = a.polynomial_norm();
    }
    [[nodiscard]] double const* data() const { return numbers_.data(); }

private:
    std::vector<double> numbers_;
};

inline namespace SIVID_PACK_TARGET {

/// The sums of `column_sum`, in registers of whatever width this target has.
template <std::size_t N, std::size_t D>
struct column_kernel {
    using columns = coefficient_columns<N, D>;
    using factor = column_factor<N, D>;
    using model = taylor_model<N, D>;
    using table = monomials<N, D>;
    static constexpr std::size_t terms = table::count;
    using vector = lanes_detail::vector;
    using whole = lanes_detail::vector_mask;
    static constexpr std::size_t per_vector = lanes_detail::per_vector;
    static constexpr std::size_t parts = columns::at_once / per_vector;
    typedef double stored __attribute__((vector_size(lanes_detail::vector_bytes), may_alias));

    /// totals += \f$ \sum_{j \le to} a_j v_{k-j} \f$; behind the coefficients, what that loses: by
    /// degrees beyond D, radii, and `rounding` times the sizes of the products.
    [[gnu::noinline]] static void add(double* totals, double const* a, double const* v,
                                      std::size_t to, double rounding) {
        if constexpr (terms == 1) {
            add_all(totals, a, v, to, rounding, std::make_index_sequence<parts>{});
        } else {
            for (std::size_t part = 0; part < parts; ++part) {
                add_part(totals + part * per_vector, a, v + part * per_vector, to, rounding);
            }
        }
    }

    /// The totals divided by a natural number, as a coefficient of the columns.
    /// @param up   makes the computed losses upper bounds
    [[gnu::noinline]] static void divide(double const* totals, double divisor, double up,
                                         double* result) {
        auto const* from = reinterpret_cast<stored const*>(totals);
        auto* to = reinterpret_cast<stored*>(result);
        constexpr auto const& first = table::data.first;
        for (std::size_t part = 0; part < parts; ++part, ++from, ++to) {
            for (std::size_t i = 0; i < terms; ++i) to[i * parts] = from[i * parts] / divisor;
            vector above{};
            for (std::size_t d = 0; d <= D; ++d) {
                vector sum{};
                for (std::size_t i = first[d]; i < first[d + 1]; ++i) sum += size(to[i * parts]);
                sum *= model::up;
                to[(columns::first_norm + d) * parts] = sum;
                if (d > 0) above += sum;
            }
            above *= model::up;
            vector beyond{};
            for (std::size_t d = 1; d <= D; ++d) {
                beyond += to[(columns::first_norm + D + 1 - d) * parts];
                to[(columns::first_beyond + d - 1) * parts] = beyond * model::up;
            }
            vector const norm = (vector(to[columns::first_norm * parts]) + above) * model::up;
            vector const lost = from[terms * parts];
            // Each coefficient is rounded once more, unless it is divided by 1.
            vector const r =
                ((lost * up + model::tiny) / divisor + norm * (divisor == 1 ? 0 : model::unit)) *
                    model::up +
                model::tiny;
            // Products of a size near the overflow have lost far more than that.
            auto const known = reinterpret_cast<whole>((norm < model::largest) & (lost < 1e280));
            vector const never = vector{} + std::numeric_limits<double>::infinity();
            to[columns::above * parts] = above;
            to[columns::whole_norm * parts] = norm;
            to[columns::radius * parts] = reinterpret_cast<vector>(
                (reinterpret_cast<whole>(r) & known) | (reinterpret_cast<whole>(never) & ~known));
        }
    }

    /// How often a product of a convolution of so many orders is rounded at most.
    static constexpr std::size_t roundings(std::size_t orders) {
        if constexpr (terms > 1) return orders * table::data.longest_sum;
        return std::min(orders, chunk + (orders - 1) / chunk);
    }

private:
    /// Products up to so many are unrolled: the positions are constants of the instructions.
    static constexpr std::size_t unrolled = 250;
    static constexpr std::size_t chunk = 4;

    [[gnu::always_inline]] static inline vector size(vector const& x) {
        constexpr auto all = std::numeric_limits<std::int64_t>::max(); // but the sign
        return reinterpret_cast<vector>(reinterpret_cast<whole>(x) & (whole{} + all));
    }

    /// Numbers, no polynomials: all sums stay in registers. Few are summed before they join the
    /// others, so that none is rounded as often as there are orders.
    template <std::size_t... P>
    [[gnu::always_inline]] static inline void add_all(double* totals, double const* a,
                                                      double const* v, std::size_t to,
                                                      double rounding, std::index_sequence<P...>) {
        vector value[parts]{}, by_radius[parts]{}, by_size[parts]{};
        for (std::size_t first = 0; first <= to; first += chunk) {
            std::size_t const end = std::min(to + 1, first + chunk);
            vector few[parts]{};
            for (std::size_t j = first; j < end; ++j, a += factor::count, v -= columns::step) {
                auto const* const b = reinterpret_cast<stored const*>(v);
                vector const times = vector{} + a[0];
                vector const everything = vector{} + a[factor::everything];
                vector const lost =
                    vector{} + (a[factor::radius] + rounding * a[factor::whole_norm]);
                ((few[P] += times * b[P]), ...);
                ((by_radius[P] += everything * b[columns::radius * parts + P]), ...);
                ((by_size[P] += lost * b[columns::whole_norm * parts + P]), ...);
            }
            ((value[P] += few[P]), ...);
        }
        auto* const sum = reinterpret_cast<stored*>(totals);
        ((sum[P] += value[P]), ...);
        ((sum[parts + P] += by_radius[P] + by_size[P]), ...);
    }

    static void add_part(double* totals, double const* a, double const* v, std::size_t to,
                         double rounding) {
        vector sum[terms]{};
        vector lost{};
        for (std::size_t j = 0; j <= to; ++j, a += factor::count, v -= columns::step) {
            auto const* const b = reinterpret_cast<stored const*>(v);
            multiply(sum, a, b, std::make_index_sequence<terms>{});
            for (std::size_t d = 0; d < D; ++d) {
                lost += b[(columns::first_beyond + d) * parts] * a[factor::first_norm + d];
            }
            lost += b[columns::radius * parts] * a[factor::everything];
            lost += b[columns::whole_norm * parts] *
                    (a[factor::radius] + rounding * a[factor::whole_norm]);
        }
        auto* const total = reinterpret_cast<stored*>(totals);
        for (std::size_t i = 0; i < terms; ++i) total[i * parts] += sum[i];
        total[terms * parts] += lost;
    }
    template <std::size_t... K>
    [[gnu::always_inline]] static inline void multiply(vector* sum, double const* a,
                                                       stored const* b, std::index_sequence<K...>) {
        if constexpr (table::products > unrolled) {
            for (std::size_t k = 0; k < terms; ++k) {
                vector total = sum[k];
                for (std::size_t p = table::data.sum[k]; p < table::data.sum[k + 1]; ++p) {
                    total += b[table::data.pairs[p].right * parts] * a[table::data.pairs[p].left];
                }
                sum[k] = total;
            }
        } else {
            (coefficient<table::data.sum[K]>(
                 sum[K], a, b,
                 std::make_index_sequence<table::data.sum[K + 1] - table::data.sum[K]>{}),
             ...);
        }
    }
    template <std::size_t First, std::size_t... P>
    [[gnu::always_inline]] static inline void
    coefficient(vector& sum, double const* a, stored const* b, std::index_sequence<P...>) {
        ((sum +=
          b[table::data.pairs[First + P].right * parts] * a[table::data.pairs[First + P].left]),
         ...);
    }
};

} // namespace SIVID_PACK_TARGET

/// A sum of convolutions of single series with rows of columns, and of single models, in all
/// columns: one rounding bound for each of them (`docs/taylor_models.md`, section 1.1).
template <std::size_t N, std::size_t D>
class column_sum {
    using columns = coefficient_columns<N, D>;
    using model = taylor_model<N, D>;
    static constexpr std::size_t rows = model::terms + 1;

public:
    column_sum() = default;
    explicit column_sum(std::size_t groups) : totals_(groups * rows) {}

    /// Begins with 0.
    /// @param longest  orders of the longest convolution that is expected
    /// @param addends  how many convolutions and models are expected; both expectations should be
    ///                 near, but need not be right
    void start(std::size_t longest, std::size_t addends) {
        std::fill(totals_.begin(), totals_.end(), block{});
        expected_ = roundings(longest, addends);
        rounding_ = expected_ * (model::unit * (1 + 1e-9));
        expected_joins_ = joins(addends);
        join_rounding_ = expected_joins_ * (model::unit * (1 + 1e-9));
        longest_ = addends_ = 0;
        operations_ = 0;
    }
    /// Adds a model in one column.
    void add(std::size_t column, model const& a) {
        double* const p =
            totals_[column / columns::at_once * rows].data() + column % columns::at_once;
        for (std::size_t i = 0; i < model::terms; ++i) p[i * columns::at_once] += a.c[i];
        p[model::terms * columns::at_once] +=
            a.r + join_rounding_ * a.polynomial_norm() + model::tiny;
        ++addends_;
        operations_ += 4;
    }
    /// Adds \f$ \sum_{j=0}^{to} a_j v_{k-j} \f$, v a row.
    void add_convolution(column_factor<N, D> const& a, columns const& v, std::size_t row,
                         std::size_t k, std::size_t to) {
        for (std::size_t g = 0; g < v.groups(); ++g) {
            column_kernel<N, D>::add(totals_[g * rows].data(), a.data(), v.at(row, g, k), to,
                                     rounding_);
        }
        ++addends_;
        longest_ = std::max(longest_, to + 1);
        operations_ += static_cast<double>((to + 1) * (D + 2) + 4);
    }
    /// Enters the sum, divided by a natural number, as coefficient k of a row.
    void divide_into(columns& v, std::size_t row, std::size_t k, std::size_t divisor) const {
        double const short_of = std::max(
            {1.0, roundings(longest_, addends_) / expected_, joins(addends_) / expected_joins_});
        double const up = short_of * (1 + (4 * operations_ + 64) * model::unit);
        for (std::size_t g = 0; g < v.groups(); ++g) {
            column_kernel<N, D>::divide(totals_[g * rows].data(), static_cast<double>(divisor), up,
                                        v.at(row, g, k));
        }
    }

private:
    struct alignas(64) block : std::array<double, columns::at_once> {};
    /// How often addends are rounded where they join; the first one joins 0. At least 1, as it
    /// divides.
    [[nodiscard]] static double joins(std::size_t addends) {
        return static_cast<double>(std::max<std::size_t>(addends, 2) - 1);
    }
    /// How often a product is rounded at most: in its convolution, and where addends join.
    [[nodiscard]] static double roundings(std::size_t longest, std::size_t addends) {
        std::size_t const orders = std::max<std::size_t>(longest, 1);
        return static_cast<double>(column_kernel<N, D>::roundings(orders)) + joins(addends);
    }

    std::vector<block> totals_;
    double expected_ = 1;
    double rounding_ = 0;
    double expected_joins_ = 1;
    double join_rounding_ = 0;
    double operations_ = 0;
    std::size_t longest_ = 0, addends_ = 0;
};

} // namespace sivid

#endif
