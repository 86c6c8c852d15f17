// SPDX-License-Identifier: MIT
// What is written; that it comes back is in checkpoint_reader.test.cpp.
#include <sivid/io/checkpoint.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <fstream>
#include <sstream>
#include <string>

using namespace sivid;

namespace {

identification_state some_state() {
    identification_state s;
    s.seconds = 0.5;
    s.problem = "asked";
    auto& search = s.search;
    search.prior = search.whole = search.last_hull = box{interval(0, 1)};
    search.paved = {{box{interval(0, 0.25)}, box_verdict::outside},
                    {box{interval(0.25, 0.5)}, box_verdict::inside}};
    search.lessons = {{box{interval(0.5, 1)}}};
    search.waiting = {{box{interval(0.5, 1)}, 0.5, 0, search_state::origin{0, 0, 8}}};
    search.pushed = 1;
    return s;
}

} // namespace

TEST_CASE("a checkpoint states format, digest and exact numbers, line by line") {
    auto const text = checkpoint_text(some_state(), "a-problem");
    CHECK(text.rfind("sivid-checkpoint-9\nsha256 ", 0) == 0);
    auto const body = text.substr(text.find('\n', text.find('\n') + 1) + 1);
    CHECK(text.find(sha256(body)) != std::string::npos);
    CHECK(body.find("problem a-problem\n") != std::string::npos);
    CHECK(body.find("asked asked\n") != std::string::npos);
    CHECK(body.find("no_guess\n") != std::string::npos);
    CHECK(body.find("paved 2\no ") != std::string::npos);
    CHECK(body.find("\ni " + std::string{to_hex(0.25)} + " " + to_hex(0.5)) != std::string::npos);
    CHECK(body.find("lesson 1\n") != std::string::npos);
    CHECK(body.find("knows 0 0 8 ") != std::string::npos);
    CHECK(body.substr(body.size() - 5) == "\nend\n");
    CHECK(checkpoint_text(some_state(), "a-problem") == text);
    CHECK(checkpoint_text(some_state(), "another") != text);
}

TEST_CASE("a checkpoint replaces the one before and leaves nothing beside it") {
    io_support::temporary_folder const folder;
    auto const file = folder.path() / "search.checkpoint";
    auto state = some_state();
    write_checkpoint(file, state, "p");
    state.seconds = 2;
    write_checkpoint(file, state, "p");
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    CHECK(text.str() == checkpoint_text(state, "p"));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
    CHECK_THROWS_AS(write_checkpoint(folder.path() / "none" / "file", state, "p"), output_error);
}
