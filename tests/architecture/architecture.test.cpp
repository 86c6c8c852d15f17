// SPDX-License-Identifier: MIT
#include "architecture/rules.hpp"

#include "support/catch.hpp"

#include <unistd.h>

namespace {

namespace fs = std::filesystem;

/// A small well-formed tree in a temporary folder, in which breaches are planted.
class planted_tree {
public:
    planted_tree()
        : root_{fs::temp_directory_path() /
                std::string{"sivid_architecture_"}.append(std::to_string(::getpid()))} {
        fs::remove_all(root_);
        header("number/low.hpp", "#include <boost/numeric/interval.hpp>\n#include <vector>\n");
        header("space/high.hpp", "#include <sivid/number/low.hpp>\n#include <Eigen/Core>\n");
        write("include/sivid/sivid.hpp",
              wrapped("sivid/sivid.hpp", "#include <sivid/number/low.hpp>\n"
                                         "#include <sivid/space/high.hpp>\n"));
        write("tests/sivid.test.cpp", "#include <sivid/sivid.hpp>\n");
    }
    ~planted_tree() { fs::remove_all(root_); }
    planted_tree(planted_tree const&) = delete;
    planted_tree& operator=(planted_tree const&) = delete;

    void write(fs::path const& file, std::string const& text) const {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream{root_ / file} << text;
    }
    static std::string wrapped(fs::path const& name, std::string const& body) {
        auto const guard = architecture::guard_of(name);
        return "// SPDX-License-Identifier: MIT\n#ifndef " + guard + "\n#define " + guard + "\n" +
               body + "#endif\n";
    }
    /// A header in good form.
    void header(std::string const& name, std::string const& body) const {
        write("include/sivid/" + name, wrapped("sivid/" + name, body));
    }
    /// An umbrella of all headers.
    void umbrella() const {
        std::string body;
        for (auto const& entry : fs::recursive_directory_iterator{root_ / "include/sivid"})
            if (entry.is_regular_file() && entry.path().filename() != "sivid.hpp")
                body += "#include <" +
                        fs::relative(entry.path(), root_ / "include").generic_string() + ">\n";
        write("include/sivid/sivid.hpp", wrapped("sivid/sivid.hpp", body));
    }
    void remove(fs::path const& file) const { fs::remove(root_ / file); }

    std::string findings() const {
        std::string text;
        for (auto const& f : architecture::check(root_))
            text += f.rule + ": " + f.file + ": " + f.what + "\n";
        return text;
    }

private:
    fs::path root_;
};

} // namespace

TEST_CASE("the tree keeps its rules") {
    std::string text;
    for (auto const& f : architecture::check(SIVID_SOURCE_DIR))
        text += f.rule + ": " + f.file + ": " + f.what + "\n";
    CHECK(text == "");
}

TEST_CASE("a tree in good form has no finding") { CHECK(planted_tree{}.findings() == ""); }

