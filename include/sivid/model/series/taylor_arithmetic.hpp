// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_TAYLOR_ARITHMETIC_HPP
#define SIVID_MODEL_SERIES_TAYLOR_ARITHMETIC_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/series/detail/series_storage.hpp>
#include <sivid/number/polynomial/taylor_model_functions.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace sivid {

/// Taylor models behind the names of `interval_traits`, so that a recorded model and its series in
/// time run on them as on intervals.
template <class C = double>
struct taylor_arithmetic {
    using value_type = taylor_model<C>;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    static constexpr std::size_t lanes = side_by_side::count;
    static constexpr bool keeps_reciprocals = true;
    /// Whether convolutions are done in rows of coefficients: where the lanes are not taken by
    /// boxes, they are free for orders in time.
    static constexpr bool keeps_rows = std::is_same_v<C, double>;
    using rows = series_rows;
    static constexpr convolved_by by_order = convolved_by::order;

    class accumulator {
    public:
        accumulator() = default;
        /// Forms the sum in the memory of `place`, where no addend may be.
        explicit accumulator(value_type& place) : sum_(place) {}
        void add_convolution(rows const& r, std::size_t a, rows const&, std::size_t b,
                             std::size_t k, std::size_t from, std::size_t to, double factor = 1,
                             convolved_by weight = convolved_by::one) requires(keeps_rows) {
            sum_.add_convolution(r, a, b, k, from, to, factor, weight);
        }
        void add(value_type const& a, double factor = 1) { sum_.add(a, factor); }
        void add_product(value_type const& a, value_type const& b, double factor = 1) {
            sum_.add(a, b, factor);
        }
        void add_square(value_type const& a, double factor = 1) { sum_.add(a, a, factor); }
        [[nodiscard]] value_type result() { return sum_.result(); }
        void result_into(value_type& a) { sum_.result_into(a); }

    private:
        product_sum<C> sum_;
    };

    static value_type point(double x) { return value_type::constant(C(x)); }
    static value_type enclose(interval const& x) { return value_type::constant(x); }
    /// get(lane) in each lane.
    template <class F>
    static value_type enclose_lanes(F const& get) {
        value_type result;
        for (std::size_t l = 0; l < lanes; ++l) {
            interval const x = get(l);
            side_by_side::put(result.c(0), l, mid(x));
            side_by_side::put(result.r(), l,
                              is_empty(x) ? std::numeric_limits<double>::infinity() : rad(x));
        }
        result.finish();
        return result;
    }
    static value_type enclose(literal const& l) { return value_type::constant(l.enclosure); }
    static value_type neg(value_type const& a) { return -a; }
    static value_type add(value_type const& a, value_type const& b) { return a + b; }
    static value_type sub(value_type const& a, value_type const& b) { return a - b; }
    static value_type mul(value_type const& a, value_type const& b) {
        value_type result(typename value_type::unset{});
        mul_into(result, a, b);
        return result;
    }
    static value_type over(value_type const& a, std::size_t k) {
        value_type result(a.shape(), typename value_type::unset{});
        over_into(result, a, k);
        return result;
    }
    /// @param result  may be a
    static void over_into(value_type& result, value_type const& a, std::size_t k) {
        static auto const inverses = [] {
            std::array<std::pair<double, double>, 64> all;
            for (std::size_t n = 1; n < all.size(); ++n) all[n] = inverse(n);
            return all;
        }();
        auto const [m, rho] = k < inverses.size() ? inverses[k] : inverse(k);
        number_detail::scale_into(result, a, C(m), C(rho));
    }
    /// @param result  neither a nor b
    static void mul_into(value_type& result, value_type const& a, value_type const& b) {
        if (a.is_constant()) return number_detail::scale_into(result, b, a.c(0), a.r());
        if (b.is_constant()) return number_detail::scale_into(result, a, b.c(0), b.r());
        product_sum<C> sum(result);
        sum.add(a, b);
        sum.finish();
    }
    /// The functions that are not defined everywhere take bounds of the argument besides, asked for
    /// where its polynomial leaves the domain: see `slot_ranges`.
    /// @param known  () -> `value_bounds<C>`
    template <class Known>
    static value_type reciprocal(value_type const& a, mask& undefined, Known const& known) {
        return settled(univariate::reciprocal, a, known, undefined,
                       [&a](mask& lost) { return sivid::reciprocal(a, lost); });
    }
    template <class Known>
    static value_type sqrt(value_type const& a, mask& undefined, Known const& known) {
        return settled(univariate::sqrt, a, known, undefined,
                       [&a](mask& lost) { return sivid::sqrt(a, lost); });
    }
    template <class Known>
    static value_type log(value_type const& a, mask& undefined, Known const& known) {
        return settled(univariate::log, a, known, undefined,
                       [&a](mask& lost) { return sivid::apply(univariate::log, a, lost); });
    }
    template <class Known>
    static value_type tan(value_type const& a, mask& undefined, Known const& known) {
        return settled(univariate::tan, a, known, undefined,
                       [&a](mask& lost) { return sivid::apply(univariate::tan, a, lost); });
    }
    static value_type reciprocal(value_type const& a, mask& undefined) {
        return reciprocal(a, undefined, own_bounds(a));
    }
    static value_type div(value_type const& a, value_type const& b, mask& undefined) {
        return mul(a, reciprocal(b, undefined));
    }
    static value_type sqr(value_type const& a) { return mul(a, a); }
    static value_type pown(value_type const& a, int n, mask& undefined) {
        return model_detail::power_by_products<taylor_arithmetic>(a, n, undefined);
    }
    static value_type sqrt(value_type const& a, mask& undefined) {
        return sqrt(a, undefined, own_bounds(a));
    }
    static value_type exp(value_type const& a) {
        mask undefined{};
        return sivid::apply(univariate::exp, a, undefined);
    }
    static value_type log(value_type const& a, mask& undefined) {
        return log(a, undefined, own_bounds(a));
    }
    static value_type sin(value_type const& a) { return everywhere(univariate::sin, a); }
    static value_type cos(value_type const& a) { return everywhere(univariate::cos, a); }
    static value_type tan(value_type const& a, mask& undefined) {
        return tan(a, undefined, own_bounds(a));
    }
    static value_type atan(value_type const& a) { return everywhere(univariate::atan, a); }
    static value_type tanh(value_type const& a) { return everywhere(univariate::tanh, a); }
    static value_type tanh_slope(value_type const& a) {
        return everywhere(univariate::sech_squared, a);
    }

