// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_DETAIL_PAVING_SEARCH_HPP
#define SIVID_PAVING_SEARCH_DETAIL_PAVING_SEARCH_HPP

#include <sivid/number/guard.hpp>
#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/search/detail/box_batches.hpp>
#include <sivid/paving/search/detail/lesson.hpp>
#include <sivid/paving/search/detail/split_rule.hpp>
#include <sivid/paving/search/frontier.hpp>
#include <sivid/paving/search/search_budget.hpp>
#include <sivid/paving/search/search_state.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/work_limit.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A running set inversion: boxes that wait, the paving of all others, and when to look at what.
///   while (!search.done() && !search.must_stop()) search.step();
/// What happens depends on the test, the prior, the options and the number of steps alone, neither
/// on the threads nor on interruptions: judgements are made ahead of their turn at most, and sets
/// of boxes to learn about are chosen before the first of them is learnt about.
template <set_test Test>
class paving_search {
    using knowledge = typename paving_detail::knowledge_of<Test>::type;
    using answer = assessment<knowledge>;
    using known_part = std::shared_ptr<paving_detail::learnt<knowledge>>;
    using lesson = paving_detail::lesson<knowledge>;
    using frontier = paving_detail::frontier<paving_detail::companion<knowledge>>;
    using item = typename frontier::item;
    static constexpr bool in_batches = batch_set_test<Test>;

public:
    /// @throws std::invalid_argument  for a prior or a state that cannot be searched
    paving_search(Test& test, box const& prior, inversion_options const& options)
        : test_(&test),
          options_(options),
          prior_(prior),
          paving_(prior),
          waiting_(options.order),
          limit_(left_of(options), options.keep_going),
          batches_(test, waiting_, options.workers),
          splits_{.whole = prior},
          rest_{.last = prior},
          outside_kept_(options.keep_outside || options.checkpoint || options.resume) {
        require_sound_environment();
        if (options.proof_bytes > 0) log_.emplace(options.proof_bytes);
        if (prior.size() == 0 || is_empty(prior))
            throw std::invalid_argument("invert: empty prior");
        for (std::size_t i = 0; i < prior.size(); ++i)
            if (!std::isfinite(width(prior[i])))
                throw std::invalid_argument("invert: side " + std::to_string(i) +
                                            " of the prior (counted from 0) is unbounded");
        if (options_.resume) {
            restore(*options_.resume);
        } else {
            waiting_.push(prior, 1, {});
        }
    }
    paving_search(paving_search const&) = delete;
    paving_search& operator=(paving_search const&) = delete;

    [[nodiscard]] bool done() const { return waiting_.empty(); }

    /// Whether a budget or what was reached ends the search here; also reports progress and writes
    /// checkpoints.
    [[nodiscard]] bool must_stop() {
        double const inner = paving_.inner_volume().upper();
        double const outer = paving_.outer_volume().upper() + waiting_.volume();
        // Asked first: who told the test to stop says so after it, too.
        bool const cut = cut_short();
        bool const cancelled =
            (options_.progress &&
             !options_.progress({seconds(), tested_, waiting_.size(), inner, outer})) ||
            (options_.keep_going && !options_.keep_going());
        auto stop = used_up(options_, limit_, tested_, bytes());
        if (!stop && cancelled) stop = stop_reason::cancelled;
        if (!stop && cut) stop = stop_reason::time_budget;
        if (options_.checkpoint && (stop || checkpoint_due())) write_checkpoint();
        if (!stop) stop = hull_rests();
        if (!stop && inner > 0 && inner >= options_.sufficient_ratio * outer &&
            options_.sufficient_ratio < 1) {
            stop = stop_reason::inside_share;
        }
        if (!stop) return false;
        reason_ = *stop;
        stopped_at_ = seconds();
        return true;
    }

    /// Takes the next box, or the next boxes to learn about, and settles what is found. A test that
    /// was interrupted meanwhile settles nothing: then all is as it was before the step.
    void step() {
        work_watch const took;
        if (!settle_next()) return;
        worked_ += took.spent();
        if (waiting_.empty()) reopen();
    }

