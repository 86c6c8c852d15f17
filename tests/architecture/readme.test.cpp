// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

std::string text_of_file(std::filesystem::path const& file) {
    std::ifstream in{file};
    return {std::istreambuf_iterator<char>{in}, {}};
}

} // namespace

TEST_CASE("the guide's first program is the one that is compiled", "[readme]") {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    auto const guide = text_of_file(root / "docs/guide.md");
    auto program = text_of_file(root / "examples/first_steps/main.cpp");
    program.erase(0, program.find('\n') + 1); // the licence line
    REQUIRE(program.size() > 500);
    CHECK(guide.find("```cpp\n" + program + "```") != std::string::npos);
    CHECK(std::count(program.begin(), program.end(), '\n') <= 40);
}

namespace {

/// A block of a page between fences, with the comment on the line before it, if any.
struct block {
    std::string page, kind, marker, text;
    std::size_t line = 0;
};

std::vector<block> blocks_of(std::string const& page, std::string const& text) {
    std::vector<block> all;
    std::istringstream in{text};
    bool open = false;
    std::string before;
    std::size_t number = 0;
    for (std::string line; std::getline(in, line); before = line) {
        ++number;
        if (line.starts_with("```")) {
            open = !open;
            if (!open) continue;
            bool const marked = before.starts_with("<!-- ") && before.ends_with(" -->");
            all.push_back({page, line.substr(3), marked ? before.substr(5, before.size() - 9) : "",
                           "", number});
        } else if (open) {
            all.back().text += line + "\n";
        } else if (line.starts_with("    ") && before.empty() && !line.starts_with("    -")) {
            all.push_back({page, "(indented)", "", line, number});
        }
    }
    if (open) all.push_back({page, "(not closed)", "", "", number});
    return all;
}

/// The pages of README, the rules, docs, theory and benchmarks.
std::vector<std::string> all_pages() {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    std::vector<std::string> pages{"README.md", "CONTRIBUTING.md", "benchmarks/RESULTS.md",
                                   "benchmarks/withheld/CAMPAIGNS.md"};
    for (auto const* folder : {"docs/", "docs/theory/"})
        for (auto const& entry : std::filesystem::directory_iterator{root / folder})
            if (entry.path().extension() == ".md")
                pages.push_back(folder + entry.path().filename().string());
    return pages;
}

std::vector<block> all_blocks() {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    std::vector<block> all;
    for (auto const& page : all_pages())
        for (auto& b : blocks_of(page, text_of_file(root / page))) all.push_back(std::move(b));
    return all;
}

/// Each line without the space around it, and without what other encodings write otherwise.
std::string trimmed(std::string const& text) {
    std::istringstream in{text};
    std::string out;
    for (std::string line; std::getline(in, line);) {
        std::erase_if(line, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
        auto const from = line.find_first_not_of(" \r");
        if (from == std::string::npos) continue;
        out += line.substr(from, line.find_last_not_of(" \r") + 1 - from) + "\n";
    }
    return out;
}

std::string without_space(std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    return text;
}

/// All sources in which a program's name or option can stand.
std::string const& sources() {
    static std::string const all = [] {
        std::string text;
        std::filesystem::path const root{SIVID_SOURCE_DIR};
        for (auto const* folder :
             {"examples", "benchmarks", "scripts", "tests/machines", "tests/package", "cmake",
              "include/sivid/io", "include/sivid/app"})
            for (auto const& e : std::filesystem::recursive_directory_iterator{root / folder}) {
                auto const extension = e.path().extension();
                if (e.is_regular_file() &&
                    (extension == ".cpp" || extension == ".hpp" || extension == ".ipp" ||
                     extension == ".txt" || extension == ".cmake" || extension.empty()))
                    text += text_of_file(e.path());
            }
        return text + text_of_file(root / "CMakeLists.txt");
    }();
    return all;
}

/// What is wrong with one command line: a program or script that does not exist, an option that
/// nobody reads.
std::string wrong_command(std::string const& line) {
    std::istringstream words{line};
    std::string program, word;
    words >> program;
    while (program.find('=') != std::string::npos) words >> program; // VARIABLE=value
    if (program == "sudo") words >> program;
    static std::set<std::string> const tools{"apt",   "cd",    "cp",     "cmake", "echo", "mpirun",
                                             "conan", "ctest", "export", "g++",   "vcpkg"};
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    bool const script =
        program.find('/') != std::string::npos && std::filesystem::exists(root / program);
    std::string const name = std::filesystem::path{program}.filename().string();
    bool const target =
        sources().find("add_executable(" + name) != std::string::npos ||
        sources().find("sivid_add_robot_program(" + name) != std::string::npos ||
        (name.starts_with("sivid_benchmark_") && sources().find(name) != std::string::npos);
    if (!script && !target && tools.count(program) == 0) return "no such program: " + program;
    bool const own = tools.count(program) == 0;
    while (words >> word) {
        while (!word.empty() && (word.front() == '[' || word.front() == '(')) word.erase(0, 1);
        if (own && word.starts_with("--")) {
            auto const option = word.substr(0, word.find_first_of("=])"));
            if (sources().find(option) == std::string::npos) return "no such option: " + option;
        }
        if (word.starts_with("-DSIVID_") &&
            sources().find(word.substr(2, word.find('=') - 2)) == std::string::npos)
            return "no such setting: " + word;
    }
    return {};
}

/// What is wrong with the block; empty when something holds it to the tree.
std::string wrong_block(block const& b) {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    auto const marked_file = b.marker.substr(0, b.marker.find(';'));
    auto const from_file = [&] { return text_of_file(root / marked_file); };
    if (b.kind == "math") return {};
    if (b.kind == "sh") {
        std::istringstream in{b.text};
        std::string command;
        for (std::string line; std::getline(in, line);) {
            line = line.substr(0, line.find(" # "));
            bool const goes_on = line.starts_with(" ");
            if (!goes_on && !command.empty())
                if (auto const wrong = wrong_command(command); !wrong.empty()) return wrong;
            command = goes_on ? command + line : line;
        }
        return command.empty() ? "an empty block" : wrong_command(command);
    }
    if (b.kind == "python") // tests/python/test_pages.py runs what it says that it runs
        return b.page == "docs/python.md" && (b.marker == "run by tests/python/test_pages.py" ||
                                              b.marker.starts_with("not run: "))
                   ? ""
                   : "a block of Python that nobody runs";
    if (b.marker.starts_with("printed by: ")) return wrong_command(b.marker.substr(12));
    if (b.marker.starts_with("keys of: ")) {
        auto const writer = text_of_file(root / b.marker.substr(9));
        static std::regex const key{"\"([a-z_]{3,})\":"};
        for (std::sregex_iterator k{b.text.begin(), b.text.end(), key}, end; k != end; ++k)
            if (writer.find("\"" + (*k)[1].str() + "\"") == std::string::npos)
                return "no key " + (*k)[1].str();
        return {};
    }
    if (marked_file.empty()) return "nothing says where it comes from";
    if (!std::filesystem::is_regular_file(root / marked_file)) return "no file " + marked_file;
    if (b.kind == "cpp") {
        bool const compiled =
            marked_file.starts_with("examples/") || marked_file.starts_with("tests/");
        if (!compiled) return "not a file that the tests compile: " + marked_file;
        return trimmed(from_file()).find(trimmed(b.text)) == std::string::npos
                   ? "not part of " + marked_file
                   : "";
    }
    if (b.kind == "json") {
        // Entries may be left out; what stands here stands there.
        static std::regex const entry{R"("[A-Za-z_]+":("[^"]*"|\[[^\[\]{}]*\]|[-+.0-9a-z]+))"};
        auto const here = without_space(b.text), there = without_space(from_file());
        for (std::sregex_iterator e{here.begin(), here.end(), entry}, end; e != end; ++e)
            if (there.find(e->str()) == std::string::npos)
                return "not part of " + marked_file + ": " + e->str();
        return {};
    }
    if (b.kind == "cmake" || b.kind == "toml") {
        std::istringstream in{b.text};
        for (std::string line; std::getline(in, line);) {
            // Remarks on files of CMake are those of the page.
            auto const end = b.kind == "cmake" ? line.find("  #") : std::string::npos;
            if (trimmed(from_file()).find(trimmed(line.substr(0, end))) == std::string::npos)
                return "not part of " + marked_file + ": " + line;
        }
        return {};
    }
    if (b.kind.empty())
        return trimmed(from_file()).find(trimmed(b.text)) == std::string::npos
                   ? "not part of " + marked_file
                   : "";
    return "a block of kind " + b.kind;
}

} // namespace

TEST_CASE("every block of the guides is held to what is compiled, imported or run", "[readme]") {
    auto const all = all_blocks();
    CHECK_FALSE(all.empty());
    for (auto const& b : all) {
        INFO(b.page << ":" << b.line << ", " << b.kind << "\n" << b.text);
        CHECK(wrong_block(b) == "");
    }
}

TEST_CASE("a block that has gone stale is found", "[readme]") {
    block const stale[]{
        {"p", "cpp", "", "int x;\n"},
        {"p", "cpp", "examples/first_steps/main.cpp", "int nowhere = 3;\n"},
        {"p", "cpp", "README.md", "int main() {\n"},
        {"p", "sh", "", "hovercraft identify DATASET --no-such-option\n"},
        {"p", "sh", "", "hovercraft identify DATASET\nno_such_program DATASET\n"},
        {"p", "sh", "", "cmake -S . -B build -DSIVID_NO_SUCH=ON\n"},
        {"p", "json", "examples/import/german_logger/mapping.json", "{ \"duration\": 2.9 }\n"},
        {"p", "cmake", "examples/consumer/CMakeLists.txt", "find_package(other)\n"},
        {"p", "toml", "examples/first_steps/logistic_growth.toml", "time = \"s\"\n"},
        {"p", "", "", "printed\n"},
        {"p", "(indented)", "", "    code\n"}};
    for (auto const& b : stale) {
        INFO(b.kind << "\n" << b.text);
        CHECK(wrong_block(b) != "");
    }
}

namespace {

/// Literals that go on in the next line, after a blank or the sign of a choice, in one.
std::string with_whole_literals(std::string const& source) {
    std::string out;
    for (std::size_t i = 0; i < source.size(); ++i) {
        if (source[i] == '\\' && i + 1 < source.size() && source[i + 1] == '"') continue;
        auto const next = source.find_first_not_of(" \n:?", i + 1);
        bool const broken = source[i] == '"' && next != std::string::npos && source[next] == '"' &&
                            source.find('\n', i) < next;
        if (broken)
            i = next;
        else
            out += source[i];
    }
    return out;
}

} // namespace

TEST_CASE("messages that the pages explain are those of the sources", "[readme]") {
    namespace fs = std::filesystem;
    fs::path const root{SIVID_SOURCE_DIR};
    std::string all;
    for (auto const* folder : {"include", "examples", "cmake"})
        for (auto const& e : fs::recursive_directory_iterator{root / folder})
            if (auto const name = e.path().filename().string();
                e.is_regular_file() &&
                (name.find("pp") != std::string::npos || name.find("cmake") != std::string::npos ||
                 e.path().extension() == ".txt"))
                all += text_of_file(e.path());
    all = with_whole_literals(all);
    std::regex const quoted{"`([^`]+)`"}, dots{R"(\.\.\.)"};
    std::size_t seen = 0;
    for (auto const* page : {"troubleshooting", "results", "error_bounds"}) {
        std::istringstream in{text_of_file(root / "docs" / (std::string{page} + ".md"))};
        for (std::string line; std::getline(in, line);) {
            if (!line.starts_with("| `")) continue; // a row of messages
            auto const cell = line.substr(0, line.find(" | ", 3));
            for (std::sregex_iterator q{cell.begin(), cell.end(), quoted}, end; q != end; ++q) {
                auto const message = (*q)[1].str();
                for (std::sregex_token_iterator p{message.begin(), message.end(), dots, -1}, none;
                     p != none; ++p) {
                    auto piece = p->str();
                    piece.erase(0, piece.find_first_not_of(" ,;:"));
                    piece.erase(piece.find_last_not_of(" ,;:") + 1);
                    if (piece.size() < 6) continue;
                    ++seen;
                    INFO(page << ": " << piece);
                    CHECK(all.find(piece) != std::string::npos);
                }
            }
        }
    }
    CHECK(seen > 60);
}

TEST_CASE("links of the pages lead to files and headings", "[readme]") {
    namespace fs = std::filesystem;
    fs::path const root{SIVID_SOURCE_DIR};
    // As a forge names a heading: small letters, blanks as hyphens, without other signs.
    auto const named = [](std::string const& heading) {
        std::string out;
        for (char const c : heading) {
            auto const u = static_cast<unsigned char>(c);
            if (std::isalnum(u) || c == '_' || c == '-') out += static_cast<char>(std::tolower(u));
            if (c == ' ') out += '-';
        }
        return out;
    };
    auto const has = [&](fs::path const& page, std::string const& anchor) {
        std::istringstream in{text_of_file(page)};
        for (std::string line; std::getline(in, line);)
            if (auto const at = line.find_first_not_of('#'); at > 0 && at < line.size())
                if (line[at] == ' ' && named(line.substr(at + 1)) == anchor) return true;
        return false;
    };
    std::regex const link{R"(\]\(([\w./-]+\.(md|svg|png|cff))(#([\w-]+))?\))"};
    auto pages = all_pages();
    pages.insert(pages.end(), {"CHANGELOG.md", "docs/adr/index.md", "docs/site/start.md"});
    std::size_t seen = 0;
    for (auto const& page : pages) {
        auto const text = text_of_file(root / page);
        for (std::sregex_iterator l{text.begin(), text.end(), link}, end; l != end; ++l, ++seen) {
            auto const to = (root / page).parent_path() / (*l)[1].str();
            INFO(page << ": " << l->str());
            CHECK(fs::exists(to));
            if ((*l)[4].matched) CHECK(has(to, (*l)[4].str()));
        }
    }
    CHECK(seen > 100);
}

TEST_CASE("sources that the guides name exist", "[readme]") {
    namespace fs = std::filesystem;
    fs::path const root{SIVID_SOURCE_DIR};
    std::vector<std::string> sources;
    for (auto const* folder : {"include", "examples", "tests", "benchmarks"}) {
        for (auto const& entry : fs::recursive_directory_iterator{root / folder}) {
            if (entry.is_regular_file())
                sources.push_back("/" + fs::relative(entry.path(), root).generic_string());
        }
    }
    auto const exists = [&](std::string const& name) {
        return std::any_of(sources.begin(), sources.end(), [&](std::string const& source) {
            auto const from = source.size() - std::min(source.size(), name.size());
            return source.compare(from, name.size(), name) == 0 &&
                   (name.front() == '_' || source[from - 1] == '/');
        });
    };
    CHECK_FALSE(exists("identify.ipp.hpp"));
    std::regex const quoted{"`[^`\\n]+`"}, named{R"([\w/.-]*\w\.[hi]pp\b)"};
    std::size_t seen = 0;
    for (auto const& entry : fs::recursive_directory_iterator{root / "docs"}) {
        auto const page = entry.path().filename();
        if (entry.path().extension() != ".md") continue;
        auto const text = text_of_file(entry.path());
        for (std::sregex_iterator q{text.begin(), text.end(), quoted}, end; q != end; ++q) {
            auto const part = q->str();
            for (std::sregex_iterator n{part.begin(), part.end(), named}; n != end; ++n, ++seen) {
                INFO(page << ": " << n->str());
                CHECK(exists(n->str()));
            }
        }
    }
    CHECK(seen > 100);
}

TEST_CASE("each short program is whole in the guide or named there, in at most 40 lines",
          "[readme]") {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    auto const guide = text_of_file(root / "docs/guide.md");
    for (auto const& entry : std::filesystem::directory_iterator{root / "examples/short"}) {
        if (entry.path().extension() != ".cpp") continue;
        auto const program = text_of_file(entry.path());
        INFO(entry.path());
        bool const whole = guide.find("```cpp\n" + program.substr(program.find('\n') + 1) +
                                      "```") != std::string::npos;
        auto const name = "`examples/short/" + entry.path().filename().string() + "`";
        CHECK((whole || guide.find(name) != std::string::npos));
        CHECK(std::count(program.begin(), program.end(), '\n') <= 40);
    }
}

TEST_CASE("entry points say what they throw, guarantee and cost", "[readme]") {
    struct door {
        char const *header, *function;
    };
    for (auto const& [header, function] :
         {door{"paving/identify.hpp", "identify"},
          door{"paving/invert.hpp", "invert"},
          door{"paving/static_inversion.hpp", "invert_static"},
          door{"paving/identifiability.hpp", "identifiability_of"},
          door{"paving/inflation.hpp", "bound_inflation"},
          door{"paving/outlier_budget.hpp", "smallest_outlier_budget"},
          door{"paving/divisors.hpp", "divisors_of"},
          door{"paving/bisection_test.hpp", "identify_by_bisection"},
          door{"enclosure/enclose.hpp", "enclose"},
          door{"enclosure/tube.hpp", "integrate"},
          door{"diagnosis/diagnose.hpp", "diagnose"},
          door{"diagnosis/diagnosis_run.hpp", "judge_by_holdout"},
          door{"report/diagnosis_page.hpp", "diagnosis_page"},
          door{"decision/prediction.hpp", "predict"},
          door{"decision/verification.hpp", "verify"},
          door{"decision/rank.hpp", "rank"},
          door{"decision/measurement_ranking.hpp", "rank_measurements"},
          door{"decision/gain_search.hpp", "find_gains"},
          door{"decision/promised_width.hpp", "promise_widths"},
          door{"decision/promised_width.hpp", "tell_apart"},
          door{"decision/experiment_design.hpp", "design_experiment"},
          door{"decision/experiment_design.hpp", "design_separation"},
          door{"io/dataset.hpp", "read_dataset"},
          door{"verifier/predict_from.hpp", "predict_from"}}) {
        auto const text =
            text_of_file(std::filesystem::path{SIVID_SOURCE_DIR} / "include/sivid" / header);
        std::smatch found;
        std::regex const declared(std::string{"\\n((///[^\\n]*\\n)+)[^/;{]*\\b"} + function +
                                  "\\(");
        CAPTURE(header, function);
        REQUIRE(std::regex_search(text, found, declared));
        for (auto const* word : {"@throws", "@guarantee", "@cost"}) {
            CAPTURE(word);
            CHECK(found[1].str().find(word) != std::string::npos);
        }
    }
}
