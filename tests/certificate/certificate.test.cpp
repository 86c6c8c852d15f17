// SPDX-License-Identifier: MIT
// Certificates as the program writes them, and what the checker without sivid says of them: of
// honest ones, of forged ones, of damaged ones.
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/sha256.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <vector>

using io_support::temporary_folder;

namespace {

auto const growth_model =
    std::string{SIVID_SOURCE_DIR} + "/examples/first_steps/logistic_growth.toml";
auto const motor_model = std::string{SIVID_SOURCE_DIR} + "/examples/own_robot/motor.toml";

support::finished_program sivid_program(std::vector<std::string> const& arguments) {
    return support::run_program(SIVID_PROGRAM, arguments);
}

/// A campaign, its result and its certificate, in a folder.
struct certified {
    temporary_folder folder;
    std::string data = (folder.path() / "data").string(), out = (folder.path() / "out").string();
    std::string text;
    int code = -1;

    void identify(std::string const& model, std::string const& seconds = "10") {
        (void)sivid_program(
            {"identify", model, data, "--out", out, "--quiet", "--budget", seconds});
        code = sivid_program({"certificate", model, out, "--quiet"}).code;
        text = folder.read("out/certificate.txt");
    }
};

/// A culture with planted constants: consistent.
certified const& growth() {
    static certified const* const made = [] {
        auto* const c = new certified;
        c->folder.write("g.json",
                        R"({ "format": "sivid-scenario-1", "name": "growth", "duration": 6,
                                       "initial": { "x": [0.10, 0.12] }, "inputs": {} })");
        REQUIRE(sivid_program({"generate", growth_model, "--scenario",
                               (c->folder.path() / "g.json").string(), "--absolute", "0.02",
                               "--rate", "1", "--out", c->data})
                    .code == 0);
        c->identify(growth_model);
        return c;
    }();
    return *made;
}
/// The quickstart's motor without friction: inconsistent.
certified const& motor() {
    static certified const* const made = [] {
        auto* const c = new certified;
        auto const mapping = std::string{SIVID_SOURCE_DIR} + "/examples/own_robot/mapping.json";
        REQUIRE(sivid_program({"import", motor_model, mapping, "--out", c->data}).code == 0);
        c->identify(motor_model);
        return c;
    }();
    return *made;
}

/// With an honest digest at its end, whatever it says.
std::string sealed(std::string text) {
    auto const end = text.rfind("\nend\t");
    if (end != std::string::npos) text.resize(end + 1);
    return text + "end\t" + sivid::sha256(text) + "\n";
}
/// What a program says of a text: 0 all is proved, 2 refused, 3 not all is proved.
int verdict_on(std::string const& text, std::string const& program = CHECK_CERTIFICATE,
               std::string const& data = {}) {
    temporary_folder const folder;
    folder.write("c.txt", text);
    std::vector<std::string> arguments{(folder.path() / "c.txt").string()};
    if (!data.empty()) arguments.push_back(data);
    support::child_program const child(program, arguments, folder.path());
    return child.wait_at_most(60);
}
/// The statements: lines and, behind `model` and `file`, their blocks.
std::vector<std::string> statements_of(std::string const& text) {
    std::vector<std::string> all;
    for (std::size_t at = 0; at < text.size();) {
        auto end = text.find('\n', at) + 1;
        auto const line = text.substr(at, end - at);
        if (line.starts_with("model\t") || line.starts_with("file\t"))
            end += std::stoul(line.substr(line.rfind('\t') + 1)) + 1;
        all.push_back(text.substr(at, end - at));
        at = end;
    }
    return all;
}
std::string joined(std::vector<std::string> const& statements) {
    std::string text;
    for (auto const& s : statements) text += s;
    return text;
}
/// One replaced, sealed again.
std::string with(std::string const& text, std::string const& from, std::string const& to) {
    auto changed = text;
    auto const at = changed.find(from);
    REQUIRE(at != std::string::npos);
    return sealed(changed.replace(at, from.size(), to));
}
/// A statement that begins so, replaced.
std::string with_line(std::string const& text, std::string const& begin, std::string const& to) {
    auto const at = text.find("\n" + begin);
    REQUIRE(at != std::string::npos);
    auto const end = text.find('\n', at + 1);
    return sealed(text.substr(0, at + 1) + to + text.substr(end));
}

} // namespace