    /// What waits is pending in the result.
    [[nodiscard]] inversion finish() && {
        while (!waiting_.empty()) paving_.add(waiting_.pop().set, box_verdict::pending);
        if (outside_kept_ && !options_.keep_outside) paving_ = without_outside(paving_);
        auto proof = log_ ? log_->proof_from(prior_) : exclusion_proof{};
        return {std::move(paving_),
                reason_,
                tested_,
                cost_,
                stopped_at_.value_or(seconds()),
                (options_.resume ? options_.resume->work : 0) + limit_.spent(),
                limit_.late(),
                std::move(proof)};
    }

    /// Bytes held by boxes and knowledge.
    [[nodiscard]] std::size_t bytes() const {
        auto const sides = prior_.size() * sizeof(interval);
        return waiting_.size() * (sizeof(item) + sides) +
               paving_.boxes().size() * (sizeof(paved_box) + sides) + *held_;
    }

    [[nodiscard]] search_state state() const requires resumable_set_test<Test> {
        search_state s;
        s.prior = prior_;
        s.paved = paving_.boxes();
        paving_detail::lesson_list<knowledge> lessons;
        for (auto const& i : waiting_.items()) {
            s.waiting.push_back({i.set, i.volume, i.number, lessons.origin_of(i.load.known)});
        }
        s.lessons = std::move(lessons).take();
        s.pushed = waiting_.pushed();
        s.waiting_volume = waiting_.running_volume();
        s.tested = tested_;
        s.cost = cost_;
        s.batches = options_.batches;
        s.accuracy_reached = reason_ == stop_reason::accuracy_reached;
        s.whole = splits_.whole;
        s.measured_at = splits_.measured_at;
        s.last_hull = rest_.last;
        s.rested = rest_.rested;
        s.next_look = rest_.next_look;
        s.seconds = seconds();
        s.work = worked_;
        s.outside_kept = outside_kept_;
        if (log_) s.proof = log_->proof_from(prior_);
        return s;
    }

private:
    void restore(search_state const& s) {
        if constexpr (resumable_set_test<Test>) {
            s.require_valid();
            if (s.prior.size() != prior_.size() || !subset(s.prior, prior_) ||
                !subset(prior_, s.prior) || s.batches != options_.batches) {
                throw std::invalid_argument("search state: it is of another search");
            }
            for (auto const& b : s.paved) paving_.add(b.set, b.verdict);
            outside_kept_ = outside_kept_ && s.outside_kept;
            if (log_) log_->take_up(s.proof, prior_);
            paving_detail::lesson_restorer<knowledge> known(s, held_);
            std::vector<item> items;
            for (auto const& w : s.waiting) {
                items.push_back({w.set, w.volume, w.number, {known(w.known), nullptr}});
            }
            waiting_.restore(std::move(items), s.pushed, s.waiting_volume);
            tested_ = s.tested;
            cost_ = s.cost;
            if (s.accuracy_reached) reason_ = stop_reason::accuracy_reached;
            splits_ = {s.whole, s.measured_at};
            rest_ = {s.last_hull, s.rested, s.next_look};
            earlier_ = s.seconds;
            worked_ = s.work;
            written_at_ = earlier_;
        } else {
            throw std::invalid_argument("invert: this kind of test cannot be resumed");
        }
    }

    [[nodiscard]] double seconds() const { return earlier_ + clock_.spent(); }
    /// What earlier runs left of the budget.
    [[nodiscard]] static double left_of(inversion_options const& options) {
        return options.seconds - (options.resume ? options.resume->work : 0);
    }
    [[nodiscard]] bool checkpoint_due() const {
        double const since = seconds() - written_at_;
        return since >= options_.checkpoint_seconds && since >= 10 * writing_;
    }
    void write_checkpoint() {
        if constexpr (resumable_set_test<Test>) {
            double const before = seconds();
            options_.checkpoint(state());
            written_at_ = seconds();
            writing_ = written_at_ - before;
        } else {
            throw std::invalid_argument("invert: this kind of test cannot be resumed");
        }
    }

    [[nodiscard]] bool cut_short() const {
        if constexpr (interruptible_set_test<Test>) {
            return test_->cancelled();
        } else {
            return false;
        }
    }

    [[nodiscard]] std::optional<stop_reason> hull_rests() {
        std::optional<stop_reason> why;
        auto const hull = [this] { return waiting_.hull(paving_.outer_hull()); };
        auto const ends = [&](box const& around) {
            if (options_.hull_gain > 0 &&
                (volume(around) <= options_.small_hull ||
                 batches_.hold_faces(paving_, around, options_.hull_gain)))
                why = stop_reason::hulls_rest;
            else if (too_blurred(around))
                why = stop_reason::too_blurred;
            return why.has_value();
        };
        return rest_(tested_, options_.hull_gain, hull, ends) ? why : std::nullopt;
    }

