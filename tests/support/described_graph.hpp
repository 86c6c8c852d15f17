// SPDX-License-Identifier: MIT
// Reads the lines of `describe` back and computes with them.
#ifndef SIVID_TESTS_SUPPORT_DESCRIBED_GRAPH_HPP
#define SIVID_TESTS_SUPPORT_DESCRIBED_GRAPH_HPP

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace support {

/// Values by name; `compute` adds those of "%1 = a + b" and "u' = %7" lines.
class described_graph {
public:
    std::map<std::string, double> values;

    void compute(std::string const& text) {
        std::istringstream lines(text);
        std::string line;
        bool inside = false;
        while (std::getline(lines, line)) {
            if (line.rfind("graph:", 0) == 0 || line == "results") {
                inside = true;
                continue;
            }
            if (line.rfind("  ", 0) != 0) inside = false;
            if (!inside) continue;
            auto const equals = line.find("= ");
            if (equals == std::string::npos) throw std::logic_error("no formula: " + line);
            std::istringstream front(line.substr(0, equals));
            std::string name;
            front >> name;
            auto formula = line.substr(equals + 2);
            // Remarks stand behind at least two blanks.
            formula = formula.substr(0, formula.find("  "));
            values[name] = value(formula);
        }
    }

private:
    double operand(std::string const& word) const {
        if (auto const found = values.find(word); found != values.end()) return found->second;
        if (word[0] == '[') { // the middle of [lo, hi]
            auto const comma = word.find(',');
            return 0.5 * (std::strtod(word.c_str() + 1, nullptr) +
                          std::strtod(word.c_str() + comma + 1, nullptr));
        }
        char* end = nullptr;
        double const x = std::strtod(word.c_str(), &end);
        if (*end != 0 || word.empty()) throw std::logic_error("no value: " + word);
        return x;
    }
    /// Up to the blank, comma or end outside brackets.
    static std::string word(std::string const& text, std::size_t& at) {
        std::size_t const begin = at;
        bool bracket = false;
        while (at < text.size() &&
               (bracket || (text[at] != ' ' && text[at] != ',' && text[at] != '(' &&
                            text[at] != ')' && (text[at] != '^' || at == begin)))) {
            bracket = (bracket || text[at] == '[') && text[at] != ']';
            ++at;
        }
        return text.substr(begin, at - begin);
    }
    double value(std::string const& f) const {
        std::size_t at = 0;
        if (f[0] == '-' && f.find(' ') == std::string::npos && f.size() > 1 &&
            (f[1] == '%' || std::isalpha(static_cast<unsigned char>(f[1])) != 0)) {
            return -operand(f.substr(1));
        }
        auto const first = word(f, at);
        if (at == f.size()) return operand(first);
        if (f[at] == '^') return std::pow(operand(first), std::strtod(f.c_str() + at + 1, nullptr));
        if (f[at] == '(') {
            ++at;
            double const a = operand(word(f, at));
            double b = 0;
            if (f[at] == ',') {
                at += 2;
                b = operand(word(f, at));
            }
            return function(first, a, b);
        }
        char const op = f[at + 1];
        at += 3;
        double const a = operand(first);
        double const b = operand(word(f, at));
        if (at != f.size()) throw std::logic_error("not read to the end: " + f);
        return op == '+' ? a + b : op == '-' ? a - b : op == '*' ? a * b : a / b;
    }
    static double function(std::string const& name, double a, double b) {
        if (name == "sqrt") return std::sqrt(a);
        if (name == "exp") return std::exp(a);
        if (name == "log") return std::log(a);
        if (name == "sin") return std::sin(a);
        if (name == "cos") return std::cos(a);
        if (name == "tan") return std::tan(a);
        if (name == "atan") return std::atan(a);
        if (name == "tanh") return std::tanh(a);
        if (name == "abs") return std::abs(a);
        if (name == "sign") return a > 0 ? 1 : a < 0 ? -1 : 0;
        if (name == "min") return std::min(a, b);
        if (name == "max") return std::max(a, b);
        throw std::logic_error("no such function: " + name);
    }
};

} // namespace support

#endif
