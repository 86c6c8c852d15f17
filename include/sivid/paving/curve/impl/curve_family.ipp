// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_IMPL_CURVE_FAMILY_IPP
#define SIVID_PAVING_CURVE_IMPL_CURVE_FAMILY_IPP

#include <sivid/paving/curve/detail/curve_family.hpp>

#include <sivid/model/series/taylor_arithmetic.hpp>
#include <sivid/number/polynomial/taylor_model_functions.hpp>
#include <sivid/number/taylor_model.hpp>
#include <sivid/paving/curve/detail/shape_choice.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Curves over cells of parameters as Taylor models in the cells' own unknowns.
class curve_over_cell {
    using arithmetic = taylor_arithmetic<double>;
    using traits = interval_traits<interval>;

public:
    using model = taylor_model<double>;

    /// @param shape  in the unknowns of the cell, and perhaps further ones
    curve_over_cell(recorded_map const& g, parallelepiped const& cell,
                    model_shape<double> const& shape)
        : g_(&g), shape_(&shape) {
        for (std::size_t j = 0; j < cell.size(); ++j) {
            auto p = model::constant(cell.middle[j]);
            for (std::size_t k = 0; k < cell.size(); ++k) {
                if (cell.side[k][j] == 0) continue;
                p = p + model::variable(shape, k, 0.0, cell.side[k][j]);
            }
            p_.push_back(widened(p, cell.slack[j]));
        }
    }

    [[nodiscard]] std::optional<model> at(model const& z) const {
        auto values = g_->at<arithmetic>(
            [&](std::size_t i) -> model const& { return i == 0 ? z : p_[i - 1]; });
        if (!values) return std::nullopt;
        return std::move(values->front());
    }
    [[nodiscard]] std::vector<model> const& parameters() const { return p_; }
    [[nodiscard]] std::optional<std::vector<model>> coefficients(curve_shapes const& s) const {
        std::vector<model> values, result;
        for (std::size_t i = 0; i < s.nodes.size(); ++i) {
            auto value = at(model::constant(s.nodes[i]));
            if (!value) return std::nullopt;
            values.push_back(*std::move(value) - model::constant(s.middles[i]));
        }
        for (std::size_t j = 0; j < s.count(); ++j) {
            auto sum = model(*shape_);
            for (std::size_t i = 0; i < values.size(); ++i) {
                sum = sum + scaled(values[i], s.weights[j][i]);
            }
            auto const bound = bounds(sum);
            if (!std::isfinite(bound.upper) || !std::isfinite(bound.lower)) return std::nullopt;
            result.push_back(std::move(sum));
        }
        return result;
    }
    /// Where a function that lies in a range has d.
    [[nodiscard]] strip strip_of(model const& f, interval const& range,
                                 std::size_t unknowns) const {
        strip result{std::vector<double>(unknowns, 0.0), range};
        auto rest = f;
        for (std::size_t k = 0; k < unknowns && !f.is_number(); ++k) {
            result.slope[k] = f.c(shape_->space->variable(k));
            rest = rest - model::variable(*shape_, k, 0.0, result.slope[k]);
        }
        auto const b = bounds(rest);
        result.range = traits::sub(range, traits::bounds(b.lower, b.upper));
        return result;
    }

private:
    recorded_map const* g_;
    model_shape<double> const* shape_;
    std::vector<model> p_;
};

inline taylor_model<double> polynomial_of(std::vector<double> const& c,
                                          taylor_model<double> const& x) {
    std::vector<taylor_model<double>> terms;
    for (double const k : c) terms.push_back(taylor_model<double>::constant(k));
    return horner(
        terms, [&c](std::size_t k) { return c[k] == 0; }, x);
}

/// Part number k of a side.
inline interval piece_of(interval const& side, std::size_t k, std::size_t parts) {
    auto const cut = [&](std::size_t i) {
        return i == 0 ? side.lower()
               : i == parts
                   ? side.upper()
                   : side.lower() + (side.upper() - side.lower()) *
                                        (static_cast<double>(i) / static_cast<double>(parts));
    };
    return interval_traits<interval>::bounds(cut(k), std::max(cut(k), cut(k + 1)));
}

} // namespace paving_detail