    /// Whether the smallest boxes of a hull that rests decide nothing: what starts or inputs blur
    /// says as little about them as about large ones. Asked behind boxes enough for large ones to
    /// have said something, eight for each of three sides: the row "geared motor" of the demo had
    /// 300 000 boxes and not one decided. Its work is not counted, so that a search that goes on
    /// from a later state ends at the same box.
    [[nodiscard]] bool too_blurred(box const& left) {
        constexpr std::size_t enough = 512;
        if (tested_ < enough || !(options_.accuracy > 0) || paving_.has_outer()) return false;
        auto const& whole = options_.accuracy_of_hull ? left : splits_.whole;
        auto const smallest = paving_detail::smallest_boxes(left, whole, 0.5 * options_.accuracy);
        uncounted const here;
        return batches_.decide_none_of(smallest) && !cut_short();
    }

    [[nodiscard]] double volume(box const& x) const { return relative_volume(x, prior_).upper(); }
    void decide(box x, box_verdict v) {
        if (v != box_verdict::outside || outside_kept_) paving_.add(std::move(x), v);
    }
    [[nodiscard]] std::optional<std::size_t> split_side(box const& x,
                                                        std::vector<double> const& smear) {
        return splits_(x, smear, options_, tested_,
                       [&] { return waiting_.hull(hull(paving_.outer_hull(), x)); });
    }
    /// Boxes that were small against an older hull may be wide against that of what is left in the
    /// end. Their halves wait.
    void reopen() {
        if (!options_.accuracy_of_hull || !paving_.has_outer()) return;
        splits_.measure(paving_.outer_hull(), tested_);
        subpaving rest(prior_);
        reason_ = stop_reason::decided;
        for (auto const& b : paving_.boxes()) {
            bool const open = b.verdict == box_verdict::undecided;
            auto const side = open ? split_side(b.set, {}) : std::nullopt;
            if (side) {
                if (log_) log_->add(b.set, {}, b.set, side);
                push_halves(b.set, *side, nullptr);
            } else {
                rest.add(b.set, b.verdict);
                if (open) reason_ = stop_reason::accuracy_reached;
            }
        }
        paving_ = std::move(rest);
    }
    void push_halves(box const& x, std::size_t side, known_part known) {
        auto [low, high] = bisect(x, side, mid(x[side]));
        double const low_volume = volume(low);
        double const high_volume = volume(high);
        waiting_.push(std::move(low), low_volume, {known});
        waiting_.push(std::move(high), high_volume, {std::move(known)});
    }

    /// @returns false where all is as it was before
    [[nodiscard]] bool settle_next() {
        auto const before = waiting_.now();
        if constexpr (in_batches) {
            auto next = batches_.take();
            if (cut_short()) {
                waiting_.back_to(before, {std::move(next)});
                return false;
            }
            if (next.load.judged->blind) return learn(before, std::move(next));
            auto const judged = std::move(next.load.judged);
            work_clock::advance(judged->work);
            auto known = judged->knowledge ? std::move(next.load.known) : nullptr;
            ++tested_;
            settle(std::move(next), *judged, std::move(known));
        } else {
            auto next = waiting_.pop();
            auto const known = next.load.known;
            auto found = ask(next.set, known);
            if (cut_short()) {
                waiting_.back_to(before, {std::move(next)});
                return false;
            }
            ++tested_;
            settle(std::move(next), found, hand_on(found.knowledge, known));
        }
        return true;
    }
    /// What a test found about a box goes into the paving, and its parts wait.
    void settle(item of, answer found, known_part known) {
        auto& x = of.set;
        cost_ += found.cost;
        auto const tell = [&](std::optional<box> const& left,
                              std::optional<std::size_t> split = std::nullopt) {
            if (log_) log_->add(x, std::move(found.proof), left, split);
        };
        if (found.verdict == box_verdict::outside || is_empty(found.rest)) {
            tell(std::nullopt);
            decide(std::move(x), box_verdict::outside);
            return;
        }
        for (auto& cut : difference(x, found.rest)) decide(std::move(cut), box_verdict::outside);
        if (found.verdict == box_verdict::inside) {
            tell(found.rest);
            decide(std::move(found.rest), box_verdict::inside);
            return;
        }
        // A box that shrank much is worth another look before it is split.
        double const after = volume(found.rest);
        using paving_detail::rank_of;
        if (rank_of(after) < rank_of(0.5 * of.volume) && after > 0) {
            tell(found.rest);
            waiting_.push(std::move(found.rest), after, {std::move(known)});
            return;
        }
        auto const side = split_side(found.rest, found.smear);
        tell(found.rest, side);
        if (side) return push_halves(found.rest, *side, std::move(known));
        reason_ = stop_reason::accuracy_reached;
        decide(std::move(found.rest), box_verdict::undecided);
    }

