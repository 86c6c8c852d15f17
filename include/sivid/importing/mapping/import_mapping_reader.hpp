// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_MAPPING_IMPORT_MAPPING_READER_HPP
#define SIVID_IMPORTING_MAPPING_IMPORT_MAPPING_READER_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/mapping/detail/clock_mapping_reader.hpp>
#include <sivid/importing/mapping/detail/required_keys.hpp>
#include <sivid/importing/mapping/detail/source_form_reader.hpp>
#include <sivid/importing/mapping/detail/window_mapping_reader.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/dataset/stated_unit.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/text/json_document.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Reads the format sivid-mapping-1; users call read_import_mapping or import_mapping_from_text.
class import_mapping_reader {
public:
    explicit import_mapping_reader(std::filesystem::path file) : file_{std::move(file)} {}

    [[nodiscard]] import_mapping read(json_value const& root) {
        mapping_entries::require_format(root, "sivid-mapping-1");
        root.allow_only({"format", "id", "model", "parameters", "fixed", "max_outlier_fraction",
                         "effects", "defaults", "scenarios"});
        require_mapping_keys(root);
        import_mapping result;
        result.file = file_;
        result.id = root.at("id").string();
        result.model = root.at("model").string();
        read_constants(root, result);
        result.max_outlier_fraction =
            mapping_entries::outlier_fraction(root.at("max_outlier_fraction"));
        if (auto const* list = root.find("effects")) result.effects = read_dataset_effects(*list);
        if (auto const* d = root.find("defaults")) {
            d->allow_only({"role", "file", "source", "time", "duration", "interpolation", "inputs",
                           "channels", "further_files", "initial", "initial_after_break", "windows",
                           "thin"});
            defaults_ = d;
        }
        for (auto const& entry : root.at("scenarios").elements()) {
            auto next = read_scenario(entry);
            for (auto const& s : result.scenarios)
                if (s.name == next.name)
                    entry.at("name").fail("the name appears twice", "give each its own name");
            result.scenarios.push_back(std::move(next));
        }
        check_together(root.at("scenarios"), result);
        return result;
    }

private:
    static void read_constants(json_value const& root, import_mapping& result) {
        auto const& list = root.at("parameters");
        for (std::size_t i = 0; i < list.members().size(); ++i) {
            auto const& entry = list.members()[i];
            entry.allow_only({"prior", "unit"});
            auto const* unit = entry.find("unit");
            if (unit != nullptr) (void)read_unit(*unit);
            result.parameters.push_back({list.name_of(i), unit ? unit->any_string() : "",
                                         mapping_entries::range(entry.at("prior"))});
        }
        if (result.parameters.empty())
            list.fail("no parameter is unknown", "list at least one constant with its prior");
        auto const* fixed = root.find("fixed");
        if (fixed == nullptr) return;
        for (std::size_t i = 0; i < fixed->members().size(); ++i) {
            auto const& entry = fixed->members()[i];
            for (auto const& p : result.parameters)
                if (p.name == fixed->name_of(i))
                    entry.fail(in_quotes(p.name) + " is fixed and a parameter",
                               "keep one of the two");
            bool const plain = entry.type() != json_value::kind::object;
            if (!plain) entry.allow_only({"value", "unit"});
            auto const value = (plain ? entry : entry.at("value")).number();
            auto const* unit = plain ? nullptr : entry.find("unit");
            if (unit != nullptr) (void)read_unit(*unit);
            result.fixed.push_back(
                {fixed->name_of(i), value, *enclose(value), unit ? unit->any_string() : ""});
        }
    }

    /// The scenario's own entry, or that of the defaults, or nullptr.
    [[nodiscard]] json_value const* either(json_value const& scenario, char const* key) const {
        if (auto const* own = scenario.find(key)) return own;
        return defaults_ == nullptr ? nullptr : defaults_->find(key);
    }
    [[nodiscard]] json_value const& need(json_value const& scenario, char const* key) const {
        auto const* found = either(scenario, key);
        return found == nullptr ? scenario.at(key) : *found; // at() says that it is missing
    }

