// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_SIMULATOR_IMPL_ROBOT_FILE_IPP
#define SIVID_IO_SIMULATOR_IMPL_ROBOT_FILE_IPP

#include <sivid/io/simulator/robot_file.hpp>

#include <sivid/compiled.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_name.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// Collects the bytes that change, then makes the new text.
class robot_editor {
public:
    robot_editor(xml_document const& of, export_format format)
        : of_(&of), mjcf_(format == export_format::mjcf) {
        auto const& root = of.elements.front();
        bool const fits =
            mjcf_ ? root.name == "mujoco" || root.name == "mujocoinclude" : root.name == "robot";
        if (!fits)
            of.fail(root.line, "the root is <" + root.name + ">",
                    mjcf_ ? "give an MJCF file, whose root is <mujoco>, or choose another --to"
                          : "give a URDF file, whose root is <robot>, or choose another --to");
        for (auto const& e : of.elements) {
            if (e.name.starts_with("xacro:"))
                of.fail(e.line, "<" + e.name + "> is not URDF yet", "run xacro on it first");
            if (mjcf_ && e.name == "include")
                included_.push_back(in_quotes(e.value("file")) + " in line " +
                                    std::to_string(e.line));
        }
        if (!included_.empty())
            notes_.push_back("included files are left as they are: " + joined(included_, ", "));
    }

    void change(robot_change const& c) {
        auto const& rule = *c.what->rule;
        if (rule.kind == "body") require_own_inertia();
        auto at = element_named(*c.what);
        for (auto path = rule.path; !path.empty();) {
            auto const name = path.substr(0, path.find('/'));
            path.remove_prefix(std::min(name.size() + 1, path.size()));
            auto const found = children(at, name);
            if (found.empty() && name == "dynamics") return join(made_[at], rule.own, c);
            if (found.size() != 1)
                of_->fail(of_->elements[found.empty() ? at : found[1]].line,
                          text_of(rule.kind, " ", in_quotes(c.what->name), " has ",
                                  found.empty() ? "no" : "more than one", " <", name, ">"),
                          "write exactly one there, with all that it needs");
            at = found.front();
        }
        set(at, c);
    }

    [[nodiscard]] changed_robot result() {
        for (auto const& [at, j] : joined_) {
            auto const& e = of_->elements[at];
            auto const behind =
                e.attributes.empty() ? e.begin + 1 + e.name.size() : e.attributes.back().end + 1;
            if (!j.attributes.empty()) edits_.push_back({behind, behind, j.attributes});
            constexpr std::string_view own = " <!-- sivid:";
            auto end = e.end;
            if (std::string_view{of_->text}.substr(end).starts_with(own))
                end = of_->text.find("-->", end) + 3;
            edits_.push_back({e.end, end, j.comment()});
        }
        for (auto const& [at, j] : made_) {
            auto const& e = of_->elements[at];
            if (of_->text[e.end - 2] == '/')
                of_->fail(e.line, "the joint is empty", "write what a joint needs");
            auto const next = of_->text.find_first_not_of(" \t\r\n", e.end);
            auto const space = of_->text.substr(e.end, next - e.end);
            edits_.push_back(
                {e.end, e.end, space + "<dynamics" + j.attributes + "/>" + j.comment()});
        }
        std::ranges::stable_sort(edits_, {}, &edit::begin);
        std::string text;
        std::size_t from = 0;
        for (auto const& e : edits_) {
            text.append(of_->text, from, e.begin - from).append(e.text);
            from = e.end;
        }
        text.append(of_->text, from);
        return {std::move(text), std::move(notes_)};
    }

private:
    struct edit {
        std::size_t begin, end;
        std::string text;
    };
    /// What an element gets more.
    struct joins {
        std::string attributes, words;
        [[nodiscard]] std::string comment() const {
            auto text = words; // a comment holds no --, and the file may be no UTF-8
            for (auto& c : text) c = static_cast<unsigned char>(c) < 0x80 ? c : '?';
            for (auto at = text.find("--"); at != text.npos; at = text.find("--", at + 1))
                text.insert(at + 1, " ");
            return " <!-- sivid: " + text + " -->";
        }
    };

    static void join(joins& to, std::string_view attribute, robot_change const& c) {
        if (!attribute.empty()) to.attributes += text_of(" ", attribute, "=\"", c.numbers, "\"");
        to.words += (to.words.empty() ? "" : "; ") + c.comment;
    }

