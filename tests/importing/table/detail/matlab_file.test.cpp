// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/matlab_file.hpp>

#include "io/import_support.hpp"
#include "io/matlab_support.hpp"

#include <limits>
#include <random>

using namespace sivid;
using io_support::dec;
using io_support::matlab_writer;

namespace {

matlab_variable const* find(matlab_file const& file, std::string const& name) {
    for (auto const& v : file.variables())
        if (v.name == name) return &v;
    return nullptr;
}
std::string refused(std::string const& text, inflate_function const& inflate = {}) {
    try {
        matlab_file const file{"a.mat", text, inflate};
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "no error";
}
std::string sample(bool little) {
    matlab_writer const w{little};
    return w.file(
        w.doubles("t", 3, 1, {0, 0.1, 0.25}) +
        w.matrix(6, "X", 2, 2, w.element(2, std::string{"\x01\x02\x03\xFF"})) + // stored as uint8
        w.matrix(7, "f", 1, 1, w.element(7, w.numbers<float>({0.1F}))) +
        w.matrix(14, "n", 2, 1, w.element(12, w.numbers<std::int64_t>({9007199254740993, -5}))) +
        w.matrix(4, "word", 1, 2, w.element(16, "ab")) +
        w.structure("log", {{"time", w.doubles("", 1, 2, {1, 2})},
                            {"none", w.element(14, "")},
                            {"deep", w.structure("", {{"u", w.doubles("", 1, 1, {7})}})}}) +
        w.element(99, "unknown element"));
}

} // namespace

TEST_CASE("variables of both byte orders, exactly") {
    for (bool const little : {true, false}) {
        CAPTURE(little);
        matlab_file const file{"a.mat", sample(little), {}};
        auto const* t = find(file, "t");
        REQUIRE(t);
        CHECK(t->about == "double 3x1");
        CHECK(*t->at(1, 0) == exact_decimal::of(0.1)); // all digits of the double
        CHECK_FALSE(*t->at(1, 0) == dec("0.1"));
        auto const* x = find(file, "X");
        REQUIRE(x);
        CHECK(*x->at(1, 1) == dec("255"));
        CHECK(*x->at(0, 1) == dec("3"));
        CHECK(*find(file, "f")->at(0, 0) == exact_decimal::of(static_cast<double>(0.1F)));
        CHECK(*t->meant_at(1, 0) == dec("0.1"));
        CHECK(*find(file, "f")->meant_at(0, 0) == dec("0.1"));
        CHECK(find(file, "f")->single);
        CHECK(*find(file, "n")->at(0, 0) == dec("9007199254740993"));
        CHECK(*find(file, "n")->meant_at(0, 0) == dec("9007199254740993"));
        CHECK(*find(file, "n")->at(1, 0) == dec("-5"));
        CHECK_FALSE(find(file, "word")->numeric);
        CHECK(find(file, "log.time")->columns == 2);
        CHECK(*find(file, "log.deep.u")->at(0, 0) == dec("7"));
        CHECK(find(file, "log.none") == nullptr);
    }
}

TEST_CASE("NaN is no reading, infinite numbers are told") {
    matlab_writer const w;
    matlab_file const file{"a.mat",
                           w.file(w.doubles("x", 2, 1,
                                            {std::numeric_limits<double>::quiet_NaN(),
                                             -std::numeric_limits<double>::infinity()})),
                           {}};
    CHECK_FALSE(file.variables()[0].at(0, 0));
    CHECK_THROWS_AS(file.variables()[0].at(1, 0), std::range_error);
}

TEST_CASE(
    "what cannot be read is listed: complex, sparse, of three dimensions, lists of structures") {
    matlab_writer const w;
    auto const real = w.element(9, w.numbers<double>({1}));
    auto const dims3 = w.element(14, w.element(6, w.number(6U) + w.number(0U)) +
                                         w.element(5, w.number(1) + w.number(1) + w.number(1)) +
                                         w.element(1, "cube") + real);
    matlab_file const file{"a.mat",
                           w.file(w.matrix(6 | 0x0800, "z", 1, 1, real + real) +
                                  w.matrix(5, "s", 1, 1, "") + dims3 +
                                  w.matrix(2, "list", 2, 1, "")),
                           {}};
    REQUIRE(file.variables().size() == 4);
    for (auto const& v : file.variables()) CHECK_FALSE(v.numeric);
    CHECK(file.variables()[0].about == "complex double 1x1");
    CHECK(file.variables()[2].about == "double 1x1x1");
}

TEST_CASE("objects are listed, and leave the variables beside them readable") {
    for (bool const little : {true, false}) {
        matlab_writer const w{little};
        matlab_file const file{"a.mat",
                               w.file(w.object("T", "table") + w.doubles("y", 2, 1, {1, 2}) +
                                      w.structure("log", {{"d", w.object("", "datetime")},
                                                          {"u", w.doubles("", 1, 1, {7})}}) +
                                      w.matrix(9, "", 1, 3, w.element(2, "abc"))), // their store
                               {}};
        REQUIRE(file.variables().size() == 4);
        CHECK(find(file, "T")->about == "an object of class 'table'");
        CHECK(find(file, "T")->object);
        CHECK_FALSE(find(file, "T")->numeric);
        CHECK(find(file, "log.d")->about == "an object of class 'datetime'");
        CHECK(*find(file, "y")->at(1, 0) == dec("2"));
        CHECK(*find(file, "log.u")->at(0, 0) == dec("7"));
    }
}

TEST_CASE("compressed variables are inflated by the program, or refused with a way out") {
    matlab_writer const w;
    auto const inner = w.doubles("t", 2, 1, {1, 2});
    auto const text = w.file(w.element(15, "squeezed", false) + w.doubles("u", 1, 1, {3}));
    CHECK_THAT(refused(text), ContainsSubstring("compressed") && ContainsSubstring("save -v6"));
    matlab_file const file{"a.mat", text, [&](std::string_view packed, std::size_t most) {
                               CHECK(packed == "squeezed");
                               CHECK(most > 1'000'000);
                               return std::optional{inner};
                           }};
    REQUIRE(file.variables().size() == 2);
    CHECK(*find(file, "t")->at(1, 0) == dec("2"));
    CHECK(*find(file, "u")->at(0, 0) == dec("3"));
    CHECK_THAT(refused(text, [](auto, auto) { return std::nullopt; }),
               ContainsSubstring("a compressed variable is damaged"));
}

TEST_CASE("other formats are refused by name") {
    std::string hdf = "MATLAB 7.3 MAT-file, Platform: GLNXA64";
    hdf.resize(512, ' ');
    CHECK_THAT(refused(hdf + "\x89HDF\r\n\x1a\n"),
               ContainsSubstring("version 7.3 (HDF5)") && ContainsSubstring("save -v6"));
    CHECK_THAT(refused("\x89HDF\r\n\x1a\n"), ContainsSubstring("HDF5"));
    CHECK_THAT(refused(""), ContainsSubstring("no MATLAB file of level 5"));
    CHECK_THAT(refused(std::string(300, '\0')), ContainsSubstring("no MATLAB file of level 5"));
    auto other = sample(true);
    other[125] = 2;
    CHECK_THAT(refused(other), ContainsSubstring("another version"));
}

TEST_CASE("damaged MATLAB files are refused or read, never anything else") {
    std::mt19937_64 random{7};
    int read = 0, bad = 0;
    for (int i = 0; i < 4000; ++i) {
        auto text = sample(random() % 2 == 0);
        for (auto times = 1 + random() % 4; times > 0; --times) {
            auto const at = 126 + random() % (text.size() - 126);
            switch (random() % 4) {
            case 0:
                text[at] = static_cast<char>(random());
                break;
            case 1:
                text[at] = static_cast<char>(random() % 2 == 0 ? 0xFF : 0x7F);
                break;
            case 2:
                if (random() % 4 == 0) text.resize(std::max<std::size_t>(at, 130));
                break;
            default:
                text.insert(at, std::string(random() % 9, static_cast<char>(random() % 16)));
            }
        }
        try {
            matlab_file const file{"a.mat", text, [&](std::string_view packed, std::size_t) {
                                       return random() % 2 == 0 ? std::optional{std::string{packed}}
                                                                : std::nullopt;
                                   }};
            ++read;
            for (auto const& v : file.variables()) {
                if (!v.numeric) continue;
                for (std::size_t k = 0; k < v.rows * v.columns; ++k) {
                    try {
                        (void)v.at(k % v.rows, k / v.rows);
                    } catch (std::range_error const&) {
                    }
                }
            }
        } catch (input_error const& e) {
            ++bad;
            REQUIRE(unprintable_in(e.what()).empty());
        }
    }
    CHECK(read > 200);
    CHECK(bad > 200);
}
