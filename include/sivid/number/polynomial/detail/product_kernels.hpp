// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_PRODUCT_KERNELS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_PRODUCT_KERNELS_HPP

#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/monomial_space.hpp>
#include <sivid/number/polynomial/monomials.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

/// @file
/// The innermost loops: truncated products of polynomials. Every one of them forms coefficient k
/// from at most `longest_sum` products, each rounded once and added up at most `longest_sum` - 1
/// times before the total joins what is there; the bounds of `docs/taylor_models.md`, section 1.1,
/// hold for all of them.

namespace sivid {
inline namespace SIVID_PACK_TARGET {
namespace product_detail {

/// Sizes whose products are unrolled: what searches and single boxes use.
#define SIVID_UNROLLED_PRODUCTS(X)                                                                 \
    X(2, 1)                                                                                        \
    X(3, 1)                                                                                        \
    X(4, 1)                                                                                        \
    X(6, 1) X(7, 1) X(2, 2) X(3, 2) X(1, 3) X(2, 3) X(3, 3) X(4, 3) X(1, 4) X(2, 4) X(3, 4) X(2, 6)

/// What a coefficient starts from where there is nothing to start from.
struct no_start {
    template <class V>
    [[gnu::always_inline]] friend inline V operator+(no_start, V const& x) {
        return x;
    }
};
/// start(k) for all coefficients that start with their first product.
[[gnu::always_inline]] inline no_start from_nothing(std::size_t) { return {}; }

/// Unrolled: the positions are constants of the instructions.
template <std::size_t N, std::size_t D>
struct unrolled_product {
    using table = monomials<N, D>;
    static constexpr bool fixed = true;
    static constexpr std::size_t terms = table::count;
    static constexpr std::size_t degree = D;

    /// @param start  (k): what the sum of the products that make up coefficient k begins with
    /// @param join   (k, total): takes coefficient k of start + a b
    template <class A, class B, class Start, class Join>
    [[gnu::always_inline]] static inline void run(monomial_space const&, A const& a, B const& b,
                                                  Start const& start, Join const& join) {
        run(a, b, start, join, std::make_index_sequence<terms>{});
    }

private:
    template <class A, class B, class Start, class Join, std::size_t... K>
    [[gnu::always_inline]] static inline void run(A const& a, B const& b, Start const& start,
                                                  Join const& join, std::index_sequence<K...>) {
        (join(K, coefficient<table::data.sum[K]>(
                     a, b, start(K),
                     std::make_index_sequence<table::data.sum[K + 1] - table::data.sum[K]>{})),
         ...);
    }
    template <std::size_t First, class A, class B, class S, std::size_t... P>
    [[gnu::always_inline]] static inline auto coefficient(A const& a, B const& b, S const& start,
                                                          std::index_sequence<P...>) {
        return (start + ... +
                (a(table::data.pairs[First + P].left) * b(table::data.pairs[First + P].right)));
    }
};

/// Degrees 0, 1 and 2 in any number of variables: the monomials of degree 2 stand in rows, all that
/// is read stands side by side, and no table is needed.
template <std::size_t D>
struct low_degree_product {
    static constexpr bool fixed = D == 0;
    static constexpr std::size_t terms = 1; ///< where it is fixed
    static constexpr std::size_t degree = D;

    template <class A, class B, class Start, class Join>
    [[gnu::always_inline]] static inline void
    run(monomial_space const& space, A const& a, B const& b, Start const& start, Join const& join) {
        auto const a0 = a(0);
        auto const b0 = b(0);
        join(0, start(0) + a0 * b0);
        if constexpr (D > 0) {
            std::size_t const n = space.variables();
            for (std::size_t v = 1; v <= n; ++v) join(v, start(v) + a0 * b(v) + a(v) * b0);
            if constexpr (D > 1) {
                std::size_t k = n + 1;
                for (std::size_t u = 1; u <= n; ++u) {
                    auto const au = a(u);
                    auto const bu = b(u);
                    join(k, start(k) + a0 * b(k) + au * bu + a(k) * b0);
                    ++k;
                    for (std::size_t v = u + 1; v <= n; ++v, ++k) {
                        join(k, start(k) + a0 * b(k) + au * b(v) + a(v) * bu + a(k) * b0);
                    }
                }
            }
        }
    }
};

/// Any size, by the space's table.
struct tabled_product {
    static constexpr bool fixed = false;
    static constexpr std::size_t terms = 0, degree = 0;

    template <class A, class B, class Start, class Join>
    [[gnu::always_inline]] static inline void
    run(monomial_space const& space, A const& a, B const& b, Start const& start, Join const& join) {
        auto const& table = space.products();
        auto const* pair = table.pairs.data();
        for (std::size_t k = 0; k < space.terms(); ++k) {
            auto const* const end = table.pairs.data() + table.sum[k + 1];
            auto total = start(k) + a(pair->left) * b(pair->right);
            for (++pair; pair != end; ++pair) total += a(pair->left) * b(pair->right);
            join(k, total);
        }
    }
};

/// Sums the absolute values of `Count` coefficients, as a tree: additions do not wait for each
/// other.
template <std::size_t Count, class C>
[[gnu::always_inline]] inline C sum_of_sizes(C const* c) {
    using side_by_side = lane_traits<C>;
    if constexpr (Count == 1) {
        return side_by_side::abs(c[0]);
    } else if constexpr (Count <= 16) {
        return sum_of_sizes<Count / 2>(c) + sum_of_sizes<Count - Count / 2>(c + Count / 2);
    } else {
        constexpr std::size_t chains = 4, rest = Count % chains;
        C sum[chains]{};
        for (std::size_t i = 0; i < Count - rest; i += chains) {
            for (std::size_t j = 0; j < chains; ++j) sum[j] += side_by_side::abs(c[i + j]);
        }
        for (std::size_t j = 0; j < rest; ++j) sum[j] += side_by_side::abs(c[Count - rest + j]);
        return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
}
/// The same for a number of them that is not known beforehand, at least one.
template <class C>
[[gnu::always_inline]] inline C sum_of_sizes(C const* c, std::size_t count) {
    using side_by_side = lane_traits<C>;
    C s = side_by_side::abs(c[0]);
    std::size_t i = 1;
    if (count >= 4) {
        C t = side_by_side::abs(c[1]), u = side_by_side::abs(c[2]), v = side_by_side::abs(c[3]);
        for (i = 4; i + 3 < count; i += 4) {
            s += side_by_side::abs(c[i]);
            t += side_by_side::abs(c[i + 1]);
            u += side_by_side::abs(c[i + 2]);
            v += side_by_side::abs(c[i + 3]);
        }
        s = (s + t) + (u + v);
    }
    for (; i < count; ++i) s += side_by_side::abs(c[i]);
    return s;
}

/// The norms of a polynomial: above[0] those of degrees 1 .. D together, then those of degrees
/// 0 .. D.
template <class C>
using norms_function = void (*)(monomial_space const&, C const* c, C* above, double up);

template <class Kernel, class C>
void measure_norms(monomial_space const& space, C const* c, C* above, double up) {
    C total{};
    if constexpr (Kernel::fixed) {
        above[1] = lane_traits<C>::abs(c[0]) * up;
        if constexpr (Kernel::degree > 0) {
            constexpr auto const& first = Kernel::table::data.first;
            [&]<std::size_t... K>(std::index_sequence<K...>) {
                ((above[K + 2] = sum_of_sizes<first[K + 2] - first[K + 1]>(c + first[K + 1]) * up,
                  total += above[K + 2]),
                 ...);
            }
            (std::make_index_sequence<Kernel::degree>{});
        }
    } else {
        auto const* const first = space.firsts();
        std::size_t const degree = space.degree();
        above[1] = lane_traits<C>::abs(c[0]) * up;
        for (std::size_t k = 1; k <= degree; ++k) {
            C const norm = sum_of_sizes(c + first[k], first[k + 1] - first[k]) * up;
            above[k + 1] = norm;
            total += norm;
        }
    }
    above[0] = total * up;
}

/// Calls `use.template operator()<Kernel>()` with the kernel for a size.
template <class Use>
[[nodiscard]] auto with_product_kernel(std::size_t variables, std::size_t degree, Use const& use) {
#define SIVID_USE_PRODUCT(N, D)                                                                    \
    if (variables == N && degree == D) return use.template operator()<unrolled_product<N, D>>();
    SIVID_UNROLLED_PRODUCTS(SIVID_USE_PRODUCT)
#undef SIVID_USE_PRODUCT
    switch (degree) {
    case 0:
        return use.template operator()<low_degree_product<0>>();
    case 1:
        return use.template operator()<low_degree_product<1>>();
    case 2:
        return use.template operator()<low_degree_product<2>>();
    default:
        return use.template operator()<tabled_product>();
    }
}

/// sum += factor * a * b, in each lane.
template <class C>
using product_function = void (*)(monomial_space const&, C* sum, C const* a, C const* b,
                                  double factor);

template <class Kernel, class C>
void accumulate_product(monomial_space const& space, C* sum, C const* a, C const* b,
                        double factor) {
    if constexpr (std::is_same_v<C, double>) {
        Kernel::run(
            space, [a](std::size_t k) { return a[k]; }, [b](std::size_t k) { return b[k]; },
            from_nothing, [sum, factor](std::size_t k, double total) { sum[k] += factor * total; });
    } else {
        for (std::size_t p = 0; p < C::parts; ++p) {
            Kernel::run(
                space, [a, p](std::size_t k) { return a[k].part(p); },
                [b, p](std::size_t k) { return b[k].part(p); }, from_nothing,
                [sum, p, factor](std::size_t k, auto const& total) {
                    sum[k].part(p) += factor * total;
                });
        }
    }
}

template <class C>
[[nodiscard]] product_function<C> product_for(std::size_t variables, std::size_t degree) {
    return with_product_kernel(variables, degree, []<class Kernel>() -> product_function<C> {
        return &accumulate_product<Kernel, C>;
    });
}

template <class C>
[[nodiscard]] norms_function<C> norms_for(std::size_t variables, std::size_t degree) {
    return with_product_kernel(variables, degree, []<class Kernel>() -> norms_function<C> {
        return &measure_norms<Kernel, C>;
    });
}

} // namespace product_detail
} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