    void set(std::size_t at, robot_change const& c) {
        auto const& e = of_->elements[at];
        auto const& own = c.what->rule->own;
        auto const* const there = e.find(own);
        join(joined_[at], there == nullptr && !c.what->part ? own : std::string_view{}, c);
        if (there == nullptr) {
            if (c.what->part)
                of_->fail(e.line,
                          text_of(c.what->title(), " is to change one number of an "
                                                   "attribute that is not there"),
                          "write all numbers as a list in \"value\"");
            return;
        }
        auto const raw = of_->text.substr(there->begin, there->end - there->begin);
        if (raw.find_first_of("&${") != std::string::npos)
            of_->fail(e.line, text_of(own, " is ", in_quotes(raw), ", no plain number"),
                      "write numbers there, after xacro");
        auto begin = there->begin, end = there->end;
        if (c.what->part) std::tie(begin, end) = number_within(*there, e, *c.what);
        edits_.push_back({begin, end, c.numbers});
    }
    [[nodiscard]] std::vector<std::size_t> children(std::size_t of, std::string_view name) const {
        std::vector<std::size_t> result;
        for (std::size_t k = 1; k < of_->elements.size(); ++k)
            if (of_->elements[k].parent == of && of_->elements[k].name == name) result.push_back(k);
        return result;
    }
    /// Where the n-th number of an attribute stands.
    [[nodiscard]] std::pair<std::size_t, std::size_t>
    number_within(xml_element::attribute const& a, xml_element const& e,
                  export_entry const& what) const {
        auto end = a.begin;
        for (std::size_t k = 0; k < *what.part; ++k) {
            auto const begin = of_->text.find_first_not_of(" \t\r\n", end);
            if (begin >= a.end)
                of_->fail(e.line, what.title() + " is not there: it has " + std::to_string(k),
                          "write all numbers as a list in \"value\"");
            end = std::min(of_->text.find_first_of(" \t\r\n", begin), a.end);
            if (k + 1 == *what.part) return {begin, end};
        }
        return {end, end}; // part is at least 1
    }

    /// Whether an element of this name is one of those that a robot is made of, not one that refers
    /// to these (sensors, tendons, transmissions), and no class of defaults.
    [[nodiscard]] bool is_own(xml_element const& e, std::string_view kind) const {
        auto const& parent = of_->elements[e.parent];
        if (!mjcf_) return e.name == kind && e.parent == 0;
        if (kind == "actuator") return parent.name == "actuator";
        return e.name == kind && (kind == "body" || parent.name == "body");
    }
    [[nodiscard]] std::size_t element_named(export_entry const& what) const {
        std::vector<std::size_t> found;
        std::vector<std::string> others;
        for (std::size_t k = 1; k < of_->elements.size(); ++k) {
            auto const& e = of_->elements[k];
            auto const* const name = e.find("name");
            if (name == nullptr || !is_own(e, what.kind)) continue;
            if (name->value == what.name)
                found.push_back(k);
            else if (others.size() < 20)
                others.push_back(name->value);
        }
        auto const title = what.kind + " " + in_quotes(what.name);
        if (found.size() > 1)
            of_->fail(of_->elements[found[1]].line,
                      title + " is there more than once, first in line " +
                          std::to_string(of_->elements[found[0]].line),
                      "give each a name of its own");
        if (found.size() == 1) return found.front();
        auto const near = nearest_name(what.name, others);
        auto remedy = !near.empty()    ? "did you mean " + in_quotes(near) + "?"
                      : others.empty() ? "none has a name: give it one"
                                       : "there are: " + joined(others, ", ");
        if (!included_.empty())
            remedy +=
                "; it may be in an included file, then give that one: " + joined(included_, ", ");
        of_->fail(0, "it has no " + title, remedy);
    }
    /// The masses that the file states are those of the model.
    void require_own_inertia() const {
        for (auto const& e : of_->elements) {
            if (e.name != "compiler") continue;
            auto const total = e.value("settotalmass");
            if (e.value("inertiafromgeom") == "true" || (!total.empty() && total.front() != '-'))
                of_->fail(e.line,
                          "the compiler takes masses from elsewhere (inertiafromgeom, "
                          "settotalmass), and would pass the change over",
                          "take that out, and state each <inertial>");
        }
    }

    xml_document const* of_;
    bool mjcf_;
    std::vector<std::string> included_, notes_;
    std::vector<edit> edits_;
    std::map<std::size_t, joins> joined_, made_;
};

} // namespace io_detail

SIVID_DECL changed_robot changed_robot_file(xml_document const& of,
                                            std::vector<robot_change> const& changes) {
    if (changes.empty()) return {of.text, {}};
    io_detail::robot_editor editor(of, changes.front().what->rule->format);
    for (auto const& c : changes) editor.change(c);
    return editor.result();
}

} // namespace sivid

#endif
