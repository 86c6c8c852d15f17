// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DATASET_IPP
#define SIVID_IO_IMPL_DATASET_IPP

#include <sivid/io/dataset.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/detail/dataset_tables.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset/stated_unit.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid {

/// Reads the folder of a data set in the format sivid-dataset-1.
/// One instance reads one folder; users call read_dataset.
class dataset_reader {
public:
    dataset_reader(std::filesystem::path folder, model_names const& model)
        : folder_{std::move(folder)}, model_{model} {}

    [[nodiscard]] dataset read() const {
        auto const root = read_json(folder_ / "dataset.json");
        root.allow_only({"format", "id", "model", "parameters", "fixed", "max_outlier_fraction",
                         "time_unit", "channel_units", "input_units", "scenarios", "effects",
                         "assumptions"});
        mapping_entries::require_format(root, "sivid-dataset-1");
        dataset result;
        result.id = root.at("id").string();
        result.model = root.at("model").string();
        if (result.model != model_.name)
            root.at("model").fail(text_of("unknown model ", in_quotes(result.model)),
                                  "known here: " + model_.name);
        read_parameters(root.at("parameters"), result);
        if (auto const* fixed = root.find("fixed")) read_fixed(*fixed, result);
        result.max_outlier_fraction =
            mapping_entries::outlier_fraction(root.at("max_outlier_fraction"));
        read_scenarios(root.at("scenarios"), read_units(root), result);
        if (auto const* list = root.find("effects")) result.effects = read_dataset_effects(*list);
        if (auto const* list = root.find("assumptions"))
            for (auto const& a : list->elements()) result.assumptions.push_back(a.string());
        return result;
    }

private:
    [[nodiscard]] std::size_t constant(json_value const& entry, std::string const& name) const {
        return mapping_entries::index_of(model_.constants, name, entry, "constant");
    }

    void read_parameters(json_value const& list, dataset& result) const {
        for (std::size_t i = 0; i < list.members().size(); ++i) {
            auto const& entry = list.members()[i];
            auto const& name = list.name_of(i);
            auto const index = constant(entry, name);
            entry.allow_only({"prior", "unit"});
            auto const& own = model_.constants[index];
            result.parameters.push_back(
                {index, name, own.unit,
                 range(entry.at("prior"), entry.find("unit"), own, "constant", "prior")});
        }
        if (result.parameters.empty())
            list.fail("no parameter is unknown",
                      "list at least one constant, with a prior of zero width if it is known");
    }

    void read_fixed(json_value const& list, dataset& result) const {
        for (std::size_t i = 0; i < list.members().size(); ++i) {
            auto const& entry = list.members()[i];
            auto const& name = list.name_of(i);
            auto const index = constant(entry, name);
            for (auto const& parameter : result.parameters)
                if (parameter.constant == index)
                    entry.fail(in_quotes(name) + " is fixed and a parameter",
                               "keep one of the two");
            bool const plain = entry.type() != json_value::kind::object;
            if (!plain) entry.allow_only({"value", "unit"});
            auto const& number = plain ? entry : entry.at("value");
            auto const value = number.number();
            auto const unit =
                unit_of(plain ? nullptr : entry.find("unit"), model_.constants[index], "constant");
            auto const range = unit.range(value, value);
            if (!range)
                number.fail("beyond the range of double in the model's unit", "check the unit");
            result.fixed.push_back({index, value, range->enclosure, unit.name()});
        }
    }

    /// @param stated  the entry of the unit; nullptr: the model's
    /// @param kind    of quantity, for messages
    [[nodiscard]] static stated_unit unit_of(json_value const* stated, name_unit const& own,
                                             std::string const& kind) {
        if (stated == nullptr) return {};
        return {*stated, own.unit, text_of("the ", kind, " ", in_quotes(own.name))};
    }
    /// A range in the unit that stands beside it.
    [[nodiscard]] static stated_range range(json_value const& entry, json_value const* unit,
                                            name_unit const& own, std::string const& kind,
                                            std::string_view what) {
        auto const plain = mapping_entries::range(entry, what);
        auto const result = unit_of(unit, own, kind).range(plain.lower, plain.upper);
        if (!result || mag(result->enclosure) > farthest_range)
            entry.fail(text_of("in the model's unit the ", what, " reaches beyond 1e100"),
                       "check its unit");
        return *result;
    }

    [[nodiscard]] stated_units read_units(json_value const& root) const {
        stated_units units;
        if (auto const* time = root.find("time_unit"))
            units.time = {*time, model_.time_unit, "the time"};
        auto const read = [&](char const* key, std::vector<name_unit> const& names,
                              std::string const& kind, std::vector<stated_unit>& to) {
            auto const* list = root.find(key);
            if (list == nullptr) return;
            to.resize(names.size());
            for (std::size_t i = 0; i < list->members().size(); ++i) {
                auto const& entry = list->members()[i];
                auto const k = mapping_entries::index_of(names, list->name_of(i), entry, kind);
                to[k] = unit_of(&entry, names[k], kind);
            }
        };
        read("channel_units", model_.channels, "channel", units.channels);
        read("input_units", model_.inputs, "input", units.inputs);
        return units;
    }

