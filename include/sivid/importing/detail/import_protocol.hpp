// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_DETAIL_IMPORT_PROTOCOL_HPP
#define SIVID_IMPORTING_DETAIL_IMPORT_PROTOCOL_HPP

#include <sivid/io/text/json_writer.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/measurement/bound_candidates.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sivid {

/// What an import did to the recorded lines and what it takes for granted. Nothing is dropped,
/// changed or decided without a note.
class import_protocol {
public:
    enum class kind {
        dropped, ///< is not in the data set
        changed, ///< is in it, but not as recorded
        decided, ///< could have been read in two ways
        assumed  ///< cannot be seen in the data
    };

    struct note {
        kind what = kind::dropped;
        std::string scenario, field; ///< field: input, channel, or "" for the whole line
        std::string reason;
        std::vector<std::size_t> lines; ///< of the recorded file; none: concerns all of it
    };

    struct scenario_summary {
        std::string name, role, file;
        std::size_t lines = 0;           ///< of the file
        std::size_t first = 0, last = 0; ///< lines that the scenario comes from
        std::size_t rows = 0;            ///< of them read
        std::size_t measurements = 0;    ///< in the data set
        std::string duration;            ///< [s]
        std::string stretch = {};        ///< what it is a window of; "": none
        std::string begin = "0";         ///< [s], on the time axis of the stretch

        /// The scenario that its notes name.
        [[nodiscard]] std::string const& noted_as() const {
            return stretch.empty() ? name : stretch;
        }
    };

    /// What the fit scenarios say of an error bound.
    struct suggested_bound {
        std::string quantity, unit, bound; ///< bound: in the data set; "": stated
        std::vector<bound_candidate> candidates;
    };

    std::string dataset, mapping;
    std::vector<scenario_summary> scenarios;
    std::vector<suggested_bound> bounds;

    /// Notes of one scenario, field and reason become one.
    void add(kind what, std::string const& scenario, std::string const& field,
             std::string const& reason, std::size_t line = 0) {
        auto const [found, is_new] =
            index_.try_emplace(std::tuple{what, scenario, field, reason}, notes_.size());
        if (is_new) notes_.push_back({what, scenario, field, reason, {}});
        if (line > 0) notes_[found->second].lines.push_back(line);
    }
    [[nodiscard]] std::vector<note> const& notes() const { return notes_; }

    /// Lines in ascending ranges: {3, 4, 5, 9} is [3, 5], [9, 9].
    [[nodiscard]] static std::vector<std::pair<std::size_t, std::size_t>>
    ranges(std::vector<std::size_t> lines) {
        std::sort(lines.begin(), lines.end());
        std::vector<std::pair<std::size_t, std::size_t>> result;
        for (auto const line : lines) {
            if (!result.empty() && line <= result.back().second + 1)
                result.back().second = line;
            else
                result.emplace_back(line, line);
        }
        return result;
    }

    [[nodiscard]] static char const* word(kind k) {
        constexpr char const* words[] = {"dropped", "changed", "decided", "assumed"};
        return words[static_cast<std::size_t>(k)];
    }

    /// For people; long lists of lines are cut, the JSON has them all. Both can be printed,
    /// whatever the names are.
    [[nodiscard]] std::string text() const {
        std::string out = "data set " + dataset + ", imported by " + mapping + "\n";
        constexpr std::size_t most = 12; // windows of a stretch, and scenarios of a bound
        for (std::size_t i = 0, shown = 0; i < scenarios.size(); ++i) {
            auto const& s = scenarios[i];
            bool const first = i == 0 || scenarios[i - 1].noted_as() != s.noted_as();
            bool const last =
                i + 1 == scenarios.size() || scenarios[i + 1].noted_as() != s.noted_as();
            shown = first ? 0 : shown + 1;
            if (shown < most)
                out += (first ? "\nscenario " : "scenario ") + s.name + " (" + s.role +
                       "): " + s.file + ", lines " + std::to_string(s.first) + " to " +
                       std::to_string(s.last) + " of " + std::to_string(s.lines) + ", " +
                       std::to_string(s.rows) + " rows, " + std::to_string(s.measurements) +
                       " measurements, " + s.duration + " s" +
                       (s.stretch.empty() ? "" : " from " + s.begin + " s") + "\n";
            else if (last)
                out += "... and " + std::to_string(shown + 1 - most) + " more\n";
            if (last) append_notes(out, [&](std::string const& name) { return is_of(name, s); });
        }
        auto const elsewhere = [&](std::string const& name) {
            return std::none_of(scenarios.begin(), scenarios.end(),
                                [&](auto const& s) { return is_of(name, s); });
        };
        std::string rest;
        append_notes(rest, elsewhere);
        if (!rest.empty()) out += "\nwhole logs, and stretches that became no scenario\n" + rest;
        for (auto const& b : bounds) {
            auto const of = b.unit.empty() ? "" : " " + b.unit;
            out += "\nerror bound of " + b.quantity +
                   (b.bound.empty() ? " is stated; candidates" : ", proposed: " + b.bound + of) +
                   "\n";
            for (auto const& c : b.candidates) {
                out += "  " + c.from + ": " + (c.bound > 0 ? number(c.bound) + of : "none");
                if (c.beyond > 0) out += ", worse at most " + number(100 * c.beyond) + " %";
                out += "\n";
                for (auto const& a : c.rests_on)
                    out += (c.bound > 0 ? "    assumed: " : "    ") + a + "\n";
            }
        }
        if (!bounds.empty())
            out += "\nwhat each bound decides: identify with this data set and --by-bounds\n";
        return printable_text(out, std::string::npos, true);
    }

