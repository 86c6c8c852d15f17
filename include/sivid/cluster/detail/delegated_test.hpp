// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_DETAIL_DELEGATED_TEST_HPP
#define SIVID_CLUSTER_DETAIL_DELEGATED_TEST_HPP

#include <sivid/cluster/box_server.hpp>
#include <sivid/cluster/packing.hpp>
#include <sivid/cluster/worker_pool.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid::cluster {

/// A test whose questions a pool of workers answers (`box_server`): a search with it finds what it
/// finds with the test itself, bit for bit, whoever answers what. Knowledge stays with the worker
/// that learnt it; here are its number and size.
///   A box is judged by a worker that has the lesson of the boxes around it. Where one worker would
/// have to judge much more than others, another learns the lesson, too, once as much time was
/// lost as that takes.
template <batch_set_test Test>
class delegated_test {
    struct lesson {
        std::vector<box> boxes;
        std::vector<char> had;  ///< by worker
        std::vector<char> used; ///< by box: whether somebody still refers to what was learnt of it
        double seconds = 0;     ///< that learning it took
        double lost = 0;        ///< seconds for which those who have it were waited for
    };
    struct registry {
        std::map<std::uint64_t, lesson> lessons;
        /// By worker: what it need not keep any longer.
        std::vector<std::vector<std::pair<std::uint64_t, std::uint64_t>>> forgotten;

        void clear(typename std::map<std::uint64_t, lesson>::iterator l) {
            auto const& used = l->second.used;
            if (std::find(used.begin(), used.end(), 1) == used.end()) lessons.erase(l);
        }
    };

public:
    class knowledge {
    public:
        knowledge(std::shared_ptr<registry> in, std::uint64_t of, std::size_t at, std::size_t size)
            : number(of), place(at), bytes(size), in_(std::move(in)) {
            in_->lessons.at(number).used[place] = 1;
        }
        knowledge(knowledge const&) = delete;
        knowledge& operator=(knowledge const&) = delete;
        ~knowledge() {
            auto const l = in_->lessons.find(number);
            for (std::size_t m = 0; m < l->second.had.size(); ++m) {
                if (l->second.had[m] != 0) in_->forgotten[m].emplace_back(number, place);
            }
            l->second.used[place] = 0;
            in_->clear(l);
        }

        std::uint64_t const number; ///< of the lesson
        std::size_t const place;
        std::size_t const bytes; ///< with its frame

    private:
        std::shared_ptr<registry> in_;
    };
    using answer = assessment<knowledge>;

    /// @param own  the test that all workers have, here; is referred to, as is the pool
    delegated_test(worker_pool& helpers, Test& own) : pool_(&helpers), own_(&own) {
        all_->forgotten.resize(helpers.size());
    }

    [[nodiscard]] std::size_t at_once() const { return own_->at_once(); }
    [[nodiscard]] std::size_t hands() const { return pool_->size(); }
    /// What `paving_detail::bytes_of` adds to it is subtracted: budgets count what one machine
    /// would hold.
    [[nodiscard]] std::size_t bytes(knowledge const& known) const {
        return known.bytes - frame_bytes_;
    }
    [[nodiscard]] bool cancelled() const {
        if constexpr (interruptible_set_test<Test>) {
            return cut_short_ || own_->cancelled();
        } else {
            return cut_short_;
        }
    }

    [[nodiscard]] answer judge(box const& x, std::shared_ptr<knowledge const> const& known) {
        std::vector<posed_question<knowledge>> const one{{&x, known}};
        return std::move(judge_all(one)[0]);
    }
    [[nodiscard]] std::vector<answer> learn(std::vector<box> const& boxes) {
        std::vector<std::vector<box>> const one(1, boxes);
        return std::move(learn_all(one)[0]);
    }

    [[nodiscard]] std::vector<std::vector<answer>>
    learn_all(std::vector<std::vector<box>> const& sets) {
        std::vector<worker_pool::task> tasks;
        auto const first = next_;
        next_ += sets.size();
        for (std::size_t k = 0; k < sets.size(); ++k) {
            tasks.push_back({[this, &sets, k, first](std::size_t worker) {
                return packed(box_request{forgotten_by(worker), {{first + k, sets[k]}}, true, {}});
            }});
        }
        auto const said = asked(tasks);
        std::vector<std::vector<answer>> result(sets.size());
        for (std::size_t k = 0; k < sets.size(); ++k) {
            if (said[k]) {
                result[k] = read_lesson(*said[k], first + k, sets[k]);
            } else { // nobody wants it any more; nothing is said of these boxes
                for (auto const& x : sets[k]) result[k].push_back(nothing_about(x));
            }
        }
        return result;
    }

    [[nodiscard]] std::vector<answer>
    judge_all(std::vector<posed_question<knowledge>> const& questions) {
        std::vector<answer> result;
        for (auto const& q : questions) result.push_back(nothing_about(*q.set));
        std::vector<share> shares(pool_->size());
        deal(questions, shares);
        std::vector<worker_pool::task> tasks;
        std::vector<share const*> whose;
        for (std::size_t m = 0; m < shares.size(); ++m) {
            if (shares[m].questions.empty()) continue;
            whose.push_back(&shares[m]);
            tasks.push_back({[this, &questions, &of = shares[m]](std::size_t worker) {
                                 return request(questions, of, worker);
                             },
                             m});
        }
        auto const said = asked(tasks);
        for (std::size_t k = 0; k < tasks.size(); ++k) {
            if (!said[k]) continue;
            unpacker in(said[k]->body);
            auto const& mine = whose[k]->questions;
            double const took = in.take<double>() / static_cast<double>(mine.size());
            judging_ = judging_ > 0 ? 0.9 * judging_ + 0.1 * took : took;
            for (auto const q : mine) {
                result[q] = answer_about(*questions[q].set, in);
                if (in.take<bool>()) result[q].knowledge = questions[q].known;
            }
            for (auto const number : whose[k]->lessons) forget_rest(number, said[k]->worker);
        }
        return result;
    }

private:
    struct share { ///< of a worker
        std::vector<std::size_t> questions;
        std::vector<std::uint64_t> lessons; ///< to be learnt first
    };

