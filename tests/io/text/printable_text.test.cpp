// SPDX-License-Identifier: MIT
#include <sivid/io/text/printable_text.hpp>

#include "support/catch.hpp"

#include <random>
#include <string>

using sivid::printable_path;
using sivid::printable_text;
using sivid::unprintable_in;

TEST_CASE("what steers a terminal or turns text is replaced and named") {
    struct one {
        std::string text, shown, what;
    };
    for (auto const& c :
         {one{"plain text, 5 °C, Größe, 北", "plain text, 5 °C, Größe, 北", ""},
          one{"a\x1b[31mred", "a?[31mred", "U+001B"}, one{"a\rb\nc\td", "a?b?c?d", "U+000D"},
          one{std::string("nul\0l", 5), "nul?l", "U+0000"}, one{"del\x7f", "del?", "U+007F"},
          one{"csi\xc2\x9b"
              "31m",
              "csi?31m", "U+009B"},
          one{"\xe2\x80\xae"
              "txt.exe",
              "?txt.exe", "U+202E"},
          one{"\xe2\x81\xa6in\xe2\x81\xa9", "?in?", "U+2066"}, one{"\xef\xbb\xbfx", "?x", "U+FEFF"},
          one{"\xe2\x80\xa8x", "?x", "U+2028"}, one{"\xf3\xa0\x81\xa1tag", "?tag", "U+E0061"},
          one{"bad\xff", "bad?", "a byte that is not UTF-8"},
          one{"cut\xe2\x80", "cut??", "a byte that is not UTF-8"},
          one{"long\xc0\x80", "long??", "a byte that is not UTF-8"},
          one{"half\xed\xa0\x80", "half???", "a byte that is not UTF-8"}}) {
        CAPTURE(c.shown);
        CHECK(printable_text(c.text) == c.shown);
        CHECK(unprintable_in(c.text) == c.what);
        CHECK(unprintable_in(printable_text(c.text)).empty());
    }
    CHECK(printable_text("a\nb\r", 100, true) == "a\nb?");
}

TEST_CASE("long texts are cut between characters and paths keep their end") {
    CHECK(printable_text("abcdef", 6) == "abcdef");
    CHECK(printable_text("abcdefg", 6) == "abcdef...");
    CHECK(printable_text("aäöü", 4) == "aä...");
    CHECK(printable_text("", 0).empty());
    CHECK(printable_path("/home/x/result.json") == "/home/x/result.json");
    auto const path = printable_path(std::string(1000, 'd') + "/result.json");
    CHECK(path.size() <= 203);
    CHECK(path.ends_with("d/result.json"));
    CHECK(unprintable_in(printable_path("ö" + std::string(199, 'x') + "\x1b", 200)).empty());
}

TEST_CASE("whatever the bytes, what comes out can be printed and is not longer") {
    std::mt19937_64 random{1};
    for (int k = 0; k < 20000; ++k) {
        std::string text(random() % 30, ' ');
        for (char& c : text) c = static_cast<char>(random() % 3 == 0 ? random() : 0x80 | random());
        auto const shown = printable_text(text);
        CHECK(unprintable_in(shown).empty());
        CHECK(shown.size() <= text.size());
        CHECK(printable_text(text, 10).size() <= 13);
    }
}