SIVID_DECL curve_family::curve_family(bound_model const& model, unknown_curve const& curve,
                                      box const& prior, interval const& range)
    : curve_(curve), g_(map_of(model.g, curve)), range_(range), prior_(curve.parameters.size()) {
    for (std::size_t j = 0; j < prior_.size(); ++j) prior_[j] = prior[curve.parameters[j]];
    parameters_ = prior_;
    auto const n = prior_.size();
    // Where a curve is linear in a parameter, models are exact however far apart its ends are.
    std::vector<std::size_t> cuts(n, 1);
    std::size_t bent = 0;
    for (std::size_t j = 0; j < n; ++j) bent += is_bent(j) ? 1 : 0;
    for (std::size_t j = 0; j < n; ++j) {
        if (is_bent(j)) cuts[j] = bent == 1 ? 16 : bent == 2 ? 8 : bent == 3 ? 4 : 2;
    }
    std::vector<std::size_t> at(n, 0);
    for (bool more = true; more;) {
        box cell(n);
        for (std::size_t j = 0; j < n; ++j) {
            cell[j] = paving_detail::piece_of(prior_[j], at[j], cuts[j]);
        }
        cells_.push_back(paving_detail::parallelepiped::of(cell));
        more = false;
        for (std::size_t j = 0; j < n && !more; ++j) {
            at[j] = (at[j] + 1) % cuts[j];
            more = at[j] != 0;
        }
    }
}

SIVID_DECL bool curve_family::is_bent(std::size_t j) const {
    std::vector<double> p;
    for (auto const& side : prior_) p.push_back(mid(side));
    for (double const share : {0.11, 0.47, 0.89}) {
        double const z = range_.lower() + share * width(range_);
        double values[3];
        for (int k = 0; k < 3; ++k) {
            auto at = p;
            at[j] += (k - 1) * rad(prior_[j]);
            values[k] = paving_detail::curve_value(g_, z, at).value_or(HUGE_VAL);
        }
        double const bend = std::abs(values[0] - 2 * values[1] + values[2]);
        if (!(bend <= 1e-9 * std::abs(values[1]))) return true;
    }
    return false;
}

SIVID_DECL std::optional<curve_shapes>
curve_family::shapes(std::vector<double> const& visited, double negligible,
                     std::function<bool()> const& keep_going) const {
    using namespace paving_detail;
    using model = curve_over_cell::model;
    using traits = interval_traits<interval>;
    constexpr std::size_t most_parameters = 4, degree = 6, parts = 16;
    auto const n = prior_.size();
    if (n > most_parameters || !(width(range_) > 0) || cells_.empty()) return std::nullopt;
    for (auto const& side : prior_) {
        if (!(width(side) > 1e-9 * mag(side))) return std::nullopt;
    }
    auto result = shape_choice(g_, cells_)(range_, visited, negligible);
    if (!result) return std::nullopt;
    auto const& small = model_shape<double>::of(n, degree);
    auto const& large = model_shape<double>::of(n + 1, degree);
    std::vector<model> arguments, means;
    std::vector<std::vector<model>> forms; // over parts of the range
    for (std::size_t k = 0; k < parts; ++k) {
        auto const part = piece_of(range_, k, parts);
        auto z =
            widened(model::variable(large, n, mid(part), rad(part)), 4e-16 * mag(part) + 1e-300);
        auto const x = scaled(z - model::constant(result->centre), result->scale);
        means.push_back(polynomial_of(result->mean, x));
        auto& here = forms.emplace_back();
        for (auto const& s : result->shapes) here.push_back(polynomial_of(s, x));
        arguments.push_back(std::move(z));
    }
    result->coefficients = empty_box(result->count());
    double size = 0;
    for (double const v : result->middles) size = std::max(size, std::abs(v));
    for (auto const& cell : cells_) {
        if (keep_going && !keep_going()) return std::nullopt;
        auto const theta = curve_over_cell(g_, cell, small).coefficients(*result);
        if (!theta) return std::nullopt;
        std::vector<model> wide;
        for (std::size_t j = 0; j < theta->size(); ++j) {
            auto const b = bounds((*theta)[j]);
            result->coefficients[j] =
                traits::hull(result->coefficients[j], traits::bounds(b.lower, b.upper));
            wide.push_back(converted((*theta)[j], large));
        }
        curve_over_cell const here(g_, cell, large);
        for (std::size_t k = 0; k < parts; ++k) {
            auto left = here.at(arguments[k]);
            if (!left) return std::nullopt;
            left = *left - means[k];
            for (std::size_t j = 0; j < wide.size(); ++j) left = *left - wide[j] * forms[k][j];
            auto const b = bounds(*left);
            result->error = std::max({result->error, b.upper, -b.lower});
            if (!(std::max(b.upper, -b.lower) <= 0.02 * size)) return std::nullopt; // also for NaN
        }
    }
    return result;
}

SIVID_DECL std::pair<std::size_t, double>
curve_family::longest_side(paving_detail::parallelepiped const& cell) const {
    std::pair<std::size_t, double> longest(0, 0.0);
    for (std::size_t k = 0; k < cell.size(); ++k) {
        for (std::size_t j = 0; j < cell.size(); ++j) {
            double const share = std::abs(cell.side[k][j]) / rad(prior_[j]);
            if (share > longest.second) longest = {k, share};
        }
    }
    return longest;
}

