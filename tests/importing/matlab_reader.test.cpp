// SPDX-License-Identifier: MIT
#include <sivid/importing/matlab_reader.hpp>

#include "io/import_support.hpp"
#include "io/matlab_support.hpp"

#include <limits>
#include <random>

#include <zlib.h>

using namespace sivid;
using io_support::dec;
using io_support::matlab_writer;
using io_support::temporary_folder;

namespace {

matlab_variable const* find(matlab_file const& file, std::string const& name) {
    for (auto const& v : file.variables)
        if (v.name == name) return &v;
    return nullptr;
}
matlab_file read(std::string const& text) {
    temporary_folder const folder;
    folder.write("a.mat", text);
    return read_matlab(folder.path() / "a.mat");
}
std::string refused(std::string const& text) {
    try {
        (void)read(text);
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        REQUIRE(unprintable_in(e.what()).empty());
        return e.what();
    }
    return "no error";
}
std::string packed(std::string const& text) {
    auto size = compressBound(static_cast<uLong>(text.size()));
    std::string result(size, '\0');
    compress(reinterpret_cast<Bytef*>(result.data()), &size,
             reinterpret_cast<Bytef const*>(text.data()), static_cast<uLong>(text.size()));
    result.resize(size);
    return result;
}
/// All numbers, as text.
std::string content(matlab_file const& file) {
    std::string text;
    for (auto const& v : file.variables) {
        text += v.name + " " + v.about;
        if (!v.numeric()) continue;
        for (std::size_t k = 0; k < v.rows * v.columns; ++k)
            if (auto const x = v.at(k % v.rows, k / v.rows)) text += " " + x->text();
    }
    return text;
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

/// t and n, two columns, in a file of version 7.3.
std::string sample_73() {
    temporary_folder const folder;
    auto const name = (folder.path() / "a.mat").string();
    std::vector<double> t{0, 0.1, 0.25};
    std::vector<std::int64_t> n{9007199254740993, -5};
    auto* const mat = Mat_CreateVer(name.c_str(), nullptr, MAT_FT_MAT73);
    REQUIRE(mat != nullptr);
    auto const write = [&](char const* of, matio_classes c, matio_types type, std::size_t rows,
                           void* data) {
        std::size_t dims[] = {rows, 1};
        auto* const v = Mat_VarCreate(of, c, type, 2, dims, data, 0);
        Mat_VarWrite(mat, v, MAT_COMPRESSION_NONE);
        Mat_VarFree(v);
    };
    write("t", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, t.data());
    write("n", MAT_C_INT64, MAT_T_INT64, 2, n.data());
    Mat_Close(mat);
    return folder.read("a.mat");
}

} // namespace

TEST_CASE("variables of both byte orders, exactly") {
    for (bool const little : {true, false}) {
        CAPTURE(little);
        auto const file = read(sample(little));
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
        CHECK(find(file, "f")->single());
        CHECK(*find(file, "n")->at(0, 0) == dec("9007199254740993"));
        CHECK(*find(file, "n")->meant_at(0, 0) == dec("9007199254740993"));
        CHECK(*find(file, "n")->at(1, 0) == dec("-5"));
        CHECK_FALSE(find(file, "word")->numeric());
        CHECK(find(file, "log.time")->columns == 2);
        CHECK(*find(file, "log.deep.u")->at(0, 0) == dec("7"));
        CHECK(find(file, "log.none") == nullptr);
    }
}

TEST_CASE("NaN is no reading, infinite numbers are told") {
    matlab_writer const w;
    auto const file = read(w.file(w.doubles(
        "x", 2, 1,
        {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})));
    CHECK_FALSE(file.variables[0].at(0, 0));
    CHECK_THROWS_AS(file.variables[0].at(1, 0), std::range_error);
}

TEST_CASE(
    "what cannot be read is listed: complex, text, of three dimensions, lists of structures") {
    matlab_writer const w;
    auto const real = w.element(9, w.numbers<double>({1}));
    auto const two_of_one_field = w.element(5, w.number(std::int32_t{16})) +
                                  w.element(1, "u" + std::string(15, '\0')) +
                                  w.doubles("", 1, 1, {1}) + w.doubles("", 1, 1, {2});
    auto const eight = w.element(9, w.numbers<double>({1, 2, 3, 4, 5, 6, 7, 8}));
    auto const dims3 = w.element(14, w.element(6, w.number(6U) + w.number(0U)) +
                                         w.element(5, w.number(2) + w.number(2) + w.number(2)) +
                                         w.element(1, "cube") + eight);
    auto const file = read(w.file(w.matrix(6 | 0x0800, "z", 1, 1, real + real) +
                                  w.matrix(4, "word", 1, 2, w.element(16, "ab")) + dims3 +
                                  w.matrix(2, "list", 2, 1, two_of_one_field)));
    REQUIRE(file.variables.size() == 4);
    for (auto const& v : file.variables) CHECK_FALSE(v.numeric());
    CHECK(file.variables[0].about == "complex double 1x1");
    CHECK(file.variables[2].about == "double 2x2x2");
}

TEST_CASE("objects are listed, and leave the variables beside them readable") {
    for (bool const little : {true, false}) {
        matlab_writer const w{little};
        auto const file = read(w.file(
            w.object("T", "table") + w.doubles("y", 2, 1, {1, 2}) +
            w.structure("log", {{"d", w.object("", "datetime")}, {"u", w.doubles("", 1, 1, {7})}}) +
            w.matrix(9, "", 1, 3, w.element(2, "abc")))); // their store
        REQUIRE(file.variables.size() == 4);
        CHECK(file.variables[0].object); // libmatio 1.5 does not know its name
        CHECK_FALSE(file.variables[0].numeric());
        CHECK(find(file, "log.d")->object);
        CHECK(*find(file, "y")->at(1, 0) == dec("2"));
        CHECK(*find(file, "log.u")->at(0, 0) == dec("7"));
    }
}

TEST_CASE("compressed variables are read, and a changed bit in one is seen") {
    matlab_writer const w;
    auto const stream = packed(w.doubles("t", 2, 1, {1, 2}));
    auto const with = [&](std::string const& s) {
        return w.file(w.element(15, s, false) + w.doubles("u", 1, 1, {3}));
    };
    auto const file = read(with(stream));
    REQUIRE(file.variables.size() == 2);
    CHECK(*find(file, "t")->at(1, 0) == dec("2"));
    CHECK(*find(file, "u")->at(0, 0) == dec("3"));
    for (std::size_t at = 0; at < stream.size(); ++at) {
        auto wrong = stream;
        wrong[at] = static_cast<char>(wrong[at] ^ 0x20);
        CAPTURE(at);
        auto const says = refused(with(wrong));
        // bits that say nothing: of zlib's head
        if (says == "no error") CHECK(content(read(with(wrong))) == content(file));
    }
}

TEST_CASE("files of version 7.3 are read") {
    auto const text = sample_73();
    auto const file = read(text);
    REQUIRE(file.variables.size() == 2);
    CHECK(find(file, "t")->about == "double 3x1");
    CHECK(*find(file, "t")->at(2, 0) == dec("0.25"));
    CHECK(*find(file, "t")->at(1, 0) == exact_decimal::of(0.1));
    CHECK(*find(file, "n")->at(0, 0) == dec("9007199254740993"));
    for (std::size_t size = 0; size < text.size(); size += 97) {
        CAPTURE(size);
        CHECK(refused(text.substr(0, size)) != "no error");
    }
}

TEST_CASE("other formats are refused by name") {
    CHECK_THAT(refused("\x89HDF\r\n\x1a\n"), ContainsSubstring("no MATLAB file of level 5"));
    CHECK_THAT(refused(""), ContainsSubstring("no MATLAB file of level 5"));
    CHECK_THAT(refused(std::string(300, '\0')), ContainsSubstring("no MATLAB file of level 5"));
    CHECK_THAT(refused(std::string{"MATLAB 5.0"}), ContainsSubstring("save -v6"));
    auto other = sample(true);
    other[125] = 2;
    CHECK_THAT(refused(other), ContainsSubstring("another version"));
}

TEST_CASE("a file that was cut gives no number that the whole one does not have") {
    for (bool const little : {true, false}) {
        auto const text = sample(little);
        auto const whole = read(text);
        std::size_t bad = 0;
        for (std::size_t size = 0; size < text.size(); ++size) {
            CAPTURE(little, size);
            if (refused(text.substr(0, size)) != "no error") {
                ++bad;
                continue;
            }
            for (auto const& v : read(text.substr(0, size)).variables) // cut between two
                CHECK(content({"", {v}}) == content({"", {*find(whole, v.name)}}));
        }
        CHECK(bad + 20 > text.size());
    }
}

TEST_CASE("damaged MATLAB files are refused or read, never anything else") {
    std::mt19937_64 random{7};
    int good = 0, bad = 0;
    for (int i = 0; i < 1500; ++i) {
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
        if (refused(text) == "no error")
            ++good;
        else
            ++bad;
    }
    CHECK(good > 70);
    CHECK(bad > 200);
}

TEST_CASE("damaged files of version 7.3 end no process") {
    auto const whole = sample_73();
    std::mt19937_64 random{73};
    int bad = 0;
    for (int i = 0; i < 400; ++i) {
        auto text = whole;
        for (auto times = 1 + random() % 6; times > 0; --times)
            text[520 + random() % (text.size() - 520)] = static_cast<char>(random());
        bad += refused(text) != "no error" ? 1 : 0;
    }
    CHECK(bad > 10);
}