    [[nodiscard]] answer ask(box const& x, known_part const& known) {
        if constexpr (learning_set_test<Test>) {
            return (*test_)(x, known ? known->found() : nullptr);
        } else {
            return (*test_)(x);
        }
    }
    [[nodiscard]] known_part hand_on(std::shared_ptr<knowledge const> const& found,
                                     known_part const& before) {
        if (!found) return nullptr;
        if (before && before->found() == found) return before;
        return std::make_shared<paving_detail::learnt<knowledge>>(
            found, paving_detail::bytes_of(*test_, prior_, *found), held_);
    }

    /// Replaces every box by its halves; false when one cannot be split.
    [[nodiscard]] bool halve(std::vector<item>& items) {
        std::vector<item> halves;
        for (auto const& i : items) {
            auto const side = split_side(i.set, {});
            if (!side) return false;
            if (log_) log_->add(i.set, {}, i.set, side);
            auto [low, high] = bisect(i.set, *side, mid(i.set[*side]));
            for (auto* half : {&low, &high}) {
                double const size = volume(*half);
                halves.push_back({std::move(*half), size, i.number, i.load});
            }
        }
        items = std::move(halves);
        return true;
    }

    /// Boxes that are blind too are learnt about together. @returns false where nothing was settled
    [[nodiscard]] bool learn(typename frontier::moment const& before, item first) {
        auto [sets, moved] = batches_.gather(std::move(first), options_.batches);
        std::vector<item> taken;
        for (auto const& set : sets) taken.insert(taken.end(), set.begin(), set.end());
        auto const splits = splits_;
        // While there are few the search has just begun: halves are more use than wholes.
        while (options_.order == search_order::largest_first &&
               2 * sets[0].size() <= test_->at_once() && halve(sets[0])) {
        }
        for (auto const& i : taken) work_clock::advance(i.load.judged ? i.load.judged->work : 0);
        auto found = batches_.learn(sets);
        if (cut_short()) {
            waiting_.back_to(before, std::move(taken), moved);
            splits_ = splits;
            return false;
        }
        for (std::size_t k = 0; k < sets.size(); ++k) {
            for (std::size_t n = 0; n < sets[k].size(); ++n) {
                ++tested_;
                auto& says = found[k].answers[n];
                known_part known;
                if (says.knowledge) {
                    known = lesson::add(found[k].of, n, says.knowledge,
                                        paving_detail::bytes_of(*test_, prior_, *says.knowledge),
                                        held_);
                }
                settle(std::move(sets[k][n]), std::move(says), std::move(known));
            }
        }
        return true;
    }

    Test* test_;
    inversion_options options_;
    box prior_;
    subpaving paving_;
    /// Bytes of knowledge; outlives what refers to it.
    std::shared_ptr<std::size_t> held_ = std::make_shared<std::size_t>(0);
    frontier waiting_;
    work_limit limit_;
    paving_detail::box_batches<Test> batches_;
    stop_reason reason_ = stop_reason::decided;
    std::size_t tested_ = 0;
    std::size_t cost_ = 0;
    std::optional<proof_log> log_;
    paving_detail::split_rule splits_;
    paving_detail::hull_rest rest_;
    /// A state without them could not be told from one that lost a box.
    bool outside_kept_;
    std::optional<double> stopped_at_; ///< when a budget, or what was reached, ended the search
    stopwatch clock_;
    double earlier_ = 0;    ///< seconds of the runs before
    double worked_ = 0;     ///< of the budget, at the end of the last step, with the runs before
    double written_at_ = 0; ///< of the last checkpoint, and what it took
    double writing_ = 0;
};

} // namespace sivid

#endif
