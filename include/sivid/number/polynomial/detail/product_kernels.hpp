// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_PRODUCT_KERNELS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_PRODUCT_KERNELS_HPP

/// @file
/// Where coefficients of Taylor models lie, and the loops over them: products, convolutions of
/// series in rows and in columns.

#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/pack/detail/vectors.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/monomial_space.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace sivid::number_detail {

/// Aligned memory for temporaries, in multiples of a cache line. What is given back is kept for the
/// next one of its size, in lists of the thread's own; so arithmetic that makes the same
/// temporaries again and again allocates in its first round only. A block may be given back in
/// another thread than the one that took it.
class aligned_blocks {
public:
    static constexpr std::size_t line = 64;

    [[nodiscard]] static void* take(std::size_t lines) {
        if (lines < kept_sizes) {
            if (node* const first = lists_.first[lines]) {
                lists_.first[lines] = first->next;
                --lists_.kept[lines];
                return first;
            }
        }
        return make(lines);
    }
    static void give_back(void* block, std::size_t lines) noexcept {
        if (lines >= kept_sizes || !lists_.open || lists_.kept[lines] * lines >= most_kept)
            return free(block);
        ++lists_.kept[lines];
        lists_.first[lines] = ::new (block) node{lists_.first[lines]};
    }

private:
    /// Larger ones are not kept: their allocation costs little beside what is done with them.
    static constexpr std::size_t kept_sizes = 512;
    /// Cache lines that a list keeps: a thread that only gives back does not hoard.
    static constexpr std::size_t most_kept = 1U << 16;

    struct node {
        node* next;
    };
    /// Without constructor and destructor, so that reading it needs no check whether it is there.
    struct lists {
        std::array<node*, kept_sizes> first;
        std::array<std::size_t, kept_sizes> kept; ///< blocks in each list
        bool open;
    };
    /// Frees what the lists hold when the thread ends.
    struct keeper {
        keeper() { lists_.open = true; }
        ~keeper() {
            lists_.open = false;
            for (auto& list : lists_.first) {
                while (list != nullptr) {
                    node* const next = list->next;
                    free(list);
                    list = next;
                }
            }
        }
        keeper(keeper const&) = delete;
        keeper& operator=(keeper const&) = delete;
    };

    [[gnu::noinline]] static void* make(std::size_t lines) {
        static thread_local keeper const here;
        (void)here;
        return ::operator new (lines* line, std::align_val_t{line});
    }
    [[gnu::noinline]] static void free(void* block) noexcept {
        ::operator delete (block, std::align_val_t{line});
    }

    static inline constinit thread_local lists lists_{};
};

/// Numbers that are needed for a while; zeros at first.
template <class C>
class scratch {
public:
    scratch() = default;
    explicit scratch(std::size_t numbers) {
        take(numbers);
        std::uninitialized_fill_n(first_, numbers, C(0.0));
    }
    ~scratch() {
        if (first_ != nullptr) aligned_blocks::give_back(first_, lines_);
    }
    scratch(scratch const&) = delete;
    scratch& operator=(scratch const&) = delete;
    /// Makes room for so many, which have no value yet.
    void resize(std::size_t numbers) {
        if (first_ != nullptr) aligned_blocks::give_back(std::exchange(first_, nullptr), lines_);
        take(numbers);
    }
    [[nodiscard]] C& operator[](std::size_t i) { return first_[i]; }
    [[nodiscard]] C const& operator[](std::size_t i) const { return first_[i]; }
    [[nodiscard]] C* data() { return first_; }

private:
    void take(std::size_t numbers) {
        lines_ = std::max<std::size_t>(
            (numbers * sizeof(C) + aligned_blocks::line - 1) / aligned_blocks::line, 1);
        first_ = static_cast<C*>(aligned_blocks::take(lines_));
    }
    std::size_t lines_ = 0;
    C* first_ = nullptr;
};

/// So many numbers in a row, aligned to a cache line: the memory of what lives longer than an
/// operation. Zeros, or not set.
template <class C>
class workspace {
public:
    struct unset {};

    workspace() = default;
    workspace(std::size_t numbers, unset)
        : first_(static_cast<C*>(::operator new (std::max<std::size_t>(numbers, 1) * sizeof(C),
                                                 std::align_val_t{aligned_blocks::line}))) {}
    explicit workspace(std::size_t numbers) : workspace(numbers, unset{}) {
        std::uninitialized_fill_n(first_.get(), numbers, C(0.0));
    }

    [[nodiscard]] C* data() { return first_.get(); }
    [[nodiscard]] C const* data() const { return first_.get(); }

private:
    struct release {
        void operator()(C* p) const noexcept {
            ::operator delete (p, std::align_val_t{aligned_blocks::line});
        }
    };
    std::unique_ptr<C, release> first_;
};

} // namespace sivid::number_detail

// The innermost loops: truncated products of polynomials. Every one of them forms coefficient k
// from at most `longest_sum` products, each rounded once and added up at most `longest_sum` - 1
// times before the total joins what is there; the bounds of `docs/theory/taylor_models.md`,
// section 1.1, hold for all of them.

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

/// The lanes of first, first + 1, ... from one number to another.
[[gnu::always_inline]] inline vector_mask lanes_within(std::size_t first, std::size_t from,
                                                       std::size_t to) {
    // Read rather than compared: without AVX-512, g++ compares numbers one by one.
    std::int64_t const* const not_before =
        ramp.data() + per_vector - (from > first ? from - first : 0);
    std::int64_t const* const not_after =
        ramp.data() + per_vector + (to - first < per_vector ? per_vector - 1 - (to - first) : 0);
    return vector_mask(*reinterpret_cast<loose_mask const*>(not_before)) &
           vector_mask(*reinterpret_cast<loose_mask const*>(not_after));
}

/// What products are multiplied by, from `first` on, and its modulus.
struct signed_and_size {
    vector weight, size;
};
[[gnu::always_inline]] inline signed_and_size weights(row_convolution const& c, std::size_t first) {
    vector w = vector{} + 1;
    if (c.weight == convolved_by::order) w = counted(first);
    double const size = c.factor < 0 ? -c.factor : c.factor;
    return {w * c.factor, w * size};
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
        vector_mask const used = lanes_within(first, c.from, c.to);
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
            auto const [signed_weight, size] = weights(c, first);
            for (std::size_t i = 0; i < terms; ++i) left[i] *= signed_weight;
            for (std::size_t i = terms; i < rows; ++i) left[i] *= size;
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

/// The eight partial sums of each row added up.
inline void add_up_rows(std::size_t terms, double const* totals, double* result) {
    static_assert(per_vector * row_parts == 8);
    auto const* sum = reinterpret_cast<stored_vector const*>(totals);
    for (std::size_t g = 0; g < terms + 2; g += per_vector, sum += 8) {
        vector rows[8];
        for (std::size_t i = 0; i < 8; ++i) rows[i] = sum[i];
        *reinterpret_cast<loose_vector*>(result + g) = lanes_detail::sums_of_eights(rows);
    }
}

} // namespace product_detail
} // namespace SIVID_PACK_TARGET
} // namespace sivid

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
