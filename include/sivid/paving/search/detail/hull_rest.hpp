// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_DETAIL_HULL_REST_HPP
#define SIVID_PAVING_SEARCH_DETAIL_HULL_REST_HPP

#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Faces of a box that nothing was found to touch.
class open_faces {
public:
    /// @param share  of a side's width within which a box touches a face
    open_faces(box const& around, double share) {
        for (std::size_t i = 0; i < around.size(); ++i) {
            double const near = share * width(around[i]);
            faces_.push_back({i, true, around[i].lower() + near});
            faces_.push_back({i, false, around[i].upper() - near});
        }
    }
    [[nodiscard]] bool none() const { return faces_.empty(); }
    [[nodiscard]] bool touched_by(box const& x) const {
        return std::any_of(faces_.begin(), faces_.end(),
                           [&x](face const& f) { return f.touched_by(x); });
    }
    void close(box const& x) {
        std::erase_if(faces_, [&x](face const& f) { return f.touched_by(x); });
    }

private:
    struct face {
        std::size_t side;
        bool low;
        double until;
        [[nodiscard]] bool touched_by(box const& x) const {
            return low ? x[side].lower() <= until : x[side].upper() >= until;
        }
    };
    std::vector<face> faces_;
};

/// Notices that the hull of what is left shrinks no more, at two looks one after the other, each of
/// them when the tests have doubled. One is not enough: a slanting sheet must be cut at all its
/// ends before a side of it is shorter: where a box has more than two sides, the second look is
/// due when the tests have doubled twice. And while no test can say anything of boxes as large as
/// they are, nothing shrinks because the search has only begun.
struct hull_rest {
    box last; ///< at the last look
    bool rested = false;
    std::size_t next_look = 8; ///< tests

    /// @param gain  a side that lost no more than this share of its width rests
    /// @param hull  of what is left, called where a look is due
    /// @param ends  whether a hull that rests ends the search
    /// @returns  what `ends` says from the second such look on, also when asked again
    template <class Hull, class Ends>
    [[nodiscard]] bool operator()(std::size_t tests, double gain, Hull const& hull,
                                  Ends const& ends) {
        if (tests < next_look) return false;
        box now = hull();
        bool rests = true;
        for (std::size_t i = 0; i < now.size(); ++i) {
            rests = rests && width(now[i]) >= (1 - gain) * width(last[i]);
        }
        if (rests && rested && ends(now)) return true;
        rested = rests;
        next_look = (rests && now.size() > 2 ? 4 : 2) * tests;
        last = std::move(now);
        return false;
    }
};

} // namespace paving_detail

} // namespace sivid

#endif