    /// The same in the format sivid-import-1, complete.
    [[nodiscard]] std::string json() const {
        using layout = json_writer::layout;
        auto const plain = [](std::string const& s) { return printable_text(s); };
        json_writer j;
        j.begin_object().members("format", "sivid-import-1", "dataset", plain(dataset));
        j.members("mapping", plain(mapping));
        j.list("scenarios", scenarios, [&](scenario_summary const& s) {
            j.object("name", plain(s.name), "role", s.role, "file", plain(s.file), "lines", s.lines,
                     "first", s.first, "last", s.last, "rows", s.rows, "measurements",
                     s.measurements, "begin", s.begin, "duration", s.duration);
        });
        j.list("notes", notes_, [&](note const& n) {
            j.begin_object(layout::one_line).members("kind", word(n.what));
            j.members("scenario", plain(n.scenario), "field", plain(n.field));
            j.members("reason", plain(n.reason), "count", n.lines.size());
            j.list("lines", ranges(n.lines), [](auto const& r) {
                return std::array{r.first, r.second};
            });
            j.end_object();
        });
        j.list("bounds", bounds, [&](suggested_bound const& b) {
            j.begin_object().members("quantity", plain(b.quantity), "unit", plain(b.unit));
            j.members("bound", b.bound).list("candidates", b.candidates, [&](auto const& c) {
                j.begin_object(layout::one_line).members("from", c.from, "bound", c.bound);
                j.members("beyond", c.beyond).list("rests_on", c.rests_on, plain).end_object();
            });
            j.end_object();
        });
        return j.end_object().text();
    }

private:
    /// Whether a note that names this is of the scenario, or of a further file of it.
    static bool is_of(std::string const& name, scenario_summary const& s) {
        return name == s.noted_as() || name.starts_with(s.noted_as() + "/");
    }
    static std::string number(double x) { return rounded_digits(x).text(); }
    /// Three digits, to be read.
    static exact_decimal rounded_digits(double x) {
        return exact_decimal::shortest(x).divided_by(1, 3).second;
    }

    template <class Wanted>
    void append_notes(std::string& out, Wanted const& wanted) const {
        constexpr std::size_t most = 12;
        for (auto const& n : notes_) {
            if (!wanted(n.scenario)) continue;
            out += std::string{"  "} + word(n.what) + ": ";
            if (auto const slash = n.scenario.find('/'); slash != std::string::npos)
                out += n.scenario.substr(slash + 1) + ": ";
            if (!n.field.empty()) out += n.field + ": ";
            out += n.reason;
            if (!n.lines.empty()) {
                out += " (" + std::to_string(n.lines.size()) +
                       (n.lines.size() == 1 ? " line: " : " lines: ");
                auto const all = ranges(n.lines);
                for (std::size_t i = 0; i < std::min(all.size(), most); ++i) {
                    out += (i > 0 ? ", " : "") + std::to_string(all[i].first);
                    if (all[i].second > all[i].first) out += "-" + std::to_string(all[i].second);
                }
                out += all.size() > most ? ", ...)" : ")";
            }
            out += "\n";
        }
    }

    std::vector<note> notes_;
    std::map<std::tuple<kind, std::string, std::string, std::string>, std::size_t> index_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_DETAIL_IMPORT_PROTOCOL_HPP
