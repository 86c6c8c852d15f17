// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_CERTIFICATE_COVER_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_CERTIFICATE_COVER_HPP

#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/run/plain_run.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::io_detail {

/// The prior as a tree of boxes that simple runs exclude, and boxes that are kept: the text of a
/// certificate's tree. Faces are doubles of few digits, so that their decimals are the faces.
class certificate_cover {
public:
    /// Bounds of measurements are as much wider here, as a share of their widths: what the checker
    /// may be weaker.
    static constexpr double slack = 0.02;

    certificate_cover(identification_problem const& problem, std::size_t boxes, work_limit limit)
        : problem_(&problem), limit_(std::move(limit)), boxes_(boxes) {
        for (auto e : problem.experiments) {
            for (auto& m : e.measurements) {
                double const by = 0.5 * slack * width(m.bound);
                m.bound = interval_traits<interval>::add(m.bound, interval(-by, by));
            }
            runs_.push_back(std::make_unique<plain_run<interval>>(problem.model, problem.choice, e,
                                                                  certificate_options()));
        }
    }

    /// Excludes the prior, but for a box in it if there is one.
    void exclude_all_but(std::optional<box> const& kept) {
        kept ? around(problem_->prior, *kept, 0, false) : exclude(problem_->prior);
    }

    [[nodiscard]] std::string const& text() const { return text_; }
    [[nodiscard]] std::size_t excluded() const { return excluded_; }
    /// The hull of what is kept; nothing where nothing is.
    [[nodiscard]] std::optional<box> const& hull_of_kept() const { return kept_; }

    /// A number of few digits between two.
    [[nodiscard]] static double face(double low, double high) {
        return few_digits(low, high, 0.5 * low + 0.5 * high, 0.3 * (high - low));
    }

private:
    void around(box const& x, box const& kept, std::size_t side, bool upper) {
        if (side == x.size()) return keep(x);
        auto const next = upper ? side + 1 : side;
        double const at = upper ? kept[side].upper() : kept[side].lower();
        if (!(x[side].lower() < at && at < x[side].upper())) return around(x, kept, next, !upper);
        auto const [low, high] = split(x, side, at);
        if (!upper) exclude(low);
        around(upper ? low : high, kept, next, !upper);
        if (upper) exclude(high);
    }
    std::pair<box, box> split(box const& x, std::size_t side, double at) {
        text_ += "split\t" + std::to_string(side) + "\t" + nearest_text(at) + "\n";
        return bisect(x, side, at);
    }
    void keep(box const& x) {
        text_ += "keep\n";
        kept_ = kept_ ? hull(*kept_, x) : x;
    }
    void exclude(box const& x) {
        if (tried_++ >= boxes_ || !limit_()) return keep(x);
        for (std::size_t k = 0; k < runs_.size(); ++k) {
            auto const e = (last_ + k) % runs_.size(); // what refuted the last may refute this
            if (!refutes(e, x)) continue;
            text_ += "out\t" + std::to_string(e) + "\n";
            ++excluded_;
            last_ = e;
            return;
        }
        auto const side = widest_side(x, problem_->prior, 1e-6);
        if (!side) return keep(x);
        double const at = face(x[*side].lower(), x[*side].upper());
        if (!(x[*side].lower() < at && at < x[*side].upper())) return keep(x);
        auto const [low, high] = split(x, *side, at);
        exclude(low);
        exclude(high);
    }
    [[nodiscard]] bool refutes(std::size_t e, box const& x) {
        auto const& starts = problem_->experiments[e].initial;
        if (refutes_from(e, starts, x)) return true;
        return refutes_from(e, point_box(mid(starts)), x) && refutes_halves(e, starts, x, 5);
    }
    [[nodiscard]] bool refutes_from(std::size_t e, box const& starts, box const& x) {
        auto const known = (*runs_[e])(starts, x);
        return decide(known, runs_[e]->samples(), x, problem_->experiments[e].outliers) ==
               run_finding::refuted;
    }
    /// The same, the starts divided where they are widest: the checker does so, too.
    [[nodiscard]] bool refutes_halves(std::size_t e, box const& starts, box const& x, int depth) {
        auto const side = widest_side(starts, problem_->experiments[e].initial);
        if (!side || depth == 0) return false;
        auto const [low, high] = bisect(starts, *side, mid(starts[*side]));
        auto const excluded = [&](box const& half) {
            return refutes_from(e, half, x) || refutes_halves(e, half, x, depth - 1);
        };
        return excluded(low) && excluded(high);
    }

    identification_problem const* problem_;
    work_limit limit_;
    std::size_t boxes_, tried_ = 0, excluded_ = 0, last_ = 0;
    std::vector<std::unique_ptr<plain_run<interval>>> runs_;
    std::string text_;
    std::optional<box> kept_;
};

} // namespace sivid::io_detail

#endif
