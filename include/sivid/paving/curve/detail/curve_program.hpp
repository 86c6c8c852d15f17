// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_DETAIL_CURVE_PROGRAM_HPP
#define SIVID_PAVING_CURVE_DETAIL_CURVE_PROGRAM_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/operation.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/structure/unknown_curve.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// g(z, p) alone, for any arithmetic.
class curve_program {
public:
    curve_program(graph const& from, unknown_curve const& curve) {
        std::vector<std::optional<node_id>> image(from.size());
        image[curve.argument] = g_.leaf(operation::time, 0);
        code_ = program(g_, {value_ = copy(from, curve, curve.value, image)});
    }
    /// @returns nothing where g is not defined everywhere
    template <class A, class Parameters>
    [[nodiscard]] std::optional<typename A::value_type> at(typename A::value_type const& z,
                                                           Parameters const& p) const {
        auto memory = code_.template memory<A>();
        code_.read(memory, [&](operation op, std::size_t k) -> typename A::value_type const& {
            return op == operation::time ? z : p[k];
        });
        auto const undefined = code_.template run<A>(memory);
        if (undefined) return std::nullopt;
        return std::move(memory[value_]);
    }

private:
    node_id copy(graph const& from, unknown_curve const& curve, node_id i,
                 std::vector<std::optional<node_id>>& image) {
        if (image[i]) return *image[i];
        auto const& n = from[i];
        node_id made = 0;
        if (n.op == operation::literal) {
            made = g_.constant(from.value(n));
        } else if (n.op == operation::constant) {
            auto const at = std::lower_bound(curve.parameters.begin(), curve.parameters.end(),
                                             static_cast<std::size_t>(n.index)) -
                            curve.parameters.begin();
            made = g_.leaf(operation::constant, static_cast<std::size_t>(at));
        } else {
            auto const a = copy(from, curve, n.a, image);
            auto const b = is_binary(n.op) ? copy(from, curve, n.b, image) : node_id{};
            made = same_operation{}(n, a, b, g_);
        }
        image[i] = made;
        return made;
    }

    graph g_;
    node_id value_ = 0;
    program code_;
};

} // namespace sivid::paving_detail

#endif
