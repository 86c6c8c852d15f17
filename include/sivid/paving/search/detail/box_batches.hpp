// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_DETAIL_BOX_BATCHES_HPP
#define SIVID_PAVING_SEARCH_DETAIL_BOX_BATCHES_HPP

#include <sivid/executor.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/search/detail/hull_rest.hpp>
#include <sivid/paving/search/detail/lesson.hpp>
#include <sivid/paving/search/frontier.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/work_clock.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace sivid::paving_detail {

template <class Test>
struct knowledge_of {
    using type = std::monostate;
};
template <class Test>
    requires requires { typename Test::knowledge; }
struct knowledge_of<Test> {
    using type = typename Test::knowledge;
};

/// Bytes that knowledge of a box takes.
template <class Test>
[[nodiscard]] std::size_t bytes_of(Test const& test, box const& x,
                                   typename knowledge_of<Test>::type const& found) {
    using knowledge = typename knowledge_of<Test>::type;
    auto const frame = sizeof(learnt<knowledge>) + sizeof(box) + x.size() * sizeof(interval);
    if constexpr (measured_set_test<Test>) {
        return frame + test.bytes(found);
    } else {
        return frame + sizeof(knowledge);
    }
}

/// What waits with a box.
template <class Knowledge>
struct companion {
    std::shared_ptr<learnt<Knowledge>> known = nullptr;
    std::shared_ptr<assessment<Knowledge> const> judged = nullptr; ///< ahead of its turn
};

/// Nothing: for tests that are asked about one box after the other.
template <class Test>
class box_batches {
public:
    template <class Frontier>
    box_batches(Test&, Frontier&, executor const&) {}
    [[nodiscard]] static bool hold_faces(subpaving const&, box const&, double) { return true; }
    [[nodiscard]] static bool decide_none_of(std::vector<box> const&) { return false; }
};

/// Takes boxes from a frontier and has them judged and learnt about, in parallel where the test
/// allows it. What comes out does not depend on the number of threads: judgements depend on the box
/// alone and are only made earlier, and sets are chosen before any of them is learnt about.
template <batch_set_test Test>
class box_batches<Test> {
    using knowledge = typename Test::knowledge;
    using answer = assessment<knowledge>;
    using waiting_boxes = frontier<companion<knowledge>>;
    using item = typename waiting_boxes::item;

public:
    box_batches(Test& test, waiting_boxes& waiting, executor const& workers)
        : test_(&test), waiting_(&waiting), workers_(workers) {}

    /// The next box with its judgement.
    [[nodiscard]] item take() {
        if (!waiting_->next().load.judged) look_ahead();
        return waiting_->pop();
    }

    struct gathered {
        std::vector<std::vector<item>> sets;
        std::vector<std::size_t> moved; ///< numbers that others had, which now wait under new ones
    };
    /// The first, which is blind, and more blind boxes that are near their turn: one set as large
    /// as the test takes at once, or what there is, and up to `most` - 1 further full sets.
    [[nodiscard]] gathered gather(item first, std::size_t most) {
        std::size_t const wanted = test_->at_once();
        gathered result;
        auto& sets = result.sets;
        sets.resize(1);
        std::vector<item> others;
        sets[0].push_back(std::move(first));
        auto const fill = [&](std::vector<item>& set) {
            for (std::size_t looked = 0;
                 looked < 2 * wanted && set.size() < wanted && !waiting_->empty(); ++looked) {
                auto other = take();
                (other.load.judged->blind ? set : others).push_back(std::move(other));
            }
        };
        fill(sets[0]);
        while (sets.size() < most && sets.back().size() == wanted) {
            std::vector<item> more;
            fill(more);
            if (more.size() < wanted) {
                std::move(more.begin(), more.end(), std::back_inserter(others));
                break;
            }
            sets.push_back(std::move(more));
        }
        for (auto& i : others) {
            result.moved.push_back(i.number);
            waiting_->push(std::move(i.set), i.volume, std::move(i.load));
        }
        return result;
    }

    /// A call of `learn`.
    struct lecture {
        std::shared_ptr<lesson<knowledge>> of;
        std::vector<answer> answers;
    };
    [[nodiscard]] std::vector<lecture> learn(std::vector<std::vector<item>> const& sets) const {
        std::vector<lecture> result(sets.size());
        std::vector<std::vector<box>> boxes(sets.size());
        for (std::size_t k = 0; k < sets.size(); ++k) {
            for (auto const& i : sets[k]) boxes[k].push_back(i.set);
        }
        auto answers = answers_about(boxes);
        for (std::size_t k = 0; k < sets.size(); ++k) {
            result[k].of = std::make_shared<lesson<knowledge>>();
            result[k].of->boxes = std::move(boxes[k]);
            result[k].answers = std::move(answers[k]);
        }
        return result;
    }

