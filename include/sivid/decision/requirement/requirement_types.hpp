// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_REQUIREMENT_REQUIREMENT_TYPES_HPP
#define SIVID_DECISION_REQUIREMENT_REQUIREMENT_TYPES_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/graph.hpp>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// A requirement on a motion over [0, end], in signal temporal logic.
///
///     always(abs(v) < 0.3) and eventually[0, 1](u >= 2)
///     eventually(abs(u) < 0.01) and x at end in [3, 7]
///     u > 0.5 until[0, 4] x >= 2
///
///   requirement formula | requirement provided formula
///   formula     comparison | (formula) | not f | f and f | f or f | f implies f
///               | always[a, b] f | eventually[a, b] f | f until[a, b] f | f at T
///   comparison  expressions with < <= > >= (also a < b < c), or e in [a, b]; `e at T < c`
///   expression  numbers, states, channels, inputs, constants, t, + - * / ^n, (e), and sqrt exp log
///               sin cos tan atan tanh abs sign min max; measured(c) is the channel c where a state
///               has its name, too
///
/// Windows [a, b] count from the time at which their formula is asked, the outermost from 0;
/// without one they reach to the end, which may be written `end`. Times T are those of the motion.
/// From the tightest: at, comparisons, not / always / eventually, until, and, or, implies.
///   `f provided g`: nothing is known of a motion unless g is proved for it. It is proved where
///   both
/// are, and refuted only where f is and g is proved.
///   A formula holds at an instant as usual; time is dense: `always` speaks of every instant. `f
/// until g`: g holds at some t' in the window, and f from now until just before t'.
///   Robustness: that of a < b is b - a; min for and and always, max for or and eventually, the
///   sign
/// turns with not. Where it is above 0 the formula holds, below 0 it does not. Comparisons with
/// abs, min or max on top are taken apart into those of their operands; truth and robustness stay.
struct requirement {
    enum class kind : std::uint8_t {
        comparison,
        negation,
        conjunction,
        disjunction,
        always,
        eventually,
        until,
        at,
        provided
    };
    /// An operation of the formula.
    struct part {
        kind what = kind::comparison;
        std::size_t first = 0, second = 0; ///< operands, which stand before it
        std::size_t comparison = 0;        ///< index into `margins`
        bool strict = false;               ///< of a comparison: its margin must not be 0
        double from = 0;                   ///< window; of `at`: the time
        double to = 0;                     ///< of a window; infinity: the end
        std::size_t position = 0;          ///< in the text, from 0
    };

    std::string text;
    std::vector<part> parts;         ///< the last one is the whole
    std::vector<node_id> margins;    ///< in the model's graph: the comparison asks for more than 0
    std::vector<std::string> labels; ///< of the margins: the comparison's text
    std::vector<double> times;       ///< at which the verdict may hang: begin and end among them
};

/// What is wrong with a requirement, or a control law, where, and what to do.
class requirement_error : public std::invalid_argument {
public:
    /// @param what  the text is: "requirement"
    requirement_error(std::string_view what, std::string_view text, std::size_t position,
                      std::string const& problem, std::string const& remedy);
    /// In the text, from 0.
    [[nodiscard]] std::size_t position() const { return position_; }

private:
    std::size_t position_;
};

} // namespace sivid

#endif
