// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_CONTROL_LAW_IPP
#define SIVID_DECISION_IMPL_CONTROL_LAW_IPP

#include <sivid/decision/control_law.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/requirement/detail/requirement_numbers.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

/// Reads a control law from left to right, without going back.
class control_law_parser : requirement_numbers {
public:
    control_law_parser(std::string_view text, closed_loop& loop, double end)
        : requirement_numbers("law", text, loop.open()), loop_(loop), end_(end) {}

    void read() {
        do {
            one();
        } while (words_.take(";") && !words_.at_end());
        if (!words_.at_end())
            words_.fail("nothing can follow here", "separate the commands of several inputs by ;");
    }

private:
    void one() {
        auto const position = words_.position();
        auto const input = words_.take_name();
        auto const& all = model_.about.inputs;
        bool const known = input && std::any_of(all.begin(), all.end(),
                                                [&](auto const& i) { return i.name == *input; });
        if (!known)
            words_.fail_at(position, "an input of the model is needed here",
                           "write INPUT = expression; the model has: " + joined_names(all));
        words_.need("=", "write INPUT = expression");
        auto const value = sum();
        need_plain(value);
        if (!commanded_.insert(*input).second)
            words_.fail_at(position, "'" + *input + "' is commanded twice",
                           "command each input of the model once");
        loop_.command(*input, {g(), value.value});
    }

    operand in_brackets() override { return sum(); }
    [[nodiscard]] std::string further_functions() const override {
        return ", clamp, during, integral";
    }
    std::optional<operand> further_call(std::string const& name, std::size_t position) override {
        if (name == "measured") {
            auto const& channel = model_.about.channels[channel_in_bracket()].name;
            return number(position, loop_.measured(channel).in(g()));
        }
        if (name == "clamp") {
            auto const x = sum();
            words_.need(",", "write clamp(x, low, high)");
            auto const low = sum();
            words_.need(",", "write clamp(x, low, high)");
            auto const high = sum();
            words_.need(")", "write clamp(x, low, high)");
            return binary(operation::min, binary(operation::max, x, low), high);
        }
        if (name == "during") {
            double const from = instant(end_);
            words_.need(",", "write during(from, to) in " + time_unit());
            double const to = instant(end_);
            words_.need(")", "write during(from, to) in " + time_unit());
            if (!(from < to))
                words_.fail_at(position, "it ends before it begins", "write during(from, to)");
            // What begins before the end and lasts to it holds at the end, too.
            double const off = to < end_ ? to : std::nextafter(2 * end_, HUGE_VAL);
            return number(position, loop_.during(from, off).in(g()));
        }
        if (name == "integral") {
            auto const x = sum();
            need_plain(x);
            words_.need(")", "close the bracket");
            auto const count = model_.rate.size();
            return number(position,
                          loop_
                              .integral({g(), x.value}, "integral " + std::to_string(count), "1",
                                        end_ * largest(x.value))
                              .in(g()));
        }
        return std::nullopt;
    }

    /// How large x may become while states are in their own ranges: a scale, no bound.
    [[nodiscard]] double largest(node_id x) {
        using traits = interval_traits<interval>;
        auto const& about = model_.about;
        leaf_ranges at{traits::bounds(0, end_), {}, {}, {}};
        auto const box_of = [](auto const& items, auto const& side) {
            std::vector<interval> sides;
            for (auto const& i : items) sides.push_back(side(i));
            return box(std::move(sides));
        };
        at.states = box_of(about.states, [](auto const& s) { return s.limit.range(); });
        at.constants = box_of(about.constants, [](auto const& c) { return c.nominal.enclosure; });
        at.inputs = box_of(about.inputs, [](auto const&) { return traits::bounds(-1, 1); });
        graph_range range(g(), {x});
        range.evaluate(at);
        double const most = mag(range.value(x));
        bool const usable = !range.undefined(x) && std::isfinite(most * end_) && most > 0;
        return usable ? most : 1e3;
    }

    closed_loop& loop_;
    double end_;
    std::set<std::string> commanded_;
};

} // namespace decision_detail

SIVID_DECL void command_by(std::string_view text, closed_loop& loop, double end) {
    if (!(end > 0) || !std::isfinite(end))
        throw std::invalid_argument("command_by: the motion needs a duration above 0, not " +
                                    nearest_text(end));
    decision_detail::control_law_parser(text, loop, end).read();
}

} // namespace sivid

#endif
