// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_VERIFICATION_IPP
#define SIVID_DECISION_IMPL_VERIFICATION_IPP

#include <sivid/decision/verification.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/detail/idle_parts.hpp>
#include <sivid/decision/detail/judged_motions.hpp>
#include <sivid/paving/cut_contraction.hpp>
#include <sivid/paving/work_limit.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

class verification_search {
public:
    verification_search(prediction_problem const& problem, requirement const& what,
                        feasible_points const& feasible, prediction_options const& options)
        : asked_(what),
          around_(problem.around()),
          slim_(problem, what),
          feasible_(feasible),
          options_(options),
          limit_(options.seconds, options.keep_going) {
        options_.run.enclosure.keep_going = limit_;
        double const cells = static_cast<double>(std::max<std::size_t>(options.cells, 1));
        times_ = time_cells(problem, what.times, problem.end / cells);
    }

    verification_search(verification_search const&) = delete;
    verification_search& operator=(verification_search const&) = delete;

    [[nodiscard]] verification operator()() {
        std::vector<motion_cover::part> todo;
        for (int refinement = 0;; ++refinement) {
            motions_.emplace(problem_, what_, times_, options_.run);
            if (refinement == 0) todo.push_back(motions_->cover().whole());
            open_.clear();
            for (auto& p : todo) {
                p.known = nullptr;
                open_.push_back({std::move(p)});
            }
            search();
            integrations_ += motions_->cover().integrations();
            if (result_.witness || refinement == 6 || !limit_()) break;
            todo = coarse();
            if (todo.empty()) break;
        }
        finish();
        result_.seconds = since(begun_);
        return std::move(result_);
    }

private:
    using clock = std::chrono::steady_clock;
    [[nodiscard]] static double since(clock::time_point t) {
        return std::chrono::duration<double>(clock::now() - t).count();
    }
    struct item {
        motion_cover::part what;
        judged_motions::judgement says{};
        bool judged = false, settled = false;
        int violations = 0; ///< how often it, or what it is a half of, was found to violate
        int halvings = 0;   ///< that led to it
    };

    [[nodiscard]] bool going() const {
        return limit_() && !result_.witness && parts_ < options_.parts;
    }

    /// Integrates, halves and judges until nothing is open but what needs other instants, or for
    /// good.
    void search() {
        std::size_t rounds = 0;
        while (going()) {
            std::vector<item*> next;
            for (auto& i : open_) {
                if (!i.judged) next.push_back(&i);
                if (next.size() == motions_->cover().at_once()) break;
            }
            if (!next.empty()) {
                judge(next);
                drop_proved();
                continue;
            }
            std::sort(open_.begin(), open_.end(), [](item const& a, item const& b) {
                if (a.settled != b.settled) return b.settled;
                return a.says.found.low < b.says.found.low;
            });
            if (open_.empty() || open_.front().settled) break;
            // Bounds of motions that were not carried to the end suggest little.
            auto const& worst = open_.front();
            bool const violated = worst.says.found.refuted();
            bool const telling = worst.says.reached == problem_.end;
            if (violated || rounds == 0 || (telling && (rounds & (rounds - 1)) == 0))
                seek_witness(worst);
            ++rounds;
            if (result_.witness) return;
            halve();
        }
    }

    void judge(std::vector<item*> const& which) {
        std::vector<motion_cover::part*> fresh;
        for (auto* i : which) {
            if (!i->what.known) fresh.push_back(&i->what);
        }
        if (!fresh.empty()) motions_->cover().learn(fresh);
        for (auto* i : which) {
            i->says = motions_->judge(i->what);
            i->judged = true;
            ++parts_;
        }
    }

    void drop_proved() {
        std::erase_if(open_, [this](item const& i) {
            if (!i.judged || !i.says.found.proved()) return false;
            note(i.says.found);
            return true;
        });
    }
    void note(truth const& t) {
        if (t.low < low_.low) low_ = t;
        high_ = std::max(high_, t.high);
    }

