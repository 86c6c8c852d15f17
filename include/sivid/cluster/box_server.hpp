// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_BOX_SERVER_HPP
#define SIVID_CLUSTER_BOX_SERVER_HPP

#include <sivid/cluster/wire.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/search/detail/box_batches.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::cluster {

/// Requests about boxes.
enum class box_request : std::uint64_t {
    learn, ///< of boxes together, which become a lesson
    judge  ///< boxes by what was learnt of boxes around them
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

    /// @throws wire_error  for a request that cannot be read
    /// @throws unsound_environment  where this thread rounds otherwise
    [[nodiscard]] std::string operator()(std::string_view request) {
        require_sound_environment();
        wire_reader in(request);
        forget(in);
        auto const what =
            static_cast<box_request>(in.below(static_cast<std::uint64_t>(box_request::judge) + 1));
        return what == box_request::learn ? learn(in) : judge(in);
    }

    /// Lessons of which something is kept.
    [[nodiscard]] std::size_t lessons() const { return lessons_.size(); }

private:
    struct lesson {
        std::vector<std::shared_ptr<knowledge const>> found;
        std::size_t kept = 0; ///< of them
    };

    void forget(wire_reader& in) {
        for (auto n = in.count(16); n > 0; --n) {
            auto const which = lessons_.find(in.number());
            auto const place = in.number();
            if (which == lessons_.end()) continue;
            auto& l = which->second;
            wire_reader::require(place < l.found.size(), "knowledge of nowhere");
            if (!l.found[place]) continue;
            l.found[place] = nullptr;
            if (--l.kept == 0) lessons_.erase(which);
        }
    }
    [[nodiscard]] std::vector<box> boxes(wire_reader& in) const {
        std::vector<box> list(in.count(8));
        for (auto& x : list) {
            x = in.sides(prior_.size());
            wire_reader::require(subset(x, prior_), "a box outside the prior");
        }
        return list;
    }
    [[nodiscard]] std::vector<assessment<knowledge>> learnt(std::uint64_t number,
                                                            std::vector<box> const& about) {
        auto says = test_->learn(about);
        lesson l;
        for (auto const& a : says) {
            l.found.push_back(a.knowledge);
            l.kept += a.knowledge ? 1 : 0;
        }
        if (l.kept > 0) lessons_[number] = std::move(l);
        return says;
    }

    [[nodiscard]] std::string learn(wire_reader& in) {
        auto const number = in.number();
        auto const about = boxes(in);
        in.finish();
        wire_writer out;
        for (auto const& a : learnt(number, about)) {
            out.put(a).put(a.knowledge != nullptr);
            out.put(std::uint64_t{
                a.knowledge ? paving_detail::bytes_of(*test_, prior_, *a.knowledge) : 0});
        }
        return out.take();
    }
    [[nodiscard]] std::string judge(wire_reader& in) {
        wire_writer out;
        for (auto lists = in.count(8); lists > 0; --lists) { // lessons that are to be had here, too
            auto const number = in.number();
            auto const about = boxes(in);
            static_cast<void>(learnt(number, about));
        }
        auto const count = in.count(24);
        stopwatch const clock;
        for (auto n = count; n > 0; --n) {
            auto const which = lessons_.find(in.number());
            auto const place = in.number();
            auto const x = in.sides(prior_.size());
            wire_reader::require(which != lessons_.end() && place < which->second.found.size() &&
                                     which->second.found[place],
                                 "knowledge that nobody has learnt here");
            auto const a = test_->judge(x, which->second.found[place]);
            out.put(a).put(a.knowledge != nullptr);
        }
        in.finish();
        return wire_writer().put(clock.spent()).take() + out.take();
    }

    Test* test_;
    box prior_;
    std::map<std::uint64_t, lesson> lessons_;
};

} // namespace sivid::cluster

#endif