    [[nodiscard]] static answer nothing_about(box const& x) {
        answer a{.rest = x};
        a.blind = true;
        return a;
    }
    [[nodiscard]] worker_pool::answers asked(std::vector<worker_pool::task> const& tasks) {
        auto said = pool_->ask(tasks, [this] { return !cancelled(); });
        for (auto const& s : said) cut_short_ = cut_short_ || !s || s->cut_short;
        return said;
    }
    /// Of a lesson that was learnt again only what is still in use is to be kept.
    void forget_rest(std::uint64_t number, std::size_t worker) {
        auto const& used = all_->lessons.at(number).used;
        for (std::size_t place = 0; place < used.size(); ++place) {
            if (used[place] == 0) all_->forgotten[worker].emplace_back(number, place);
        }
    }
    [[nodiscard]] std::vector<std::pair<std::uint64_t, std::uint64_t>>
    forgotten_by(std::size_t worker) {
        return std::exchange(all_->forgotten[worker], {});
    }
    [[nodiscard]] static answer answer_about(box const& x, unpacker& in) {
        auto a = in.take<answer>();
        if (a.rest.size() != x.size() || !(is_empty(a.rest) || subset(a.rest, x)))
            throw std::runtime_error("an answer about a box: what is left of it is no part of it");
        return a;
    }

    [[nodiscard]] std::vector<answer> read_lesson(worker_pool::answer const& said,
                                                  std::uint64_t number,
                                                  std::vector<box> const& about) {
        unpacker in(said.body);
        std::vector<answer> result;
        auto& l = all_->lessons[number];
        l.boxes = about;
        l.had.assign(pool_->size(), 0);
        l.had[said.worker] = 1;
        l.seconds = said.seconds;
        l.used.assign(about.size(), 0);
        for (auto const& x : about) {
            result.push_back(answer_about(x, in));
            work_clock::advance(result.back().work);
            bool const any = in.take<bool>();
            auto const bytes = static_cast<std::size_t>(in.take<std::uint64_t>());
            frame_bytes_of(x);
            if (any)
                result.back().knowledge =
                    std::make_shared<knowledge const>(all_, number, result.size() - 1, bytes);
        }
        all_->clear(all_->lessons.find(number));
        return result;
    }
    /// What `paving_detail::bytes_of` counts beside the test's own bytes.
    void frame_bytes_of(box const& x) {
        frame_bytes_ =
            sizeof(paving_detail::learnt<knowledge>) + sizeof(box) + x.size() * sizeof(interval);
    }

    /// Says who judges what. Boxes that nothing is known of are blind: nobody is asked.
    void deal(std::vector<posed_question<knowledge>> const& questions, std::vector<share>& shares) {
        std::vector<double> load(shares.size(), 0.0);
        double const each = judging_ > 0 ? judging_ : 1e-4;
        auto const least = [&load](auto const& may) {
            std::optional<std::size_t> best;
            for (std::size_t m = 0; m < load.size(); ++m) {
                if (may(m) && (!best || load[m] < load[*best])) best = m;
            }
            return best;
        };
        for (std::size_t q = 0; q < questions.size(); ++q) {
            if (!questions[q].known) continue;
            auto& l = all_->lessons.at(questions[q].known->number);
            auto who = *least([&l](std::size_t m) { return l.had[m] != 0; });
            auto const idle = least([this](std::size_t m) { return pool_->is_present(m); });
            if (idle && load[*idle] < load[who]) {
                l.lost += std::min(each, load[who] - load[*idle]);
                if (l.lost > l.seconds && l.had[*idle] == 0) {
                    who = *idle;
                    l.had[who] = 1;
                    l.lost = 0;
                    shares[who].lessons.push_back(questions[q].known->number);
                    load[who] += l.seconds;
                }
            }
            shares[who].questions.push_back(q);
            load[who] += each;
        }
    }
    [[nodiscard]] std::string request(std::vector<posed_question<knowledge>> const& questions,
                                      share const& of, std::size_t worker) {
        box_request r{forgotten_by(worker), {}, false, {}};
        for (auto const l : of.lessons) r.lessons.push_back({l, all_->lessons.at(l).boxes});
        for (auto const q : of.questions) {
            auto const& known = *questions[q].known;
            r.questions.push_back({known.number, known.place, *questions[q].set});
        }
        return packed(r);
    }

    worker_pool* pool_;
    Test* own_;
    std::shared_ptr<registry> all_ = std::make_shared<registry>();
    std::uint64_t next_ = 1; ///< lesson
    std::size_t frame_bytes_ = 0;
    double judging_ = 0; ///< seconds that a judgement takes
    bool cut_short_ = false;
};

} // namespace sivid::cluster

#endif
