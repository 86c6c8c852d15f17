// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/number_text.hpp>

#include <cstdint>
#include <string>

using namespace sivid::report;

TEST_CASE("escape: markup becomes entities, text stays") {
    CHECK(escape("a<b> & \"c\" 'd'") == "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
    CHECK(escape("m\xC2\xB2 \xCF\x88 \xF0\x9F\x9A\x80") == "m\xC2\xB2 \xCF\x88 \xF0\x9F\x9A\x80");
}

TEST_CASE("escape: what is no text becomes the replacement character") {
    std::string const r = "\xEF\xBF\xBD";
    CHECK(escape(std::string("\0\x01\x1B", 3)) == r + r + r);
    CHECK(escape("\xFF") == r);
    CHECK(escape("\xC0\xAF") == r + r);         // overlong
    CHECK(escape("\xED\xA0\x80") == r + r + r); // surrogate
    CHECK(escape("\xE2\x80\xAE") == r + r + r); // right-to-left override
    CHECK(escape("\xE2\x82") == r + r);         // cut
}

TEST_CASE("escape: any bytes give well-formed content") {
    std::uint32_t seed = 1;
    for (int round = 0; round < 300; ++round) {
        std::string bytes;
        for (int i = 0; i < 40; ++i) {
            seed = seed * 1664525u + 1013904223u;
            bytes += static_cast<char>(seed >> 24);
        }
        std::string const safe = escape(bytes);
        REQUIRE(sivid_tests::markup_error("<t class=\"" + safe + "\">" + safe + "</t>") == "");
    }
}

TEST_CASE("escape: the checker of these tests finds faults") {
    CHECK(sivid_tests::markup_error("<a><b></a></b>") != "");
    CHECK(sivid_tests::markup_error("<a x=1></a>") != "");
    CHECK(sivid_tests::markup_error("<a x=\"nan\"/>") != "");
    CHECK(sivid_tests::markup_error("<a>&nbsp;</a>") != "");
    CHECK(sivid_tests::markup_error("<a id=\"q\"/><a id=\"q\"/>") != "");
    CHECK(sivid_tests::markup_error("<a fill=\"url(#q)\"/>") != "");
    CHECK(sivid_tests::markup_error("<a x=\"1\"><b/>t</a>") == "");
}

TEST_CASE("escape: shorten counts characters, not bytes") {
    CHECK(shorten("abcdef", 6) == "abcdef");
    CHECK(shorten("abcdefg", 4) == "abc\xE2\x80\xA6");
    CHECK(shorten("\xCF\x88\xCF\x88\xCF\x88", 2) == "\xCF\x88\xE2\x80\xA6");
    CHECK(approximate_text_width("WW", 10) > approximate_text_width("ii", 10));
}
