// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_REQUIREMENT_DETAIL_REQUIREMENT_PARSER_HPP
#define SIVID_DECISION_REQUIREMENT_DETAIL_REQUIREMENT_PARSER_HPP

#include <sivid/decision/requirement/detail/requirement_numbers.hpp>
#include <sivid/decision/requirement/requirement_types.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// Reads a requirement from left to right, without going back.
class requirement_parser : requirement_numbers {
public:
    requirement_parser(std::string_view text, recorded_model& model, double end)
        : requirement_numbers("requirement", text, model), end_(end) {
        result_.text = std::string(text);
    }

    [[nodiscard]] requirement read() {
        auto all = implication();
        need_formula(all, "a requirement");
        for (auto position = words_.position(); words_.take("provided");
             position = words_.position()) {
            auto const condition = implication();
            need_formula(condition, "provided");
            all = join(kind::provided, all, condition, position);
        }
        if (!words_.at_end()) {
            words_.fail(
                "nothing can follow here",
                "join requirements by and, or, implies, until, provided; mind the brackets");
        }
        close(all.part);
        ask(result_.parts.size() - 1, 0, 0);
        result_.times.push_back(0);
        result_.times.push_back(end_);
        std::sort(result_.times.begin(), result_.times.end());
        result_.times.erase(std::unique(result_.times.begin(), result_.times.end()),
                            result_.times.end());
        return std::move(result_);
    }

private:
    using kind = requirement::kind;

    // Formulas -----------------------------------------------------------------------------------

    operand in_brackets() override { return implication(); }
    operand implication() {
        level const nested(*this);
        auto left = disjunction();
        auto const position = words_.position();
        if (!words_.take("implies")) return left;
        need_formula(left, "implies");
        auto right = implication();
        need_formula(right, "implies");
        return join(kind::disjunction, negation(left, position), right, position);
    }
    operand disjunction() {
        return chain("or", kind::disjunction, [this] { return conjunction(); });
    }
    operand conjunction() {
        return chain("and", kind::conjunction, [this] { return until(); });
    }
    template <class Next>
    operand chain(char const* word, kind what, Next const& next) {
        auto left = next();
        for (auto position = words_.position(); words_.take(word); position = words_.position()) {
            need_formula(left, word);
            auto const right = next();
            need_formula(right, word);
            left = join(what, left, right, position);
        }
        return left;
    }
    operand until() {
        auto left = prefixed();
        auto const position = words_.position();
        if (!words_.take("until")) return left;
        need_formula(left, "until");
        requirement::part p{.what = kind::until, .first = left.part, .position = position};
        window(p);
        auto const right = prefixed();
        need_formula(right, "until");
        p.second = right.part;
        return formula(p);
    }
    operand prefixed() {
        level const nested(*this);
        auto const position = words_.position();
        if (words_.take("not")) {
            auto const of = prefixed();
            need_formula(of, "not");
            return negation(of, position);
        }
        for (auto const& [word, what] :
             {std::pair{"always", kind::always}, std::pair{"eventually", kind::eventually}}) {
            if (!words_.take(word)) continue;
            requirement::part p{.what = what, .position = position};
            window(p);
            auto const of = prefixed();
            need_formula(of, word);
            p.first = of.part;
            return formula(p);
        }
        return comparison();
    }

    operand comparison() {
        auto const begin = words_.position();
        auto const known = result_.margins.size();
        auto const result = relations();
        for (auto k = std::max(known, result_.labels.size()); k < result_.margins.size(); ++k)
            result_.labels.push_back(words_.text_from(begin));
        return result;
    }
    /// a < b, or a <= b.
    struct relation {
        operand a, b;
        bool strict;
    };
    operand relations() {
        auto left = timed();
        if (words_.take("in")) {
            words_.need("[", "write the range as [lower, upper]");
            auto const low = timed();
            words_.need(",", "write the range as [lower, upper]");
            auto const high = timed();
            words_.need("]", "write the range as [lower, upper]");
            return compared({{low, left, false}, {left, high, false}});
        }
        std::vector<relation> chain;
        while (auto const sign = words_.take_relation()) {
            auto const right = timed();
            bool const less = sign->front() == '<';
            chain.push_back({less ? left : right, less ? right : left, sign->size() == 1});
            left = right;
        }
        if (!chain.empty()) return compared(chain);
        if (left.time)
            words_.fail("a comparison is missing behind 'at'",
                        "write (x + 1) at 2 > 3: 'at' stands behind the whole expression");
        return left;
    }

    /// An operand with `at T` behind it, if there is such.
    operand timed() {
        auto of = sum();
        auto const position = words_.position();
        if (!words_.take("at")) return of;
        double const time = instant(end_);
        if (time > end_)
            words_.fail_at(position,
                           "this time is beyond the end, " + nearest_text(end_, 6) + " " +
                               time_unit(),
                           "choose an earlier one, or a scenario that lasts longer");
        if (of.is_formula) {
            return formula({.what = kind::at,
                            .first = of.part,
                            .from = time,
                            .to = time,
                            .position = position});
        }
        of.time = time;
        return of;
    }