    void read_scenarios(json_value const& list, stated_units const& units, dataset& result) const {
        for (auto const& entry : list.elements()) {
            auto next = read_scenario(entry, units);
            for (auto const& earlier : result.scenarios)
                if (earlier.name == next.name)
                    entry.at("name").fail(
                        text_of("the scenario ", in_quotes(next.name), " appears twice"),
                        "give each its own name");
            result.scenarios.push_back(std::move(next));
        }
        auto const is_fit = [](scenario const& s) { return s.role == scenario_role::fit; };
        if (std::none_of(result.scenarios.begin(), result.scenarios.end(), is_fit))
            list.fail("no scenario has the role fit", "identification needs at least one");
    }

    [[nodiscard]] scenario read_scenario(json_value const& entry, stated_units const& units) const {
        entry.allow_only({"name", "role", "duration", "inputs", "interpolation", "measurements",
                          "initial", "bridged"});
        scenario result;
        result.name = mapping_entries::file_name(entry.at("name"));
        result.role = entry.at("role").is_second_of("fit", "holdout") ? scenario_role::holdout
                                                                      : scenario_role::fit;
        auto const duration = units.time.nearest(mapping_entries::duration(entry.at("duration")));
        if (!duration || !(*duration > 0))
            entry.at("duration").fail("no duration in the model's unit of time", "check time_unit");
        result.duration = *duration;

        // A model without inputs needs no file of them.
        bool const driven = !model_.inputs.empty() || entry.find("inputs") != nullptr;
        auto const* between = driven ? &entry.at("interpolation") : entry.find("interpolation");
        auto const kind = between != nullptr && between->is_second_of("linear", "hold")
                              ? interpolation::hold
                              : interpolation::linear;
        auto const file = [&](char const* key) {
            auto const& value = entry.at(key);
            auto const path = path_inside(folder_, value.string(), value.place());
            if (std::error_code fault; !std::filesystem::exists(path, fault))
                value.fail(text_of("there is no file ", in_quotes(value.string())),
                           "check the name");
            return path;
        };
        auto const measurements = file("measurements");
        read_initial(entry.at("initial"), result);
        if (driven) {
            result.inputs =
                read_inputs(csv_table::read(file("inputs")), model_, kind, result.duration, units);
        }
        if (auto const* bridged = entry.find("bridged")) read_bridged(*bridged, result, units.time);
        read_measurements(csv_table::read(measurements), model_, result, units);
        if (result.measurements.empty())
            entry.at("measurements")
                .fail("the scenario has no measurement", "every scenario needs at least one value");
        return result;
    }

    /// What stands where samples of an input are missing: each gap lies between two samples.
    void read_bridged(json_value const& list, scenario& result, stated_unit const& time) const {
        for (std::size_t i = 0; i < list.members().size(); ++i) {
            auto const& entry = list.members()[i];
            auto const index =
                mapping_entries::index_of(model_.inputs, list.name_of(i), entry, "input");
            entry.allow_only({"samples", "gaps"});
            auto& input = result.inputs.at(index);
            auto const& times = input.signal.times();
            for (auto const& gap : entry.at("gaps").elements()) {
                auto const [from, to] = mapping_entries::ends(gap, "gap");
                std::pair const ends{time.nearest(from).value_or(-HUGE_VAL),
                                     time.nearest(to).value_or(HUGE_VAL)}; // beyond any sample
                auto const next = std::upper_bound(times.begin(), times.end(), ends.first);
                if (next == times.begin() || next == times.end() ||
                    *std::prev(next) != ends.first || *next != ends.second)
                    gap.fail(text_of("the gap [", from.text(), ", ", to.text(),
                                     "] does not go from one sample of ",
                                     in_quotes(list.name_of(i)), " to the next"),
                             "state the times of the samples around what is missing");
                if (!input.bridged.empty() && !(input.bridged.back().second <= ends.first))
                    gap.fail("the gaps do not follow each other", "state each once, by time");
                input.bridged.push_back(ends);
            }
            if (input.bridged.empty()) entry.at("gaps").fail("no gap", "leave the input out");
            input.missing = mapping_entries::whole(entry.at("samples"), input.bridged.size(),
                                                   std::numeric_limits<std::int32_t>::max());
        }
    }

    void read_initial(json_value const& list, scenario& result) const {
        for (std::size_t i = 0; i < model_.states.size(); ++i)
            result.initial.push_back({model_.state_ranges.at(i), std::nullopt});
        for (std::size_t i = 0; i < list.members().size(); ++i) {
            auto const& entry = list.members()[i];
            auto const index =
                mapping_entries::index_of(model_.states, list.name_of(i), entry, "state");
            bool const plain = entry.type() != json_value::kind::object;
            if (!plain) entry.allow_only({"range", "unit"});
            auto const start =
                range(plain ? entry : entry.at("range"), plain ? nullptr : entry.find("unit"),
                      model_.states[index], "state", "initial value");
            auto const& own = model_.state_ranges.at(index);
            if (disjoint(start.enclosure, own))
                entry.fail(text_of("the state never is where the model keeps it, from ",
                                   nearest_text(own.lower(), 6), " to ",
                                   nearest_text(own.upper(), 6)),
                           "correct it, or widen the state's range in the model");
            result.initial[index] = {start.enclosure, start};
        }
    }

    std::filesystem::path folder_;
    model_names const& model_;
};

SIVID_DECL dataset read_dataset(std::filesystem::path const& folder, model_names const& model) {
    std::error_code fault;
    if (!std::filesystem::is_directory(folder, fault))
        throw input_error{
            {.file = folder.string()}, "no such folder", "give the folder that holds dataset.json"};
    return dataset_reader{folder, model}.read();
}

} // namespace sivid

#endif
