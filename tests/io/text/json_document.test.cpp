// SPDX-License-Identifier: MIT
#include <sivid/io/text/json_document.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

using namespace sivid;

namespace {
json_value parse(std::string const& text) { return parse_json("a.json", text); }
} // namespace

TEST_CASE("numbers keep the text of the file") {
    auto const root = parse(
        R"({"a": 0.1, "b": [0.20, -3, 1E2, 18446744073709551615, 123456789012345678901234567890], "c": -0})");
    CHECK(root.at("a").number() == *exact_decimal::parse("0.1"));
    auto const& b = root.at("b").elements();
    REQUIRE(b.size() == 5);
    CHECK(b[0].number().text() == "0.2");
    CHECK(b[1].number().text() == "-3");
    CHECK(b[2].number().text() == "100");
    CHECK(b[3].number() == *exact_decimal::parse("18446744073709551615"));
    CHECK(b[4].number() == *exact_decimal::parse("123456789012345678901234567890"));
    CHECK(root.at("c").number().is_zero());
    // more digits than a double holds
    auto const fine =
        parse("[0.1000000000000000055511151231257827, 0.1000000000000000055511151231257828]");
    CHECK(fine.elements()[0].number() < fine.elements()[1].number());
}

TEST_CASE("objects keep their order, and texts their content") {
    auto const root = parse("{\"z\": \"\", \"a\": {\"x\": null}, \"m\": true, \"t\": \"\\u00e9\"}");
    REQUIRE(root.members().size() == 4);
    CHECK(root.name_of(0) == "z");
    CHECK(root.name_of(1) == "a");
    CHECK(root.at("z").any_string().empty());
    CHECK(root.at("a").at("x").type() == json_value::kind::null);
    CHECK(root.at("m").type() == json_value::kind::boolean);
    CHECK(root.at("t").string() == "\xC3\xA9");
    CHECK(root.find("absent") == nullptr);
}

TEST_CASE("every defect of a document is one error with its pointer") {
    struct defect {
        std::string text, pointer, message;
    };
    for (auto const& d :
         std::vector<defect>{{"", "", "the file is empty"},
                             {"{\"a\": 1", "", "malformed JSON"},
                             {"{\"a\": 1} x", "", "malformed JSON"},
                             {"{\"a\": [1, }", "/a/1", "malformed JSON"},
                             {"{\n\"a\": \n  nan}", "/a", "line 3, column"},
                             {"[1, 1e999]", "/1", "beyond the range of double"},
                             {"{\"a\": 1, \"a\": 2}", "", "'a' appears twice"},
                             {"{\"o\": {\"a\": 1, \"a\": 2}}", "/o", "'a' appears twice"},
                             {"{\"a\": \"\xff\"}", "/a", "malformed JSON"},
                             {"{\"a\": 01}", "", "malformed JSON"},
                             {"// comment\n{}", "", "malformed JSON"},
                             {"{'a': 1}", "", "malformed JSON"},
                             {std::string(100000, '['), "", "nested too deeply"}}) {
        CAPTURE(d.text.substr(0, 40));
        try {
            (void)parse(d.text);
            FAIL_CHECK("was accepted");
        } catch (input_error const& e) {
            if (d.message != "nested too deeply") CHECK(e.place().pointer == d.pointer);
            CHECK(e.place().file == "a.json");
            CHECK_THAT(e.what(), ContainsSubstring(d.message));
        }
    }
}

TEST_CASE("an object of many keys takes no longer than its length") {
    std::string text = "{";
    for (int i = 0; i < 100'000; ++i) text += "\"key_" + std::to_string(i) + "\": {\"key\": 1}, ";
    auto const root = parse(text + "\"key\": 2}");
    CHECK(root.members().size() == 100'001);
    CHECK(root.name_of(77'777) == "key_77777");
    CHECK_THROWS_AS(parse(text + "\"key_5\": 2}"), input_error);
}

TEST_CASE("a value of another type is an error with its pointer") {
    auto const root =
        parse(R"({"a/b~c": [1, "x"], "o": {"k": 1}, "e": "", "n": "\n", "deep": 1e-400})");
    auto const message = [](auto&& access) {
        try {
            (void)access();
        } catch (input_error const& e) {
            return std::string{e.what()};
        }
        return std::string{};
    };
    CHECK_THAT(message([&] { return root.at("a/b~c").elements()[1].number(); }),
               StartsWith("a.json: /a~1b~0c/1: found a text instead of a number"));
    CHECK_THAT(message([&] { return root.at("a/b~c").string(); }),
               ContainsSubstring("found a list instead of a text"));
    CHECK_THAT(message([&] { return root.at("o").elements(); }),
               ContainsSubstring("found an object instead of a list"));
    CHECK_THAT(message([&] { return root.at("e").members(); }),
               ContainsSubstring("instead of an object"));
    CHECK_THAT(message([&] { return root.at("none"); }),
               StartsWith("a.json: (document): the key 'none' is missing"));
    CHECK_THAT(message([&] { return root.at("e").string(); }),
               ContainsSubstring("the text is empty"));
    CHECK_THAT(message([&] { return root.at("n").string(); }),
               ContainsSubstring("control character"));
    CHECK_THAT(message([&] {
                   root.at("o").allow_only({"x", "y"});
                   return 0;
               }),
               StartsWith("a.json: /o/k: unknown key 'k'; known here: x, y"));
    CHECK_NOTHROW(root.at("o").allow_only({"k"}));
    CHECK(root.at("deep").number().is_positive());
}

TEST_CASE("files with a byte-order mark are read") {
    io_support::temporary_folder const folder;
    folder.write("a.json", "\xEF\xBB\xBF{\r\n\"a\": 1}\r\n");
    CHECK(read_json(folder.path() / "a.json").at("a").number().text() == "1");
    CHECK_THROWS_AS(read_json(folder.path() / "b.json"), input_error);
}