TEST_CASE("the checker proves what the program certified, compiled by whatever compiler",
          "[certificate]") {
    CHECK(growth().code == 0);
    CHECK(motor().code == 0);
    std::istringstream programs{OTHER_CHECKERS};
    std::vector<std::string> all{CHECK_CERTIFICATE, SANITIZED_CHECKER};
    for (std::string one; std::getline(programs, one, ':');) all.push_back(one);
    for (auto const& program : all) {
        INFO(program);
        CHECK(verdict_on(growth().text, program, growth().data) == 0);
        CHECK(verdict_on(motor().text, program, motor().data) == 0);
    }
    auto const said =
        support::run_program(CHECK_CERTIFICATE, {growth().out + "/certificate.txt", growth().data});
    for (auto const* words :
         {"rate x = %4", "assume each measurement lies within its error bound",
          "PROVED: the witness explains the measurements",
          "PROVED: no parameter of the prior beyond the hull explains them",
          "unproved the hull of the result itself", "PROVED: all that is claimed"})
        CHECK_THAT(said.out, ContainsSubstring(words));
    CHECK(support::run_program(CHECK_CERTIFICATE, {}).code == 2);
    CHECK(support::run_program(CHECK_CERTIFICATE, {"no such file"}).code == 2);
}

TEST_CASE("a changed byte, a cut and something behind the end are refused", "[certificate]") {
    auto const& text = growth().text;
    std::mt19937 random(7);
    for (int k = 0; k < 60; ++k) {
        auto damaged = text;
        auto& c = damaged[random() % text.size()];
        c = static_cast<char>(c ^ static_cast<char>(1 + random() % 100));
        CHECK(verdict_on(damaged) == 2);
        CHECK(verdict_on(text.substr(0, random() % text.size())) == 2);
    }
    CHECK(verdict_on(text + "x") == 2);
    CHECK(verdict_on(text + text) == 2);
    CHECK(verdict_on("") == 2);
    CHECK(verdict_on(std::string(100, '\0')) == 2);
}

TEST_CASE("other data are refused, inside of a certificate and beside it", "[certificate]") {
    auto const& text = growth().text;
    auto const at = text.find("t,x,x_err\n") + 10;
    auto other = text;
    auto const digit = text.find(',', at) + 4; // of the first measurement
    other[digit] = other[digit] == '9' ? '8' : static_cast<char>(other[digit] + 1);
    CHECK(verdict_on(sealed(other)) == 2); // not the digest of the data
    CHECK(verdict_on(text, CHECK_CERTIFICATE, motor().data) == 2);
    temporary_folder const folder;
    for (auto const* name : {"dataset.json", "growth.inputs.csv", "growth.measurements.csv"})
        folder.write(name, growth().folder.read(std::string("data/") + name));
    CHECK(verdict_on(text, CHECK_CERTIFICATE, folder.path().string()) == 0);
    folder.write("growth.measurements.csv",
                 growth().folder.read("data/growth.measurements.csv") + " ");
    CHECK(verdict_on(text, CHECK_CERTIFICATE, folder.path().string()) == 2);
    // Whoever recomputes that digest as well changes what the data say, and the witness misses it.
    auto const table = other.find("file\tgrowth.measurements.csv");
    auto const size = std::stoul(other.substr(other.find('\t', table + 6) + 1));
    auto const begin = other.find('\n', table) + 1;
    auto rows = other.substr(begin, size);
    for (auto p = rows.find(",0."); p != std::string::npos; p = rows.find(",0.", p + 8))
        if (p > 12) rows[p + 3] = rows[p + 3] == '9' ? '0' : '9';
    other.replace(begin, size, rows);
    std::string all;
    for (auto const& s : statements_of(other)) {
        if (!s.starts_with("file\t")) continue;
        auto const head = s.find('\n');
        auto const name = s.substr(5, s.find('\t', 5) - 5),
                   body = s.substr(head + 1, s.size() - head - 2);
        all += name + "\n" + std::to_string(body.size()) + "\n" + body;
    }
    auto const digest = other.find("\ndata\t") + 6;
    other.replace(digest, 64, sivid::sha256(all));
    CHECK(verdict_on(sealed(other)) == 3);
}

