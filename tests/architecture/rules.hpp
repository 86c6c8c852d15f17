// SPDX-License-Identifier: MIT
// The rules of the source tree, as a function from a tree to a list of findings.
#ifndef SIVID_TESTS_ARCHITECTURE_RULES_HPP
#define SIVID_TESTS_ARCHITECTURE_RULES_HPP

#include "architecture/rooms.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace architecture {

namespace fs = std::filesystem;

inline constexpr std::array<std::string_view, 17> floors{
    "number", "space",    "measurement", "model",   "approximate", "enclosure",
    "paving", "decision", "diagnosis",   "io",      "verifier",    "importing",
    "report", "text",     "parallel",    "cluster", "app"};
inline constexpr std::size_t core_floors = 9;
/// Headers outside of floors that each floor may include.
inline constexpr std::array<std::string_view, 5> common{
    "sivid/version.hpp", "sivid/compiled.hpp", "sivid/executor.hpp", "sivid/work_clock.hpp",
    "sivid/work_limit.hpp"};
inline constexpr std::size_t hard_line_limit = 1000;

/// One breach: which rule, in which file (relative to the tree), and what.
struct finding {
    std::string rule, file, what;
};

inline std::size_t rank_of(std::string_view floor) {
    auto const found = std::find(floors.begin(), floors.end(), floor);
    return static_cast<std::size_t>(found - floors.begin()); // floors.size() when unknown
}

