// SPDX-License-Identifier: MIT
// Throughput of interval operations over 512 intervals in L1, one thread: packs, the vocabulary
// type, boost::numeric::interval<double> with its default policies, and what the machine can do at
// most (the loads and stores of the operation, and its floating-point instructions, without
// anything else). Counters: ns and core cycles an interval; the core's clock is measured beside it.
#include <sivid/number/pack_functions.hpp>

#include <benchmark/benchmark.h>
#include <boost/numeric/interval.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <random>
#include <utility>
#include <vector>

namespace {

constexpr std::size_t count = 512;

using sivid::interval;
using boost_interval = boost::numeric::interval<double>;
using pack8 = sivid::pack<8>;
using pack16 = sivid::pack<16>;

/// Core clock in GHz: a chain of dependent integer additions runs one a cycle. The greatest of
/// several.
double measured_clock() {
    double best = 0.0;
    for (int trial = 0; trial < 40; ++trial) {
        std::uint64_t x = 1;
        auto const start = std::chrono::steady_clock::now();
        for (int i = 0; i < 20'000; ++i) {
            __asm__ volatile("add $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\t"
                             "add $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\t"
                             "add $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\t"
                             "add $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\tadd $1, %0"
                             : "+r"(x));
        }
        auto const stop = std::chrono::steady_clock::now();
        double const ghz =
            320'000.0 / std::chrono::duration<double, std::nano>(stop - start).count();
        best = ghz > best ? ghz : best;
    }
    return best;
}

template <class I>
I make(double lo, double hi) {
    if constexpr (requires { I::parts; })
        return sivid::interval_traits<I>::bounds(lo, hi);
    else
        return I(lo, hi);
}
template <class I>
constexpr std::size_t lanes_of() {
    if constexpr (requires { I::parts; })
        return I::lanes;
    else
        return 1;
}

/// 512 intervals of mixed sign in [-3, 3]; `shift` moves them (divisors, arguments of log).
template <class I>
std::vector<I> numbers(std::uint64_t seed, double shift = 0.0) {
    std::mt19937_64 random{seed};
    std::uniform_real_distribution<double> in{-3.0, 3.0};
    std::vector<I> v;
    for (std::size_t i = 0; i < count / lanes_of<I>(); ++i) {
        if constexpr (lanes_of<I>() == 1) {
            double const a = in(random) + shift, b = in(random) + shift;
            v.push_back(make<I>(a < b ? a : b, a < b ? b : a));
        } else {
            double lo[64], hi[64];
            for (std::size_t k = 0; k < lanes_of<I>(); ++k) {
                double const a = in(random) + shift, b = in(random) + shift;
                lo[k] = a < b ? a : b;
                hi[k] = a < b ? b : a;
            }
            v.push_back(I::load(lo, hi));
        }
    }
    return v;
}

double clock_ghz = 0.0;

/// Seconds of this thread: other programs on a shared machine do not count.
double thread_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void report(benchmark::State& state, double seconds) {
    double const ns = seconds * 1e9 / (static_cast<double>(state.iterations()) * count);
    state.counters["ns"] = ns;
    state.counters["cycles"] = ns * clock_ghz;
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/// y[i] = f(a[i], b[i]) over all intervals.
template <class I, class F>
void run(benchmark::State& state, F const& f, double shift_a, double shift_b) {
    auto const a = numbers<I>(1, shift_a), b = numbers<I>(2, shift_b);
    auto y = a;
    double const start = thread_seconds();
    for (auto _ : state) {
        for (std::size_t i = 0; i < a.size(); ++i) y[i] = f(a[i], b[i]);
        benchmark::DoNotOptimize(y.data());
        benchmark::ClobberMemory();
    }
    report(state, thread_seconds() - start);
}

template <class I, class F>
void add_one(std::string const& name, F f, double shift_a = 0.0, double shift_b = 0.0) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [=](benchmark::State& s) { run<I>(s, f, shift_a, shift_b); });
}

