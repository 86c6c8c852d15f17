// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_BY_GROUPS_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_BY_GROUPS_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sivid::paving_detail {

/// Asks contractors that take no outliers where outliers are allowed.
///   Of Q + 1 groups of measurements, one has none of Q outliers. What explains the data explains
///   all of that group, so it is in what contractors leave of one of the groups: in the hull of
///   these.
class by_groups : public contractor {
public:
    explicit by_groups(strategy others) : others_(std::move(others)) {}

    [[nodiscard]] std::string name() const override { return "groups of measurements"; }
    [[nodiscard]] std::string obstacle(identification_problem const& problem) const override {
        auto const allowed = outliers(problem);
        if (allowed == 0) return "no outliers are allowed";
        return allowed <= most ? ""
                               : std::to_string(allowed) + " outliers are allowed, more than " +
                                     std::to_string(most);
    }
    [[nodiscard]] std::shared_ptr<contractor const> without(std::string_view name) const override {
        return std::make_shared<by_groups>(others_.without(name));
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record& says) const override {
        auto const groups = outliers(asked.problem()) + 1;
        std::optional<leftover> all;
        for (std::size_t g = 0; g < groups; ++g) {
            work_limit const own(limit.seconds() / static_cast<double>(groups - g), limit);
            inquiry group(one_of(groups, g, asked.problem()), asked.options(), asked.search(), own);
            contract(others_, group);
            says.integrations += group.integrations();
            if (group.empty()) continue;
            all = all ? joined(std::move(*all), group.left()) : group.left();
        }
        says.figures.emplace_back("groups", static_cast<double>(groups));
        return all ? std::move(*all) : leftover{empty_box(asked.problem().prior.size())};
    }

private:
    static constexpr std::size_t most = 7; ///< as in linear programs

    [[nodiscard]] static std::size_t outliers(identification_problem const& problem) {
        std::size_t sum = 0;
        for (auto const& e : problem.experiments) sum += e.outliers;
        return sum;
    }
    /// Of experiments that allow outliers, every so manieth measurement; the others say nothing.
    [[nodiscard]] static identification_problem one_of(std::size_t groups, std::size_t which,
                                                       identification_problem problem) {
        std::size_t count = 0;
        for (auto& e : problem.experiments) {
            if (std::exchange(e.outliers, 0) == 0) continue;
            for (auto& m : e.measurements)
                if (count++ % groups != which) m.bound = interval_traits<interval>::entire();
        }
        return problem;
    }
    [[nodiscard]] static leftover joined(leftover a, leftover const& b) {
        a.parameters = hull(a.parameters, b.parameters);
        for (std::size_t e = 0; e < a.starts.size(); ++e)
            a.starts[e] = hull(a.starts[e], b.starts[e]);
        return a;
    }

    strategy others_;
};

} // namespace sivid::paving_detail

#endif
