// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_RECORDED_MAP_HPP
#define SIVID_MODEL_GRAPH_RECORDED_MAP_HPP

#include <sivid/model/expression.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/number/text/needed_given.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// A function of several numbers to several numbers, recorded once as a graph.
class recorded_map {
public:
    /// @param f  callable with a `std::vector<expression>` of so many arguments; returns a range of
    ///           expressions
    template <class F>
    recorded_map(std::size_t arguments, F const& f) : arguments_(arguments) {
        std::vector<expression> x;
        for (std::size_t i = 0; i < arguments; ++i) {
            x.emplace_back(g_, g_.leaf(operation::constant, i));
        }
        for (expression const& y : f(static_cast<std::vector<expression> const&>(x))) {
            values_.push_back(y.in(g_));
        }
        program_ = program(g_, values_);
    }
    /// @param values  in a graph whose only leaves but literals are constants: the arguments
    recorded_map(std::size_t arguments, graph g, std::vector<node_id> values)
        : arguments_(arguments),
          g_(std::move(g)),
          values_(std::move(values)),
          program_(g_, values_) {}

    [[nodiscard]] std::size_t arguments() const { return arguments_; }
    [[nodiscard]] std::size_t values() const { return values_.size(); }

    /// The values in any arithmetic; nothing where one is not defined.
    /// @param argument  (index) -> its value
    template <class A, class Argument>
    [[nodiscard]] std::optional<std::vector<typename A::value_type>>
    at(Argument const& argument) const {
        auto memory = program_.template memory<A>();
        program_.read(memory, [&argument](operation, std::size_t i) -> decltype(auto) {
            return argument(i);
        });
        if (program_.template run<A>(memory)) return std::nullopt;
        std::vector<typename A::value_type> result;
        for (auto const i : values_) result.push_back(memory[i]);
        return result;
    }
    /// A box that contains all values over x; nothing where one is not defined on all of x.
    [[nodiscard]] std::optional<box> over(box const& x) const {
        require(x.size());
        auto values = at<proven_arithmetic<interval>>([&x](std::size_t i) { return x[i]; });
        if (!values) return std::nullopt;
        return box(*std::move(values));
    }

    /// The values as expressions in `to`, of arguments that live there.
    [[nodiscard]] std::vector<node_id> in(graph& to, std::vector<node_id> const& arguments) const {
        require(arguments.size());
        return copy_into(to, g_, values_, [&](node const& n, graph&) {
            return arguments[static_cast<std::size_t>(n.index)];
        });
    }

private:
    void require(std::size_t given) const {
        if (given != arguments_)
            throw std::invalid_argument("recorded_map: a wrong number of arguments" +
                                        needed_given(arguments_, given));
    }

    std::size_t arguments_;
    graph g_;
    std::vector<node_id> values_;
    program program_;
};

} // namespace sivid

#endif