    static decided_sign<mask> sign_of(value_type const& a) {
        auto values = rough_bounds(a); // decides as often as not, and costs nothing
        auto const decided = (values.lower > C(0.0)) | (values.upper < C(0.0));
        bool const open = !side_by_side::all(decided) && a.degree() > 1;
        if (open && !side_by_side::all(decided | changes_sign(a))) values = bounds(a);
        decided_sign<mask> s;
        s.positive = values.lower > C(0.0);
        s.negative = values.upper < C(0.0);
        s.neither = !(s.positive | s.negative);
        return s;
    }
    /// Where nothing is known.
    static mask unknown(value_type const& a) { return !(a.norm() < C(value_type::largest)); }
    static value_type select(mask m, value_type const& a, value_type const& b) {
        return sivid::select(m, a, b);
    }
    static value_type abs(value_type const& a) {
        auto const side = sign_of(a);
        auto const sure = sivid::select(side.positive, a, -a);
        if (!side_by_side::any(side.neither)) return sure;
        return sivid::select(
            side.neither,
            by_range(
                side.neither, [](interval const& x) { return interval_traits<interval>::abs(x); },
                a),
            sure);
    }
    /// As a set: [-1, 1] where the argument touches 0.
    static value_type sign(value_type const& a) {
        auto const side = sign_of(a);
        return sivid::select(side.neither, enclose(interval(-1.0, 1.0)),
                             sivid::select(side.positive, point(1.0), point(-1.0)));
    }
    static value_type min(value_type const& a, value_type const& b) {
        auto const side = sign_of(a - b);
        auto const sure = sivid::select(side.positive, b, a);
        if (!side_by_side::any(side.neither)) return sure;
        return sivid::select(side.neither,
                             by_range(
                                 side.neither,
                                 [](interval const& x, interval const& y) {
                                     return interval_traits<interval>::min(x, y);
                                 },
                                 a, b),
                             sure);
    }
    static value_type max(value_type const& a, value_type const& b) { return -min(-a, -b); }

private:
    /// Middle and radius of 1/k.
    static std::pair<double, double> inverse(std::size_t k) {
        using traits = interval_traits<interval>;
        bool never = false;
        auto const x =
            traits::div(traits::point(1.0), traits::point(static_cast<double>(k)), never);
        return {mid(x), rad(x)};
    }
    static interval range_in(value_bounds<C> const& values, std::size_t lane) {
        double const lower = side_by_side::get(values.lower, lane);
        double const upper = side_by_side::get(values.upper, lane);
        bool const known = std::isfinite(lower) && std::isfinite(upper);
        return known ? interval(lower, upper) : interval_traits<interval>::entire();
    }
    /// A function of the arguments' ranges in the wanted lanes; 0 in the others.
    template <class F, class... Models>
    static value_type by_range(mask wanted, F const& f, Models const&... models) {
        auto const of_values = [&](auto const&... values) {
            return enclose_lanes([&](std::size_t l) {
                return side_by_side::test(wanted, l) ? f(range_in(values, l)...) : interval(0.0);
            });
        };
        auto result = of_values(bounds(models)...);
        result.give_up_when_huge(result.norms()[0]);
        return result;
    }
    static auto own_bounds(value_type const& a) {
        return [&a] { return bounds(a); };
    }
    /// A function by its polynomial, or by what is known of the argument where that is lost.
    template <class Known, class Usual>
    static value_type settled(univariate f, value_type const& a, Known const& known,
                              mask& undefined, Usual const& usual) {
        mask lost{};
        auto result = usual(lost);
        if (!side_by_side::any(lost)) return result;
        return apply_between(f, a, known(), lost, std::move(result), undefined);
    }
    /// A bounded function: its range is the answer where the polynomial fails.
    static value_type everywhere(univariate f, value_type const& a) {
        mask undefined{};
        auto const result = sivid::apply(f, a, undefined);
        if (!side_by_side::any(undefined)) return result;
        auto never = false;
        interval range;
        taylor_coefficients(f, interval_traits<interval>::entire(), 0, &range, never);
        return sivid::select(undefined, enclose(range), result);
    }
};

namespace model_detail {
template <class C>
struct arithmetic_for<taylor_model<C>> {
    using type = taylor_arithmetic<C>;
};

/// All in one workspace, as large as the largest may be.
template <class C>
struct storage_of<taylor_model<C>> {
    struct size {
        model_shape<C> const* shape = &model_shape<C>::number();

        size() = default;
        size(model_shape<C> const& s) : shape(&s) {} // NOLINT: a size is what a shape says
    };
    using type = taylor_models<C>;
    static type make(std::size_t count, size const& s) { return type(count, *s.shape); }
    template <class Rows>
    static Rows make_rows(std::size_t series, std::size_t orders, size const& s) {
        return Rows(series, orders, *s.shape);
    }
};
} // namespace model_detail

} // namespace sivid

#endif
