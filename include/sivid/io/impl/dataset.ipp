// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DATASET_IPP
#define SIVID_IO_IMPL_DATASET_IPP

#include <sivid/io/dataset.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/detail/dataset_tables.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

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
                         "scenarios", "effects", "assumptions"});
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
        read_scenarios(root.at("scenarios"), result);
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
            auto const& unit = model_.constants[index].unit;
            if (auto const* stated = entry.find("unit");
                stated != nullptr && !same_unit(stated->any_string(), unit))
                stated->fail(text_of("the unit ", in_quotes(stated->any_string()),
                                     " differs from the model's ", in_quotes(unit)),
                             "convert the prior and state the model's unit");
            result.parameters.push_back(
                {index, name, unit, mapping_entries::range(entry.at("prior"), "prior")});
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
            auto const value = entry.number();
            result.fixed.push_back({index, value, *enclose(value)});
        }
    }

    void read_scenarios(json_value const& list, dataset& result) const {
        for (auto const& entry : list.elements()) {
            auto next = read_scenario(entry);
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

    [[nodiscard]] scenario read_scenario(json_value const& entry) const {
        entry.allow_only({"name", "role", "duration", "inputs", "interpolation", "measurements",
                          "initial", "bridged"});
        scenario result;
        result.name = mapping_entries::file_name(entry.at("name"));
        result.role = entry.at("role").is_second_of("fit", "holdout") ? scenario_role::holdout
                                                                      : scenario_role::fit;
        result.duration = *nearest(mapping_entries::duration(entry.at("duration")));

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
                read_inputs(csv_table::read(file("inputs")), model_, kind, result.duration);
        }
        if (auto const* bridged = entry.find("bridged")) read_bridged(*bridged, result);
        read_measurements(csv_table::read(measurements), model_, result);
        if (result.measurements.empty())
            entry.at("measurements")
                .fail("the scenario has no measurement", "every scenario needs at least one value");
        return result;
    }

    /// What stands where samples of an input are missing: each gap lies between two samples.
    void read_bridged(json_value const& list, scenario& result) const {
        for (std::size_t i = 0; i < list.members().size(); ++i) {
            auto const& entry = list.members()[i];
            auto const index =
                mapping_entries::index_of(model_.inputs, list.name_of(i), entry, "input");
            entry.allow_only({"samples", "gaps"});
            auto& input = result.inputs.at(index);
            auto const& times = input.signal.times();
            for (auto const& gap : entry.at("gaps").elements()) {
                auto const [from, to] = mapping_entries::ends(gap, "gap");
                std::pair const ends{*nearest(from), *nearest(to)};
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
            auto const range = mapping_entries::range(entry, "initial value");
            result.initial[index] = {range.enclosure, range};
        }
    }

    static bool same_unit(std::string const& a, std::string const& b) {
        auto const none = [](std::string const& unit) {
            return unit.empty() || unit == "1" || unit == "-";
        };
        return a == b || (none(a) && none(b));
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
