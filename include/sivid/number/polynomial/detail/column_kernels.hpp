// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_COLUMN_KERNELS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_COLUMN_KERNELS_HPP

#include <sivid/number/polynomial/detail/convolution_kernels.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace sivid {

/// Where the numbers of a coefficient in time stand among eight columns (`series_columns`): its
/// coefficients; for d = 1 .. D the norms of degrees that with d exceed D, together; the
/// polynomial's norm; the radius; the norms 0 .. D and 1 .. D together. Each of them eight times.
struct column_layout {
    std::size_t terms, degree;
    static constexpr std::size_t at_once = 8;

    [[nodiscard]] constexpr std::size_t beyond() const { return terms; }
    [[nodiscard]] constexpr std::size_t whole_norm() const { return terms + degree; }
    [[nodiscard]] constexpr std::size_t radius() const { return whole_norm() + 1; }
    [[nodiscard]] constexpr std::size_t norms() const { return radius() + 1; }
    [[nodiscard]] constexpr std::size_t above() const { return norms() + degree + 1; }
    [[nodiscard]] constexpr std::size_t count() const { return above() + 1; }
};
/// The same for what multiplies them (`column_multiplier`): coefficients, norms 1 .. D, the bound
/// of everything, the radius, the polynomial's norm.
struct multiplier_layout {
    std::size_t terms, degree;

    [[nodiscard]] constexpr std::size_t norms() const { return terms; }
    [[nodiscard]] constexpr std::size_t everything() const { return terms + degree; }
    [[nodiscard]] constexpr std::size_t radius() const { return everything() + 1; }
    [[nodiscard]] constexpr std::size_t whole_norm() const { return radius() + 1; }
    [[nodiscard]] constexpr std::size_t count() const { return whole_norm() + 1; }
};