TEST_CASE("planted breaches are found") {
    planted_tree const tree;
    SECTION("upward include") {
        tree.header("number/low.hpp", "#  include <sivid/space/high.hpp>\n");
        CHECK_THAT(tree.findings(),
                   ContainsSubstring(
                       "upward: include/sivid/number/low.hpp: includes <sivid/space/high.hpp>"));
        CHECK_THAT(tree.findings(), ContainsSubstring("cycle: "));
    }
    SECTION("a proof that knows more of a fit than its result") {
        tree.header("approximate/approximate_fit.hpp", "");
        tree.header("approximate/fit/fit.hpp", "#include <sivid/approximate/approximate_fit.hpp>\n"
                                               "#include <sivid/executor.hpp>\n");
        tree.write("include/sivid/executor.hpp", planted_tree::wrapped("sivid/executor.hpp", ""));
        tree.header("paving/proof.hpp", "#include <sivid/approximate/approximate_fit.hpp>\n");
        tree.header("paving/impl/inflation.ipp", "#include <sivid/approximate/fit/fit.hpp>\n");
        tree.umbrella();
        CHECK(tree.findings() == "");
        tree.header("paving/proof.hpp", "#include <sivid/approximate/fit/fit.hpp>\n");
        CHECK_THAT(tree.findings(), ContainsSubstring("unproved: include/sivid/paving/proof.hpp"));
    }
    SECTION("an include of a higher room, and a room that nobody knows") {
        tree.header("paving/response/low.hpp", "");
        tree.header("paving/search/high.hpp", "#include <sivid/paving/response/low.hpp>\n");
        tree.umbrella();
        CHECK(tree.findings() == "");
        tree.header("paving/response/low.hpp", "#include <sivid/paving/search/high.hpp>\n");
        CHECK_THAT(tree.findings(),
                   ContainsSubstring("upward: include/sivid/paving/response/low.hpp: includes "
                                     "<sivid/paving/search/high.hpp> of a higher room"));
        tree.header("paving/cellar/low.hpp", "");
        CHECK_THAT(tree.findings(), ContainsSubstring("room: include/sivid/paving/cellar/low.hpp"));
    }
    SECTION("the umbrella counts as upward") {
        tree.header("number/low.hpp", "#include <sivid/sivid.hpp>\n");
        CHECK_THAT(tree.findings(), ContainsSubstring("upward: include/sivid/number/low.hpp"));
    }
    SECTION("a cycle on one floor") {
        tree.header("number/low.hpp", "#include <sivid/number/lower.hpp>\n");
        tree.header("number/lower.hpp", "#include <sivid/number/low.hpp>\n");
        CHECK_THAT(tree.findings(), ContainsSubstring("cycle: "));
    }
    SECTION("a cycle by way of definitions") {
        tree.header("space/high.hpp", "#include <sivid/space/higher.hpp>\n");
        tree.header("space/higher.hpp", "");
        tree.write("include/sivid/space/impl/higher.ipp",
                   planted_tree::wrapped("sivid/space/impl/higher.ipp",
                                         "#include <sivid/space/higher.hpp>\n"));
        tree.umbrella();
        CHECK(tree.findings() == "");
        tree.write("include/sivid/space/impl/higher.ipp",
                   planted_tree::wrapped("sivid/space/impl/higher.ipp",
                                         "#include <sivid/space/high.hpp>\n"));
        CHECK_THAT(tree.findings(), ContainsSubstring("cycle: "));
    }
    SECTION("quoted include") {
        tree.header("space/high.hpp", "#include \"../number/low.hpp\"\n");
        CHECK_THAT(tree.findings(),
                   ContainsSubstring("include form: include/sivid/space/high.hpp"));
    }
    SECTION("include of nothing") {
        tree.header("space/high.hpp", "#include <sivid/number/gone.hpp>\n");
        CHECK_THAT(tree.findings(), ContainsSubstring("missing: include/sivid/space/high.hpp"));
    }
    SECTION("length") {
        std::string longer;
        for (int i = 0; i < 996; ++i) longer += "\n"; // 1000 lines with the four of the wrapping
        tree.header("number/low.hpp", longer);
        CHECK(tree.findings() == "");
        tree.header("number/low.hpp", longer + "\n");
        CHECK_THAT(tree.findings(),
                   ContainsSubstring("size: include/sivid/number/low.hpp: 1001 lines"));
    }
    SECTION("licence line") {
        tree.write("include/sivid/number/low.hpp",
                   std::string{"\n"}.append(planted_tree::wrapped("sivid/number/low.hpp", "")));
        CHECK_THAT(tree.findings(), ContainsSubstring("licence: include/sivid/number/low.hpp"));
    }
    SECTION("guard") {
        tree.write("include/sivid/number/low.hpp",
                   planted_tree::wrapped("sivid/number/lo.hpp", ""));
        CHECK_THAT(tree.findings(),
                   ContainsSubstring(
                       "guard: include/sivid/number/low.hpp: no guard SIVID_NUMBER_LOW_HPP"));
    }
    SECTION("unknown floor") {
        tree.header("attic/old.hpp", "");
        CHECK_THAT(tree.findings(), ContainsSubstring("floor: include/sivid/attic/old.hpp"));
    }
    SECTION("absent from the umbrella") {
        tree.header("paving/fresh.hpp", "");
        CHECK_THAT(tree.findings(), ContainsSubstring("umbrella: include/sivid/paving/fresh.hpp"));
    }
    SECTION("what only some compilers know") {
        tree.header("number/low.hpp",
                    "[[gnu::always_inline]] inline int f(int plasm) { return 1; }\n"
                    "inline int g() { return 1; } // __builtin_expect\n");
        CHECK(tree.findings() == "");
        for (std::string const word :
             {"typedef double v __attribute__((vector_size(16)));\n", "using w = __int128;\n",
              "inline int h(int x) { return __builtin_ctz(x); }\n",
              "inline void k() { asm(\"\"); }\n"}) {
            tree.header("number/low.hpp", word);
            CHECK_THAT(tree.findings(),
                       ContainsSubstring("compiler: include/sivid/number/low.hpp"));
        }
        tree.header("number/rounding/detail/machine.hpp", "inline void k() { asm(\"\"); }\n");
        tree.header("number/low.hpp", "");
        CHECK(tree.findings() == "");
    }
    SECTION("a test that a script or a build file names, and that has moved") {
        for (std::string const name : {"number/low", "space/high"})
            tree.write("tests/" + name + ".test.cpp", "#include <sivid/" + name + ".hpp>\n");
        tree.write("scripts/check-far", "tests=\"number/low tests/number/low.test.cpp\"\n");
        tree.write("tests/CMakeLists.txt", "add(space/high ${x}/number/low.test.cpp)\n");
        CHECK(tree.findings() == "");
        tree.write("scripts/check-far", "tests=\"number/detail/low space/high\"\n");
        CHECK(tree.findings() ==
              "named test: scripts/check-far: no tests/number/detail/low.test.cpp\n");
        tree.write("scripts/check-far", "run tests/space/low.test.cpp\n");
        CHECK_THAT(tree.findings(), ContainsSubstring("no tests/space/low.test.cpp"));
        tree.write("scripts/check-far", "");
        tree.write("tests/CMakeLists.txt", "add(high space/room/high)\n");
        CHECK(tree.findings() ==
              "named test: tests/CMakeLists.txt: no tests/space/room/high.test.cpp\n");
    }
    SECTION("printing") {
        tree.header("number/low.hpp", "inline void f() { std::cerr << 1; }\n");
        CHECK_THAT(tree.findings(), ContainsSubstring("silence: include/sivid/number/low.hpp"));
    }
}

