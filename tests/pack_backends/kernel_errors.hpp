// SPDX-License-Identifier: MIT
// The kernels of the elementary functions against MPFR: |head + tail - f| <= kernel_error 2^-53
// |head|, on random arguments of every magnitude and on consecutive doubles across every seam of
// the reductions.
#ifndef SIVID_TESTS_PACK_BACKENDS_KERNEL_ERRORS_HPP
#define SIVID_TESTS_PACK_BACKENDS_KERNEL_ERRORS_HPP

#include "support/oracle.hpp"

#include "support/pack_functions.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <vector>

namespace backends::SIVID_PACK_TARGET {

namespace simd = sivid::simd;

/// head + tail times 2^k.
template <class V>
struct scaled {
    simd::expansion<V> y;
    V k;
};

/// The arguments of one kernel: random in [lo, hi], random with magnitudes 2^[low, high], and 41
/// doubles around each seam.
struct domain {
    double lo, hi;
    int low, high;
    std::vector<double> seams;
};

inline std::vector<double> arguments(domain const& d, std::size_t count, std::uint64_t seed) {
    oracle::inputs in{seed};
    std::vector<double> x;
    for (double const s : d.seams)
        for (int step = -20; step <= 20; ++step) x.push_back(oracle::inputs::moved(s, step));
    while (x.size() < count) {
        x.push_back(in.uniform(d.lo, d.hi));
        x.push_back(in.magnitude(d.low, d.high));
    }
    std::erase_if(x, [&](double t) { return !(t >= d.lo && t <= d.hi); });
    return x;
}

/// The greatest error over the arguments, in units of 2^-53 of the head.
template <class V, class Kernel>
double greatest_error(oracle::unary exact, Kernel const& kernel, std::vector<double> x) {
    mpfr_t t, y, sum;
    mpfr_init2(t, 53);
    mpfr_init2(y, 200);
    mpfr_init2(sum, 200);
    double worst = 0.0;
    while (x.size() % V::lanes != 0) x.push_back(x.front());
    for (std::size_t i = 0; i < x.size(); i += V::lanes) {
        scaled<V> const got = kernel(V::load(&x[i]));
        std::array<double, V::lanes> head, tail, k;
        got.y.head.store(head.data());
        got.y.tail.store(tail.data());
        got.k.store(k.data());
        for (std::size_t j = 0; j < V::lanes; ++j) {
            mpfr_set_d(t, x[i + j], MPFR_RNDN);
            exact(y, t, MPFR_RNDN);
            mpfr_mul_2si(y, y, -static_cast<long>(k[j]), MPFR_RNDN);
            mpfr_set_d(sum, head[j], MPFR_RNDN);
            mpfr_add_d(sum, sum, tail[j], MPFR_RNDN);
            mpfr_sub(y, y, sum, MPFR_RNDN);
            double const error = std::fabs(mpfr_get_d(y, MPFR_RNDA));
            if (error == 0.0) continue;
            double const relative = error / std::fabs(head[j]) * 0x1p53;
            if (!(relative <= worst)) worst = relative;
        }
    }
    mpfr_clears(t, y, sum, nullptr);
    return worst;
}

template <class V>
void check_kernels(std::size_t& checks, std::vector<std::string>& failures) {
    namespace e = simd::kernel_error;
    constexpr double ln2 = 0x1.62e42fefa39efp-1, half_pi = 0x1.921fb54442d18p+0;
    std::vector<double> ln2_seams, turn_seams, slope_seams{8.0, 1.0},
        root_seams{0.70710678118654757, 1.4142135623730951};
    for (double k : {0.5, 1.5, 2.5, 10.5, 99.5, 511.5, 1000.5})
        for (double s : {k * ln2, -k * ln2, (k + 0.5) * ln2}) ln2_seams.push_back(s);
    for (double k : {0.5, 1.0, 1.5, 2.0, 3.0, 3.5, 4.0, 22.0, 355.0, 1000.5, 65536.0, 100000.0,
                     573204.0, 667543.5})
        for (double s : {k * half_pi, -k * half_pi}) turn_seams.push_back(s);
    for (auto const& band : simd::slope_bands) {
        slope_seams.push_back(band.from);
        slope_seams.push_back(band.centre);
        slope_seams.push_back(band.from / std::sqrt(1.0 + band.from * band.from));
    }
    for (int k : {1, 2, 3, 5, 9}) root_seams.push_back(std::ldexp(root_seams[0], k));

    auto const check = [&](char const* name, double bound, oracle::unary exact, domain const& d,
                           auto kernel) {
        auto const x = arguments(d, 12'000, 77);
        checks += x.size();
        double const worst = greatest_error<V>(exact, kernel, x);
        if (worst <= bound) return;
        char line[120];
        std::snprintf(line, sizeof line, "kernel %s: error %.3f exceeds its bound %.3f", name,
                      worst, bound);
        failures.emplace_back(line);
    };
    V const zero(0.0);
    check("exp", e::exp, mpfr_exp, {-745.0, 709.7, -40, 9, ln2_seams}, [](V x) {
        auto const a = simd::reduce_exp(x);
        return scaled<V>{simd::exp_kernel(a.r, a.rest), a.k};
    });
    check("expm1", e::expm1, mpfr_expm1, {-42.0, 709.7, -300, 9, ln2_seams}, [](V x) {
        auto const a = simd::reduce_exp(x);
        return scaled<V>{simd::expm1_kernel(a), a.k};
    });
    check("sinh", e::sinh, mpfr_sinh, {-711.0, 711.0, -300, 9, ln2_seams}, [](V x) {
        auto const y = simd::hyperbolic_kernel(abs(x));
        return scaled<V>{simd::with_sign(y.sinh, x), y.k - V(1.0)};
    });
    check("cosh", e::cosh, mpfr_cosh, {-711.0, 711.0, -40, 9, ln2_seams}, [](V x) {
        auto const y = simd::hyperbolic_kernel(abs(x));
        return scaled<V>{y.cosh, y.k - V(1.0)};
    });
    check("tanh", e::tanh, mpfr_tanh, {-22.0, 22.0, -300, 4, ln2_seams}, [=](V x) {
        auto const y = simd::hyperbolic_kernel(abs(x));
        return scaled<V>{
            simd::with_sign(simd::quotient(simd::normalized(y.sinh), simd::normalized(y.cosh)), x),
            zero};
    });
    check("log", e::log, mpfr_log, {0x1p-1074, 0x1.fffffffffffffp+1023, -1074, 1023, root_seams},
          [=](V x) {
              return scaled<V>{simd::log_kernel(simd::reduce_log(x), zero), zero};
          });
    check("log near 1", e::log, mpfr_log, {0.5, 2.0, -1, 0, root_seams}, [=](V x) {
        return scaled<V>{simd::log_kernel(simd::reduce_log(x), zero), zero};
    });
    check(
        "log1p", e::log1p, mpfr_log1p,
        {-0x1.fffffffffffffp-1, 0x1p1023, -300, 1022, {-0.29289321881345254, 0.41421356237309503}},
        [=](V x) {
            return scaled<V>{simd::log1p_kernel(x), zero};
        });
    check("log1p near 0", e::log1p, mpfr_log1p,
          {-0.9, 3.0, -60, 1, {-0.29289321881345254, 0.41421356237309503}}, [=](V x) {
              return scaled<V>{simd::log1p_kernel(x), zero};
          });
    domain const quarter{-half_pi / 2, half_pi / 2, -300, -1, {}};
    check("sin", e::sin_cos, mpfr_sin, quarter, [=](V x) {
        return scaled<V>{simd::sine_kernel(simd::reduce_turns(x)).sin, zero};
    });
    check("cos", e::sin_cos, mpfr_cos, quarter, [=](V x) {
        return scaled<V>{simd::sine_kernel(simd::reduce_turns(x)).cos, zero};
    });
    check("tan", e::tan, mpfr_tan, {-0x1p20, 0x1p20, -300, 19, turn_seams}, [=](V x) {
        return scaled<V>{simd::tan_kernel(simd::reduce_turns(x)), zero};
    });
    check("atan", e::atan, mpfr_atan, {-0x1p899, 0x1p899, -300, 898, slope_seams}, [=](V x) {
        return scaled<V>{simd::atan_kernel(x), zero};
    });
    check("atan near 1", e::atan, mpfr_atan, {-10.0, 10.0, -8, 8, slope_seams}, [=](V x) {
        return scaled<V>{simd::atan_kernel(x), zero};
    });
    check("asin", e::asin, mpfr_asin, {-1.0, 1.0, -300, 0, slope_seams}, [=](V x) {
        return scaled<V>{simd::asin_kernel(x), zero};
    });
    check("acos", e::acos, mpfr_acos, {-1.0, 1.0, -60, 0, slope_seams}, [=](V x) {
        return scaled<V>{simd::acos_kernel(x), zero};
    });
}

} // namespace backends::SIVID_PACK_TARGET

#endif
