// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_DETAIL_LESSON_HPP
#define SIVID_PAVING_SEARCH_DETAIL_LESSON_HPP

#include <sivid/paving/search/search_state.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

template <class Knowledge>
struct lesson;

/// What a test found about one box, shared by all parts of the box that wait.
template <class Knowledge>
class learnt {
public:
    /// @param held  where the bytes are counted as long as this lives
    learnt(std::shared_ptr<Knowledge const> found, std::size_t bytes,
           std::shared_ptr<std::size_t> held)
        : found_(std::move(found)), bytes_(bytes), held_(std::move(held)) {
        *held_ += bytes_;
    }
    learnt(learnt const&) = delete;
    learnt& operator=(learnt const&) = delete;
    ~learnt() { *held_ -= bytes_; }

    [[nodiscard]] std::shared_ptr<Knowledge const> const& found() const { return found_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    /// Whether the knowledge is known to exist but must be learnt anew.
    [[nodiscard]] bool missing() const { return missing_; }

    void found_again(std::shared_ptr<Knowledge const> found) {
        found_ = std::move(found);
        missing_ = false;
    }

    std::shared_ptr<lesson<Knowledge>> from; ///< null when it cannot be learnt anew
    std::size_t place = 0;                   ///< among the boxes of the lesson

private:
    friend struct lesson<Knowledge>;

    std::shared_ptr<Knowledge const> found_;
    std::size_t bytes_;
    std::shared_ptr<std::size_t> held_;
    bool missing_ = false;
};

/// One call of `learn`: its boxes, and what is still in use of what it found.
template <class Knowledge>
struct lesson {
    std::vector<box> boxes;
    std::vector<std::weak_ptr<learnt<Knowledge>>> uses;

    /// Adds knowledge about the box in a place; none given: it is missing.
    [[nodiscard]] static std::shared_ptr<learnt<Knowledge>>
    add(std::shared_ptr<lesson> const& to, std::size_t place,
        std::shared_ptr<Knowledge const> found, std::size_t bytes,
        std::shared_ptr<std::size_t> const& held) {
        auto result = std::make_shared<learnt<Knowledge>>(std::move(found), bytes, held);
        result->missing_ = result->found_ == nullptr;
        result->from = to;
        result->place = place;
        to->uses.push_back(result);
        return result;
    }
};

/// Numbers the lessons that waiting boxes refer to, for a search's state.
template <class Knowledge>
class lesson_list {
public:
    [[nodiscard]] std::optional<search_state::origin>
    origin_of(std::shared_ptr<learnt<Knowledge>> const& known) {
        if (!known || !known->from) return std::nullopt;
        auto const [place, fresh] = numbers_.try_emplace(known->from.get(), lessons_.size());
        if (fresh) lessons_.push_back(known->from->boxes);
        return search_state::origin{place->second, known->place, known->bytes()};
    }
    [[nodiscard]] std::vector<std::vector<box>> take() && { return std::move(lessons_); }

private:
    std::map<lesson<Knowledge> const*, std::size_t> numbers_;
    std::vector<std::vector<box>> lessons_;
};

/// The reverse: knowledge that is missing for the time being, shared as it was.
template <class Knowledge>
class lesson_restorer {
public:
    lesson_restorer(search_state const& state, std::shared_ptr<std::size_t> held)
        : held_(std::move(held)) {
        for (auto const& boxes : state.lessons) {
            lessons_.push_back(std::make_shared<lesson<Knowledge>>());
            lessons_.back()->boxes = boxes;
        }
    }
    [[nodiscard]] std::shared_ptr<learnt<Knowledge>>
    operator()(std::optional<search_state::origin> const& known) {
        if (!known) return nullptr;
        auto& shared = found_[{known->lesson, known->place}];
        if (!shared) {
            shared = lesson<Knowledge>::add(lessons_[known->lesson], known->place, nullptr,
                                            known->bytes, held_);
        }
        return shared;
    }

private:
    std::shared_ptr<std::size_t> held_;
    std::vector<std::shared_ptr<lesson<Knowledge>>> lessons_;
    std::map<std::pair<std::size_t, std::size_t>, std::shared_ptr<learnt<Knowledge>>> found_;
};

} // namespace sivid::paving_detail

#endif
