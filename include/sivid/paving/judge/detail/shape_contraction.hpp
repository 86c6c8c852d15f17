// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_SHAPE_CONTRACTION_HPP
#define SIVID_PAVING_JUDGE_DETAIL_SHAPE_CONTRACTION_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/contract/detail/lifted_program.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/curve/detail/shaped_problem.hpp>
#include <sivid/paving/identify_options.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// What windows leave of a prior with coefficients of shapes in place of constants of curves.
///   First windows that grow from the begin, then windows all along leave a thin tube of each
///   family, whose curves have shapes of their own. Over these a window grows to the whole record;
///   its polynomials judge parts of the families, along their lines; what is left has narrower
///   shapes again, and so on.
class shape_contractor {
public:
    shape_contractor(shaped_problem& shaped, identify_options const& options,
                     work_limit const& limit)
        : shaped_(&shaped), options_(&options), limit_(&limit) {
        found_.starts = shaped.starts();
    }

    [[nodiscard]] window_contraction operator()() {
        auto const posed = shaped_->parameters();
        run_options const& run = options_->test;
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
        how.workers = options_->search.workers;
        how.degree = 2; // what is of third order is small where shapes are linear
        found_ = joined(found_, contract_by_windows(shaped_->posed(), how));
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
        options_->search.workers(left.size(), [&](std::size_t k) {
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
    identify_options const* options_;
    work_limit const* limit_;
    window_contraction found_; ///< rest and responses of the last windows
};

/// What windows leave of the prior with coefficients of shapes in place of constants of curves;
/// nothing where there are no such curves, or nothing is gained.
inline std::optional<window_contraction> contract_by_shapes(identification_problem const& posed,
                                                            identify_options const& options,
                                                            work_limit const& limit) {
    work_limit const own(0.9 * limit.seconds(), limit);
    auto shaped = shaped_problem::of(posed, own);
    if (!shaped) return std::nullopt;
    auto result = shape_contractor(*shaped, options, own)();
    if (!(relative_volume(result.rest, posed.prior).upper() < 1)) return std::nullopt;
    result.seconds = own.spent();
    return result;
}

} // namespace sivid::paving_detail

#endif