inline namespace SIVID_PACK_TARGET {
namespace product_detail {

inline constexpr std::size_t column_parts = column_layout::at_once / per_vector;

/// Numbers, no polynomials: all sums stay in registers. Few are summed before they join the
/// others, so that none is rounded as often as there are orders.
inline constexpr std::size_t column_chunk = 4;

template <std::size_t... P>
[[gnu::always_inline]] inline void add_numbers(double* totals, double const* a, double const* v,
                                               std::size_t to, double rounding,
                                               std::index_sequence<P...>) {
    constexpr std::size_t parts = column_parts;
    constexpr column_layout column{1, 0};
    constexpr multiplier_layout factor{1, 0};
    vector value[parts]{}, by_radius[parts]{}, by_size[parts]{};
    for (std::size_t first = 0; first <= to; first += column_chunk) {
        std::size_t const end = std::min(to + 1, first + column_chunk);
        vector few[parts]{};
        for (std::size_t j = first; j < end;
             ++j, a += factor.count(), v -= column.count() * column_layout::at_once) {
            auto const* const b = reinterpret_cast<stored_vector const*>(v);
            vector const times = vector{} + a[0];
            vector const everything = vector{} + a[factor.everything()];
            vector const lost = vector{} + (a[factor.radius()] + rounding * a[factor.whole_norm()]);
            ((few[P] += times * b[P]), ...);
            ((by_radius[P] += everything * b[column.radius() * parts + P]), ...);
            ((by_size[P] += lost * b[column.whole_norm() * parts + P]), ...);
        }
        ((value[P] += few[P]), ...);
    }
    auto* const sum = reinterpret_cast<stored_vector*>(totals);
    ((sum[P] += value[P]), ...);
    ((sum[parts + P] += by_radius[P] + by_size[P]), ...);
}

/// totals += \f$ \sum_{j \le to} a_j v_{k-j} \f$; behind the coefficients, what that loses: by
/// degrees beyond D, radii, and `rounding` times the sizes of the products.
/// @param v  coefficient k of eight columns; those of lower orders stand before it
template <class Kernel>
void add_columns(monomial_space const& space, double* totals, double const* a, double const* v,
                 std::size_t to, double rounding) {
    constexpr std::size_t parts = column_parts;
    if constexpr (Kernel::fixed && Kernel::terms == 1) {
        add_numbers(totals, a, v, to, rounding, std::make_index_sequence<parts>{});
    } else {
        std::size_t const terms = Kernel::fixed ? Kernel::terms : space.terms();
        std::size_t const degree = Kernel::fixed ? Kernel::degree : space.degree();
        column_layout const column{terms, degree};
        multiplier_layout const factor{terms, degree};
        std::conditional_t<Kernel::fixed, std::array<vector, Kernel::terms>,
                           number_detail::scratch<vector>>
            sum;
        if constexpr (!Kernel::fixed) sum.resize(terms);
        for (std::size_t part = 0; part < parts; ++part) {
            for (std::size_t i = 0; i < terms; ++i) sum[i] = vector{};
            vector lost{};
            double const* x = a;
            double const* y = v + part * per_vector;
            for (std::size_t j = 0; j <= to;
                 ++j, x += factor.count(), y -= column.count() * column_layout::at_once) {
                auto const* const b = reinterpret_cast<stored_vector const*>(y);
                Kernel::run(
                    space, [x](std::size_t k) { return x[k]; },
                    [b](std::size_t k) { return vector(b[k * parts]); },
                    [&sum](std::size_t k) { return sum[k]; },
                    [&sum](std::size_t k, vector const& total) { sum[k] = total; });
                for (std::size_t d = 0; d < degree; ++d) {
                    lost += b[(column.beyond() + d) * parts] * x[factor.norms() + d];
                }
                lost += b[column.radius() * parts] * x[factor.everything()];
                lost += b[column.whole_norm() * parts] *
                        (x[factor.radius()] + rounding * x[factor.whole_norm()]);
            }
            auto* const total = reinterpret_cast<stored_vector*>(totals + part * per_vector);
            for (std::size_t i = 0; i < terms; ++i) total[i * parts] += sum[i];
            total[terms * parts] += lost;
        }
    }
}

using column_function = void (*)(monomial_space const&, double* totals, double const* a,
                                 double const* v, std::size_t to, double rounding);
[[nodiscard]] inline column_function columns_for(std::size_t variables, std::size_t degree) {
    return with_product_kernel(
        variables, degree, []<class Kernel>() -> column_function { return &add_columns<Kernel>; });
}

/// The totals divided by a natural number, as a coefficient of the columns.
/// @param model_up  of the size's models
/// @param up        makes the computed losses upper bounds
inline void divide_columns(monomial_space const& space, double model_up, double const* totals,
                           double divisor, double up, double* result) {
    constexpr std::size_t parts = column_parts;
    constexpr double unit = std::numeric_limits<double>::epsilon(), tiny = 1e-290, largest = 1e300;
    std::size_t const terms = space.terms(), degree = space.degree();
    column_layout const column{terms, degree};
    auto const size = [](vector const& x) {
        constexpr auto all = std::numeric_limits<std::int64_t>::max(); // but the sign
        return vector_of(bits_of(x) & (vector_mask{} + all));
    };
    auto const* from = reinterpret_cast<stored_vector const*>(totals);
    auto* to = reinterpret_cast<stored_vector*>(result);
    for (std::size_t part = 0; part < parts; ++part, ++from, ++to) {
        for (std::size_t i = 0; i < terms; ++i) to[i * parts] = from[i * parts] / divisor;
        vector above{};
        for (std::size_t d = 0; d <= degree; ++d) {
            vector sum{};
            for (std::size_t i = space.first(d); i < space.first(d + 1); ++i) {
                sum += size(to[i * parts]);
            }
            sum *= model_up;
            to[(column.norms() + d) * parts] = sum;
            if (d > 0) above += sum;
        }
        above *= model_up;
        vector beyond{};
        for (std::size_t d = 1; d <= degree; ++d) {
            beyond += to[(column.norms() + degree + 1 - d) * parts];
            to[(column.beyond() + d - 1) * parts] = beyond * model_up;
        }
        vector const norm = (vector(to[column.norms() * parts]) + above) * model_up;
        vector const lost = from[terms * parts];
        // Each coefficient is rounded once more, unless it is divided by 1.
        vector const r =
            ((lost * up + tiny) / divisor + norm * (divisor == 1 ? 0 : unit)) * model_up + tiny;
        // Products of a size near the overflow have lost far more than that.
        auto const known = vector_mask((norm < largest) & (lost < 1e280));
        vector const never = vector{} + std::numeric_limits<double>::infinity();
        to[column.above() * parts] = above;
        to[column.whole_norm() * parts] = norm;
        to[column.radius() * parts] = vector_of((bits_of(r) & known) | (bits_of(never) & ~known));
    }
}

} // namespace product_detail
} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
