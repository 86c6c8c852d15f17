// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_CONVOLUTION_KERNELS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_CONVOLUTION_KERNELS_HPP

#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/detail/aligned_blocks.hpp>
#include <sivid/number/polynomial/detail/product_kernels.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace sivid {

/// What the products in a convolution are multiplied by.
enum class convolved_by {
    one,  ///< \f$ \sum_j a_j b_{k-j} \f$
    order ///< \f$ \sum_j j a_j b_{k-j} \f$
};

/// Where the rows of a series stand (`series_rows`): coefficients, norms 1 .. D, the polynomial's
/// norm, the radius.
struct row_layout {
    static constexpr std::size_t at_once = 8; ///< orders
    [[nodiscard]] static constexpr std::size_t rows(std::size_t terms, std::size_t degree) {
        return terms + degree + 2;
    }
    /// Rows of a sum of convolutions: the coefficients, what is lost, the size; then zeros.
    [[nodiscard]] static constexpr std::size_t sums(std::size_t terms) {
        return (terms + 2 + at_once - 1) / at_once * at_once;
    }
};

/// One convolution of two series in rows.
struct row_convolution {
    double const* a; ///< coefficient 0 of the first row
    double const* b;
    std::size_t pitch_a, pitch_b; ///< from row to row
    std::size_t k, from, to;
    double factor;
    convolved_by weight;
    bool fresh; ///< the sums are to be 0 before
};

