// SPDX-License-Identifier: MIT
// Writes the test vectors as C++ source, so that compilers see the numbers:
//     generate_literals OUT_STEM FILES VECTOR_FILE...
// makes OUT_STEM_0.cpp ... and OUT_STEM_main.cpp. The interval type is the macro
// SIVID_LITERAL_TYPE of the header SIVID_LITERAL_HEADER.
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct shape {
    std::size_t intervals, integers;
};

/// The operations of tests/conformance/operations.hpp and their arguments.
std::map<std::string, shape> known() {
    std::map<std::string, shape> all{{"fma", {3, 0}}, {"pown", {1, 1}}};
    for (char const* name : {"add", "sub", "mul", "div", "min", "max", "hull", "intersection",
                             "pow", "atan2"})
        all[name] = {2, 0};
    for (char const* name :
         {"neg", "recip", "sqr",  "sqrt", "abs",  "exp",  "expm1", "log",   "log1p", "sin",  "cos",
          "tan", "asin",  "acos", "atan", "sinh", "cosh", "tanh",  "asinh", "acosh", "atanh"})
        all[name] = {1, 0};
    return all;
}

std::string statement(std::string const& name, shape s, std::vector<std::string> const& words,
                      std::string const& lo, std::string const& hi, std::string const& text) {
    std::string line = "    SIVID_LITERAL_" + std::to_string(s.intervals) + '_' +
                       std::to_string(s.integers) + '(' + name + ", \"" + text + '"';
    for (auto const& word : words) line += ", " + word;
    return line + ", " + lo + ", " + hi + ");\n";
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    std::string const stem = argv[1];
    auto const files = static_cast<std::size_t>(std::atoi(argv[2]));
    auto const operations = known();
    std::vector<std::string> statements;
    for (int i = 3; i < argc; ++i) {
        std::ifstream in{argv[i]};
        for (std::string text; std::getline(in, text);) {
            std::istringstream line{text};
            std::string name, arrow, lo, hi;
            line >> name;
            auto const found = operations.find(name);
            if (found == operations.end()) continue;
            std::vector<std::string> words(2 * found->second.intervals + found->second.integers);
            for (auto& word : words) line >> word;
            if (!(line >> arrow >> lo >> hi) || arrow != "->") return 1;
            statements.push_back(statement(name, found->second, words, lo, hi, text));
            if (name == "add" || name == "sub" || name == "mul" || name == "div")
                statements.push_back(statement("operator_" + name, found->second, words, lo, hi,
                                               "operator " + text));
        }
    }
    constexpr std::size_t at_once = 25; // one function each, so that optimisers see small ones
    for (std::size_t f = 0; f < files; ++f) {
        std::ofstream out{stem + '_' + std::to_string(f) + ".cpp"};
        out << "// Generated from the test vectors.\n#include \"conformance/literals.hpp\"\n"
               "#include SIVID_LITERAL_HEADER\n\nnamespace {\n\n"
               "using type = SIVID_LITERAL_TYPE;\nusing o = conformance::operations<type>;\n"
               "using conformance::inf, conformance::nan;\n";
        std::size_t const begin = statements.size() * f / files,
                          end = statements.size() * (f + 1) / files;
        std::size_t functions = 0;
        for (std::size_t i = begin; i < end; ++functions) {
            out << "\nvoid part_" << functions << "(conformance::report& r) {\n";
            for (std::size_t k = 0; k < at_once && i < end; ++k, ++i) out << statements[i];
            out << "}\n";
        }
        out << "\n}  // namespace\n\nvoid literals_" << f << "(conformance::report& r) {\n";
        if (functions == 0) out << "    static_cast<void>(r);\n";
        for (std::size_t i = 0; i < functions; ++i) out << "    part_" << i << "(r);\n";
        out << "}\n";
    }
    std::ofstream out{stem + "_main.cpp"};
    out << "// Generated from the test vectors.\n#include \"conformance/literals.hpp\"\n\n";
    for (std::size_t f = 0; f < files; ++f)
        out << "void literals_" << f << "(conformance::report&);\n";
    out << "\nint main() {\n    conformance::report r;\n";
    for (std::size_t f = 0; f < files; ++f) out << "    literals_" << f << "(r);\n";
    out << "    return conformance::conclude(r);\n}\n";
    std::cout << statements.size() << " literal checks in " << files << " files\n";
    return out ? 0 : 1;
}