    /// The worst parts in two, as many as are integrated at once.
    void halve() {
        std::vector<item> halves;
        std::size_t taken = 0;
        for (auto& i : open_) {
            if (2 * taken >= motions_->cover().at_once()) break;
            if (i.settled) continue;
            ++taken;
            if (i.says.coarse) { // not by smaller boxes
                i.settled = true;
                continue;
            }
            auto const halved = [&](motion_cover::part const& p) {
                return i.says.side == motion_cover::none ? motions_->cover().split(p)
                                                         : motions_->cover().split(p, i.says.side);
            };
            auto parts = halved(i.what);
            if (parts.empty() || motions_->is_tiny(i.what)) {
                i.settled = true;
                continue;
            }
            ++i.halvings;
            if ((i.says.found.refuted() || i.halvings % 3 == 0) && meets_no_data(i.what)) {
                i.judged = false; // it leaves
                continue;
            }
            if (i.says.found.refuted() && ++i.violations > 5) { // nothing of it is known feasible
                i.settled = true;
                continue;
            }
            // Boxes side by side cost little more than one: what was carried far from the end is
            // cut finer at once.
            bool const early = i.says.worn && i.says.reached < problem_.end;
            auto const most = motions_->cover().at_once() / taken;
            while (early && 2 * parts.size() <= most) {
                std::vector<motion_cover::part> finer;
                for (auto& p : parts) {
                    auto cut = halved(p);
                    if (cut.empty()) cut.push_back(std::move(p));
                    for (auto& c : cut) finer.push_back(std::move(c));
                }
                bool const more = finer.size() > parts.size();
                parts = std::move(finer);
                if (!more) break;
            }
            for (auto& p : parts) {
                if (i.says.worn) p.known = nullptr;
                halves.push_back({std::move(p), i.says, false, false, i.violations, i.halvings});
            }
            i.judged = false; // its halves take its place
        }
        std::erase_if(open_, [](item const& i) { return !i.judged; });
        for (auto& h : halves) open_.push_back(std::move(h));
    }

    /// Whether the measurements refute all parameters of a part; they get at most half of the time.
    [[nodiscard]] bool meets_no_data(motion_cover::part const& p) {
        if (!problem_.measured || !limit_() || 2 * heard_ > since(begun_)) return false;
        auto const asked = clock::now();
        auto all = p.parameters;
        for (std::size_t j = 0; j < all.size(); ++j) {
            if (slim_.idle[j]) all[j] = around_[j];
        }
        auto const data = problem_.measured(all, limit_);
        bool const refuted = !data.known.empty() && !cut_contraction()(data.known, all);
        heard_ += since(asked);
        return refuted;
    }

    /// What is open since the grid is too coarse, once the grid is finer; empty: nothing is.
    std::vector<motion_cover::part> coarse() {
        std::set<std::size_t> cells;
        for (auto const& i : open_) {
            if (i.says.coarse) cells.insert(i.says.hiding.begin(), i.says.hiding.end());
        }
        if (cells.empty()) return {};
        std::vector<motion_cover::part> todo;
        for (auto& i : open_) {
            if (i.says.coarse)
                todo.push_back(std::move(i.what));
            else
                remember(i);
        }
        std::vector<double> finer;
        for (std::size_t k = 0; k + 1 < times_.size(); ++k) {
            finer.push_back(times_[k]);
            if (cells.count(k) == 0) continue;
            double const length = times_[k + 1] - times_[k];
            for (int part = 1; part < 4; ++part) {
                double const t = times_[k] + length * part / 4;
                if (t > finer.back() && t < times_[k + 1]) finer.push_back(t);
            }
        }
        finer.push_back(times_.back());
        times_ = std::move(finer);
        tried_.clear();
        return todo;
    }

