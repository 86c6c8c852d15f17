// SPDX-License-Identifier: MIT
#include "support/variational_reference.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace support {

std::vector<reference_sensitivity>
reference_sensitivities(dual_rate const& rate, extended_state const& x0, extended_state const& p,
                        double from, std::vector<double> const& times,
                        std::vector<sivid::sampled_signal> const& inputs, extended tolerance,
                        bool kinks) {
    auto const n = x0.size();
    auto const columns = n + p.size();
    auto const both = [&](extended t, extended_state const& z, extended_state const&,
                          extended_state const& u) {
        std::vector<dual> x, c, in;
        for (std::size_t i = 0; i < n; ++i) x.emplace_back(z[i], columns, i);
        for (std::size_t j = 0; j < p.size(); ++j) c.emplace_back(p[j], columns, n + j);
        for (auto const v : u) in.emplace_back(v);
        auto const f = rate(dual(t), x, c, in);
        extended_state r;
        for (auto const& y : f) r.push_back(y.value);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < columns; ++k) {
                extended sum = 0;
                for (std::size_t l = 0; l < n && !f[i].d.empty(); ++l) {
                    sum += f[i].d[l] * z[n + l * columns + k];
                }
                if (k >= n && !f[i].d.empty()) sum += f[i].d[k];
                r.push_back(sum);
            }
        }
        return r;
    };
    extended_state z = x0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < columns; ++k) z.push_back(i == k ? 1 : 0);
    }
    std::vector<reference_sensitivity> result;
    auto const states =
        kinks ? reference_states<dormand_prince>(both, z, p, from, times, inputs, tolerance)
              : reference_states(both, z, p, from, times, inputs, tolerance);
    for (auto const& y : states) {
        reference_sensitivity r;
        r.x.assign(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n));
        for (std::size_t i = 0; i < n; ++i) {
            auto const row = y.begin() + static_cast<std::ptrdiff_t>(n + i * columns);
            r.s.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
        }
        result.push_back(std::move(r));
    }
    return result;
}

} // namespace support