TEST_CASE("what does not hold is not proved: witness, hull, tree, verdict", "[certificate]") {
    auto const& text = growth().text;
    CHECK(verdict_on(with_line(text, "witness\tr", "witness\tr\t2.5")) == 3);
    CHECK(verdict_on(with_line(text, "witness\tr", "witness\tr\t1e-5")) == 3); // not in the prior
    CHECK(verdict_on(with_line(text, "begins\tx", "begins\tx\t0.1\t0.12\t0.05")) == 3);
    CHECK(verdict_on(with_line(text, "begins\tx", "begins\tx\t0.1\t0.12")) == 3);
    CHECK(verdict_on(with_line(text, "hull\tK", "hull\tK\t0.999\t1.001")) == 3);
    CHECK(verdict_on(with_line(text, "rate\tx", "rate\tx\t=\t%3")) != 0);
    // The truth is planted in the box that is kept: no word of the file excludes it.
    CHECK(verdict_on(with(text, "\nkeep\n", "\nout\t0\n")) == 3);
    CHECK(verdict_on(with(text, "\nkeep\n", "\nsplit\t0\t1\nout\t0\nout\t0\n")) == 3);
    auto none = text; // the whole prior, the truth in it
    for (auto const* line : {"\nwitness\t", "\nhull\t"})
        for (auto at = none.find(line); at != std::string::npos; at = none.find(line))
            none.erase(at, none.find('\n', at + 1) - at);
    none.replace(none.find("\nkeep\n"), 6, "\nout\t0\n");
    CHECK(verdict_on(with_line(none, "verdict", "verdict\tinconsistent")) == 3);
    CHECK(verdict_on(with(text, "\nout\t0\n", "\nkeep\n")) == 3); // a hole: the hull grows
    CHECK(verdict_on(with(text, "\nout\t0\n", "\n")) == 2);
    CHECK(verdict_on(with(text, "\nkeep\n", "\nkeep\nkeep\n")) == 2);
    CHECK(verdict_on(with(text, "\nout\t0\n", "\nout\t1\n")) == 2); // no such experiment
    CHECK(verdict_on(with(text, "\nsplit\t0\t", "\nsplit\t0\t1e5")) == 2);
    CHECK(verdict_on(with(text, "\nsplit\t0\t", "\nsplit\t7\t")) == 2);
    CHECK(verdict_on(with_line(text, "verdict", "verdict\tinconsistent")) == 2);
    CHECK(verdict_on(with_line(text, "verdict", "verdict\tundecided")) == 2);
    CHECK(verdict_on(with_line(motor().text, "verdict", "verdict\tconsistent")) == 2);
    CHECK(verdict_on(with(motor().text, "\nout\t", "\nkeep\nout\t")) == 2);
    auto const at = motor().text.find("\nout\t");
    auto kept = motor().text;
    CHECK(verdict_on(sealed(kept.replace(at, kept.find('\n', at + 1) - at, "\nkeep"))) == 3);
}