    /// Single motions at the points where the bounds of a part suggest a violation.
    void seek_witness(item const& worst) {
        if (feasible_.direct == nullptr || !feasible_.candidates || !feasible_.proved) return;
        auto const points = motions_->suspicious_points(worst.what, worst.says.found);
        if (!slim_direct_) {
            slim_direct_ = std::make_unique<without_idle_parts>(*feasible_.direct, asked_);
            direct_around_ = feasible_.direct->around();
        }
        if (!direct_ || direct_times_ != times_) {
            direct_times_ = times_;
            direct_ = std::make_unique<judged_motions>(slim_direct_->problem, slim_direct_->what,
                                                       times_, options_.run);
        }
        auto& cover = direct_->cover();
        struct single {
            motion_cover::part motion;
            std::vector<std::vector<double>> parameters; ///< that have this motion
        };
        std::vector<single> singles;
        std::map<std::vector<double>, std::size_t> place; // of motions that differ
        for (auto const& [start, parameters] : points) {
            for (auto const& candidate : feasible_.candidates(parameters)) {
                auto const own = mid(point_within(direct_around_, candidate));
                auto key = own;
                key.insert(key.end(), start.begin(), start.end());
                if (!tried_.insert(key).second) continue;
                for (std::size_t j = 0; j < own.size(); ++j) {
                    if (slim_direct_->idle[j]) key[j] = 0;
                }
                auto const [at, fresh] = place.emplace(std::move(key), singles.size());
                if (fresh) singles.push_back({cover.point(start, own), {}});
                singles[at->second].parameters.push_back(own);
            }
        }
        for (std::size_t first = 0; first < singles.size() && limit_(); first += cover.at_once()) {
            auto const last = std::min(first + cover.at_once(), singles.size());
            std::vector<motion_cover::part*> some;
            for (auto k = first; k < last; ++k) some.push_back(&singles[k].motion);
            cover.learn(some);
            for (auto k = first; k < last; ++k) {
                auto const says = direct_->judge(singles[k].motion);
                if (!says.found.refuted()) continue;
                for (auto const& parameters : singles[k].parameters) {
                    if (!feasible_.proved(parameters)) continue;
                    auto const segment = says.found.high_from.segment;
                    result_.witness = violating_motion{parameters, mid(singles[k].motion.initial),
                                                       says.found, times_[segment / 2]};
                    return;
                }
            }
        }
    }

    void remember(item const& i) {
        note(i.says.found);
        open_box box{i.what.parameters, i.what.initial, i.says.found, open_reason::undecided,
                     i.says.reached};
        for (std::size_t j = 0; j < around_.size(); ++j) {
            if (slim_.idle[j]) box.parameters[j] = around_[j];
        }
        if (i.judged && i.says.reached < problem_.end)
            box.why = open_reason::not_enclosed;
        else if (i.says.found.refuted())
            box.why = open_reason::infeasible;
        left_.push_back(std::move(box));
    }

    void finish() {
        for (auto const& i : open_) remember(i);
        result_.found = low_;
        result_.found.high = high_;
        result_.found.certain = left_.empty() && !result_.witness;
        result_.found.possible = !(result_.witness && left_.empty());
        result_.answer = result_.witness ? requirement_answer::refuted
                         : left_.empty() ? requirement_answer::proved
                                         : requirement_answer::open;
        result_.reached = problem_.end;
        for (auto const& b : left_) result_.reached = std::min(result_.reached, b.reached);
        std::vector<std::pair<double, std::size_t>> order; // the largest first, else as found
        for (std::size_t k = 0; k < left_.size(); ++k)
            order.emplace_back(-relative_volume(left_[k].parameters, around_).upper(), k);
        std::sort(order.begin(), order.end());
        for (auto const& [volume, k] : order) result_.open.push_back(std::move(left_[k]));
        result_.times = times_;
        result_.parts = parts_;
        result_.integrations = integrations_ + (direct_ ? direct_->cover().integrations() : 0);
    }

    requirement const& asked_;
    box around_; ///< all sets, idle sides as they are
    without_idle_parts slim_;
    prediction_problem const& problem_ = slim_.problem;
    requirement const& what_ = slim_.what;
    feasible_points const& feasible_;
    prediction_options options_;
    work_limit limit_;
    clock::time_point begun_ = clock::now();
    double heard_ = 0; ///< on what measurements say of parts [s]
    std::vector<double> times_, direct_times_;
    std::optional<judged_motions> motions_;
    std::unique_ptr<without_idle_parts> slim_direct_;
    std::unique_ptr<judged_motions> direct_;
    box direct_around_;
    std::vector<item> open_;
    std::vector<open_box> left_;
    std::set<std::vector<double>> tried_;
    std::size_t parts_ = 0, integrations_ = 0;
    truth low_{HUGE_VAL, HUGE_VAL, true, true, {}, {}}; // of no motion
    double high_ = -std::numeric_limits<double>::infinity();
    verification result_;
};

} // namespace decision_detail

SIVID_DECL verification verify(prediction_problem const& problem, requirement const& what,
                               feasible_points const& feasible, prediction_options const& options) {
    auto const require = [&what](prediction_problem const& p) {
        p.require_valid();
        for (auto const m : what.margins) {
            if (m >= p.model.g.size())
                throw std::invalid_argument("verify: the requirement was read for another model");
        }
    };
    require(problem);
    if (feasible.direct != nullptr) require(*feasible.direct);
    return decision_detail::verification_search(problem, what, feasible, options)();
}

} // namespace sivid

#endif
