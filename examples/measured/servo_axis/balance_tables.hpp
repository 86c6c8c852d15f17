// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_BALANCE_TABLES_HPP
#define SERVO_AXIS_BALANCE_TABLES_HPP

#include <sivid/number/elementary.hpp>
#include <sivid/number/interval.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

/// What the balance of a window needs and no parameter enters: computed once.
namespace servo {

using sivid::interval;

/// One window of the record, as the proofs use it.
struct window {
    std::string name;
    std::vector<double> times;      ///< knots; the first is the start
    std::vector<double> force;      ///< at the knots, linear in between
    std::vector<interval> position; ///< at the knots; the first is the start's interval
    interval velocity;              ///< of the start
};

/// Samples a block. Blocks are halved where the velocity comes near zero, down to a quarter of the
/// time between two samples.
inline constexpr std::size_t knots = 4;
inline constexpr std::size_t parts = 4; ///< of the time between two samples
inline constexpr std::size_t levels = 5;
static_assert(knots * parts == std::size_t{1} << (levels - 1));

struct slice {
    interval length, elapsed; ///< elapsed: [0, length]
    interval push;            ///< impulse of the force over the slice: int F
    interval travel;          ///< iint F
    interval pushes;          ///< the same over all parts that begin with the slice
    interval force;           ///< its range
};
struct block {
    std::array<slice, (std::size_t{1} << levels) - 1> nodes; ///< halves of i: 2i + 1, 2i + 2
    interval bend;                                           ///< sum of h^3/12
};
/// Factors for a slice of length h.
struct memory {
    interval decay;  ///< exp(-lambda h)
    interval grown;  ///< 1 - decay
    interval gained; ///< int (1 - exp(-lambda u)) du over [0, h]
};
/// What does not depend on the parameters, at the end of a block.
struct relation {
    interval position; ///< measured
    interval a;        ///< A
    interval e;        ///< E, without what the curvature between samples adds
    interval weight;   ///< int w
    interval impulse;  ///< int w F
    interval bend;     ///< - lambda [decay, 1] sum of h^3/12
    std::array<memory, levels> level;
};

inline interval span(window const& w, std::size_t from, std::size_t to) {
    return interval(w.times[to]) - interval(w.times[from]);
}

/// The block that begins with sample `from`.
inline block cut(window const& w, std::size_t from) {
    block result;
    result.bend = interval(0.0);
    auto& nodes = result.nodes;
    auto const leaves = nodes.size() / 2;
    for (std::size_t i = 0; i < knots * parts; ++i) {
        auto const k = from + i / parts;
        auto const h = span(w, k, k + 1);
        interval const f0(w.force[k]);
        auto const rise = interval(w.force[k + 1]) - f0;
        auto const part = static_cast<double>(i % parts);
        auto const n = static_cast<double>(parts);
        auto const begin = f0 + rise * (part / n);
        auto const end = f0 + rise * ((part + 1) / n);
        auto& s = nodes[leaves + i];
        s.length = h / n;
        s.force = sivid::hull(begin, end);
        s.push = s.length * (begin + end) / 2.0;
        s.travel = sqr(s.length) * (begin * 2.0 + end) / 6.0;
        s.elapsed = sivid::hull(interval(0.0), s.length);
        s.pushes = s.elapsed * s.force;
        if (i % parts == 0) result.bend += h * sqr(h) / 12.0;
    }
    for (std::size_t i = leaves; i-- > 0;) {
        auto const& left = nodes[2 * i + 1];
        auto const& right = nodes[2 * i + 2];
        auto& s = nodes[i];
        s.length = left.length + right.length;
        s.elapsed = sivid::hull(interval(0.0), s.length);
        s.force = sivid::hull(left.force, right.force);
        s.push = left.push + right.push;
        s.travel = left.travel + left.push * right.length + right.travel;
        s.pushes = sivid::hull(left.pushes, left.push + right.pushes);
    }
    return result;
}

/// One relation a block, for one lambda [1/s].
inline std::vector<relation> relate(window const& w, double rate) {
    std::vector<relation> result;
    interval const lambda(rate);
    interval e(0.0), weight(0.0), impulse(0.0), time(0.0), force_once(0.0);
    for (std::size_t from = 0; from + knots < w.times.size(); from += knots) {
        auto const to = from + knots;
        interval bend(0.0);
        auto shortest = span(w, from, from + 1);
        for (auto k = from + 1; k <= to; ++k) {
            auto const h = span(w, k - 1, k);
            shortest = sivid::hull(shortest, h);
            auto const decay = sivid::exp(-lambda * h);
            // int exp(-lambda u) du over [0, h], and the same with (1 - u/h).
            auto const whole = (1.0 - decay) / lambda;
            auto const late = (h - whole) / (lambda * h);
            auto const early = whole - late;
            auto const q0 = w.position[k - 1] - w.position[0];
            auto const q1 = w.position[k] - w.position[0];
            interval const f0(w.force[k - 1]);
            interval const f1(w.force[k]);
            e = decay * e + lambda * (early * q0 + late * q1);
            impulse = decay * impulse + (1.0 - decay) * force_once + f0 * (h / 2.0 - early) +
                      f1 * (h / 2.0 - late);
            weight = decay * weight + (1.0 - decay) * time + (h - whole);
            force_once += h * (f0 + f1) / 2.0;
            time += h;
            bend += h * sqr(h) / 12.0;
        }
        auto const tau = span(w, 0, to);
        relation r;
        r.position = w.position[to];
        r.a = lambda * (w.position[to] - w.position[0]) -
              (1.0 - sivid::exp(-lambda * tau)) * w.velocity;
        r.e = e;
        r.weight = weight;
        r.impulse = impulse;
        // All slices of a level have the same length, but for the rounding of the times.
        for (std::size_t l = 0; l < levels; ++l) {
            auto const length = shortest * static_cast<double>(knots) / std::exp2(l);
            auto& m = r.level[l];
            m.decay = sivid::exp(-lambda * length);
            m.grown = 1.0 - m.decay;
            m.gained = length - m.grown / lambda;
        }
        r.bend = -lambda * sivid::hull(r.level[0].decay, interval(1.0)) * bend;
        result.push_back(r);
    }
    return result;
}

} // namespace servo

#endif
