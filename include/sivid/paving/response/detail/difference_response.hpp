// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_DETAIL_DIFFERENCE_RESPONSE_HPP
#define SIVID_PAVING_RESPONSE_DETAIL_DIFFERENCE_RESPONSE_HPP

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

/// Which outputs of two responses are compared, and what is known of their difference.
struct compared_outputs {
    std::size_t first = 0, second = 0;
    interval bound;
};

namespace paving_detail {

/// The unknowns of two responses side by side.
[[nodiscard]] inline normalised_unknowns joined(response const& a, response const& b) {
    normalised_unknowns result(box{}, box{});
    auto const append = [](auto& to, auto const& from, std::size_t offset) {
        for (auto side : from) {
            side.variable += offset;
            to.push_back(side);
        }
    };
    auto const first = a.table->variables;
    append(result.parameters, a.unknowns.parameters, 0);
    append(result.parameters, b.unknowns.parameters, first);
    append(result.initial, a.unknowns.initial, 0);
    append(result.initial, b.unknowns.initial, first);
    result.variables = first + b.table->variables;
    return result;
}

/// A monomial of one of two responses, among the variables of both.
struct joint_term {
    std::vector<std::uint8_t> exponents;
    std::size_t term; ///< of the response
    double sign;      ///< of the response; 0: the constant of both
    std::size_t degree;
};

/// By degree; the constant first.
[[nodiscard]] inline std::vector<joint_term> joint_terms(response const& a, response const& b) {
    auto const first = a.table->variables, count = first + b.table->variables;
    std::vector<joint_term> terms{{std::vector<std::uint8_t>(count, 0), 0, 0, 0}};
    auto const collect = [&](response const& of, std::size_t offset, double sign) {
        for (std::size_t m = 0; m < of.table->size(); ++m) {
            auto const& e = of.table->exponents[m];
            auto const degree = std::accumulate(e.begin(), e.end(), std::size_t{0});
            if (degree == 0) continue;
            joint_term t{std::vector<std::uint8_t>(count, 0), m, sign, degree};
            std::copy(e.begin(), e.end(),
                      t.exponents.begin() + static_cast<std::ptrdiff_t>(offset));
            terms.push_back(std::move(t));
        }
    };
    collect(a, 0, 1);
    collect(b, first, -1);
    std::stable_sort(terms.begin(), terms.end(),
                     [](joint_term const& x, joint_term const& y) { return x.degree < y.degree; });
    return terms;
}

/// The number of the constant among the monomials; their count when there is none.
[[nodiscard]] inline std::size_t constant_term(response const& of) {
    auto const& all = of.table->exponents;
    auto const at = std::find_if(all.begin(), all.end(), [](auto const& exponents) {
        return std::all_of(exponents.begin(), exponents.end(), [](auto e) { return e == 0; });
    });
    return static_cast<std::size_t>(at - all.begin());
}

} // namespace paving_detail

/// \f$ y_1(q_1) - y_2(q_2) \f$ over the unknowns of both: how two motions differ that have nothing
/// in common, neither parameters nor starts. Parameters and starts of the first come first.
/// @guarantee  encloses the differences of whatever the two responses enclose
/// @cost  O(terms * outputs)
[[nodiscard]] inline response difference_of(response const& a, response const& b,
                                            std::vector<compared_outputs> const& rows) {
    using traits = interval_traits<interval>;
    auto const terms = paving_detail::joint_terms(a, b);
    auto table = std::make_shared<monomial_table>();
    table->variables = a.table->variables + b.table->variables;
    table->degree = std::max(a.table->degree, b.table->degree);
    for (auto const& t : terms) table->exponents.push_back(t.exponents);
    table->find_lines();
    response result{paving_detail::joined(a, b), table, {}, {}, {}, {}, rows.size(), 0};

    auto const constant_a = paving_detail::constant_term(a);
    auto const constant_b = paving_detail::constant_term(b);
    auto const at = [](response const& of, std::size_t m, std::size_t y) {
        return m < of.table->size() ? of.coefficients[m * of.outputs() + y] : 0.0;
    };
    response_builder builder(terms.size());
    for (auto const& row : rows) {
        auto const middle = traits::sub(traits::point(at(a, constant_a, row.first)),
                                        traits::point(at(b, constant_b, row.second)));
        auto const rounding = traits::abs(traits::sub(middle, traits::point(mid(middle))));
        auto const radius = traits::add(
            traits::add(traits::point(a.radius[row.first]), traits::point(b.radius[row.second])),
            rounding);
        builder.add(
            [&](std::size_t m) {
                auto const& t = terms[m];
                if (t.sign == 0) return mid(middle);
                return t.sign > 0 ? at(a, t.term, row.first) : -at(b, t.term, row.second);
            },
            upper(radius), row.bound);
    }
    std::move(builder).finish(result);
    return result;
}

/// A response of one of two motions, among the unknowns of both.
/// @param other   the parameters of the other one, of which it knows nothing
/// @param before  whether those come first
[[nodiscard]] inline response beside(response of, box const& other, bool before) {
    std::vector<normalised_unknowns::side> points;
    for (auto const& x : other) points.push_back({.centre = mid(x)});
    auto& sides = of.unknowns.parameters;
    sides.insert(before ? sides.begin() : sides.end(), points.begin(), points.end());
    return of;
}

} // namespace sivid

#endif
