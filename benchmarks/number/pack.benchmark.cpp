// SPDX-License-Identifier: MIT
// Throughput of interval operations over 512 intervals in L1, one thread: packs, the vocabulary
// type, boost::numeric::interval<double> with its default policies, and what the machine can do at
// most: the loads and stores of the operation, and its floating-point instructions, without
// anything else. Counters: ns and core cycles an interval; the core's clock is measured beside it.
// At the end everything side by side, with the goals of the project.
#include <sivid/number/guard.hpp>
#include "support/pack_functions.hpp"

#include <benchmark/benchmark.h>
#include <boost/numeric/interval.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <map>
#include <random>
#include <string>
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
std::map<std::string, double> measured; ///< cycles an interval, by the benchmark's name

/// Seconds of this thread: other programs on a shared machine do not count.
double thread_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void report(std::string const& name, benchmark::State& state, double seconds) {
    double const ns = seconds * 1e9 / (static_cast<double>(state.iterations()) * count);
    state.counters["ns"] = ns;
    state.counters["cycles"] = ns * clock_ghz;
    // The least of the repetitions: other programs of a shared machine only add.
    auto const [at, first] = measured.emplace(name, ns * clock_ghz);
    if (!first && ns * clock_ghz < at->second) at->second = ns * clock_ghz;
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/// y[i] = f(a[i], b[i]) over all intervals.
template <class I, class F>
void run(std::string const& name, benchmark::State& state, F const& f, double shift_a,
         double shift_b) {
    auto const a = numbers<I>(1, shift_a), b = numbers<I>(2, shift_b);
    auto y = a;
    double const start = thread_seconds();
    for (auto _ : state) {
        for (std::size_t i = 0; i < a.size(); ++i) y[i] = f(a[i], b[i]);
        benchmark::DoNotOptimize(y.data());
        benchmark::ClobberMemory();
    }
    report(name, state, thread_seconds() - start);
}

template <class I, class F>
void add_one(std::string const& name, F f, double shift_a = 0.0, double shift_b = 0.0) {
    benchmark::RegisterBenchmark(
        name.c_str(), [=](benchmark::State& s) { run<I>(name, s, f, shift_a, shift_b); });
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

/// The machine's limits, in the widest vector of the target: one multiply-add (one division) on
/// independent registers for each vector of intervals; the loads and stores of an operation.
template <class V, class F>
void limit_instructions(std::string const& name, benchmark::State& state, F const& instruction) {
    constexpr int chains = 12;
    constexpr std::size_t times = count / V::lanes / chains + 1;
    V x[chains];
    for (int i = 0; i < chains; ++i) x[i] = V(1.0 + i);
    double const start = thread_seconds();
    for (auto _ : state) {
        for (std::size_t i = 0; i < times; ++i)
            for (auto& v : x) v = instruction(v);
        for (auto& v : x) benchmark::DoNotOptimize(v);
    }
    double const share = static_cast<double>(count) / (times * chains * V::lanes);
    report(name, state, (thread_seconds() - start) * share);
}
template <class V, bool Binary>
void limit_memory(std::string const& name, benchmark::State& state) {
    alignas(64) static double a[2 * count] = {1.0}, b[2 * count] = {2.0}, y[2 * count];
    double const start = thread_seconds();
    for (auto _ : state) {
        for (std::size_t i = 0; i < 2 * count; i += V::lanes) {
            if constexpr (Binary)
                max(V::load(&a[i]), V::load(&b[i])).store(&y[i]);
            else
                (-V::load(&a[i])).store(&y[i]);
        }
        benchmark::DoNotOptimize(&y[0]);
        benchmark::ClobberMemory();
    }
    report(name, state, thread_seconds() - start);
}

/// A row of the table: what the operation needs at least (products or sums, one for each bound; of
/// the functions, the polynomials alone), and the goal for pack<8> in cycles (in ns if negative).
struct row {
    char const* name;
    bool binary;
    double flops, divisions, goal;
};
constexpr row rows[] = {{"add", true, 2, 0, 1.5},        {"mul", true, 2, 0, 2},
                        {"div", true, 0, 2, 2},          {"exp", false, 2 * 11, 0, -3.2},
                        {"log", false, 2 * 10, 2, -3.2}, {"sin", false, 2 * 14, 0, -2.8},
                        {"cos", false, 2 * 14, 0, -2.8}};

void print_table() {
    auto const cycles = [](std::string const& name) {
        auto const found = measured.find(name);
        return found == measured.end() ? 0.0 : found->second;
    };
    std::printf("\ncycles (ns) an interval; limits: loads and stores; floating-point instructions\n"
                "%-5s %18s %18s %18s %18s %8s %8s %s\n",
                "", "boost default", "interval", "pack<8>", "pack<16>", "memory", "flops", "goal");
    for (row const& r : rows) {
        std::printf("%-5s", r.name);
        for (char const* type : {"boost default", "interval", "pack<8>", "pack<16>"}) {
            double const c = cycles(std::string{r.name} + '/' + type);
            if (c == 0.0)
                std::printf(" %18s", "-");
            else
                std::printf(" %8.2f (%6.2f ns)", c, c / clock_ghz);
        }
        double const best = cycles(std::string{r.name} + "/pack<8>");
        bool const in_time = r.goal < 0.0;
        bool const met = in_time ? best / clock_ghz <= -r.goal : best <= r.goal;
        std::printf(" %8.2f %8.2f  <= %.1f %s: %s\n",
                    cycles(r.binary ? "limit/4 loads, 2 stores" : "limit/2 loads, 2 stores"),
                    r.flops * cycles("limit/fma") + r.divisions * cycles("limit/division"),
                    in_time ? -r.goal : r.goal, in_time ? "ns" : "cycles",
                    best == 0.0 ? "not measured"
                    : met       ? "met"
                                : "missed");
    }
}

} // namespace

int main(int argc, char** argv) {
    sivid::require_sound_environment();
    clock_ghz = measured_clock();
    std::cout << "target " << sivid::pack_target() << ", measured clock " << clock_ghz
              << " GHz; counters are per interval\n";

    using V = pack8::vector;
    for (std::string const name : {"limit/fma"})
        benchmark::RegisterBenchmark(name.c_str(), [name](benchmark::State& s) {
            V const a(0.999999), b(1e-6);
            limit_instructions<V>(name, s, [=](V x) { return fma(x, a, b); });
        });
    for (std::string const name : {"limit/division"})
        benchmark::RegisterBenchmark(name.c_str(), [name](benchmark::State& s) {
            V const a(1.000001);
            limit_instructions<V>(name, s, [=](V x) { return x / a; });
        });
    for (std::string const name : {"limit/4 loads, 2 stores"})
        benchmark::RegisterBenchmark(
            name.c_str(), [name](benchmark::State& s) { limit_memory<V, true>(name, s); });
    for (std::string const name : {"limit/2 loads, 2 stores"})
        benchmark::RegisterBenchmark(
            name.c_str(), [name](benchmark::State& s) { limit_memory<V, false>(name, s); });

    add_all_and_boost("add", [](auto const& a, auto const& b) { return a + b; });
    add_all_and_boost("sub", [](auto const& a, auto const& b) { return a - b; });
    add_all_and_boost("mul", [](auto const& a, auto const& b) { return a * b; });
    add_all_and_boost(
        "div", [](auto const& a, auto const& b) { return a / b; }, 0.0, 3.5);
    add_all("div by any", [](auto const& a, auto const& b) { return a / b; });
    add_all("neg", [](auto const& a, auto const&) { return -a; });
    add_all("sqr", [](auto const& a, auto const&) { return sqr(a); });
    add_all(
        "sqrt", [](auto const& a, auto const&) { return sqrt(a); }, 3.5);
    add_all("exp", [](auto const& a, auto const&) { return exp(a); });
    add_all(
        "log", [](auto const& a, auto const&) { return log(a); }, 3.5);
    add_all("sin", [](auto const& a, auto const&) { return sin(a); });
    add_all("cos", [](auto const& a, auto const&) { return cos(a); });
    add_all("tan", [](auto const& a, auto const&) { return tan(a); });
    add_all("atan", [](auto const& a, auto const&) { return atan(a); });
    add_all("tanh", [](auto const& a, auto const&) { return tanh(a); });
    add_all("pown 7", [](auto const& a, auto const&) { return pown(a, 7); });

    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    print_table();
}
