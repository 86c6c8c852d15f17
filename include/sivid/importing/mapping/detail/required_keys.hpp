// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_MAPPING_DETAIL_REQUIRED_KEYS_HPP
#define SIVID_IMPORTING_MAPPING_DETAIL_REQUIRED_KEYS_HPP

#include <sivid/io/text/json_document.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Finds every key that a mapping lacks, so that all are named at once; users call
/// require_mapping_keys. What is of a wrong type is left to the reader.
class required_keys {
public:
    explicit required_keys(json_value const& root) {
        all(root, {{"id", ""},
                   {"model", "the name of the model"},
                   {"parameters",
                    "the unknown constants, each with its prior, whatever a model's file says"},
                   {"max_outlier_fraction", "0 if no measurement violates its bound"},
                   {"scenarios", ""}});
        for (auto const& p : members(root.find("parameters"))) all(p, {{"prior", ""}});
        defaults_ = object(root.find("defaults"));
        auto const* list = root.find("scenarios");
        if (list == nullptr || list->type() != json_value::kind::array) return;
        for (auto const& s : list->elements())
            if (object(&s) != nullptr) scenario(s);
    }

    struct missing_key {
        std::string pointer, hint;
        [[nodiscard]] friend bool operator==(missing_key const&, missing_key const&) = default;
    };

    [[nodiscard]] std::vector<missing_key> const& missing() const { return missing_; }

private:
    using keys = std::vector<std::pair<char const*, char const*>>;

    static json_value const* object(json_value const* v) {
        return v != nullptr && v->type() == json_value::kind::object ? v : nullptr;
    }
    static std::vector<json_value> members(json_value const* v) {
        return object(v) != nullptr ? v->members() : std::vector<json_value>{};
    }
    void all(json_value const& entry, keys const& wanted) {
        if (object(&entry) == nullptr) return;
        for (auto const& [key, hint] : wanted) {
            if (entry.find(key) != nullptr) continue;
            missing_key one{entry.place().pointer + "/" + key, hint};
            if (std::find(missing_.begin(), missing_.end(), one) == missing_.end())
                missing_.push_back(std::move(one));
        }
    }
    [[nodiscard]] json_value const* either(json_value const& s, char const* key) const {
        auto const* own = s.find(key);
        return own != nullptr || defaults_ == nullptr ? own : defaults_->find(key);
    }

    void scenario(json_value const& s) {
        auto const get = [&](char const* key) { return either(s, key); };
        auto const* further = get("further_files");
        all(s, {{"name", ""}});
        keys wanted{{"file", "relative to the mapping"},
                    {"time", "its column, unit and offset, or a sample time"}};
        if (further == nullptr)
            wanted.emplace_back("channels", "what is measured, by the model's names");
        for (auto const& key : wanted)
            if (get(key.first) == nullptr) all(s, {key});
        bool any = file(get);
        wanted = {wanted[0], wanted[1], {"clock", "how it differs from that of the first file"}};
        if (further != nullptr && further->type() == json_value::kind::array)
            for (auto const& f : further->elements()) {
                if (object(&f) == nullptr) continue;
                all(f, wanted);
                any = file([&](char const* key) { return f.find(key); }) || any;
                if (auto const* clock = object(f.find("clock")))
                    all(*clock, {{"offset", "what to add in the middle of the file, in seconds: a "
                                            "number or the range that it is in"}});
            }
        if (any && get("interpolation") == nullptr)
            all(s, {{"interpolation", "linear or hold, between the readings of an input"}});
        starts(either(s, "initial"));
        starts(either(s, "initial_after_break"));
        if (auto const* windows = object(either(s, "windows"))) {
            all(*windows, {{"length", "of a window, in seconds"}});
            starts(windows->find("initial"));
        }
    }
    /// @param get  an entry of the file. @returns whether it holds inputs
    template <class Get>
    bool file(Get const& get) {
        auto const* inputs = object(get("inputs"));
        for (auto const& q : members(inputs)) all(q, {{"column", ""}});
        for (auto const& q : members(get("channels")))
            all(q, {{"column", ""}, {"error", "the bound of its error, or \"propose\""}});
        if (auto const* source = object(get("source")))
            if (auto const* kind = source->find("kind"); kind != nullptr &&
                                                         kind->type() == json_value::kind::string &&
                                                         kind->raw_string() == "serial")
                all(*source, {{"fields", "what a line holds"},
                              {"longest_gap", "the longest usual time between lines, in seconds"}});
        if (auto const* time = object(get("time"));
            time != nullptr && time->find("sample_time") == nullptr)
            all(*time, {{"column", "or sample_time, the time from row to row"},
                        {"unit", ""},
                        {"offset", "where t = 0 lies: \"first\" for the first row, or what is "
                                   "added to the times, in seconds"}});
        return inputs != nullptr && !inputs->members().empty();
    }
    void starts(json_value const* list) {
        for (auto const& entry : members(list)) {
            if (object(&entry) == nullptr || entry.find("range") != nullptr) continue;
            if (entry.find("rate_of") != nullptr && entry.find("jerk") == nullptr)
                all(entry, {{"acceleration", "how fast the rate itself changes at most, or jerk, "
                                             "how fast the acceleration does: without one of "
                                             "them differences bound no rate"}});
            else if (entry.find("rate_of") == nullptr)
                all(entry, {{"channel", "or rate_of"}});
        }
    }

    json_value const* defaults_ = nullptr;
    std::vector<missing_key> missing_;
};

/// @throws input_error  that names every missing key of a mapping
inline void require_mapping_keys(json_value const& root) {
    auto const missing = required_keys{root}.missing();
    if (missing.empty()) return;
    constexpr std::size_t longest = 900; // of a message; hints only where they fit
    std::string plain, hinted;
    for (auto const& m : missing) {
        auto const separator = plain.empty() ? "" : "; ";
        if (plain.size() < longest) plain += separator + m.pointer;
        hinted += separator + m.pointer + (m.hint.empty() ? "" : " (" + m.hint + ")");
    }
    auto const& text = hinted.size() < longest ? hinted : plain;
    root.fail(text_of(missing.size() == 1 ? "a key is missing: "
                                          : std::to_string(missing.size()) + " keys are missing: ",
                      text),
              missing.size() == 1 ? "add it" : "add them");
}

} // namespace sivid

#endif // SIVID_IMPORTING_MAPPING_DETAIL_REQUIRED_KEYS_HPP