inline std::vector<std::string> lines_of(fs::path const& file) {
    std::ifstream in{file};
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// The name between <> or "" of an include line, with its opening character in front; "" otherwise.
inline std::string included(std::string const& line) {
    std::string_view rest = line;
    auto const skip_space = [&] {
        while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t'))
            rest.remove_prefix(1);
    };
    auto const skip = [&](std::string_view word) {
        if (rest.substr(0, word.size()) != word) return false;
        rest.remove_prefix(word.size());
        skip_space();
        return true;
    };
    skip_space();
    if (!skip("#") || !skip("include") || rest.empty()) return {};
    char const close = rest.front() == '<' ? '>' : '"';
    auto const end = rest.find(close, 1);
    return end == std::string_view::npos ? std::string{} : std::string{rest.substr(0, end)};
}

inline std::string guard_of(fs::path const& relative_to_include) {
    std::string guard;
    for (char c : relative_to_include.generic_string())
        guard += std::isalnum(static_cast<unsigned char>(c))
                     ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                     : '_';
    return guard;
}

inline bool starts_with(std::string_view text, std::string_view head) {
    return text.substr(0, head.size()) == head;
}

/// Whether `name` (as in <name>) may be included from this floor's header called `file`.
inline bool package_allowed(std::string_view name, std::string_view floor, std::string_view file) {
    bool const multiprecision =
        floor == "number" && (starts_with(file, "mp_") || starts_with(file, "mpfr_"));
    auto const one_of = [&](std::initializer_list<std::string_view> heads) {
        return std::any_of(heads.begin(), heads.end(),
                           [&](auto head) { return starts_with(name, head); });
    };
    if (one_of({"mpfr.h", "mpfi.h", "gmp.h", "gmpxx.h", "boost/multiprecision/mpfr",
                "boost/multiprecision/mpfi", "boost/multiprecision/gmp"}))
        return multiprecision;
    if (one_of({"boost/mpi", "boost/serialization"})) return floor == "cluster";
    if (one_of({"boost/filesystem", "boost/program_options", "boost/regex", "boost/thread",
                "boost/iostreams", "boost/log"}))
        return false;       // these need compiled libraries
    if (one_of({"Eigen/"})) // decompositions cost seconds, and stand behind one header
        return name == "Eigen/Core" || file == "dense.ipp";
    if (one_of({"sivid/", "boost/"})) return true;
    if (one_of({"CLI/"})) return floor == "app";
    if (one_of({"nlohmann/"})) return floor == "io" || floor == "report";
    if (one_of({"mpi.h"})) return floor == "cluster";
    if (one_of({"matio.h"})) return file == "matlab_reader.hpp";
    if (one_of({"expat.h"})) return file == "xml_reader.hpp";
    if (one_of({"urdf_parser/", "console_bridge/", "tinyxml.h"})) return file == "urdf_reader.hpp";
    if (one_of({"toml++/"})) return floor == "text";
    if (one_of({"zlib.h"})) return file == "whole_level5.hpp";
    if (one_of({"tbb/", "oneapi/"})) return floor == "parallel";
    if (name.find('/') != std::string_view::npos)
        return one_of({"sys/"}) && (floor == "io" || floor == "parallel" || floor == "app");
    if (name.find('.') == std::string_view::npos) return true; // the standard library
    if (one_of({"io.h", "process.h"})) return floor == "io";   // of Windows
    if (one_of({"unistd.h", "fcntl.h"}))
        return floor == "io" || floor == "parallel" || floor == "app";
    static std::set<std::string_view> const processor{"immintrin.h", "emmintrin.h", "xmmintrin.h",
                                                      "arm_neon.h"};
    return processor.count(name) > 0;
}

/// What only some compilers know, in a line of a header that is not one of those that keep it
/// apart, behind a condition and with a form in standard C++; "" if nothing. Attributes in brackets
/// are standard: who does not know them passes them over.
inline std::string_view compiler_word(std::string const& line, std::string_view name) {
    static std::set<std::string_view> const apart{"machine.hpp",     "vectors.hpp",
                                                  "integers.hpp",    "rounding.hpp",
                                                  "pack_target.hpp", "pack_arithmetic.hpp"};
    if (starts_with(name, "sivid/number/") && apart.count(name.substr(name.rfind('/') + 1)) > 0)
        return {};
    auto const code = line.substr(0, line.find("//"));
    for (std::string_view word :
         {"__attribute__", "__builtin_", "__extension__", "__int128", "__asm__", "asm(", "asm ",
          "__restrict", "__typeof__", "#pragma GCC"}) {
        auto const at = code.find(word);
        if (at == code.npos) continue;
        bool const begins =
            at == 0 ||
            (std::isalnum(static_cast<unsigned char>(code[at - 1])) == 0 && code[at - 1] != '_');
        if (begins) return word;
    }
    return {};
}

/// What the floors of the proofs may know of the floor `approximate`: what its fits and estimates
/// return. Where one is *started* is said here.
inline bool may_include_approximate(std::string_view other, std::string_view includer) {
    static std::set<std::string_view> const results{
        "approximate_fit.hpp",    "detail/residuals.hpp",      "candidate/candidate.hpp",
        "candidate/screened.hpp", "place/estimated_place.hpp", "place/place.hpp"};
    static std::map<std::string_view, std::set<std::string_view>> const starters{
        {"sivid/app/detail/decision_task.hpp", {"fit/fit.hpp", "simulate/simulate.hpp"}},
        {"sivid/app/impl/simulate.ipp", {"simulate/simulate.hpp"}},
        {"sivid/paving/judge/detail/fitted_witness.hpp", {"fit/fit.hpp"}},
        {"sivid/paving/online/detail/online_witness.hpp", {"fit/fit.hpp"}},
        {"sivid/paving/impl/outlier_budget.ipp", {"fit/fit.hpp"}},
        {"sivid/paving/impl/inflation.ipp", {"fit/fit.hpp"}},
        {"sivid/paving/impl/least_disturbance.ipp", {"fit/fit.hpp"}},
        {"sivid/paving/disturbance/detail/disturbance_witness.hpp", {"simulate/simulate.hpp"}},
        {"sivid/diagnosis/hold_out/detail/holdout_judgement.hpp", {"fit/fit.hpp"}},
        {"sivid/diagnosis/claim/detail/claim_review.hpp", {"fit/detail/approximate_campaign.hpp"}},
        {"sivid/diagnosis/gap/impl/confined_gap.ipp", {"fit/fit.hpp"}},
        {"sivid/diagnosis/impl/manoeuvre.ipp", {"fit/fit.hpp"}},
        {"sivid/diagnosis/impl/diagnose.ipp",
         {"candidate/screening.hpp", "place/detail/place_estimate.hpp"}},
        {"sivid/diagnosis/impl/identify_remembering.ipp", {"candidate/screening.hpp"}},
        {"sivid/cluster/diagnose.hpp", {"candidate/screening.hpp"}},
        {"sivid/report/impl/identification_report.ipp", {"simulate/simulate.hpp"}},
        {"sivid/verifier/claim/detail/paving_check.hpp", {"fit/detail/counterexample.hpp"}},
        {"sivid/verifier/impl/diagnosis_check.ipp", {"fit/detail/counterexample.hpp"}}};
    std::string_view const floor = "sivid/approximate/";
    if (!starts_with(other, floor) || starts_with(includer, floor)) return true;
    auto const what = other.substr(floor.size());
    auto const starter = starters.find(includer);
    return results.count(what) > 0 ||
           (starter != starters.end() && starter->second.count(what) > 0);
}

/// Names that stand at the left margin of a header in namespace sivid, or one within it that
/// programs see: its types and functions.
inline std::set<std::string> declared_names(std::vector<std::string> const& lines) {
    static std::regex const type{"^(struct|class|enum class|concept) (\\w+)"},
        function{"^(\\[\\[nodiscard\\]\\] )?((SIVID_DECL|inline|constexpr) )+.*?\\b(\\w+)\\("},
        inner{"^namespace .*detail"};
    std::set<std::string> names;
    bool within = false; // a namespace of internals
    for (auto const& line : lines) {
        std::smatch found;
        if (line.compare(0, 10, "namespace ") == 0) within = std::regex_search(line, inner);
        if (within) continue;
        if (std::regex_search(line, found, type) && line.back() != ';') names.insert(found[2]);
        if (std::regex_search(line, found, function)) names.insert(found[4]);
    }
    return names;
}

/// The header that a file of definitions belongs to: a/b/impl/x.ipp to a/b/x.hpp.
inline std::string header_of(fs::path const& definitions) {
    return (definitions.parent_path().parent_path() / definitions.stem()).generic_string() + ".hpp";
}

/// Whether ctest and Catch2 take a name of a test case as it stands. A semicolon ends it in CMake's
/// lists, brackets hold lists together there and are tags to Catch2, which also has a wildcard at
/// either end, a negation in front, an escape, and quotes. (Commas are escaped on the way.)
inline bool plain_test_name(std::string_view name) {
    return !name.empty() && name.find_first_of(";[]\\\"") == std::string_view::npos &&
           std::string_view{" *~#"}.find(name.front()) == std::string_view::npos &&
           std::string_view{" *"}.find(name.back()) == std::string_view::npos &&
           !starts_with(name, "exclude:");
}

/// The names of the test cases in a source, as written between the quotes.
inline std::vector<std::string> test_names(std::string_view source) {
    std::vector<std::string> names;
    auto const skip_space = [&](std::size_t i) {
        while (i < source.size() && std::isspace(static_cast<unsigned char>(source[i])) != 0) ++i;
        return i;
    };
    for (std::string_view macro : {"TEST_CASE", "SCENARIO"})
        for (auto at = source.find(macro); at != std::string_view::npos;
             at = source.find(macro, at + 1)) {
            auto i = at + macro.size();
            while (i < source.size() &&
                   (std::isupper(static_cast<unsigned char>(source[i])) != 0 || source[i] == '_'))
                ++i; // TEMPLATE_TEST_CASE_SIG and the like
            i = skip_space(i);
            if (i >= source.size() || source[i] != '(') continue;
            i = skip_space(i + 1);
            std::string name;
            bool named = false;
            for (; i < source.size() && source[i] == '"'; i = skip_space(i + 1), named = true)
                for (++i; i < source.size() && source[i] != '"'; ++i) {
                    name += source[i];
                    if (source[i] == '\\' && i + 1 < source.size()) name += source[++i];
                }
            if (named) names.push_back(name);
        }
    return names;
}

/// Test cases that would not run under their name, or not at all.
inline void check_test_names(fs::path const& tree, std::vector<finding>& findings) {
    for (auto const& entry : fs::recursive_directory_iterator{tree / "tests"}) {
        auto const extension = entry.path().extension();
        if (!entry.is_regular_file() || (extension != ".cpp" && extension != ".hpp")) continue;
        std::ifstream in{entry.path()};
        std::string const source{std::istreambuf_iterator<char>{in}, {}};
        for (auto const& name : test_names(source))
            if (!plain_test_name(name))
                findings.push_back({"test name", fs::relative(entry.path(), tree).generic_string(),
                                    "ctest or Catch2 read '" + name + "' as syntax"});
    }
}

/// The tests that scripts and build files name, as number/pack/lanes, without folder and ending.
/// Some of these run by hand only, and would learn of a move there.
inline void check_named_tests(fs::path const& tree, std::vector<finding>& findings) {
    static std::set<std::string_view> const others{"conformance", "laws", "machines", "regression"};
    auto const named = [&](fs::path const& file) {
        static std::string const word = "/_-.";
        for (auto const& line : lines_of(file))
            for (std::size_t from = 0, to = 0; from < line.size(); from = to + 1) {
                to = from;
                while (to < line.size() &&
                       (std::isalnum(static_cast<unsigned char>(line[to])) != 0 ||
                        word.find(line[to]) != std::string::npos))
                    ++to;
                auto name = line.substr(from, to - from);
                if (starts_with(name, "tests/")) name.erase(0, 6);
                auto const room = name.substr(0, name.find('/'));
                bool const test = room.size() < name.size() && name.back() != '/' &&
                                  file.parent_path().filename() != room && // a test's own name
                                  (rank_of(room) < floors.size() || others.count(room) > 0);
                if (!test || fs::exists(tree / "tests" / name)) continue;
                if (!fs::exists(tree / "tests" / (name + ".test.cpp")))
                    findings.push_back({"named test", fs::relative(file, tree).generic_string(),
                                        "no tests/" + name + ".test.cpp"});
            }
    };
    if (fs::is_directory(tree / "scripts"))
        for (auto const& entry : fs::directory_iterator{tree / "scripts"})
            if (entry.is_regular_file()) named(entry.path());
    for (auto const& entry : fs::recursive_directory_iterator{tree / "tests"})
        if (entry.path().filename() == "CMakeLists.txt") named(entry.path());
}

/// All breaches of the rules in the tree that holds include/sivid and tests.
inline std::vector<finding> check(fs::path const& tree) {
    std::vector<finding> findings;
    auto const include = tree / "include";
    // Header -> headers included, by its definitions too: these come at its end where nothing is
    // compiled once, and in a cycle what they need would not be declared yet.
    std::map<std::string, std::vector<std::string>> graph;
    std::set<std::string> umbrella_members, core_headers;
    std::map<std::string, std::set<std::string>> declared; // header -> what stands in it
    std::set<std::string> listed, definitions_of_floors;   // .ipp in sivid/impl, and all of them

    for (auto const& entry : fs::recursive_directory_iterator{include / "sivid"}) {
        if (!entry.is_regular_file()) continue;
        auto const path = entry.path();
        auto const relative = fs::relative(path, include);
        auto const name = relative.generic_string();
        auto const report = [&](std::string rule, std::string what) {
            findings.push_back({std::move(rule), "include/" + name, std::move(what)});
        };
        bool const definitions = path.parent_path().filename() == "impl";
        if (path.extension() != ".hpp" && !(definitions && path.extension() == ".ipp")) {
            report("extension", "only .hpp files belong here, and .ipp files in impl");
            continue;
        }

        auto part = std::next(relative.begin());
        // sivid/impl lists what is compiled once, of all floors
        bool const at_root = std::next(part) == relative.end() || *part == "impl";
        std::string const floor = at_root ? "" : part->string();
        auto const rank = rank_of(floor);
        if (!at_root && rank == floors.size()) {
            report("floor", "unknown floor '" + floor + "'");
            continue;
        }
        auto const room = at_root ? std::string{} : room_of(relative);
        if (!room.empty() && !is_room(floor, room)) {
            report("room", "unknown room '" + room + "'");
            continue;
        }
        bool const internal = definitions || name.find("/detail/") != std::string::npos;
        auto const file = path.filename().string();
        bool const optional = // needs a package, or costs more than it says (Odeint's steppers)
            (floor == "number" &&
             (starts_with(file, "mp_") || starts_with(file, "mpfr_") || file == "format.hpp")) ||
            file == "odeint_stepping.hpp";
        if (!at_root && !internal && !optional && rank < core_floors) core_headers.insert(name);

        if (definitions && !at_root) definitions_of_floors.insert(name);

        auto const lines = lines_of(path);
        if (lines.size() > hard_line_limit) report("size", std::to_string(lines.size()) + " lines");
        if (lines.empty() || lines.front() != "// SPDX-License-Identifier: MIT")
            report("licence", "the first line is not the SPDX line");

        auto const guard = guard_of(relative);
        auto const opened = std::find(lines.begin(), lines.end(), "#ifndef " + guard);
        if (opened == lines.end() || std::next(opened) == lines.end() ||
            *std::next(opened) != "#define " + guard)
            report("guard", "no guard " + guard);

        for (auto const& line : lines) {
            for (std::string_view word :
                 {"std::cout", "std::cerr", "std::clog", "printf(", "std::exit", "std::abort"})
                if (line.find(word) != std::string::npos)
                    report("silence", std::string{"uses "}.append(word));
            if (auto const word = compiler_word(line, name); !word.empty())
                report("compiler", std::string{"uses "}.append(word));
            auto const target = included(line);
            if (target.empty()) continue;
            std::string const other = target.substr(1);
            if (target.front() == '"')
                report("include form", "\"" + other + "\" instead of <sivid/floor/file.hpp>");
            if (!package_allowed(other, floor, file)) report("package", "includes <" + other + ">");
            if (!starts_with(other, "sivid/")) continue;
            bool const to_definitions = other.find("/impl/") != std::string::npos;
            if (to_definitions && at_root) listed.insert(other);
            auto const node = definitions ? header_of(relative) : name;
            if (!to_definitions && other != node) graph[node].push_back(other);
            if (name == "sivid/sivid.hpp") umbrella_members.insert(other);
            if (!fs::exists(include / other))
                report("missing", "includes <" + other + ">, which does not exist");
            auto const slash = other.find('/', 6);
            if (slash == std::string::npos) {
                if (!at_root && std::find(common.begin(), common.end(), other) == common.end())
                    report("upward", "includes <" + other + ">");
            } else if (!at_root && rank_of(other.substr(6, slash - 6)) > rank) {
                report("upward", "includes <" + other + ">");
            } else if (auto const there = room_of(other);
                       !room.empty() && !there.empty() && other.substr(6, slash - 6) == floor &&
                       height_of(floor, there) > height_of(floor, room)) {
                report("upward", "includes <" + other + "> of a higher room");
            }
            if (!at_root && !may_include_approximate(other, name))
                report("unproved", "includes <" + other + ">, which is no result of a fit");
        }

        if (!definitions) declared[name] = declared_names(lines);
    }

    for (auto const& header : core_headers)
        if (!umbrella_members.empty() && umbrella_members.count(header) == 0)
            findings.push_back(
                {"umbrella", "include/" + header, "not in sivid.hpp (scripts/update-umbrella)"});

    auto const programs = names_in_programs(tree);
    std::set<std::string> offered;
    for (auto const& [header, names] : declared)
        if (header.find("/detail/") == std::string::npos)
            offered.insert(names.begin(), names.end());
    for (auto const& [header, names] : declared)
        for (auto const& name : names)
            if (header.find("/detail/") != std::string::npos && offered.count(name) == 0 &&
                header.find("_class.hpp") == std::string::npos && // of a public header
                programs.count(name) > 0)
                findings.push_back({"detail", "include/" + header,
                                    "a program names " + name + ", which stands in detail/"});

    for (auto const& d : definitions_of_floors)
        if (fs::exists(include / "sivid/impl/src.hpp") && listed.count(d) == 0 &&
            d.find("impl/check_") == std::string::npos) // MPFI's
            findings.push_back({"definitions", "include/" + d, "in no list of sivid/impl"});

    check_test_names(tree, findings);
    check_named_tests(tree, findings);

    // Cycles, which the guards would hide: depth-first search with the usual three colours.
    std::map<std::string, int> colour;
    std::function<void(std::string const&)> const visit = [&](std::string const& header) {
        colour[header] = 1;
        for (auto const& next : graph[header]) {
            if (colour[next] == 1)
                findings.push_back(
                    {"cycle", "include/" + header, "and " + next + " include each other"});
            if (colour[next] == 0) visit(next);
        }
        colour[header] = 2;
    };
    std::vector<std::string> headers;
    for (auto const& [header, list] : graph) headers.push_back(header);
    for (auto const& header : headers)
        if (colour[header] == 0) visit(header);
    return findings;
}

} // namespace architecture

#endif // SIVID_TESTS_ARCHITECTURE_RULES_HPP
