// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_BOX_SERVER_HPP
#define SIVID_CLUSTER_BOX_SERVER_HPP

#include <sivid/cluster/packing.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/search/detail/box_batches.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::cluster {

/// Boxes that are learnt of together, by the number of the lesson.
struct box_lesson {
    std::uint64_t number = 0;
    std::vector<box> boxes;

    template <class Archive>
    void serialize(Archive& a, unsigned) {
        a& number& boxes;
    }
};

/// A box, to be judged by what was learnt at a place of a lesson around it.
struct box_question {
    std::uint64_t lesson = 0, place = 0;
    box about;

    template <class Archive>
    void serialize(Archive& a, unsigned) {
        a& lesson& place& about;
    }
};

/// What is asked of a box_server, in this order.
struct box_request {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> forgotten; ///< lessons and places
    std::vector<box_lesson> lessons;
    bool tell = false; ///< what is learnt; else the boxes are judged
    std::vector<box_question> questions;

    template <class Archive>
    void serialize(Archive& a, unsigned) {
        a& forgotten& lessons& tell& questions;
    }
};

/// Answers about boxes by a test, and keeps what it learns: knowledge (megabytes) never travels.
/// The coordinator names lessons by numbers, and sends their boxes along where a worker does not
/// have them: learning from the same boxes gives the same, bit for bit.
template <batch_set_test Test>
class box_server {
    using knowledge = typename Test::knowledge;

public:
    /// @param prior  whose dimension all boxes have
    box_server(Test& test, box prior) : test_(&test), prior_(std::move(prior)) {}

    /// @returns  packed: if it is to tell what is learnt, for each box the assessment, whether
    /// there
    ///           is knowledge, and its bytes; else the seconds that judging took, and for each
    ///           question the assessment and whether there is knowledge
    /// @throws std::invalid_argument  for a request that no coordinator makes
    /// @throws unsound_environment  where this thread rounds otherwise
    [[nodiscard]] std::string operator()(std::string_view bytes) {
        require_sound_environment();
        auto const request = unpacker(bytes).take<box_request>();
        for (auto const& [number, place] : request.forgotten) forget(number, place);
        packer out;
        for (auto const& l : request.lessons) {
            for (auto const& a : learnt(l)) {
                if (!request.tell) continue;
                std::uint64_t const size =
                    a.knowledge ? paving_detail::bytes_of(*test_, prior_, *a.knowledge) : 0;
                out.put(a).put(a.knowledge != nullptr).put(size);
            }
        }
        if (request.tell) return out.take();
        stopwatch const clock;
        std::vector<assessment<knowledge>> judged;
        for (auto const& q : request.questions) {
            work_watch const took;
            judged.push_back(judge(q));
            judged.back().work = took.spent();
        }
        out.put(clock.spent());
        for (auto const& a : judged) out.put(a).put(a.knowledge != nullptr);
        return out.take();
    }

    /// Lessons of which something is kept.
    [[nodiscard]] std::size_t lessons() const { return lessons_.size(); }

private:
    struct lesson {
        std::vector<std::shared_ptr<knowledge const>> found;
        std::size_t kept = 0; ///< of them
    };

    static void require(bool holds, char const* what) {
        if (!holds) throw std::invalid_argument(std::string{"a request for boxes: "} + what);
    }
    void forget(std::uint64_t number, std::uint64_t place) {
        auto const which = lessons_.find(number);
        if (which == lessons_.end()) return;
        auto& l = which->second;
        require(place < l.found.size(), "knowledge of nowhere");
        if (!l.found[place]) return;
        l.found[place] = nullptr;
        if (--l.kept == 0) lessons_.erase(which);
    }
    [[nodiscard]] std::vector<assessment<knowledge>> learnt(box_lesson const& from) {
        for (auto const& x : from.boxes)
            require(x.size() == prior_.size() && !is_empty(x) && subset(x, prior_),
                    "a box outside the prior");
        work_watch const took;
        auto says = test_->learn(from.boxes);
        if (!says.empty()) says.front().work = took.spent(); // of all
        lesson l;
        for (auto const& a : says) {
            l.found.push_back(a.knowledge);
            l.kept += a.knowledge ? 1 : 0;
        }
        if (l.kept > 0) lessons_[from.number] = std::move(l);
        return says;
    }
    [[nodiscard]] assessment<knowledge> judge(box_question const& q) {
        require(q.about.size() == prior_.size() && !is_empty(q.about),
                "a box of another dimension");
        auto const which = lessons_.find(q.lesson);
        require(which != lessons_.end() && q.place < which->second.found.size() &&
                    which->second.found[q.place],
                "knowledge that nobody has learnt here");
        return test_->judge(q.about, which->second.found[q.place]);
    }

    Test* test_;
    box prior_;
    std::map<std::uint64_t, lesson> lessons_;
};

} // namespace sivid::cluster

#endif
