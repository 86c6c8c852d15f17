// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_EXPORT_IPP
#define SIVID_APP_IMPL_EXPORT_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/proved_member.hpp>
#include <sivid/app/program.hpp>
#include <sivid/decision/design/design_goal.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/io/dataset/unit_conversion.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/simulator/robot_file.hpp>
#include <sivid/io/text/json_writer.hpp>
#ifdef SIVID_HAS_EXPAT
#include <sivid/io/simulator/xml_reader.hpp>
#endif
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid::app {

namespace detail {

/// What an attribute becomes, in the unit of its file.
struct exported_attribute {
    export_entry const* what = nullptr;
    std::vector<interval> at, over; ///< at the member; over all that may explain the data
    std::vector<double> numbers;    ///< those that are written
    std::string unit;
    bool exact = true; ///< the numbers are the member's, nothing was rounded

    [[nodiscard]] std::string written() const {
        return joined(numbers, " ", [](double x) { return nearest_text(x); });
    }
    /// "damping 0.3 N m s/rad of Fv, proved within [0.28, 0.31]"
    [[nodiscard]] std::string words() const {
        return what->attribute + (what->part ? " (" + std::to_string(*what->part) + ") " : " ") +
               written() + " " + (unit.empty() ? unit : unit + " ") + "of " +
               joined(what->values, ", ") + ", proved within " +
               joined(over, ", ", [](interval const& x) { return to_string(x, 6); });
    }
};

/// Evaluates the expressions of a mapping at a member, and over all that may explain the data.
class export_values {
    using traits = interval_traits<interval>;

public:
    explicit export_values(proved_member const& m)
        : of_{m},
          model_{m.problem.model},
          at_(constant_ranges(model_, m.problem.choice, point_box(m.point))),
          over_(constant_ranges(model_, m.problem.choice, m.hull)) {}

    [[nodiscard]] exported_attribute operator()(export_entry const& e) {
        exported_attribute result;
        result.what = &e;
        for (auto const& text : e.values) {
            auto [at, over, own] = evaluated(e, text);
            if (auto const convert = conversion(e, own, result.unit)) {
                at = converted(at, *convert);
                over = converted(over, *convert);
            }
            if (!is_bounded(at)) e.place.fail("no finite number: " + text, "correct the value");
            double number = readable(at);
            if (e.step) number = in_steps(e, at, over, result.unit);
            // Ranges, gears and products of inertia may have either sign.
            bool const signless = e.rule != nullptr && e.rule->most == 1 &&
                                  !e.rule->units.empty() && !e.attribute.starts_with("i");
            if (signless && number < 0)
                e.place.fail(e.title() + " would be " + nearest_text(number),
                             "narrow the prior to what is possible, and work it out anew");
            result.exact = result.exact && at.lower() == number && at.upper() == number;
            result.at.push_back(at);
            result.over.push_back(over);
            result.numbers.push_back(number);
        }
        return result;
    }

    /// {"Fv": {"value": v, "range": [lower, upper], "unit": u}, ...}: every constant of the model.
    void write_constants(json_writer& json) const {
        auto const& about = model_.about.constants;
        json.key("constants").begin_object();
        for (std::size_t k = 0; k < about.size(); ++k)
            json.key(about[k].name)
                .object("value", readable(at_[k]), "range", over_[k], "unit", about[k].unit);
        json.end_object();
    }
    /// The unknown constants that no expression had, in words.
    [[nodiscard]] std::vector<std::string> unused() const {
        std::vector<std::string> result;
        auto const& about = model_.about.constants;
        for (auto const& name : of_.problem.choice.unknown) {
            auto const k = index_of(about, name, "constant");
            if (used_.count(k) == 0)
                result.push_back(name + " = " + nearest_text(readable(at_[k])) + " " +
                                 about[k].unit + ", proved within " + to_string(over_[k], 6));
        }
        return result;
    }

private:
    /// A double of the interval: the one with the shortest decimal.
    [[nodiscard]] static double readable(interval const& x) {
        return few_digits(x.lower(), x.upper(), mid(x), width(x));
    }
    struct evaluation {
        interval at, over;
        std::string unit;
    };
    [[nodiscard]] evaluation evaluated(export_entry const& e, std::string const& text) {
        auto const& about = model_.about.constants;
        auto const own = std::ranges::find(about, text, &model_description::constant::name);
        auto const unit = own == about.end() ? e.unit : own->unit;
        if (!e.unit.empty() && !(sivid::unit(e.unit) == sivid::unit(unit)))
            e.place.fail("the unit of " + text + " is the model's, " + in_quotes(unit),
                         "leave \"unit\" out");
        try {
            auto const node = parse_goal(text, model_).value;
            for (auto const k : leaves_of(model_.g, {node}, operation::constant)) used_.insert(k);
            graph_range range(model_.g, {node});
            auto const value = [&](std::vector<interval> const& constants) {
                range.evaluate({interval(0.0), {}, box(constants), {}});
                return range.undefined(node) ? traits::entire() : range.value(node);
            };
            return {value(at_), value(over_), unit};
        } catch (requirement_error const& fault) {
            e.place.fail(fault.what(), "write an expression of the model's constants");
        }
    }
    /// From a unit to the file's; nothing where nothing changes.
    /// @param to  receives the file's
    [[nodiscard]] static std::optional<unit_conversion>
    conversion(export_entry const& e, std::string const& from, std::string& to) {
        to = from;
        std::string_view units = e.rule != nullptr ? e.rule->units : std::string_view{};
        if (!e.file_unit.empty()) units = e.file_unit;
        for (std::size_t at = 0; at < units.size();) {
            auto const bar = std::min(units.find('|', at), units.size());
            auto const one = units.substr(at, bar - at);
            at = bar + 1;
            auto const ratio = unit(from).in(unit(one));
            auto const found = ratio ? unit_conversion::of(*ratio) : std::nullopt;
            if (!found) continue;
            to = one;
            return ratio->is_one() ? std::nullopt : found;
        }
        if (!units.empty())
            e.place.fail("the unit of the value, " + in_quotes(from.empty() ? "1" : from) +
                             ", does not convert to that of " + e.attribute + ", " +
                             std::string{units},
                         "state the \"unit\" of an expression, and by \"file_unit\" what else the "
                         "file counts in");
        return std::nullopt;
    }
    [[nodiscard]] static interval converted(interval const& x, unit_conversion const& convert) {
        if (!is_bounded(x)) return traits::entire();
        auto const y = convert(exact_decimal::of(x.lower()), exact_decimal::of(x.upper()));
        auto const ends =
            y ? enclose(y->value - y->rounding, y->value + y->rounding) : std::nullopt;
        return ends.value_or(traits::entire());
    }
    /// A delay in whole steps. @returns the nearest to the member's
    [[nodiscard]] static double in_steps(export_entry const& e, interval& at, interval& over,
                                         std::string& unit) {
        bool undefined = false;
        auto const step = *enclose(*e.step);
        at = traits::div(at, step, undefined);
        over = traits::div(over, step, undefined);
        over = traits::bounds(std::floor(over.lower()), std::ceil(over.upper()));
        unit = "steps of " + e.step->text() + " " + unit;
        return std::nearbyint(mid(at));
    }

    proved_member const& of_;
    recorded_model model_; ///< expressions are entered here
    std::vector<interval> at_, over_;
    std::set<std::size_t> used_;
};

constexpr std::string_view hull_warning =
    "Each range holds every value that explains the data (proved). The box of all ranges is larger "
    "than the set of parameters that do: a point of it that is drawn at random may explain "
    "nothing.";

/// One run of `export`.
class exporting {
public:
    exporting(robot const& r, export_command const& c)
        : of_{r},
          command_{c},
          format_{c.to == "mjcf"       ? export_format::mjcf
                  : c.to == "urdf"     ? export_format::urdf
                  : c.to == "isaaclab" ? export_format::isaaclab
                                       : export_format::json},
          is_robot_{c.to == "mjcf" || c.to == "urdf"} {}

    [[nodiscard]] int operator()() {
        require_files();
        if (!command_.map.empty()) entries_ = read_export_mapping(command_.map, format_);
        auto const robot_file = read_robot(); // before any work is done
        member_ = member_reader(of_, command_).read();
        export_values values(member_);
        for (auto const& e : entries_) all_.push_back(values(e));
        changed_robot robot;
        std::vector<robot_change> changes;
        for (auto const& a : all_)
            if (a.what->rule != nullptr) changes.push_back({a.what, a.written(), a.words()});
        if (robot_file) robot = changed_robot_file(*robot_file, changes);
        auto const note = note_text(values, robot.notes);
        auto const name = command_.out.filename().string();
        file_set files(command_.out.has_parent_path() ? command_.out.parent_path() : ".");
        files.add(name + ".note.txt", note);
        if (is_robot_) files.add(name + ".ranges.json", table(values));
        files.add(name, is_robot_ ? robot.text : table(values));
        files.commit();
        result_stream() << note << "written: " << command_.out.string() << "\n";
        return done;
    }

private:
    /// What is needed is told, and nothing that is read is written over.
    void require_files() const {
        auto const to = "--to " + command_.to;
        if (is_robot_ == command_.into.empty())
            throw bad_request(to + (is_robot_ ? " needs --into, the file to change"
                                              : " has no file to change: leave --into out"));
        if (command_.map.empty() && format_ != export_format::json)
            throw bad_request(to + " needs --map: which constant is which attribute");
        if (command_.out.filename().empty()) throw output_error("--out is no file: name one");
        std::vector<std::filesystem::path> all{command_.into, command_.map, of_.file};
        for (auto const* name : {"result.json", "boxes.csv", "products.csv", "certificates.csv",
                                 "outputs.csv", "diagnosis.json"})
            all.push_back(command_.result / name);
        for (auto const& read : all)
            for (auto const* end : {"", ".note.txt", ".ranges.json"}) {
                std::error_code fault;
                auto const out = command_.out.string() + end;
                if (!read.empty() && std::filesystem::equivalent(out, read, fault))
                    throw output_error(printable_path(out) + " is read: name another file");
            }
    }
    [[nodiscard]] std::optional<xml_document> read_robot() const {
        if (!is_robot_) return std::nullopt;
#ifdef SIVID_HAS_EXPAT
        return read_xml(command_.into);
#else
        throw bad_request("this program was built without expat (Debian: libexpat1-dev), which "
                          "reads MJCF and URDF; build it anew, or write --to json");
#endif
    }

    /// All values with their ranges, in JSON.
    [[nodiscard]] std::string table(export_values const& values) const {
        json_writer json;
        json.begin_object().members("format", "sivid-ranges-1", "dataset", member_.dataset);
        json.members("effects", member_.effects, "warning", hull_warning);
        values.write_constants(json);
        json.list("attributes", all_, [&](exported_attribute const& a) {
            auto const& e = *a.what;
            json.begin_object(json_writer::layout::one_line).members(e.kind, e.name);
            json.members("attribute", e.attribute, "part", e.part, "value", a.numbers);
            json.members("range", a.over, "unit", a.unit, "of", e.values, "exact", a.exact);
            json.end_object();
        });
        if (format_ == export_format::isaaclab) write_actuators(json);
        json.members("assumptions", member_.assumptions).end_object();
        return json.text();
    }
    /// {"elbow": {"joint_names_expr": ["elbow"], "damping": 0.3, ...}, ...}: the arguments of an
    /// actuator of Isaac Lab.
    void write_actuators(json_writer& json) const {
        std::map<std::string, std::vector<exported_attribute const*>> joints;
        for (auto const& a : all_) joints[a.what->name].push_back(&a);
        json.key("actuators").begin_object();
        for (auto const& [name, attributes] : joints) {
            std::string pattern; // the name as a regular expression
            for (char c : name) {
                if (std::string_view{R"(\^$.|?*+()[]{})"}.find(c) != std::string_view::npos)
                    pattern += '\\';
                pattern += c;
            }
            json.key(name).begin_object().members("joint_names_expr", std::vector{pattern});
            for (auto const* a : attributes)
                for (std::string const end : {"min_", "max_"}) {
                    bool const delay = a->what->attribute == "delay";
                    if (delay || end == "min_")
                        json.members((delay ? end : "") + a->what->attribute, a->numbers.front());
                }
            json.end_object();
        }
        json.end_object();
    }

    /// What was written, what could not be, and what it rests on.
    [[nodiscard]] std::string note_text(export_values const& values,
                                        std::vector<std::string> const& of_the_file) const {
        auto text = "A parameter of the model that explains the data set " +
                    in_quotes(member_.dataset) + ", proved anew by a validated run.\n";
        auto const add = [&](std::string const& head, std::string const& words) {
            text += "  " + head + ": " + printable_text(words, 1000) + "\n";
        };
        for (auto const& effect : member_.effects)
            add("effect", effect + (effect.find('@') == std::string::npos
                                        ? ""
                                        : ", which acts in a part of the data only"));
        for (auto const& a : all_) {
            auto const& e = *a.what;
            bool const said = e.rule != nullptr || format_ == export_format::json;
            auto const rounded = [](interval const& x) { return to_string(x); };
            add(said ? e.kind + " " + e.name : "not written, " + command_.to + " cannot say it",
                (said ? "" : e.kind + " " + e.name + " ") + a.words() +
                    (a.exact ? "" : "; rounded from " + joined(a.at, ", ", rounded)));
        }
        if (format_ != export_format::json || !all_.empty())
            for (auto const& words : values.unused()) add("not written, no attribute", words);
        for (auto const& words : of_the_file) add("note", words);
        add("ranges", std::string{hull_warning} + " They are as the result states them.");
        for (auto const& words : member_.assumptions) add("it rests on", words);
        return text;
    }

    robot const& of_;
    export_command const& command_;
    export_format format_;
    bool is_robot_;
    std::vector<export_entry> entries_;
    proved_member member_;
    std::vector<exported_attribute> all_;
};

} // namespace detail

SIVID_DECL int run(robot const& r, export_command const& c) {
    watch_interrupts();
    try {
        return detail::exporting(r, c)();
    } catch (detail::no_member const& none) {
        notice_stream() << "nothing is written: " << none.what() << "\n";
        return none.code;
    }
}

} // namespace sivid::app

#endif