template <class F>
void add_all(std::string const& name, F f, double shift_a = 0.0, double shift_b = 0.0) {
    add_one<pack8>(name + "/pack<8>", f, shift_a, shift_b);
    add_one<pack16>(name + "/pack<16>", f, shift_a, shift_b);
    add_one<interval>(name + "/interval", f, shift_a, shift_b);
}
template <class F>
void add_all_and_boost(std::string const& name, F f, double shift_a = 0.0, double shift_b = 0.0) {
    add_all(name, f, shift_a, shift_b);
    add_one<boost_interval>(name + "/boost default", f, shift_a, shift_b);
}

/// The machine's limits, in the widest vector of the target: per interval, `Flops` instructions of
/// multiply-add on independent registers, or the four loads and two stores of a binary operation.
template <class V>
void limit_flops(benchmark::State& state) {
    constexpr int chains = 12;
    V x[chains];
    for (int i = 0; i < chains; ++i) x[i] = V(1.0 + i);
    V const a(0.999999), b(1e-6);
    double const start = thread_seconds();
    for (auto _ : state) {
        // 2 instructions for each vector of intervals.
        for (std::size_t i = 0; i < 2 * count / V::lanes; i += chains)
            for (auto& v : x) v = fma(v, a, b);
        for (auto& v : x) benchmark::DoNotOptimize(v);
    }
    report(state, thread_seconds() - start);
}
template <class V>
void limit_memory(benchmark::State& state) {
    alignas(64) static double a[2 * count] = {1.0}, b[2 * count] = {2.0}, y[2 * count];
    double const start = thread_seconds();
    for (auto _ : state) {
        for (std::size_t i = 0; i < 2 * count; i += V::lanes)
            max(V::load(&a[i]), V::load(&b[i])).store(&y[i]);
        benchmark::DoNotOptimize(&y[0]);
        benchmark::ClobberMemory();
    }
    report(state, thread_seconds() - start);
}

} // namespace

int main(int argc, char** argv) {
    sivid::require_pack_support();
    clock_ghz = measured_clock();
    std::cout << "target " << sivid::pack_target() << ", measured clock " << clock_ghz
              << " GHz; counters are per interval\n";

    using V = pack8::vector;
    benchmark::RegisterBenchmark("limit/2 fma", [](benchmark::State& s) { limit_flops<V>(s); });
    benchmark::RegisterBenchmark("limit/4 loads, 2 stores",
                                 [](benchmark::State& s) { limit_memory<V>(s); });

    add_all_and_boost("add", [](auto const& a, auto const& b) { return a + b; });
    add_all_and_boost("sub", [](auto const& a, auto const& b) { return a - b; });
    add_all_and_boost("mul", [](auto const& a, auto const& b) { return a * b; });
    add_all_and_boost(
        "div, divisors > 0", [](auto const& a, auto const& b) { return a / b; }, 0.0, 3.5);
    add_all("div, any divisor", [](auto const& a, auto const& b) { return a / b; });
    add_all("neg", [](auto const& a, auto const&) { return -a; });
    add_all("sqr", [](auto const& a, auto const&) { return sqr(a); });
    add_all(
        "sqrt", [](auto const& a, auto const&) { return sqrt(a); }, 3.5);
    add_all("exp", [](auto const& a, auto const&) { return exp(a); });
    add_all("expm1", [](auto const& a, auto const&) { return expm1(a); });
    add_all(
        "log", [](auto const& a, auto const&) { return log(a); }, 3.5);
    add_all(
        "log1p", [](auto const& a, auto const&) { return log1p(a); }, 3.5);
    add_all("sin", [](auto const& a, auto const&) { return sin(a); });
    add_all("cos", [](auto const& a, auto const&) { return cos(a); });
    add_all("tan", [](auto const& a, auto const&) { return tan(a); });
    add_all("atan", [](auto const& a, auto const&) { return atan(a); });
    add_all("asin", [](auto const& a, auto const&) { return asin(a); });
    add_all("acos", [](auto const& a, auto const&) { return acos(a); });
    add_all("sinh", [](auto const& a, auto const&) { return sinh(a); });
    add_all("cosh", [](auto const& a, auto const&) { return cosh(a); });
    add_all("tanh", [](auto const& a, auto const&) { return tanh(a); });
    add_all("hypot", [](auto const& a, auto const& b) { return hypot(a, b); });
    add_all("pown 7", [](auto const& a, auto const&) { return pown(a, 7); });

    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
