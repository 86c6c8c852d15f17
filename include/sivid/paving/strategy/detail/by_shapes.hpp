// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_BY_SHAPES_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_BY_SHAPES_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/contract/detail/lifted_program.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/curve/detail/shaped_problem.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/detail/by_windows.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// What windows leave of a prior with coefficients of shapes in place of constants of curves.
///   First windows that grow from the begin, then windows all along leave a thin tube of each
///   family, whose curves have shapes of their own. Over these a window grows to the whole record;
///   its polynomials judge parts of the families, along their lines; what is left has narrower
///   shapes again, and so on.
class shape_windows {
public:
    shape_windows(shaped_problem& shaped, inquiry const& asked, work_limit const& limit)
        : shaped_(&shaped), asked_(&asked), limit_(&limit) {
        found_.starts = shaped.starts();
    }

    [[nodiscard]] window_contraction operator()() {
        auto const posed = shaped_->parameters();
        run_options const& run = asked_->options();
        bool left = true;
        if (shaped_->shape(1e-7, *limit_)) {
            left = windows({.run = run, .seconds = 0.1 * limit_->seconds(), .chained = 1}) &&
                   windows({.run = run, .seconds = 0.17 * limit_->seconds(), .windows = 20}) &&
                   shaped_->contract();
        }
        for (double before = 1; left && (*limit_)();) {
            if (!shaped_->shape(1e-8, *limit_)) break;
            left = windows({.run = run,
                            .seconds = 0.5 * limit_->seconds(),
                            .first = 1.5 * found_.longest,
                            .chained = 1,
                            .share = fine,
                            .gain = 0.1,
                            .patience = 1,
                            .keep_responses = true}) &&
                   shaped_->contract() && judge_parts();
            double const now = relative_volume(shaped_->parameters(), posed).upper();
            if (!(now < 0.95 * before)) break;
            before = now;
        }
        found_.rest = left ? shaped_->parameters() : empty_box(posed.size());
        found_.responses.clear();
        return std::move(found_);
    }

private:
    static constexpr double fine = 0.001; ///< products that are errors, as a share of a bound

    /// @returns false when it is proved that nothing is left
    [[nodiscard]] bool windows(window_options how) {
        how.keep_going = *limit_;
        how.workers = asked_->search().workers;
        how.degree = 2; // what is of third order is small where shapes are linear
        auto found = contract_by_windows(shaped_->posed(), how);
        found.windows += found_.windows;
        found.longest = std::max(found.longest, found_.longest);
        found_ = std::move(found);
        if (found_.empty()) return false;
        shaped_->take(found_.rest);
        shaped_->begin_in(found_.starts);
        return true;
    }
    /// By what the last windows have told over all of them.
    /// @returns false when it is proved that nothing is left
    [[nodiscard]] bool judge_parts() const {
        constexpr std::size_t most = 64;
        if (found_.responses.empty()) return true;
        auto left = shaped_->parts(most);
        asked_->search().workers(left.size(), [&](std::size_t k) {
            auto const part = left[k];
            if (is_empty(part) || !(*limit_)()) return;
            lifted_program const program(found_.responses, part, found_.from, fine);
            for (std::size_t j = 0; j < part.size() && !is_empty(left[k]); ++j) {
                if (rad(part[j]) > 0) left[k][j] = program.contracted(j, part[j]);
            }
        });
        return shaped_->take_parts(left);
    }

    shaped_problem* shaped_;
    inquiry const* asked_;
    work_limit const* limit_;
    window_contraction found_; ///< rest and responses of the last windows
};

/// Windows over fixed shapes in place of constants within a function of one moving quantity.
class by_shapes : public by_windows {
public:
    [[nodiscard]] std::string name() const override { return "shapes"; }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record& says) const override {
        auto shaped = shaped_problem::of(asked.problem(), limit);
        if (!shaped) {
            says.why = "no constants stand within a function of one moving quantity";
            says.how = contraction_record::outcome::not_applicable;
            return asked.left();
        }
        auto found = shape_windows(*shaped, asked, limit)();
        auto const& prior = asked.problem().prior;
        if (!(relative_volume(found.rest, prior).upper() < 1)) return asked.left();
        return left_by(std::move(found), says);
    }
};

} // namespace sivid::paving_detail

#endif
