// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_IDENTIFIABILITY_WORDS_IPP
#define SIVID_REPORT_IMPL_IDENTIFIABILITY_WORDS_IPP

#include <sivid/report/identifiability_words.hpp>

#include <sivid/number/text/joined.hpp>

namespace sivid::report {

namespace detail {

inline std::string nearest_text(double x) {
    return rounded_text(x, rounding::nearest, {.significant = 2});
}

/// "L * k, Sg / k" or "a + s, b - 2 s": what may move together.
inline std::string motion_text(free_motion const& m, std::vector<unknown_quantity> const& names) {
    bool const scales = m.kind == motion_kind::scaling;
    std::string text;
    for (std::size_t c = 0; c < m.weights.size(); ++c) {
        int const w = m.weights[c];
        if (w == 0) continue;
        auto const size = std::to_string(std::abs(w));
        if (!text.empty()) text += ", ";
        text += names[c].name + (scales ? (w > 0 ? " * k" : " / k") : (w > 0 ? " + " : " - "));
        if (std::abs(w) > 1) text += scales ? "^" + size : size + " ";
        if (!scales) text += "s";
    }
    return text;
}

/// The components that matter, largest first: "L +1, Sg -0.12".
inline std::string direction_text(sensitive_direction const& d,
                                  std::vector<unknown_quantity> const& names) {
    std::vector<std::size_t> order;
    for (std::size_t c = 0; c < d.components.size(); ++c) {
        if (std::abs(d.components[c]) >= 0.05) order.push_back(c);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(d.components[a]) > std::abs(d.components[b]);
    });
    std::string text;
    for (auto const c : order) {
        double const x = d.components[c];
        if (!text.empty()) text += ", ";
        text += names[c].name + (x < 0 ? " -" : " +") + nearest_text(std::abs(x));
    }
    return text;
}

} // namespace detail

SIVID_DECL std::vector<std::string> identifiability_words(identifiability const& found,
                                                          std::size_t directions) {
    auto const count = [](std::size_t n, std::string const& what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    std::vector<std::string> lines;
    auto const n = found.unknowns.size();
    std::string ranks =
        count(found.outputs, "measured output") + " and " + count(n, "unknown") + ": rank ";
    if (found.least_rank == found.most_rank) {
        ranks += std::to_string(found.least_rank) + ", proved";
    } else {
        ranks += "at least " + std::to_string(found.least_rank) + " and at most " +
                 std::to_string(found.most_rank) + ", proved; " +
                 std::to_string(found.approximate_rank) + " in floating point";
    }
    if (found.missing > 0) ranks += "; " + count(found.missing, "output") + " not reached";
    lines.push_back(std::move(ranks));
    for (auto const& m : found.free) {
        auto const moving =
            std::count_if(m.weights.begin(), m.weights.end(), [](int w) { return w != 0; });
        lines.push_back("free: " + detail::motion_text(m, found.unknowns) +
                        (moving == 1 ? ": it does not act on the outputs" : "") +
                        (m.proved ? " (by the equations)" : " (numerically, not proved)"));
    }
    for (auto const& m : found.nearly_free) {
        lines.push_back("hardly noticed: " + detail::motion_text(m, found.unknowns) +
                        " across the prior moves no output by more than " +
                        rounded_text(m.noticed, rounding::up, {.significant = 2}) +
                        " of its error bound (to first order)");
    }
    if (!found.fixed.empty())
        lines.push_back("these act through " + joined(found.fixed, ", ", &fixed_formula::formula) +
                        " alone");
    if (!found.nearly_fixed.empty())
        lines.push_back("these act nearly through " +
                        joined(found.nearly_fixed, ", ", &fixed_formula::formula) + " alone");
    std::size_t const told = std::min(found.approximate_rank, found.directions.size());
    for (std::size_t k = told - std::min(told, directions); k < told; ++k) {
        auto const& d = found.directions[k];
        lines.push_back("along " + detail::direction_text(d, found.unknowns) +
                        " of the prior's width an output moves by " +
                        detail::nearest_text(d.noticed) + " error bounds (to first order)");
    }
    return lines;
}

} // namespace sivid::report

#endif