inline namespace SIVID_PACK_TARGET {
namespace product_detail {

using lanes_detail::bits_of;
using lanes_detail::loose_mask;
using lanes_detail::loose_vector;
using lanes_detail::per_vector;
using lanes_detail::stored_vector;
using lanes_detail::vector;
using lanes_detail::vector_mask;
using lanes_detail::vector_of;
inline constexpr std::size_t row_parts = row_layout::at_once / per_vector; ///< vectors of a sum

/// Zeros, then all bits, then zeros, as many of each as a vector has.
inline constexpr std::array<std::int64_t, 3 * per_vector> ramp = [] {
    std::array<std::int64_t, 3 * per_vector> r{};
    for (std::size_t i = per_vector; i < 2 * per_vector; ++i) r[i] = -1;
    return r;
}();

[[gnu::always_inline]] inline vector masked(vector const& x, vector_mask const& used) {
    return vector_of(bits_of(x) & used);
}
/// first, first + 1, ...
[[gnu::always_inline]] inline vector counted(std::size_t first) {
    vector w = vector{} + static_cast<double>(first);
    for (std::size_t i = 0; i < per_vector; ++i) w[i] += static_cast<double>(i);
    return w;
}

/// Adds factor * \f$ \sum_{j=from}^{to} w_j a_j b_{k-j} \f$ to eight partial sums of each
/// coefficient, of what the products lose, and of their size. What stands in the rows outside of
/// that is not read as a number: it may be a NaN.
template <class Kernel>
void convolve_rows(monomial_space const& space, double* totals, row_convolution const& c) {
    std::size_t const terms = Kernel::fixed ? Kernel::terms : space.terms();
    std::size_t const degree = Kernel::fixed ? Kernel::degree : space.degree();
    std::size_t const rows = row_layout::rows(terms, degree);
    auto* const sum = reinterpret_cast<stored_vector*>(totals);
    if (c.fresh) {
        for (std::size_t i = 0; i < row_layout::sums(terms) * row_parts; ++i) sum[i] = vector{};
    }
    constexpr std::size_t local = row_layout::rows(Kernel::terms, Kernel::degree);
    constexpr bool in_registers = Kernel::fixed && local <= 8; // read without a loop
    std::conditional_t<Kernel::fixed, std::array<vector, local>, number_detail::scratch<vector>>
        left, right;
    if constexpr (!Kernel::fixed) {
        left.resize(rows);
        right.resize(rows);
    }
    bool const plain = c.factor == 1 && c.weight == convolved_by::one;
    for (std::size_t first = c.from / per_vector * per_vector; first <= c.to; first += per_vector) {
        // Read rather than compared: without AVX-512, g++ compares numbers one by one.
        std::int64_t const* const not_before =
            ramp.data() + per_vector - (c.from > first ? c.from - first : 0);
        std::int64_t const* const not_after =
            ramp.data() + per_vector +
            (c.to - first < per_vector ? per_vector - 1 - (c.to - first) : 0);
        vector_mask const used = vector_mask(*reinterpret_cast<loose_mask const*>(not_before)) &
                                 vector_mask(*reinterpret_cast<loose_mask const*>(not_after));
        double const* const p = c.a + first;
        double const* const q = c.b + static_cast<std::ptrdiff_t>(c.k) -
                                static_cast<std::ptrdiff_t>(first + per_vector - 1);
        auto const read = [&](std::size_t i) SIVID_INLINED_LAMBDA {
            // Copies: bound to references, the numbers would count as aligned.
            vector const forward(*reinterpret_cast<loose_vector const*>(p + i * c.pitch_a));
            vector const other(*reinterpret_cast<loose_vector const*>(q + i * c.pitch_b));
            left[i] = masked(forward, used);
            right[i] = masked(lanes_detail::backward(other), used);
        };
        if constexpr (in_registers) {
            [&]<std::size_t... I>(std::index_sequence<I...>) { (read(I), ...); }
            (std::make_index_sequence<local>{});
        } else {
            for (std::size_t i = 0; i < rows; ++i) read(i);
        }
        if (!plain) {
            vector w = vector{} + 1;
            if (c.weight == convolved_by::order) w = counted(first);
            double const size = c.factor < 0 ? -c.factor : c.factor;
            vector const signed_weight = w * c.factor;
            vector const unsigned_weight = w * size;
            for (std::size_t i = 0; i < terms; ++i) left[i] *= signed_weight;
            for (std::size_t i = terms; i < rows; ++i) left[i] *= unsigned_weight;
        }
        stored_vector* const own = sum + first / per_vector % row_parts;
        Kernel::run(
            space, [&](std::size_t k) { return left[k]; }, [&](std::size_t k) { return right[k]; },
            [own](std::size_t k) { return vector(own[k * row_parts]); },
            [own](std::size_t k, vector const& total) { own[k * row_parts] = total; });
        // What the products have beyond degree D, and the radii times everything.
        vector const pa = left[terms + degree], pb = right[terms + degree];
        vector const ra = left[terms + degree + 1], rb = right[terms + degree + 1];
        vector lost = ra * (pb + rb) + rb * pa;
        vector high{};
        for (std::size_t d = 1; d <= degree; ++d) {
            high += right[terms + degree - d];
            lost += left[terms + d - 1] * high;
        }
        own[terms * row_parts] += lost;
        own[(terms + 1) * row_parts] += pa * pb;
    }
}

using convolution_function = void (*)(monomial_space const&, double* totals,
                                      row_convolution const&);
[[nodiscard]] inline convolution_function convolution_for(std::size_t variables,
                                                          std::size_t degree) {
    return with_product_kernel(variables, degree, []<class Kernel>() -> convolution_function {
        return &convolve_rows<Kernel>;
    });
}

/// The eight partial sums of each row added up, pair by pair.
inline void add_up_rows(std::size_t terms, double const* totals, double* result) {
    static_assert(row_parts == 1 || row_parts == 2 || row_parts == 4 || row_parts == 8);
    auto const* sum = reinterpret_cast<stored_vector const*>(totals);
    for (std::size_t g = 0; g < terms + 2; g += per_vector, sum += per_vector * row_parts) {
        vector row[per_vector];
        for (std::size_t i = 0; i < per_vector; ++i) {
            auto const* const own = sum + i * row_parts;
            row[i] = own[0];
            if constexpr (row_parts == 2) row[i] += own[1];
            if constexpr (row_parts >= 4) row[i] = (row[i] + own[1]) + (own[2] + own[3]);
            if constexpr (row_parts == 8) row[i] += (own[4] + own[5]) + (own[6] + own[7]);
        }
        *reinterpret_cast<loose_vector*>(result + g) = lanes_detail::across(row);
    }
}

} // namespace product_detail
} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
