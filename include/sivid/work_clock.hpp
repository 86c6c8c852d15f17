// SPDX-License-Identifier: MIT
#ifndef SIVID_WORK_CLOCK_HPP
#define SIVID_WORK_CLOCK_HPP

#include <sivid/compiled.hpp>

#include <cstddef>

namespace sivid {

/// Counts what a thread computes, in seconds that the same work takes on a slow core, so that a
/// budget ends at the same place on every machine, under any load and with any number of threads.
///   The kernels that all work goes through tell what they did: series, programs, simulations,
///   linear programs. Tasks of an `executor` begin at the time of the caller, who goes on at the
///   sum of what they did; how many of them run at once does not show.
/// @guarantee  none of a time: prices are rough, `benchmarks/paving/robots` prints
///   counted over measured seconds
/// @cost  an addition
class work_clock {
public:
    /// Of this thread, since it began.
    [[nodiscard]] SIVID_DECL static double now();
    SIVID_DECL static void advance(double seconds);
    /// So many operations, each as long as `size` products of Taylor models of numbers.
    static void count(std::size_t operations, double size = 1) {
        advance(static_cast<double>(operations) * (size * price));
    }
    /// Puts it where a task begins, or where a step is taken back.
    SIVID_DECL static void set(double seconds);

    static constexpr double interval = 4; ///< size of an operation of intervals

private:
    /// Twice what it takes on a core of 2.5 GHz: a machine half as fast keeps its budgets by
    /// counting alone.
    static constexpr double price = 1e-8;
};

/// How much was computed since it was made, by the clock of the thread that asks. Copies have the
/// same begin.
class work_watch {
public:
    [[nodiscard]] double spent() const { return work_clock::now() - begin_; }

private:
    double begin_ = work_clock::now();
};

/// Work that is not counted where it is done, because it is done ahead of its turn or again. It is
/// far before the end of all budgets meanwhile: none may cut short what was done whole before.
class uncounted {
public:
    uncounted() { work_clock::set(begin_ - 0x1p20); }
    ~uncounted() { work_clock::set(begin_); }
    uncounted(uncounted const&) = delete;
    uncounted& operator=(uncounted const&) = delete;

private:
    double begin_ = work_clock::now();
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/impl/work_clock.ipp>
#endif

#endif
