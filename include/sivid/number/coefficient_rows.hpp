// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_COEFFICIENT_ROWS_HPP
#define SIVID_NUMBER_COEFFICIENT_ROWS_HPP

#include <sivid/number/detail/pack_target.hpp>
#include <sivid/number/detail/taylor_model_class.hpp>
#include <sivid/number/lanes.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sivid {

/// Series in time of single Taylor models, once more, with the orders side by side: one row for
/// each coefficient, each norm, the polynomial's norm and the radius. Coefficients of products of
/// two series are then dot products of rows, eight orders in one vector register.
template <std::size_t N, std::size_t D>
class coefficient_rows {
public:
    using model = taylor_model<N, D>;
    static constexpr std::size_t at_once = 8;
    /// Rows of a series: coefficients, norms 1 .. D, the polynomial's norm, the radius.
    static constexpr std::size_t first_norm = model::terms;
    static constexpr std::size_t whole_norm = first_norm + D;
    static constexpr std::size_t radius = whole_norm + 1;
    static constexpr std::size_t count = radius + 1;
    /// Rows of a sum of convolutions: the coefficients, what is lost, the size; then zeros.
    static constexpr std::size_t sums = (model::terms + 2 + at_once - 1) / at_once * at_once;

    coefficient_rows() = default;
    /// @param orders  0 .. orders - 1 of each series will be kept
    coefficient_rows(std::size_t series, std::size_t orders)
        : pitch_(at_once + (orders + at_once - 1) / at_once * at_once),
          blocks_(series * count * pitch_ / at_once) {}

    /// Enters coefficient k of a series.
    void put(std::size_t series, std::size_t k, model const& a) {
        double* p = data() + series * count * pitch_ + at_once + k;
        for (std::size_t i = 0; i < model::terms; ++i, p += pitch_) *p = a.c[i];
        for (std::size_t d = 1; d <= D; ++d, p += pitch_) *p = a.norms[d];
        *p = a.polynomial_norm();
        *(p + pitch_) = a.r;
    }
    /// Where coefficient 0 of the first row of a series is; `at_once` numbers in front of each row
    /// may be read.
    [[nodiscard]] double const* begin(std::size_t series) const {
        return blocks_.data()->data() + series * count * pitch_ + at_once;
    }
    /// Distance between rows.
    [[nodiscard]] std::size_t pitch() const { return pitch_; }

private:
    struct alignas(64) block : std::array<double, at_once> {};
    double* data() { return blocks_.data()->data(); }

    std::size_t pitch_ = at_once;
    std::vector<block> blocks_;
};

/// What the products in a convolution are multiplied by.
enum class convolution_weight {
    one,  ///< \f$ \sum_j a_j b_{k-j} \f$
    order ///< \f$ \sum_j j a_j b_{k-j} \f$
};