TEST_CASE("each statement and each of its fields is needed", "[certificate]") {
    auto const all = statements_of(growth().text);
    for (std::size_t k = 0; k + 1 < all.size() && !all[k].starts_with("verdict"); ++k) {
        auto without = all;
        without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
        bool const words = all[k].starts_with("assume") || all[k].starts_with("unproved");
        INFO(all[k].substr(0, 60));
        CHECK((verdict_on(sealed(joined(without))) != 0) == !words);
        for (std::size_t tab = all[k].find('\t'), first = tab;
             tab != std::string::npos && tab < all[k].find('\n');
             tab = all[k].find('\t', tab + 1)) {
            auto shorter = all;
            auto& s = shorter[k];
            auto const line = s.find('\n'), end = std::min(s.find('\t', tab + 1), line);
            s.erase(tab, end - tab);
            // A constant with one end less, and a start without its witness, are statements, too.
            if (verdict_on(sealed(joined(shorter))) == 0) FAIL_CHECK("field at " << tab - first);
        }
    }
    auto none = growth().text; // no assumption at all
    for (auto at = none.find("\nassume"); at != std::string::npos; at = none.find("\nassume"))
        none.erase(at, none.find('\n', at + 1) - at);
    CHECK(verdict_on(sealed(none)) == 2);
}

TEST_CASE("what is no number, a huge one or a name of nothing is refused", "[certificate]") {
    auto const& text = growth().text;
    for (auto const* x : {"nan", "inf", "-inf", "1e999", "0x1p3", "1e", "1..2", "--1", "", " 1",
                          "1 ", "1e400", "4294967296999999999999999999999999999999999e299"}) {
        INFO(x);
        CHECK(verdict_on(with_line(text, "witness\tr", std::string("witness\tr\t") + x)) == 2);
        CHECK(verdict_on(with_line(text, "hull\tK", std::string("hull\tK\t") + x + "\t2")) == 2);
    }
    for (auto const* n : {"-1", "99999999999", "x", "1.5", "1e3"})
        CHECK(verdict_on(with_line(text, "split", std::string("split\t") + n + "\t1")) == 2);
    CHECK(verdict_on(with_line(text, "file\tdataset.json", "file\tdataset.json\t99999999")) == 2);
    CHECK(verdict_on(with_line(text, "file\tdataset.json", "file\t../dataset.json\t10")) == 2);
    CHECK(verdict_on(with_line(text, "let\t%1", "let\t%1\t=\tx\t/\tnothing")) == 2);
    CHECK(verdict_on(with_line(text, "let\t%1", "let\t%1\t=\tx\t%\tK")) == 2);
    CHECK(verdict_on(with_line(text, "let\t%1", "let\t%1\t=\tsystem\tK")) == 2);
    CHECK(verdict_on(with_line(text, "state\tx", "state\t\x1b[2J\tg")) == 2);
    std::string deep = "\n";
    for (int k = 0; k < 100'000; ++k) deep += "split\t0\t1\n";
    CHECK(verdict_on(with(text, "\nsplit", deep + "split")) == 2);
}

TEST_CASE("random damages neither crash the checker nor make it prove what is false",
          "[certificate]") {
    auto const& text = growth().text;
    auto const model_from = text.find("\nstate\t"), claims = text.find("\nhull\t");
    std::mt19937 random(11);
    auto const marks = std::string("0123456789.e-\t\n+*/sxrK%,") + '\0';
    for (int k = 0; k < 120; ++k) {
        auto damaged = text;
        bool const of_claims = random() % 2 == 0; // the same problem, other claims
        auto const from = of_claims ? claims : random() % 2 == 0 ? model_from : 0;
        for (auto n = 1 + random() % 3; n > 0; --n) {
            auto const at = from + random() % (damaged.size() - from - 70);
            auto const what = random() % 4;
            if (what == 0) damaged.erase(at, 1 + random() % 20);
            if (what == 1) damaged.insert(at, damaged.substr(from + random() % 100, random() % 40));
            if (what >= 2) damaged[at] = marks[random() % marks.size()];
        }
        auto const code = verdict_on(sealed(damaged), SANITIZED_CHECKER);
        INFO("damage " << k);
        CHECK((code == 0 || code == 2 || code == 3));
        if (code != 0 || !of_claims) continue;
        // Whatever is accepted of this problem holds the witness of the honest certificate.
        for (auto const* name : {"r", "K"}) {
            auto const value = [&](std::string const& in, std::string const& line, int nth) {
                std::istringstream fields{in.substr(in.find("\n" + line + "\t" + name) + 1)};
                std::string word;
                for (int i = 0; i <= nth; ++i) fields >> word;
                return std::stod(word);
            };
            auto const at = value(text, "witness", 2);
            CHECK(value(damaged, "hull", 2) <= at);
            CHECK(value(damaged, "hull", 3) >= at);
        }
    }
}

TEST_CASE("both know the same functions, and the same time", "[certificate]") {
    certified swing;
    auto const model = (swing.folder.path() / "swing.toml").string();
    swing.folder.write("swing.toml", R"(format = "sivid-model-1"
name = "swing"
states = { th = "3 rad", w = "5 rad/s" }
inputs = { u = "rad/s^2" }
constants = { a = "[8, 12] 1/s^2", b = "0.6 rad/s^2" }
outputs = { th = "th" }
[equations]
th = "w"
w = """-a*sin(th)*1 [rad] - b*tanh(w/1 [rad/s]) + 0.1 [rad/s^2]*exp(-(w/1 [rad/s])^2)*cos(th)
       + 0.05 [rad/s^2]*sqrt(1 + tan(th/4)^3 + t/1 [s]) + u"""
)");
    swing.folder.write("s.json", R"({ "format": "sivid-scenario-1", "name": "swing", "duration": 1,
        "initial": { "th": 0.5, "w": 0 }, "inputs": { "u": { "shape": "constant", "value": 0.5 } } })");
    REQUIRE(sivid_program({"generate", model, "--scenario",
                           (swing.folder.path() / "s.json").string(), "--absolute", "0.02",
                           "--rate", "5", "--input-rate", "5", "--out", swing.data})
                .code == 0);
    swing.identify(model);
    REQUIRE(swing.code == 0);
    CHECK(verdict_on(swing.text, CHECK_CERTIFICATE, swing.data) == 0);
    CHECK(verdict_on(with(swing.text, "sin\tth", "cos\tth")) == 3);
    CHECK(verdict_on(with(swing.text, "title\tgenerated\ts\t1\t1", "title\tgenerated\ts\t2\t2")) ==
          3);
    CHECK(verdict_on(with(swing.text, "input\tu\trad/s^2\t1\t1", "input\tu\trad/s^2\t9\t9")) == 3);
    CHECK(verdict_on(with(swing.text, "\nstate\tw", "\ntitle\tx\ts\t1\t1\nstate\tw")) == 2);
}