    /// All of a chain, at the time that it is asked at: every instant, unless one is named.
    operand compared(std::vector<relation> const& chain) {
        auto const moves = [&](operand const& side) {
            return (g().depends(side.value) & (on_time | on_state | on_input)) != 0;
        };
        // Behind a constant, as in 1 < x < 2 at 1, the time can but be that of the whole chain.
        std::optional<double> time;
        bool of_all = false;
        for (auto const& r : chain) {
            for (auto const* side : {&r.a, &r.b}) {
                need_number(*side);
                if (!time) time = side->time;
                of_all = of_all || (side->time && !moves(*side));
            }
        }
        std::optional<operand> all;
        for (auto const& r : chain) {
            for (auto const* side : {&r.a, &r.b}) {
                bool const other = side->time ? *side->time != *time : moves(*side) && !of_all;
                if (time && other)
                    words_.fail_at(side->position, "the sides are not asked at the same time",
                                   "compare at one time, as in (x > y) at 2");
            }
            auto const next = below(r.a.value, r.b.value, r.strict, r.a.position);
            all = all ? join(kind::conjunction, *all, next, next.position) : next;
        }
        if (!time) return *all;
        return formula({.what = kind::at,
                        .first = all->part,
                        .from = *time,
                        .to = *time,
                        .position = all->position});
    }

    /// a < b, taken apart where a or b is an absolute value, a least or a greatest one.
    operand below(node_id a, node_id b, bool strict, std::size_t position) {
        bool const room = result_.margins.size() + pending_ < 64;
        auto const split = [&](kind what, node_id a1, node_id b1, node_id a2, node_id b2) {
            ++pending_;
            auto const left = below(a1, b1, strict, position);
            --pending_;
            return join(what, left, below(a2, b2, strict, position), position);
        };
        auto const left = g()[a], right = g()[b]; // copies: the graph grows
        if (room && left.op == operation::abs)
            return split(kind::conjunction, left.a, b, g().neg(left.a), b);
        if (room && left.op == operation::max)
            return split(kind::conjunction, left.a, b, left.b, b);
        if (room && left.op == operation::min)
            return split(kind::disjunction, left.a, b, left.b, b);
        if (room && right.op == operation::abs)
            return split(kind::disjunction, a, right.a, a, g().neg(right.a));
        if (room && right.op == operation::max)
            return split(kind::disjunction, a, right.a, a, right.b);
        if (room && right.op == operation::min)
            return split(kind::conjunction, a, right.a, a, right.b);
        auto const margin = numeric(position, [&] { return g().sub(b, a); });
        auto const known = std::find(result_.margins.begin(), result_.margins.end(), margin);
        auto const index = static_cast<std::size_t>(known - result_.margins.begin());
        if (known == result_.margins.end()) result_.margins.push_back(margin);
        return formula({.what = kind::comparison,
                        .comparison = index,
                        .strict = strict,
                        .position = position});
    }

    operand join(kind what, operand const& a, operand const& b, std::size_t position) {
        return formula({.what = what, .first = a.part, .second = b.part, .position = position});
    }
    operand negation(operand const& a, std::size_t position) {
        return formula({.what = kind::negation, .first = a.part, .position = position});
    }
    operand formula(requirement::part const& p) {
        result_.parts.push_back(p);
        return {.is_formula = true, .part = result_.parts.size() - 1, .position = p.position};
    }
    /// The whole is the last part.
    void close(std::size_t whole) { result_.parts.resize(whole + 1); }

    void need_formula(operand const& x, std::string const& for_what) {
        if (!x.is_formula)
            words_.fail_at(x.position,
                           for_what + " needs something that holds or not, not a number",
                           "compare it, as in u > 0.5");
    }
    // Times --------------------------------------------------------------------------------------

    void window(requirement::part& p) {
        p.from = 0;
        p.to = std::numeric_limits<double>::infinity();
        if (!words_.take("[")) return;
        auto const position = words_.position();
        p.from = instant(end_);
        words_.need(",", "write the window as [from, to] in " + time_unit());
        if (words_.peek("end")) {
            static_cast<void>(words_.take("end"));
        } else {
            p.to = instant(end_);
        }
        words_.need("]", "write the window as [from, to] in " + time_unit());
        if (p.to < p.from)
            words_.fail_at(position, "the window ends before it begins", "write [from, to]");
    }
    /// Notes that a part is asked at the times [from, to], and its operands at theirs.
    void ask(std::size_t index, double from, double to) {
        struct question {
            std::size_t index;
            double from, to;
        };
        std::vector<question> open{{index, from, to}};
        while (!open.empty()) {
            auto const q = open.back();
            open.pop_back();
            auto const& p = result_.parts[q.index];
            result_.times.push_back(q.from);
            result_.times.push_back(q.to);
            switch (p.what) {
            case kind::comparison:
                break;
            case kind::negation:
                open.push_back({p.first, q.from, q.to});
                break;
            case kind::conjunction:
            case kind::disjunction:
            case kind::provided:
                open.push_back({p.first, q.from, q.to});
                open.push_back({p.second, q.from, q.to});
                break;
            case kind::at:
                open.push_back({p.first, p.from, p.to});
                break;
            case kind::always:
            case kind::eventually:
            case kind::until: {
                bool const to_end = std::isinf(p.to);
                double const first = q.from + p.from, last = to_end ? end_ : q.to + p.to;
                if (last > end_ || q.to + p.from > end_)
                    words_.fail_at(
                        p.position,
                        "its window reaches to " + nearest_text(std::max(last, q.to + p.from), 6) +
                            " " + time_unit() + ", and the motion ends at " +
                            nearest_text(end_, 6) + " " + time_unit(),
                        "shorten the window, or that of the formula around it; or take a scenario "
                        "that lasts longer");
                bool const begins_now = p.what == kind::until;
                open.push_back({p.first, begins_now ? q.from : first, last});
                if (begins_now) open.push_back({p.second, first, last});
                break;
            }
            }
        }
    }

    double end_;
    requirement result_;
    std::size_t pending_ = 0; ///< comparisons that are still to be entered
};

} // namespace sivid::decision_detail

#endif