inline namespace SIVID_PACK_TARGET {

/// Eight partial sums, in vector registers, of each coefficient of a sum of convolutions, of what
/// the products lose, and of their size. Their layout in memory is the same for every target.
template <std::size_t N, std::size_t D>
struct convolution_kernel {
    using rows = coefficient_rows<N, D>;
    using table = monomials<N, D>;
    static constexpr std::size_t terms = table::count;
    static constexpr std::size_t width = rows::at_once;

    // No wider than a register: g++ keeps wider vectors in memory, even within loops.
    using vector = lanes_detail::vector;
    using whole = lanes_detail::vector_mask;
    static constexpr std::size_t bytes = lanes_detail::vector_bytes;
    static constexpr std::size_t per_vector = lanes_detail::per_vector;
    static constexpr std::size_t parts = width / per_vector; ///< vectors of a row of partial sums
    typedef double stored __attribute__((vector_size(bytes), may_alias));
    typedef double loose __attribute__((vector_size(bytes), aligned(8), may_alias));
    typedef std::int64_t loose_whole __attribute__((vector_size(bytes), aligned(8), may_alias));

    /// Zeros, then all bits, then zeros, as many of each as a vector has.
    static constexpr std::array<std::int64_t, 3 * per_vector> ramp = [] {
        std::array<std::int64_t, 3 * per_vector> r{};
        for (std::size_t i = per_vector; i < 2 * per_vector; ++i) r[i] = -1;
        return r;
    }();

    /// Adds factor * \f$ \sum_{j=from}^{to} w_j a_j b_{k-j} \f$, w as `weight` says. What stands in
    /// the rows outside of that is not read as a number: it may be a NaN.
    /// @param fresh  whether the partial sums are to be 0 before
    [[gnu::noinline]] static void add(double* totals, bool fresh, double const* a,
                                      std::size_t pitch_a, double const* b, std::size_t pitch_b,
                                      std::size_t k, std::size_t from, std::size_t to,
                                      double factor, convolution_weight weight) {
        auto* const sum = reinterpret_cast<stored*>(totals);
        if (fresh) {
            for (std::size_t i = 0; i < groups * per_vector * parts; ++i) sum[i] = vector{};
        }
        bool const plain = factor == 1 && weight == convolution_weight::one;
        for (std::size_t first = from / per_vector * per_vector; first <= to; first += per_vector) {
            // Read rather than compared: without AVX-512, g++ compares numbers one by one.
            std::int64_t const* const not_before =
                ramp.data() + per_vector - (from > first ? from - first : 0);
            std::int64_t const* const not_after =
                ramp.data() + per_vector +
                (to - first < per_vector ? per_vector - 1 - (to - first) : 0);
            whole const used = whole(*reinterpret_cast<loose_whole const*>(not_before)) &
                               whole(*reinterpret_cast<loose_whole const*>(not_after));
            double const* const p = a + first;
            double const* const q = b + static_cast<std::ptrdiff_t>(k) -
                                    static_cast<std::ptrdiff_t>(first + per_vector - 1);
            vector left[rows::count];
            vector right[rows::count];
            auto const read = [&](std::size_t i) __attribute__((always_inline)) {
                // Copies: bound to references, the numbers would count as aligned.
                vector const forward(*reinterpret_cast<loose const*>(p + i * pitch_a));
                vector const other(*reinterpret_cast<loose const*>(q + i * pitch_b));
                left[i] = masked(forward, used);
                right[i] = masked(backward(other, std::make_index_sequence<per_vector>{}), used);
            };
            if constexpr (rows::count <= in_registers) {
                [&]<std::size_t... I>(std::index_sequence<I...>) { (read(I), ...); }
                (std::make_index_sequence<rows::count>{});
            } else {
                for (std::size_t i = 0; i < rows::count; ++i) read(i);
            }
            if (!plain) {
                vector w = vector{} + 1;
                if (weight == convolution_weight::order) w = counted(first);
                double const size = factor < 0 ? -factor : factor;
                vector const signed_weight = w * factor;
                vector const unsigned_weight = w * size;
                for (std::size_t i = 0; i < terms; ++i) left[i] *= signed_weight;
                for (std::size_t i = terms; i < rows::count; ++i) left[i] *= unsigned_weight;
            }
            stored* const own = sum + first / per_vector % parts;
            multiply(own, left, right, std::make_index_sequence<terms>{});
            // What the products have beyond degree D, and the radii times everything.
            vector const pa = left[rows::whole_norm], pb = right[rows::whole_norm];
            vector const ra = left[rows::radius], rb = right[rows::radius];
            vector lost = ra * (pb + rb) + rb * pa;
            vector high{};
            for (std::size_t d = 1; d <= D; ++d) {
                high += right[rows::first_norm + D - d];
                lost += left[rows::first_norm + d - 1] * high;
            }
            own[terms * parts] += lost;
            own[(terms + 1) * parts] += pa * pb;
        }
    }

    /// The eight partial sums of each row added up, pair by pair.
    [[gnu::noinline]] static void add_up(double const* totals, double* result) {
        auto const* sum = reinterpret_cast<stored const*>(totals);
        for (std::size_t g = 0; g < groups; ++g, sum += per_vector * parts) {
            vector row[per_vector];
            for (std::size_t i = 0; i < per_vector; ++i) {
                row[i] = sum[i * parts];
                if constexpr (parts == 2) row[i] += sum[i * parts + 1];
                if constexpr (parts == 4) {
                    row[i] =
                        (row[i] + sum[i * parts + 1]) + (sum[i * parts + 2] + sum[i * parts + 3]);
                }
            }
            *reinterpret_cast<loose*>(result + g * per_vector) = across(row);
        }
    }

private:
    static_assert(parts == 1 || parts == 2 || parts == 4);
    /// Products up to so many are unrolled: the positions are constants of the instructions.
    static constexpr std::size_t unrolled = 250;
    /// So many rows at most are read without a loop, so that they can stay in registers.
    static constexpr std::size_t in_registers = 8;
    /// Vectors of rows of a sum: what is added up together.
    static constexpr std::size_t groups = (terms + 2 + per_vector - 1) / per_vector;

    [[gnu::always_inline]] static inline vector masked(vector const& x, whole const& used) {
        return reinterpret_cast<vector>(reinterpret_cast<whole>(x) & used);
    }
    template <std::size_t... I>
    [[gnu::always_inline]] static inline vector backward(vector const& x,
                                                         std::index_sequence<I...>) {
        return __builtin_shufflevector(x, x, (per_vector - 1 - I)...);
    }
    /// first, first + 1, ...
    [[gnu::always_inline]] static inline vector counted(std::size_t first) {
        vector w = vector{} + static_cast<double>(first);
        for (std::size_t i = 0; i < per_vector; ++i) w[i] += static_cast<double>(i);
        return w;
    }
    /// The sum of each of as many vectors as one has lanes.
    template <class Vector>
    [[gnu::always_inline]] static inline Vector across(Vector const* x) {
        constexpr std::size_t count = sizeof(Vector) / sizeof(double);
        if constexpr (count == 2) {
            return __builtin_shufflevector(x[0], x[1], 0, 2) +
                   __builtin_shufflevector(x[0], x[1], 1, 3);
        } else if constexpr (count == 4) {
            Vector two[2];
            for (std::size_t i = 0; i < 2; ++i) {
                two[i] = __builtin_shufflevector(x[2 * i], x[2 * i + 1], 0, 4, 2, 6) +
                         __builtin_shufflevector(x[2 * i], x[2 * i + 1], 1, 5, 3, 7);
            }
            return __builtin_shufflevector(two[0], two[1], 0, 1, 4, 5) +
                   __builtin_shufflevector(two[0], two[1], 2, 3, 6, 7);
        } else {
            Vector two[4], four[2];
            for (std::size_t i = 0; i < 4; ++i) {
                Vector const y = x[2 * i], z = x[2 * i + 1];
                two[i] = __builtin_shufflevector(y, z, 0, 8, 2, 10, 4, 12, 6, 14) +
                         __builtin_shufflevector(y, z, 1, 9, 3, 11, 5, 13, 7, 15);
            }
            for (std::size_t i = 0; i < 2; ++i) {
                Vector const y = two[2 * i], z = two[2 * i + 1];
                four[i] = __builtin_shufflevector(y, z, 0, 1, 8, 9, 4, 5, 12, 13) +
                          __builtin_shufflevector(y, z, 2, 3, 10, 11, 6, 7, 14, 15);
            }
            return __builtin_shufflevector(four[0], four[1], 0, 1, 2, 3, 8, 9, 10, 11) +
                   __builtin_shufflevector(four[0], four[1], 4, 5, 6, 7, 12, 13, 14, 15);
        }
    }

    template <std::size_t... K>
    [[gnu::always_inline]] static inline void multiply(stored* sum, vector const* a,
                                                       vector const* b, std::index_sequence<K...>) {
        if constexpr (table::products > unrolled) {
            for (std::size_t k = 0; k < terms; ++k) {
                vector total = sum[k * parts];
                for (std::size_t p = table::data.sum[k]; p < table::data.sum[k + 1]; ++p) {
                    total += a[table::data.pairs[p].left] * b[table::data.pairs[p].right];
                }
                sum[k * parts] = total;
            }
        } else {
            (coefficient<table::data.sum[K]>(
                 sum[K * parts], a, b,
                 std::make_index_sequence<table::data.sum[K + 1] - table::data.sum[K]>{}),
             ...);
        }
    }
    template <std::size_t First, std::size_t... P>
    [[gnu::always_inline]] static inline void
    coefficient(stored& sum, vector const* a, vector const* b, std::index_sequence<P...>) {
        vector total = sum;
        ((total += a[table::data.pairs[First + P].left] * b[table::data.pairs[First + P].right]),
         ...);
        sum = total;
    }
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
