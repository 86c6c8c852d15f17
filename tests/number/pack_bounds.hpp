// SPDX-License-Identifier: MIT
// The recurrences of docs/theory/pack_functions.md: error bounds of the kernels of packs, summed
// operation by operation over 1000 pieces of each reduced range. All terms are positive, so plain
// doubles are in error by far less than the 1e-6 by which every bound is enlarged at the end.
#ifndef SIVID_TESTS_NUMBER_PACK_BOUNDS_HPP
#define SIVID_TESTS_NUMBER_PACK_BOUNDS_HPP

#include <algorithm>
#include <cmath>
#include <vector>

namespace pack_bounds {

constexpr double u = 0x1p-53, ln2 = 0.6931471805599453, quarter_pi = 0.7853981633974483;
constexpr int pieces = 1000;
constexpr double enlarged = 1.0 + 1e-6;

/// Coefficients a(0), a(1), ... by their magnitudes.
template <class F>
std::vector<double> series(int n, F const& a) {
    std::vector<double> c;
    for (int i = 0; i < n; ++i) c.push_back(a(i));
    return c;
}
inline double factorial(int n) { return std::tgamma(n + 1.0); }

/// Bounds of the value and of the error of Horner's rule for |x| <= X, two roundings a step.
struct value_and_error {
    double value, error;
};
inline value_and_error horner(std::vector<double> const& c, double X) {
    double B = c.back() * (1 + u), E = u * c.back();
    for (auto ci = c.rbegin() + 1; ci != c.rend(); ++ci) {
        double const product = X * B, sum = *ci * (1 + u) + product * (1 + u);
        E = X * E + u * product + u * *ci + u * sum;
        B = sum * (1 + u);
    }
    return {B, E};
}
inline double derivative(std::vector<double> const& c, double z) {
    double d = 0.0;
    for (std::size_t i = 1; i < c.size(); ++i)
        d += static_cast<double>(i) * c[i] * std::pow(z, static_cast<double>(i) - 1);
    return d;
}

constexpr double exp_range = 0.34657360; // ln(2)/2 and the rounding of x log2(e)
constexpr double reduction = 0x1p-82;

/// Error and magnitude of exp_tail for |r| <= R.
inline value_and_error exp_tail(double R) {
    auto const c = series(12, [](int i) { return 1.0 / factorial(i + 2); });
    auto const [B, E] = horner(c, R);
    double const z = R * R, T = z * B;
    double const rest = u * R + reduction, rest_term = rest * (1 + R), tail = T + rest_term;
    double const truncation = std::pow(R, 14) / factorial(14) / (1 - R / 15); // geometric
    return {tail, 3 * u * T + z * E + truncation + rest * z + 3 * u * rest_term + u * tail};
}

/// The rounding of tail -+ delta |head| for delta <= 8 u.
inline double last(double tail, double head) { return u * (tail + 8 * u * head); }

inline double exp() {
    double worst = 0.0;
    for (int sign : {1, -1})
        for (int i = 1; i <= pieces; ++i) {
            double const R = exp_range * i / pieces, R0 = exp_range * (i - 1) / pieces;
            auto const [t, error] = exp_tail(R);
            double const head = (sign > 0 ? 1 + R0 : 1 - R) * (1 - u), tail = u + t;
            worst = std::max(worst, (error + u * tail + reduction + last(tail, 2 * head)) / head);
        }
    return worst / u * enlarged;
}

inline double expm1() {
    double worst = 0.0;
    for (int i = 2; i <= pieces; ++i) { // k = 0; relative to r the error grows with r: the first
                                        // piece is covered by the second, here and below
        double const R = exp_range * i / pieces, R0 = exp_range * (i - 1) / pieces;
        auto const [t, error] = exp_tail(R);
        worst = std::max(worst, (error + last(t, R)) / R0);
    }
    for (double k : {-60.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 10.0, 60.0, 1000.0})
        for (int sign : {1, -1})
            for (int i = 1; i <= pieces; ++i) {
                double const a = sign * exp_range * (i - 1) / pieces,
                             b = sign * exp_range * i / pieces;
                auto const [t, error] = exp_tail(std::fabs(b));
                double const m = std::exp2(-k);
                double const least =
                    std::min(std::fabs(std::exp(a) - m), std::fabs(std::exp(b) - m));
                double const most =
                    std::max(std::fabs(std::exp(a) - m), std::fabs(std::exp(b) - m)) + t + u;
                double const head = least - t - 8 * u, tail = u + t + u * most;
                double const sum = error + u * (u + t) + u * tail + reduction;
                worst = std::max(worst, (sum + last(tail, most)) / head);
            }
    return worst / u * enlarged;
}

/// Bounds for sinh and cosh, relative to the head with the last rounding, and relative to the
/// value.
struct hyperbolic {
    double sinh = 0, cosh = 0, sinh_value = 0, cosh_value = 0;
};
inline hyperbolic sinh_cosh() {
    auto const even = series(6, [](int i) { return 1.0 / factorial(4 + 2 * i); });
    auto const odd = series(7, [](int i) { return 1.0 / factorial(3 + 2 * i); });
    hyperbolic w;
    for (int i = 1; i <= pieces; ++i) {
        double const R = exp_range * i / pieces, R0 = exp_range * std::max(i - 1, 0) / pieces;
        double const z = R * R, dz = u * z;
        auto const [Be, Ee] = horner(even, z);
        auto const [Bo, Eo] = horner(odd, z);
        double const e4 = z * z * Be, e = z / 2 + e4, o = R * z * Bo;
        double const e_error = dz / 2 + 4 * u * e4 + z * z * (Ee + derivative(even, z) * dz) +
                               u * e + std::pow(z, 8) / factorial(16) * 1.1;
        double const o_error = 3 * u * o + R * z * (Eo + derivative(odd, z) * dz) +
                               R * std::pow(z, 8) / factorial(17) * 1.1;
        if (i > 1) {
            w.sinh = std::max(w.sinh, (o_error + last(o, R)) / R0);
            w.sinh_value = std::max(w.sinh_value, o_error / R0);
        }
        double const rest = u * R + reduction, rest_term = rest * (1 + R);
        double const t = e + o + rest_term, tail = u + t;
        double const error = e_error + o_error + u * (e + o) + rest * z + 2 * u * rest_term +
                             u * t + u * tail + reduction;
        for (double k : {0.0, 1.0, 2.0, 3.0, 10.0, 60.0})
            for (int sign : {1, -1})
                for (bool const is_cosh : {false, true}) {
                    if (!is_cosh && k == 0.0) continue;
                    double const m = std::exp2(-2 * k), s = is_cosh ? 1.0 : -1.0;
                    auto const f = [&](double x) { return std::exp(x) + s * m * std::exp(-x); };
                    double const value = std::min(f(sign * R), f(sign * R0));
                    double const tails = tail * (1 + m) + u * 4, head = value - tails - 4 * u;
                    double const sum = error * (1 + m) + 2 * u * tails + 4 * u * u;
                    auto& by_head = is_cosh ? w.cosh : w.sinh;
                    auto& by_value = is_cosh ? w.cosh_value : w.sinh_value;
                    by_head = std::max(by_head, (sum + last(tails, 2 * value)) / head);
                    by_value = std::max(by_value, sum / value);
                }
    }
    for (double* x : {&w.sinh, &w.cosh, &w.sinh_value, &w.cosh_value}) *x *= enlarged / u;
    return w;
}

inline double log() {
    auto const c = series(11, [](int i) { return 2.0 / (2 * i + 3); });
    double worst = 0.0;
    for (double const end : {0.41421357, -0.29289322})
        for (int i = 2; i <= pieces; ++i) {
            double const f = end * i / pieces, g = end * (i - 1) / pieces, a = std::fabs(f);
            double const s = a / (2 + f), z = s * s, ds = 2.01 * u * s;
            auto const [B, E] = horner(c, z);
            double const dz = 2 * ds * s + u * z, R = z * B, half = a * a / 2;
            double const dR = dz * B + z * (E + derivative(c, z) * dz) + u * R;
            double const inner = R + half,
                         d_inner = dR + u * half + u * inner + 2 * std::pow(z, 12) / (25 * (1 - z));
            double const t = std::fabs(std::log1p(f) - f);
            double const error = ds * inner + s * d_inner + u * s * inner + u * half + 1.01 * u * t;
            worst = std::max(worst, (error + 2 * u * t + last(t, a)) / std::fabs(g)); // e = 0
            for (double e : {-1.0, 1.0, 2.0, -2.0, 5.0, -1074.0, 1024.0}) {
                double const value = std::min(std::fabs(e * ln2 + std::log1p(f)),
                                              std::fabs(e * ln2 + std::log1p(g)));
                double const low = std::fabs(e) * 0x1p-41, tail = u * (value + t + 0.1) + low + t;
                double const sum = error + u * t + 2 * u * low + u * (low + t) + u * tail +
                                   std::fabs(e) * 0x1p-101;
                worst = std::max(worst, (sum + last(tail, 2 * value)) / (value - t - 0x1p-29));
            }
        }
    return worst / u * enlarged;
}

struct waves {
    double sin = 0, cos = 0, sin_value = 0, cos_value = 0;
};
inline waves sin_cos() {
    auto const odd = series(8, [](int i) { return 1.0 / factorial(3 + 2 * i); });
    auto const even = series(8, [](int i) { return 1.0 / factorial(4 + 2 * i); });
    waves w;
    constexpr double argument = 0x1p-68;
    for (int i = 2; i <= pieces; ++i) {
        double const range = quarter_pi * (1 + 0x1p-30), R = range * i / pieces,
                     R0 = range * (i - 1) / pieces;
        double const z = R * R, dz = u * z;
        double const Es = horner(odd, z).error + derivative(odd, z) * dz;
        double const Ec = horner(even, z).error + derivative(even, z) * dz;
        double const ulp = std::exp2(std::floor(std::log2(R)) - 52), rest = ulp + 0x1p-83;
        double const o = R * z / 6,
                     o_error = 3 * u * o + R * z * Es + std::pow(R, 19) / factorial(19);
        double const t = o + rest,
                     sin_error = o_error + rest * z * z / 24 + 3 * u * rest + u * t + argument * R;
        w.sin = std::max(w.sin, (sin_error + last(t, R)) / R0);
        w.sin_value = std::max(w.sin_value, sin_error / (R0 * std::sin(R) / R));
        double const h = z * z / 24, tail = u + h + R * rest;
        double const cos_error = dz / 2 + 4 * u * h + z * z * Ec + std::pow(R, 20) / factorial(20) +
                                 R * rest * z / 6 + 2 * u * R * rest + u * tail + argument;
        w.cos = std::max(w.cos, (cos_error + last(tail, 1)) / (std::cos(R) - tail));
        w.cos_value = std::max(w.cos_value, cos_error / std::cos(R));
    }
    for (double* x : {&w.sin, &w.cos, &w.sin_value, &w.cos_value}) *x *= enlarged / u;
    return w;
}

inline double angle() {
    auto const c = series(10, [](int i) { return 1.0 / (2 * i + 3); });
    double worst = 0.0;
    for (double const base : {0.0, std::atan(0.25)})
        for (int i = 2; i <= pieces; ++i) {
            double const t = 0.125000001 * i / pieces, t0 = 0.125 * (i - 1) / pieces, z = t * t;
            double const E = horner(c, z).error + derivative(c, z) * u * z, curve = t * z / 3;
            double const t_tail = base > 0 ? 2.5 * u : 3 * u * t;
            double const tail = u * (base + t) + u * base + curve + t_tail;
            double const error = 3 * u * curve + t * z * E + std::pow(t, 23) / 23 + t_tail * z +
                                 4 * u * t_tail + u * (curve + t_tail) + 2 * u * tail + 0x1p-98;
            worst = std::max(worst, (error + last(tail, 2)) / (base > 0 ? base - t : t0));
        }
    return worst / u * enlarged;
}

} // namespace pack_bounds

#endif
