// SPDX-License-Identifier: MIT
// Messages: what was changed, cut, or is of another version is refused.
#include <sivid/cluster/frame.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

using namespace sivid::cluster;

TEST_CASE("a message comes back, and with any byte changed it is refused") {
    support::draws d(7201);
    for (std::size_t const size : {std::size_t{0}, std::size_t{1}, std::size_t{333}}) {
        frame f{frame::kind::answer, 77, {}};
        for (std::size_t k = 0; k < size; ++k) f.body += static_cast<char>(d.below(256));
        auto const bytes = to_bytes(f);
        auto const back = frame_of(bytes);
        CHECK(back.what == f.what);
        CHECK(back.number == f.number);
        CHECK(back.body == f.body);
        std::size_t accepted = 0;
        for (std::size_t k = 0; k < bytes.size(); ++k) {
            auto wrong = bytes;
            wrong[k] = static_cast<char>(wrong[k] ^ static_cast<char>(1 + d.below(255)));
            try {
                (void)frame_of(wrong);
                ++accepted;
            } catch (wire_error const&) {
            }
        }
        CHECK(accepted == 0);
        for (std::size_t k = 0; k < bytes.size(); ++k)
            CHECK_THROWS_AS(frame_of(bytes.substr(0, k)), wire_error);
        CHECK_THROWS_AS(frame_of(bytes + bytes), wire_error);
        CHECK_THROWS_AS(frame_of(bytes + 'x'), wire_error);
    }
}

TEST_CASE("messages of other programs say so") {
    CHECK_THROWS_WITH(frame_of("hello"), ContainsSubstring("another program"));
    auto other = to_bytes({frame::kind::stop, 0, {}});
    other[7] = '2';
    CHECK_THROWS_WITH(frame_of(other), ContainsSubstring("another version"));
    CHECK_THROWS_AS(frame_of(""), wire_error);
}