    /// Whether each face of a hull is touched by a box of the paving, or by a waiting one that what
    /// is known of it shows sharply: such a face moves with the size of boxes alone, others when
    /// enclosures become narrow enough.
    /// @param share  of a side's width within which a box touches a face
    [[nodiscard]] bool hold_faces(subpaving const& paving, box const& hull, double share) {
        open_faces open(hull, share);
        for (auto const& b : paving.boxes()) {
            if (b.verdict != box_verdict::outside) open.close(b.set);
        }
        for (auto* const i : waiting_->best(waiting_->size())) {
            if (!i->load.known || !open.touched_by(i->set)) continue;
            if (!i->load.judged) judge({i});
            if (!i->load.judged->blind) open.close(i->set);
        }
        return open.none();
    }

    /// Whether learning about these boxes neither decides nor narrows one of them.
    [[nodiscard]] bool decide_none_of(std::vector<box> const& boxes) const {
        auto const says = answers_about({boxes})[0];
        for (std::size_t k = 0; k < boxes.size(); ++k)
            if (says[k].verdict != box_verdict::undecided || !subset(boxes[k], says[k].rest))
                return false;
        return true;
    }

private:
    void in_parallel(std::size_t count, executor::task const& work) const {
        if constexpr (concurrent_set_test<Test>) {
            workers_(count, [&work](std::size_t k) {
                require_sound_environment(); // of this thread
                work(k);
            });
        } else {
            for (std::size_t k = 0; k < count; ++k) work(k);
        }
    }

    /// By calls of `learn`, one for each set.
    [[nodiscard]] std::vector<std::vector<answer>>
    answers_about(std::vector<std::vector<box>> const& sets) const {
        if constexpr (delegating_set_test<Test>) {
            return test_->learn_all(sets);
        } else {
            std::vector<std::vector<answer>> result(sets.size());
            in_parallel(sets.size(), [&](std::size_t k) { result[k] = test_->learn(sets[k]); });
            return result;
        }
    }

    /// How many boxes are judged at once, the next one and those after it.
    [[nodiscard]] std::size_t ahead() const {
        if constexpr (delegating_set_test<Test>) {
            return 16 * test_->hands();
        } else {
            bool const alone = !concurrent_set_test<Test> || !workers_.run || workers_.threads < 2;
            return alone ? 1 : 16 * workers_.threads;
        }
    }
    void look_ahead() {
        auto next = waiting_->best(ahead());
        std::erase_if(next, [](item const* i) { return i->load.judged != nullptr; });
        judge(next);
    }
    /// The work counts when their turn comes: see `paving_search`.
    void judge(std::vector<item*> const& items) {
        uncounted const here;
        remember(items);
        std::vector<posed_question<knowledge>> questions;
        for (auto const* i : items) {
            questions.push_back({&i->set, i->load.known ? i->load.known->found() : nullptr});
        }
        if constexpr (delegating_set_test<Test>) {
            auto says = test_->judge_all(questions);
            for (std::size_t k = 0; k < items.size(); ++k) {
                items[k]->load.judged = std::make_shared<answer const>(std::move(says[k]));
            }
        } else {
            in_parallel(items.size(), [&](std::size_t k) {
                work_clock::set(0); // where all digits count, whenever it is done
                work_watch const took;
                auto says = test_->judge(*questions[k].set, questions[k].known);
                says.work = took.spent();
                items[k]->load.judged = std::make_shared<answer const>(std::move(says));
            });
        }
    }

    /// Learns anew what these boxes knew before the search was interrupted.
    void remember(std::vector<item*> const& items) const {
        std::vector<lesson<knowledge>*> missing;
        for (auto const* i : items) {
            if (!i->load.known || !i->load.known->missing()) continue;
            auto* const from = i->load.known->from.get();
            if (std::find(missing.begin(), missing.end(), from) == missing.end()) {
                missing.push_back(from);
            }
        }
        if (missing.empty()) return;
        std::vector<std::vector<box>> boxes;
        for (auto const* from : missing) boxes.push_back(from->boxes);
        auto const found = answers_about(boxes);
        for (std::size_t k = 0; k < missing.size(); ++k) {
            for (auto const& use : missing[k]->uses) {
                auto const part = use.lock();
                if (part) part->found_again(found[k][part->place].knowledge);
            }
        }
    }

    Test* test_;
    waiting_boxes* waiting_;
    executor workers_;
};

} // namespace sivid::paving_detail

#endif