TEST_CASE("what no certificate can hold is said in words", "[certificate]") {
    temporary_folder const folder;
    auto const refused = [&](std::string const& model, std::string const& data) {
        auto const out = (folder.path() / "out").string();
        (void)sivid_program({"identify", model, data, "--out", out, "--quiet", "--budget", "2"});
        auto const asked = sivid_program({"certificate", model, out});
        CHECK(asked.code == 2);
        return asked.err;
    };
    auto const kinked = (folder.path() / "kinked.toml").string();
    auto text = growth().folder.read("../" + growth_model);
    text = sivid::read_text(growth_model);
    text.replace(text.find("r*x*(1"), 6, "r*abs(x)*(1");
    folder.write("kinked.toml", text);
    CHECK_THAT(refused(kinked, growth().data), ContainsSubstring("the equations have 'abs'"));
    // With data that were changed since.
    folder.write("later/dataset.json", growth().folder.read("data/dataset.json"));
    for (auto const* name : {"growth.inputs.csv", "growth.measurements.csv"})
        folder.write(std::string("later/") + name,
                     growth().folder.read(std::string("data/") + name) + "\n");
    auto const other = sivid_program({"certificate", growth_model, growth().out, "--dataset",
                                      (folder.path() / "later").string(), "--out",
                                      (folder.path() / "c.txt").string()});
    CHECK(other.code == 2);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "c.txt"));
}