    [[nodiscard]] scenario_mapping read_scenario(json_value const& entry) const {
        entry.allow_only({"name", "role", "file", "source", "time", "duration", "interpolation",
                          "inputs", "channels", "further_files", "initial", "initial_after_break",
                          "windows", "thin"});
        scenario_mapping result;
        result.place = entry.place();
        result.name = mapping_entries::name(entry.at("name"), entry.at("name").string());
        if (auto const* role = either(entry, "role"); role && role->is_second_of("fit", "holdout"))
            result.role = scenario_role::holdout;
        auto const* source = either(entry, "source");
        read_file(need(entry, "file"), source, need(entry, "time"), result);
        bool const splits =
            result.form.gap == break_policy::split || result.form.restart == break_policy::split;
        if (splits && !result.time.from_first)
            need(entry, "time")
                .fail("a log that is split has no common offset of the time",
                      "state \"offset\": \"first\"");
        if (auto const* duration = either(entry, "duration"))
            result.duration = mapping_entries::duration(*duration);
        if (auto const* between = either(entry, "interpolation");
            between && between->is_second_of("linear", "hold"))
            result.between = interpolation::hold;
        if (auto const* inputs = either(entry, "inputs")) result.inputs = quantities(*inputs, true);
        auto const* further = either(entry, "further_files");
        auto const& channels = further != nullptr && either(entry, "channels") == nullptr
                                   ? *further
                                   : need(entry, "channels");
        if (&channels != further) {
            result.channels = quantities(channels, false);
            for (auto const& q : channels.members())
                if (auto const* e = q.find("time_error")) (void)e->at("within");
        }
        if (further != nullptr)
            for (auto const& file : further->elements()) add_further(file, result);
        if (result.channels.empty())
            channels.fail("no channel is measured", "map at least one channel of the model");
        if (auto const* initial = either(entry, "initial"))
            result.initial = read_starts(*initial, result.channels);
        if (auto const* after = either(entry, "initial_after_break"))
            result.initial_after_break = read_starts(*after, result.channels);
        if (auto const* thin = either(entry, "thin"))
            result.thin = mapping_entries::whole(*thin, 1, 1'000'000);
        if (auto const* windows = either(entry, "windows")) {
            result.windows = read_window_mapping(*windows, result.channels);
            if (result.role == scenario_role::holdout && windows->find("holdout") != nullptr)
                windows->at("holdout").fail("the whole scenario is held out",
                                            "remove this, or make the scenario's role fit");
        }
        return result;
    }

    void read_file(json_value const& file, json_value const* source, json_value const& time,
                   scenario_mapping& result) const {
        std::filesystem::path const stated{file.string()};
        result.file = stated.is_absolute() ? stated : file_.parent_path() / stated;
        if (source != nullptr) result.form = read_source_form(*source);
        result.time = read_time_mapping(time, result.form.from == source_form::kind::serial);
        if (result.form.from == source_form::kind::matlab && result.time.form != time_form::number)
            time.at("unit").fail("texts, and MATLAB files hold numbers",
                                 "write s, ms, us, ns, min or h");
    }

    /// A further file of a scenario, whose quantities join those of the first one.
    void add_further(json_value const& entry, scenario_mapping& scenario) const {
        entry.allow_only({"file", "source", "time", "clock", "inputs", "channels"});
        scenario_mapping f;
        f.place = entry.place();
        read_file(entry.at("file"), entry.find("source"), entry.at("time"), f);
        f.name = text_of(scenario.name, "/", f.file.filename().string());
        f.between = scenario.between;
        if (f.form.gap == break_policy::split || f.form.restart == break_policy::split)
            entry.at("source").fail("a further file is not split", "write refuse, keep or drop");
        std::optional<quantity_mapping> there;
        f.clock = read_clock_mapping(entry.at("clock"), there);
        if (f.clock->here) f.watched.push_back(*f.clock->here);
        f.clock->there = scenario.watched.size();
        if (there) scenario.watched.push_back(*there);
        auto const join = [&](char const* key,
                              std::vector<quantity_mapping> scenario_mapping::*to) {
            auto const* list = entry.find(key);
            if (list == nullptr) return;
            f.*to = quantities(*list, to == &scenario_mapping::inputs);
            for (auto q : f.*to) {
                for (auto const& other : scenario.*to)
                    if (other.name == q.name)
                        list->fail(text_of(in_quotes(q.name), " stands in two files"),
                                   "keep one of them");
                q.elsewhere = true;
                (scenario.*to).push_back(std::move(q));
            }
        };
        join("inputs", &scenario_mapping::inputs);
        join("channels", &scenario_mapping::channels);
        if (f.inputs.empty() && f.channels.empty())
            entry.fail("nothing of the file is used", "map \"inputs\" or \"channels\" of it");
        scenario.further.push_back(std::move(f));
    }