SIVID_DECL std::optional<paving_detail::parallelepiped>
curve_family::contracted(paving_detail::parallelepiped cell, curve_shapes const& shapes,
                         box const& coefficients) const {
    auto const n = prior_.size();
    auto const& shape = model_shape<double>::of(n, 4);
    for (bool again = true; again;) {
        paving_detail::curve_over_cell const here(g_, cell, shape);
        auto const own = here.coefficients(shapes);
        std::vector<paving_detail::strip> strips;
        for (std::size_t j = 0; j < n; ++j) {
            strips.push_back(here.strip_of(here.parameters()[j], parameters_[j], n));
        }
        for (std::size_t j = 0; own && j < own->size(); ++j) {
            strips.push_back(here.strip_of((*own)[j], coefficients[j], n));
        }
        auto less = cell.within(std::move(strips));
        if (!less) return std::nullopt;
        again = less->volume < 0.5 * cell.volume;
        cell = *std::move(less);
    }
    return cell;
}

SIVID_DECL bool curve_family::measure() {
    box whole = empty_box(prior_.size());
    for (auto const& cell : cells_) whole = hull(whole, cell.hull());
    parameters_ = cells_.empty() ? whole : intersect(parameters_, whole);
    return !is_empty(parameters_);
}

SIVID_DECL bool curve_family::contract(box const& within, curve_shapes const& shapes,
                                       box const& coefficients) {
    constexpr std::size_t enough = 256; // cells
    constexpr double fine = 1.0 / 1024; // of a side of the prior
    parameters_ = intersect(parameters_, within);
    if (is_empty(parameters_) || is_empty(coefficients)) cells_.clear();
    for (auto open = std::exchange(cells_, {}); !open.empty();) {
        std::vector<paving_detail::parallelepiped> left;
        double most = 0;
        for (auto& cell : open) {
            auto found = contracted(std::move(cell), shapes, coefficients);
            if (!found) continue;
            most = std::max(most, longest_side(*found).second);
            left.push_back(*std::move(found));
        }
        open.clear();
        if (left.size() >= enough || !(most > fine)) {
            cells_ = std::move(left);
            break;
        }
        for (auto& cell : left) {
            auto const [k, length] = longest_side(cell);
            if (length > 0.6 * most) {
                auto [lower, upper] = cell.halves(k);
                open.push_back(std::move(lower));
                open.push_back(std::move(upper));
            } else {
                open.push_back(std::move(cell));
            }
        }
    }
    return measure();
}

SIVID_DECL std::vector<box> curve_family::parts(curve_shapes const& shapes, std::size_t count) {
    using traits = interval_traits<interval>;
    auto const n = prior_.size();
    std::size_t along = 0; // the parameter over which the cells are spread most
    for (std::size_t j = 1; j < n; ++j) {
        auto const share = [this](std::size_t i) {
            return width(parameters_[i]) / width(prior_[i]);
        };
        along = share(j) > share(along) ? j : along;
    }
    std::sort(cells_.begin(), cells_.end(),
              [along](auto const& a, auto const& b) { return a.middle[along] < b.middle[along]; });
    std::vector<box> result;
    for (std::size_t part = 0; part < count; ++part) {
        box theta = empty_box(shapes.count());
        for (auto i = part_begin(part, count); i < part_begin(part + 1, count); ++i) {
            auto const own =
                paving_detail::curve_over_cell(g_, cells_[i], model_shape<double>::of(n, 4))
                    .coefficients(shapes);
            for (std::size_t j = 0; j < theta.size(); ++j) {
                auto const b = own ? bounds((*own)[j]) : value_bounds<double>{-HUGE_VAL, HUGE_VAL};
                theta[j] = traits::hull(theta[j], traits::bounds(b.lower, b.upper));
            }
        }
        result.push_back(std::move(theta));
    }
    return result;
}

SIVID_DECL bool curve_family::contract_parts(curve_shapes const& shapes,
                                             std::vector<box> const& left) {
    std::vector<paving_detail::parallelepiped> cells;
    for (std::size_t part = 0; part < left.size(); ++part) {
        if (is_empty(left[part])) continue;
        for (auto i = part_begin(part, left.size()); i < part_begin(part + 1, left.size()); ++i) {
            auto found = contracted(cells_[i], shapes, left[part]);
            if (found) cells.push_back(*std::move(found));
        }
    }
    cells_ = std::move(cells);
    return measure();
}

} // namespace sivid

#endif