TEST_CASE("names of test cases that would be taken apart are found") {
    planted_tree const tree;
    auto const with_case = [&](std::string const& macro_and_name) {
        tree.write("tests/space/high.test.cpp",
                   "#include <sivid/space/high.hpp>\n" + macro_and_name + ", \"[.long]\") {}\n");
        return tree.findings();
    };
    std::string const macro = "TEST_"
                              "CASE(\"";
    CHECK(with_case(macro + "plain, with a comma: x' = a x (1e-8) <2>\"") == "");
    for (auto name : {"this; that", "within [0, 1]", " led", "trailing ", "*all", "all*", "~not",
                      "a \\\"word\\\"", "back\\\\slash", "#1", "exclude: it"}) {
        CAPTURE(name);
        CHECK_THAT(with_case(macro + name + "\""),
                   ContainsSubstring("test name: tests/space/high.test.cpp"));
    }
    CHECK_THAT(with_case("TEMPLATE_" + macro + "one\"\n    \"; two\", \"\", int"),
               ContainsSubstring("'one; two'"));
}

TEST_CASE("packages are kept to the floors that may use them") {
    using architecture::package_allowed;
    for (auto name : {"nlohmann/json.hpp", "fmt/format.h", "CLI/CLI.hpp", "tbb/parallel_for.h",
                      "mpfr.h", "gmp.h", "boost/multiprecision/mpfi.hpp", "boost/filesystem.hpp",
                      "benchmark/benchmark.h", "unistd.h"}) {
        CAPTURE(name);
        CHECK_FALSE(package_allowed(name, "number", "interval.hpp"));
        CHECK_FALSE(package_allowed(name, "diagnosis", "gap.hpp"));
    }
    for (auto name : {"vector", "boost/numeric/odeint.hpp", "Eigen/Core", "immintrin.h",
                      "sivid/number/interval.hpp"}) {
        CAPTURE(name);
        CHECK(package_allowed(name, "number", "interval.hpp"));
    }
    CHECK(package_allowed("nlohmann/json.hpp", "io", "json.hpp"));
    CHECK(package_allowed("mpfr.h", "number", "mpfr_oracle.hpp"));
    CHECK(package_allowed("tbb/parallel_for.h", "parallel", "threads.hpp"));
    CHECK_FALSE(package_allowed("tbb/parallel_for.h", "io", "json.hpp"));
    CHECK(package_allowed("boost/mpi/communicator.hpp", "cluster", "mpi_world.hpp"));
    CHECK_FALSE(package_allowed("boost/mpi/communicator.hpp", "parallel", "threads.hpp"));
    CHECK_FALSE(package_allowed("CLI/CLI.hpp", "io", "json.hpp"));
    CHECK(package_allowed("CLI/CLI.hpp", "app", "app.ipp"));
}
