// SPDX-License-Identifier: MIT
#include "formula_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace withheld {

namespace {

class reader {
public:
    reader(std::string_view text, name_value const& value) : text_{text}, value_{value} {}

    double all() {
        double const result = either();
        skip();
        if (at_ != text_.size()) fail();
        return result;
    }

private:
    [[noreturn]] void fail() const {
        throw std::invalid_argument("cannot read \"" + std::string{text_} + "\" from \"" +
                                    std::string{text_.substr(at_)} + "\" on");
    }
    void skip() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    }
    bool takes(std::string_view what) {
        skip();
        if (!text_.substr(at_).starts_with(what)) return false;
        // "and" must not be the begin of a name.
        auto const after = at_ + what.size();
        auto const part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
        if (part(what.back()) && after < text_.size() && part(text_[after])) return false;
        at_ = after;
        return true;
    }
    void need(std::string_view what) {
        if (!takes(what)) fail();
    }
    double either() {
        double result = both();
        while (takes("or")) result = std::max(result, both());
        return result;
    }
    double both() {
        double result = comparison();
        while (takes("and")) result = std::min(result, comparison());
        return result;
    }
    double comparison() {
        double left = sum();
        if (takes("in")) {
            need("[");
            double const from = sum();
            need(",");
            double const to = sum();
            need("]");
            return std::min(left - from, to - left);
        }
        bool any = false;
        double margin = HUGE_VAL;
        for (;; any = true) {
            bool const less = takes("<=") || takes("<");
            if (!less && !takes(">=") && !takes(">")) return any ? margin : left;
            double const right = sum();
            margin = std::min(margin, less ? right - left : left - right);
            left = right;
        }
    }
    double sum() {
        double result = product();
        for (;;) {
            if (takes("+"))
                result += product();
            else if (takes("-"))
                result -= product();
            else
                return result;
        }
    }
    double product() {
        double result = signed_power();
        for (;;) {
            if (takes("*"))
                result *= signed_power();
            else if (takes("/"))
                result /= signed_power();
            else
                return result;
        }
    }
    double signed_power() { return takes("-") ? -signed_power() : power(); }
    double power() {
        double const base = primary();
        return takes("^") ? std::pow(base, std::round(primary())) : base;
    }
    double primary() {
        if (takes("(")) {
            double const inner = either();
            need(")");
            return inner;
        }
        skip();
        if (at_ == text_.size()) fail();
        char const c = text_[at_];
        if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return number();
        if (!std::isalpha(static_cast<unsigned char>(c))) fail();
        auto const from = at_;
        while (at_ < text_.size() &&
               (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
            ++at_;
        std::string const name{text_.substr(from, at_ - from)};
        return takes("(") ? function(name) : value_(name);
    }
    double number() {
        std::string const rest{text_.substr(at_)};
        char* end = nullptr;
        double const result = std::strtod(rest.c_str(), &end);
        at_ += static_cast<std::size_t>(end - rest.c_str());
        return result;
    }
    double function(std::string const& name) {
        if (name == "measured") { // what the sensor shows is all there is here
            skip();
            double const shown = either();
            need(")");
            return shown;
        }
        std::vector<double> x{either()};
        while (takes(",")) x.push_back(either());
        need(")");
        if (x.size() == 1) {
            if (name == "abs") return std::abs(x[0]);
            if (name == "sqrt") return std::sqrt(x[0]);
            if (name == "exp") return std::exp(x[0]);
            if (name == "sin") return std::sin(x[0]);
            if (name == "cos") return std::cos(x[0]);
        }
        if (x.size() == 2) {
            if (name == "min") return std::min(x[0], x[1]);
            if (name == "max") return std::max(x[0], x[1]);
            if (name == "during") {
                double const t = value_("t");
                return x[0] <= t && t < x[1] ? 1 : 0;
            }
        }
        if (x.size() == 3 && name == "clamp") return std::clamp(x[0], x[1], x[2]);
        throw std::invalid_argument("no function " + name + " of " + std::to_string(x.size()));
    }

    std::string_view text_;
    name_value const& value_;
    std::size_t at_ = 0;
};

std::string trimmed(std::string_view text) {
    auto const blank = " \t\n";
    auto const from = text.find_first_not_of(blank);
    if (from == std::string_view::npos) return {};
    return std::string{text.substr(from, text.find_last_not_of(blank) - from + 1)};
}

} // namespace

double value_of(std::string_view formula, name_value const& value) {
    return reader(formula, value).all();
}

std::map<std::string, std::string> commands_in(std::string_view law) {
    std::map<std::string, std::string> all;
    while (!law.empty()) {
        auto const end = std::min(law.find(';'), law.size());
        auto const one = law.substr(0, end);
        auto const equals = one.find('=');
        if (equals == std::string_view::npos)
            throw std::invalid_argument("a law is INPUT = FORMULA: " + std::string{one});
        all[trimmed(one.substr(0, equals))] = trimmed(one.substr(equals + 1));
        law.remove_prefix(std::min(end + 1, law.size()));
    }
    return all;
}

} // namespace withheld
