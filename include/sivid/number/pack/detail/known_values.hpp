// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_KNOWN_VALUES_HPP
#define SIVID_NUMBER_PACK_DETAIL_KNOWN_VALUES_HPP

/// @file
/// Functions of an interval type against values that are known: what `first_broken_kernel` of
/// `sivid::compiled` runs.

#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/rounding.hpp>

#include <array>
#include <cstddef>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

namespace trial {

using eight = std::array<double, 8>;

inline constexpr eight any{-3.7, -0.9, -0.01, 0.01, 0.6, 1.3, 2.57, 10.27},
    positive{0.003, 0.4, 0.99, 1.5, 2.0, 7.25, 100.1, 1e10},
    above_one{1.001, 1.1, 1.5, 2.0, 3.75, 20.5, 1e3, 1e9},
    unit{-0.95, -0.5, -0.01, 0.003, 0.3, 0.7, 0.9, 0.999},
    far{-1e+300, -1e+22, -3.7e+09, 1048577.25, 2.5e+07, 1e+15, 6.02e+23, 1.5e+200},
    second{0.7, -3.13, 2.3, -0.43, 3.1, 0.17, 7.39, 1.9};

/// Ascending arguments, and the greatest double below each value (by MPFR; none is a double).
struct values {
    eight x, below;
};
inline constexpr values exp_values{
    any,
    {0x1.9511fc6871043p-6, 0x1.a053cc0086e1dp-2, 0x1.fae7cfd2b9cfdp-1, 0x1.0292a5d2f2226p+0,
     0x1.d27660b11a9efp+0, 0x1.d5ab83615f8b3p+1, 0x1.a21b3bdba2eccp+3, 0x1.c2d78c755f3b1p+14}};
inline constexpr values expm1_values{
    any,
    {-0x1.f357701cbc77ep-1, -0x1.2fd619ffbc8f2p-1, -0x1.460c0b518c09fp-7, 0x1.4952e9791133ep-7,
     0x1.a4ecc162353dep-1, 0x1.55ab83615f8b3p+1, 0x1.821b3bdba2eccp+3, 0x1.c2d38c755f3b1p+14}};
inline constexpr values log_values{
    positive,
    {-0x1.73c8ffae4bedep+2, -0x1.d5240f0e0e078p-1, -0x1.495453e6fd4bcp-7, 0x1.9f323ecbf984bp-2,
     0x1.62e42fefa39efp-1, 0x1.fb22e98a1c24ep+0, 0x1.26cb7bf0a4dd9p+2, 0x1.7069e2aa2aa5ap+4}};
inline constexpr values log1p_values{
    positive,
    {0x1.88a09a34caacep-9, 0x1.588c2d913348fp-2, 0x1.60532ef13c385p-1, 0x1.d5240f0e0e077p-1,
     0x1.193ea7aad030ap+0, 0x1.0e1b775589bd9p+1, 0x1.276e592a8125ep+2, 0x1.7069e2aa3184ep+4}};
inline constexpr values sin_values{
    any,
    {0x1.0f46aec2e1b4p-1, -0x1.91103985da841p-1, -0x1.47acae915e808p-7, 0x1.47acae915e807p-7,
     0x1.2118d17a54158p-1, 0x1.ed577f9c51e4bp-1, 0x1.14fa4f9520997p-1, -0x1.7f09624435c6cp-1}};
inline constexpr values cos_values{
    any,
    {-0x1.b23a2ad7dd938p-1, 0x1.3e43a9692e21cp-1, 0x1.fff9724ad97aap-1, 0x1.fff9724ad97aap-1,
     0x1.a69263c485b14p-1, 0x1.11eb3682a4c5fp-2, -0x1.ae9cdaf3e4f7fp-1, -0x1.53bed0f38be6p-1}};
inline constexpr values tan_values{
    any,
    {-0x1.3fdd037da3554p-1, -0x1.4299ba9c2a139p+0, -0x1.47b0e05625f97p-7, 0x1.47b0e05625f96p-7,
     0x1.5e472e03a280bp-1, 0x1.cd11b1696e97ep+1, -0x1.4953d8f23eecep-1, 0x1.209ec67e57d1ep+0}};
inline constexpr values far_sin_values{
    far,
    {0x1.a2c16b010e385p-1, 0x1.b453ab76bf397p-1, -0x1.78e220dca3012p-2, 0x1.ffef292a2d12ep-1,
     -0x1.de01f480b7c81p-2, 0x1.b76f88136ceb9p-1, -0x1.dab50e1935ccp-1, 0x1.bbff0b318511ep-1}};
inline constexpr values far_cos_values{
    far,
    {-0x1.2699022adc4c1p-1, 0x1.0be2cef01c8f3p-1, -0x1.dc0f86b84ee2ap-1, -0x1.069e8f04d583dp-6,
     -0x1.c4caea726bc17p-1, -0x1.06c154609d33fp-1, 0x1.7fa6aa98c663ep-2, -0x1.fdf2433f6202ep-2}};
inline constexpr values far_tan_values{
    far,
    {-0x1.6be411f37ac77p+0, 0x1.a0f79c1b6b257p+0, 0x1.9555dff011cd4p-2, -0x1.f307e4279a3c3p+5,
     0x1.0e418d2ec8fcbp-1, -0x1.ac23600a95be5p+0, -0x1.3cc264e70a143p+1, -0x1.bdc8c9ec008f6p+0}};
inline constexpr values asin_values{
    unit,
    {-0x1.40d41159f340ap+0, -0x1.0c152382d7366p-1, -0x1.47af7a68f8eefp-7, 0x1.8937726e4cfc7p-9,
     0x1.380159e14f6fep-2, 0x1.8d00e692afd95p-1, 0x1.1ea93705fa172p+0, 0x1.86ac9ad18f803p+0}};
inline constexpr values acos_values{
    unit,
    {0x1.6979e34f1b09p+1, 0x1.0c152382d7365p+1, 0x1.94af143914c36p+0, 0x1.915b198b0babp+0,
     0x1.441f5ecbeef58p+0, 0x1.973e83f5d5c9bp-1, 0x1.cdd9f8f922e98p-2, 0x1.6e634e566a29dp-5}};
inline constexpr values atan_values{
    any,
    {-0x1.4e8c94dbf54e5p+0, -0x1.77338a80603bfp-1, -0x1.47ab48b1efb5ep-7, 0x1.47ab48b1efb5dp-7,
     0x1.14b1dd5f90cep-1, 0x1.d488143ad8c43p-1, 0x1.3320abf1428a7p+0, 0x1.794674e59ff68p+0}};
inline constexpr values sinh_values{
    any,
    {-0x1.4361720f61b9fp+4, -0x1.06c9ccd5b6af8p+0, -0x1.47af7a654e9efp-7, 0x1.47af7a654e9eep-7,
     0x1.45f775546a77dp-1, 0x1.b2c9310045c63p+0, 0x1.9fa8412f90742p+2, 0x1.c2d78c6c4969ep+13}};
inline constexpr values cosh_values{
    any,
    {0x1.43c6b68e7bd62p+4, 0x1.6edebfd5d867fp+0, 0x1.000346de27852p+0, 0x1.000346de27852p+0,
     0x1.2f7aa606e563p+0, 0x1.f88dd5c279503p+0, 0x1.a48e3687b5656p+2, 0x1.c2d78c7e750c3p+13}};
inline constexpr values tanh_values{
    any,
    {-0x1.ff5fdc948488cp-1, -0x1.6ebe982d6605dp-1, -0x1.47ab48ae4595fp-7, 0x1.47ab48ae4595ep-7,
     0x1.12f8292d2ccfbp-1, 0x1.b933c726e9b3ap-1, 0x1.fa09625cd9af9p-1, 0x1.ffffffeb5d5bbp-1}};
inline constexpr values asinh_values{
    any,
    {-0x1.02772218247ccp+1, -0x1.9e23ce96e38d5p-1, -0x1.47acae9508b07p-7, 0x1.47acae9508b06p-7,
     0x1.233d046269394p-1, 0x1.14155e5c8c3fep+0, 0x1.ac447099d3ce1p+0, 0x1.832a8d6ed3dddp+1}};
inline constexpr values acosh_values{
    above_one,
    {0x1.6e53acbcdeba2p-5, 0x1.c636c1a882f2cp-2, 0x1.ecc2caec51609p-1, 0x1.5124271980434p+0,
     0x1.ff233e421d3b3p+0, 0x1.db42d1a3ccf86p+1, 0x1.e6752e8a84ed3p+2, 0x1.56a9a0b23d187p+4}};
inline constexpr values atanh_values{
    unit,
    {-0x1.d4ef968880dd5p+0, -0x1.193ea7aad030bp-1, -0x1.47b0e059d0597p-7, 0x1.89379915f8e05p-9,
     0x1.3cf2b50617c95p-2, 0x1.bc0ed0947fbe8p-1, 0x1.78e360604b32cp+0, 0x1.e66cfde9c7c2dp+1}};
inline constexpr values sqrt_values{
    above_one,
    {0x1.0020c2830b9c6p+0, 0x1.0c7ebc96a56f5p+0, 0x1.3988e1409212ep+0, 0x1.6a09e667f3bccp+0,
     0x1.efbdeb14f4ed9p+0, 0x1.21c5b70d9f823p+2, 0x1.f9f6e4990f227p+4, 0x1.ee1b1b3d78c7ap+14}};
inline constexpr values sqr_values{
    any,
    {0x1.b6147ae147ae2p+3, 0x1.9eb851eb851ebp-1, 0x1.a36e2eb1c432cp-14, 0x1.a36e2eb1c432cp-14,
     0x1.70a3d70a3d709p-2, 0x1.b0a3d70a3d70ap+0, 0x1.a6b6ae7d566cep+2, 0x1.a5e43fe5c91dp+6}};
inline constexpr values pown_values{
    any,
    {-0x1.4374a6b89f57ap-6, -0x1.5f2a7db7a8e93p+0, -0x1.e848p+19, 0x1.e847fffffffffp+19,
     0x1.284bda12f684cp+2, 0x1.d217124b4607ap-2, 0x1.e29a86b9a45f5p-5, 0x1.e403c5f01435fp-11}};
inline constexpr values pown5_values{
    any,
    {-0x1.5ab843d46b26ep+9, -0x1.2e54b48d3ae6ap-1, -0x1.b7cdfd9d7bdbcp-34, 0x1.b7cdfd9d7bdbbp-34,
     0x1.3e81450efdc9bp-4, 0x1.db414a4d2b2c1p+1, 0x1.c07642d41c138p+6, 0x1.be48f33d62391p+16}};
inline constexpr values pow_values{
    positive,
    {0x1.18ce13ad4781p-6, 0x1.19a02ab697331p+4, 0x1.f44ceb6d27bf7p-1, 0x1.ae14da72c4dbap-1,
     0x1.125fbee250664p+3, 0x1.6681bf347aadfp+0, 0x1.140b3705d1a7p+49, 0x1.158e460913cf6p+63}};
inline constexpr values atan2_values{
    any,
    {-0x1.6241d5aaede89p+0, -0x1.6e491a846bfbfp+1, -0x1.1ceff52fb79b8p-8, 0x1.8f25cc847c6f8p+1,
     0x1.878bb7cbc7e7ep-3, 0x1.70d5f8c76b695p+0, 0x1.56b77eabc3b03p-2, 0x1.634ac8889ca26p+0}};
inline constexpr values hypot_values{
    any,
    {0x1.e2004c242d7bcp+1, 0x1.a0df988e1ba36p+1, 0x1.26671cc29b43fp+1, 0x1.b87065d24cee3p-2,
     0x1.9429f72102b4cp+1, 0x1.4fa22b8062b04p+0, 0x1.f4be89019cabbp+2, 0x1.4e37822f60e0dp+3}};
inline constexpr values add_values{
    any,
    {-0x1.8000000000001p+1, -0x1.01eb851eb851fp+2, 0x1.251eb851eb851p+1, -0x1.ae147ae147ae2p-2,
     0x1.d999999999999p+1, 0x1.7851eb851eb85p+0, 0x1.3eb851eb851ebp+3, 0x1.8570a3d70a3d6p+3}};
inline constexpr values sub_values{
    any,
    {-0x1.199999999999ap+2, 0x1.1d70a3d70a3d6p+1, -0x1.27ae147ae147bp+1, 0x1.c28f5c28f5c28p-2,
     -0x1.4000000000001p+1, 0x1.2147ae147ae14p+0, -0x1.347ae147ae148p+2, 0x1.0bd70a3d70a3dp+3}};
inline constexpr values mul_values{
    any,
    {-0x1.4b851eb851eb9p+1, 0x1.689374bc6a7efp+1, -0x1.78d4fdf3b645ap-6, -0x1.19ce075f6fd23p-8,
     0x1.dc28f5c28f5c2p+0, 0x1.c49ba5e353f7dp-3, 0x1.2fe075f6fd21fp+4, 0x1.38353f7ced916p+4}};
inline constexpr values div_values{
    any,
    {-0x1.524924924924ap+2, 0x1.2670de7769821p-2, -0x1.1cf06ada2811ep-8, -0x1.7d05f417d05f5p-6,
     0x1.8c6318c6318c5p-3, 0x1.e969696969696p+2, 0x1.641d1949c9443p-2, 0x1.59efd4e25b9efp+2}};

/// Whether f encloses its known values, of which one lane or several are asked at once: at points
/// and, unless f has the argument `second`, too, at both ends of the intervals between neighbours.
template <class T, class F>
[[nodiscard, gnu::cold]] bool holds(values const& v, F const& f) noexcept {
    using I = decltype(T::point(0.0));
    auto const lanes_of = [](auto const& lower, auto const& upper) -> I {
        if constexpr (requires { T::from_lanes(lower, upper); })
            return T::from_lanes(lower, upper);
        else
            return T::bounds(lower(0), upper(0));
    };
    constexpr bool binary = requires(I const& x) { f(x, x); };
    for (std::size_t first = 0; first < 8; first += T::lanes)
        for (std::size_t to = 0; to < (binary ? 1 : 2); ++to) {
            auto const next = [&](std::size_t l) { return first + l < 7 ? first + l + to : 7; };
            I const x = lanes_of([&](std::size_t l) { return detail::opaque(v.x[first + l]); },
                                 [&](std::size_t l) { return detail::opaque(v.x[next(l)]); });
            I z;
            if constexpr (binary) {
                auto const y = [&](std::size_t l) { return detail::opaque(second[first + l]); };
                z = f(x, lanes_of(y, y));
            } else {
                z = f(x);
            }
            for (std::size_t l = 0; l < T::lanes; ++l)
                for (double const below : {v.below[first + l], v.below[next(l)]})
                    if (!(T::lower(z, l) <= below && detail::next_up(below) <= T::upper(z, l)))
                        return false;
        }
    return true;
}

/// The first function of the traits T that misses a known value; null where all hold.
template <class T>
[[nodiscard, gnu::cold]] char const* first_broken_function() noexcept {
    using I = decltype(T::point(0.0));
    typename T::mask cut{};
    if (!holds<T>(exp_values, [](I const& x) { return T::exp(x); })) return "exp";
    if (!holds<T>(sin_values, [](I const& x) { return T::sin(x); }) ||
        !holds<T>(far_sin_values, [](I const& x) { return T::sin(x); }))
        return "sin";
    if (!holds<T>(cos_values, [](I const& x) { return T::cos(x); }) ||
        !holds<T>(far_cos_values, [](I const& x) { return T::cos(x); }))
        return "cos";
    if (!holds<T>(atan_values, [](I const& x) { return T::atan(x); })) return "atan";
    if (!holds<T>(tanh_values, [](I const& x) { return T::tanh(x); })) return "tanh";
    if (!holds<T>(sqr_values, [](I const& x) { return T::sqr(x); })) return "sqr";
    if (!holds<T>(log_values, [&](I const& x) { return T::log(x, cut); })) return "log";
    if (!holds<T>(tan_values, [&](I const& x) { return T::tan(x, cut); }) ||
        !holds<T>(far_tan_values, [&](I const& x) { return T::tan(x, cut); }))
        return "tan";
    if (!holds<T>(sqrt_values, [&](I const& x) { return T::sqrt(x, cut); })) return "sqrt";
    if (!holds<T>(pown_values, [&](I const& x) { return T::pown(x, -3, cut); }) ||
        !holds<T>(pown5_values, [&](I const& x) { return T::pown(x, 5, cut); }))
        return "pown";
    if (!holds<T>(add_values, [](I const& x, I const& y) { return T::add(x, y); })) return "add";
    if (!holds<T>(sub_values, [](I const& x, I const& y) { return T::sub(x, y); })) return "sub";
    if (!holds<T>(mul_values, [](I const& x, I const& y) { return T::mul(x, y); })) return "mul";
    if (!holds<T>(div_values, [&](I const& x, I const& y) { return T::div(x, y, cut); }))
        return "div";
    if constexpr (requires(I const& x) { T::expm1(x); }) { // what no model is made of
        if (!holds<T>(expm1_values, [](I const& x) { return T::expm1(x); })) return "expm1";
        if (!holds<T>(sinh_values, [](I const& x) { return T::sinh(x); })) return "sinh";
        if (!holds<T>(cosh_values, [](I const& x) { return T::cosh(x); })) return "cosh";
        if (!holds<T>(asinh_values, [](I const& x) { return T::asinh(x); })) return "asinh";
        if (!holds<T>(log1p_values, [&](I const& x) { return T::log1p(x, cut); })) return "log1p";
        if (!holds<T>(asin_values, [&](I const& x) { return T::asin(x, cut); })) return "asin";
        if (!holds<T>(acos_values, [&](I const& x) { return T::acos(x, cut); })) return "acos";
        if (!holds<T>(acosh_values, [&](I const& x) { return T::acosh(x, cut); })) return "acosh";
        if (!holds<T>(atanh_values, [&](I const& x) { return T::atanh(x, cut); })) return "atanh";
        if (!holds<T>(hypot_values, [](I const& x, I const& y) { return T::hypot(x, y); }))
            return "hypot";
        if (!holds<T>(pow_values, [&](I const& x, I const& y) { return T::pow(x, y, cut); }))
            return "pow";
        if (!holds<T>(atan2_values, [&](I const& x, I const& y) { return T::atan2(x, y, cut); }))
            return "atan2";
    }
    return nullptr;
}

} // namespace trial

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