    static std::vector<quantity_mapping> quantities(json_value const& list, bool inputs) {
        std::vector<quantity_mapping> result;
        for (std::size_t i = 0; i < list.members().size(); ++i) {
            auto const& entry = list.members()[i];
            auto q = read_quantity_mapping(entry, list.name_of(i), inputs);
            for (auto const& other : result)
                if (other.name == q.name + "_err" || q.name == other.name + "_err")
                    entry.fail(text_of("the name ", in_quotes(q.name), " and ",
                                       in_quotes(other.name), " cannot be told apart in a table"),
                               "rename one of them");
            result.push_back(std::move(q));
        }
        return result;
    }

    static void check_together(json_value const& list, import_mapping const& mapping) {
        if (std::none_of(mapping.scenarios.begin(), mapping.scenarios.end(),
                         [](auto const& s) { return s.role == scenario_role::fit; }))
            list.fail("no scenario has the role fit", "identification needs at least one");
        for (std::size_t i = 0; i < mapping.scenarios.size(); ++i) {
            auto const& first = mapping.scenarios.front().inputs;
            auto const& these = mapping.scenarios[i].inputs;
            bool same = first.size() == these.size();
            for (auto const& q : first)
                same = same && std::any_of(these.begin(), these.end(),
                                           [&](auto const& p) { return p.name == q.name; });
            if (!same)
                list.elements()[i].fail("the inputs differ from those of the first scenario",
                                        "map every input of the model in every scenario");
            for (auto const& q : mapping.scenarios[i].channels)
                if (q.curved && !mapping.max_outlier_fraction.is_zero())
                    list.elements()[i].fail(
                        text_of("\"time_error\" of ", in_quotes(q.name),
                                " bounds slopes by readings, and some may be outliers"),
                        "state \"rate\" in place of \"acceleration\"");
            check_units(list.elements()[i], mapping, i, &scenario_mapping::inputs);
            check_units(list.elements()[i], mapping, i, &scenario_mapping::channels);
        }
    }

    /// A data set has one unit for each quantity: that of scenario `i` is that of those before.
    static void check_units(json_value const& entry, import_mapping const& mapping, std::size_t i,
                            std::vector<quantity_mapping> scenario_mapping::*list) {
        auto const stated = [](std::string const& unit) {
            return unit.empty() ? std::string{"no unit"} : in_quotes(unit);
        };
        for (auto const& q : mapping.scenarios[i].*list)
            for (std::size_t k = 0; k < i; ++k)
                for (auto const& other : mapping.scenarios[k].*list)
                    if (other.name == q.name && other.unit != q.unit)
                        entry.fail(text_of(in_quotes(q.name), " has ", stated(q.unit), " here and ",
                                           stated(other.unit), " in ",
                                           in_quotes(mapping.scenarios[k].name)),
                                   "state the same unit, and convert by \"factor\"");
    }

    std::filesystem::path file_;
    json_value const* defaults_ = nullptr;
};

/// Reads a mapping.
/// @throws input_error  for the first defect, with file, pointer and remedy
[[nodiscard]] inline import_mapping read_import_mapping(std::filesystem::path const& file) {
    return import_mapping_reader{file}.read(read_json(file));
}
/// The same from a text.
/// @param name  of the text, for messages; files are looked for beside it
[[nodiscard]] inline import_mapping import_mapping_from_text(std::string const& text,
                                                             std::string const& name) {
    return import_mapping_reader{name}.read(parse_json(name, text));
}

} // namespace sivid

#endif // SIVID_IMPORTING_MAPPING_IMPORT_MAPPING_READER_HPP
