// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_ROBOT_ROBOT_TEXT_HPP
#define SIVID_IMPORTING_ROBOT_ROBOT_TEXT_HPP

#include <sivid/importing/robot/base_parameters.hpp>
#include <sivid/importing/robot/described_robot.hpp>
#include <sivid/importing/robot/written_scalar.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/printable_text.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace importing_detail {

/// The named parts of a text, as they come.
struct text_parts {
    std::vector<std::string> of; ///< the joints' names
    std::vector<std::pair<std::string, written_scalar>> all;

    written_scalar add(std::string const& name, written_scalar const& x) {
        all.emplace_back(name, x);
        return written_scalar(name);
    }
};

/// Makes intermediate results named parts.
struct part_names {
    std::shared_ptr<text_parts> parts;

    sparse<written_scalar> operator()(std::string const& what, std::size_t body,
                                      sparse<written_scalar> const& x) const {
        if (x.is_zero()) return x;
        bool const entry = what.front() == 'M', result = entry || what == "h";
        if ((*x).is_name() && !result) return x;
        return parts->add(entry ? what + std::to_string(body + 1) : what + "_" + parts->of[body],
                          *x);
    }
};

/// The names in a formula.
[[nodiscard]] inline std::set<std::string> names_of(std::string const& formula) {
    std::set<std::string> result;
    std::string word;
    for (char const c : formula + " ") {
        bool const inner = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
        if (inner) word += c;
        if (!inner && !word.empty()) result.insert(std::exchange(word, {}));
    }
    return result;
}

/// Writes a robot as a model in text.
class robot_writer {
public:
    robot_writer(described_robot const& r, base_parameters const& base, double within)
        : robot_(r), base_(base), within_(within), parts_(std::make_shared<text_parts>()) {
        for (auto const& j : r.joints) parts_->of.push_back(j.of);
    }

    [[nodiscard]] std::string operator()() {
        write_equations();
        return head() + body_ + states() + constants() + effects();
    }

private:
    using formula = written_scalar;

    static std::string number(double x) { return exact_decimal::shortest(x).text(); }
    static std::string quoted(std::string const& text) { return "\"" + text + "\""; }
    /// Text in a line of comment: nothing in it ends the line.
    static std::string plain(std::string const& text) { return printable_text(text, 200); }

    [[nodiscard]] std::size_t count() const { return robot_.joints.size(); }
    [[nodiscard]] static std::string angle(described_joint const& j) {
        return j.joint.slides ? "m" : "rad";
    }
    [[nodiscard]] static std::string force(described_joint const& j) {
        return j.joint.slides ? "N" : "N m";
    }
    [[nodiscard]] std::string inertial_name(std::size_t constant) const {
        return std::string(inertial_names[constant % 10]) + "_" + robot_.joints[constant / 10].body;
    }
    [[nodiscard]] double nominal(std::size_t constant) const {
        return robot_.joints[constant / 10].inertial[constant % 10];
    }
    /// How far a constant may be from its description, where it stands for others, too.
    [[nodiscard]] double half_width(base_parameters::combination const& c) const {
        double w = robot_.size_of(c.kept);
        for (auto const& t : c.terms) w += std::abs(t.factor) * robot_.size_of(t.constant);
        return within_ * w;
    }
    [[nodiscard]] base_parameters::combination const* kept(std::size_t constant) const {
        auto const at = std::find_if(base_.known.begin(), base_.known.end(),
                                     [&](auto const& c) { return c.kept == constant; });
        return at == base_.known.end() ? nullptr : &*at;
    }
    [[nodiscard]] bool is_absent(std::size_t constant) const {
        auto const* const c = kept(constant);
        return nominal(constant) == 0 && (c == nullptr || half_width(*c) == 0);
    }

    void write_equations() {
        body_motion<formula> motion;
        std::vector<body_inertia<formula>> bodies;
        auto const named = [](bool there, std::string const& name) {
            return there ? sparse<formula>(formula(name)) : sparse<formula>();
        };
        for (std::size_t k = 0; k < 3; ++k)
            motion.gravity[k] = named(robot_.gravity[k] != 0, "gravity_" + axes[k]);
        for (std::size_t i = 0; i < count(); ++i) {
            auto const& j = robot_.joints[i];
            auto& origin = motion.origin.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                origin[k] = named(j.origin[k] != 0, axes[k] + "_" + j.of);
            motion.place.emplace_back("q_" + j.of);
            motion.speed.emplace_back("w_" + j.of);
            std::array<sparse<formula>, 10> c;
            for (std::size_t k = 0; k < 10; ++k)
                c[k] = named(!is_absent(10 * i + k), inertial_name(10 * i + k));
            bodies.push_back(body_of(c));
        }
        rigid_bodies<formula, part_names> equations(robot_.structure(), bodies, motion, {parts_});
        auto const h = equations.bias();
        auto const m = equations.mass();
        std::string rates;
        for (std::size_t i = 0; i < count(); ++i) {
            auto const& j = robot_.joints[i];
            loads_.push_back(!h[i].is_zero());
            rates += "q_" + j.of + "' = w_" + j.of + "\n";
        }
        for (std::size_t i = 0; i < count(); ++i) {
            std::string left;
            for (std::size_t k = 0; k < count(); ++k) {
                auto const rate = "*w_" + robot_.joints[k].of + "'";
                if (m[i][k].is_zero()) continue;
                auto const entry = (*m[i][k]).text();
                left +=
                    (left.empty() ? "" : " + ") +
                    (i == k ? "(" + entry + " + armature_" + robot_.joints[i].of + ")" : entry) +
                    rate;
            }
            auto const& of = robot_.joints[i].of;
            rates += left + " = tau_" + of + " - damping_" + of + "*w_" + of + " - friction_" + of +
                     "*way_" + of + (h[i].is_zero() ? "" : " - " + (*h[i]).text()) + "\n";
            parts_->add("way_" + of,
                        formula("w_" + of) / formula("sqrt(w_" + of + "^2 + rest_" + of + "^2)"));
        }
        body_ = written(rates);
    }
    /// The parts that the equations need, and the equations.
    std::string written(std::string const& rates) {
        used_ = names_of(rates);
        std::string text;
        for (auto p = parts_->all.rbegin(); p != parts_->all.rend(); ++p) {
            if (!used_.contains(p->first)) continue;
            used_.merge(names_of(p->second.text()));
            text.insert(0, p->first + " = " + p->second.text() + "\n");
        }
        return "\nequations = \"\"\"\n" + text + rates + "\"\"\"\n";
    }

    [[nodiscard]] std::string head() const {
        auto text = "# The robot " + plain(robot_.name) +
                    ": an open chain of rigid bodies, M(q) w' + h(q, w) = torques of the motors "
                    "less friction.\n"
                    "#   q, w, tau: place, speed and motor of a joint. m, mx.., Ixx..: mass, first "
                    "moments and moments of inertia\n#   of the body that it moves, about the "
                    "joint. Friction is smooth below the speed rest; sign(w) for way is exact, and "
                    "slower.\n";
        for (auto const& note : robot_.notes) text += "# " + plain(note) + "\n";
        for (auto const& j : robot_.joints)
            if (j.turned)
                text += "# The frame of " + j.body + " has z along the joint " + j.of +
                        " and is not that of the file.\n";
        text += "# " + known_words() + "\n";
        for (auto const& line : known_lines()) text += "#   " + line + "\n";
        std::set<std::string> none;
        return text +
               "format = \"sivid-model-1\"\nname = " + quoted(model_name(robot_.name, none)) + "\n";
    }

public:
    [[nodiscard]] std::string known_words() const {
        return text_of(
            std::to_string(base_.known.size()), " of ", std::to_string(10 * count()),
            " inertial constants or combinations are all that motions and torques tell (",
            base_.exact ? "proved" : "to rounding, for not all turns are right angles",
            "); the first of each stands for it:");
    }
    /// A combination in each.
    [[nodiscard]] std::vector<std::string> known_lines() const {
        std::vector<std::string> lines;
        for (auto const& c : base_.known) {
            auto line = inertial_name(c.kept);
            for (auto const& t : c.terms) {
                auto const size = std::abs(t.factor);
                line += (t.factor < 0 ? " - " : " + ") +
                        (size == 1 ? "" : number(with_digits(size, 6)) + " ") +
                        inertial_name(t.constant);
            }
            lines.push_back(std::move(line));
        }
        return lines;
    }

private:
    [[nodiscard]] static double fastest(described_joint const& j) { return j.fastest.value_or(10); }
    [[nodiscard]] std::string states() const {
        std::string place, motor, shown;
        for (auto const& j : robot_.joints) {
            auto const [low, high] = j.range.value_or(std::pair{-6.3, 6.3});
            place += "q_" + j.of + " = \"[" + number(low) + ", " + number(high) + "] " + angle(j) +
                     "\"\nw_" + j.of + " = \"" + number(fastest(j)) + " " + angle(j) + "/s\"\n";
            motor += "tau_" + j.of + " = " + quoted(force(j)) + "\n";
            for (auto const* const what : {"q_", "w_"})
                shown += what + j.of + " = " + quoted(what + j.of) + "\n";
        }
        return "\n[states]\n" + place + "\n[inputs]\n" + motor + "\n[outputs]\n" + shown;
    }

    /// "[lower, upper]", outward in four digits.
    static std::string about(double value, double half) {
        auto const middle = exact_decimal::shortest(value);
        auto const w = exact_decimal::shortest(half).divided_by(1, 4).second;
        return "[" + (middle - w).text() + ", " + (middle + w).text() + "]";
    }
    void add_constant(std::string& text, std::string const& name, double value, double half,
                      std::string const& in) const {
        if (!used_.contains(name)) return;
        auto const nominal = quoted(number(value) + " " + in);
        text += name + " = " +
                (half > 0 ? "{ value = " + nominal +
                                ", prior = " + quoted(about(value, half) + " " + in) + " }"
                          : nominal) +
                "\n";
    }
    [[nodiscard]] std::string constants() const {
        std::string text = "\n[constants]\n";
        for (std::size_t k = 0; k < 3; ++k)
            add_constant(text, "gravity_" + axes[k], robot_.gravity[k], 0, "m/s^2");
        for (std::size_t i = 0; i < count(); ++i) {
            auto const& j = robot_.joints[i];
            for (std::size_t k = 0; k < 3; ++k)
                add_constant(text, axes[k] + "_" + j.of, j.origin[k], 0, "m");
            for (std::size_t k = 10 * i; k < 10 * i + 10; ++k) {
                auto const* const c = kept(k);
                add_constant(text, inertial_name(k), nominal(k), c == nullptr ? 0 : half_width(*c),
                             inertial_unit(k % 10));
            }
            auto const rate = force(j) + (j.joint.slides ? " s/m" : " s/rad");
            add_constant(text, "damping_" + j.of, j.damping, within_ * j.damping, rate);
            add_constant(text, "friction_" + j.of, j.friction, within_ * j.friction, force(j));
            add_constant(text, "armature_" + j.of, 0, 0, j.joint.slides ? "kg" : "kg m^2");
            add_constant(text, "rest_" + j.of, with_digits(fastest(j) / 50, 2), 0, angle(j) + "/s");
        }
        return text;
    }
    /// What motors, gears and sensors of a joint may do that the model leaves out.
    [[nodiscard]] std::string effects() const {
        auto const m = mass_matrix(robot_, 0.3);
        std::string text = "\n# What this leaves out, at each joint.\n";
        for (std::size_t i = 0; i < count(); ++i) {
            auto const& j = robot_.joints[i];
            double const inertia = with_digits(m[i][i].value_or(0), 2),
                         fast = with_digits(fastest(j), 2);
            double const strong = with_digits(j.strongest.value_or(inertia * fast * fast), 2);
            auto const in = force(j), speed = angle(j) + "/s";
            auto const add = [&](std::string const& name, std::string const& about,
                                 std::string const& prior, std::string const& what) {
                text += "[effect." + j.of + "_" + name + "]\n" +
                        (about.empty() ? "" : "about = " + quoted(about) + "\n") +
                        "constants.k = " + prior + "\ninputs = " + quoted(what) + "\n";
            };
            auto const upto = [](double most, std::string const& unit) {
                return quoted("[0, " + number(with_digits(most, 2)) + "] " + unit);
            };
            auto const w = "w_" + j.of, tau = "tau_" + j.of, way = "way_" + j.of;
            add("viscous", "", upto(0.2 * strong / fast, in + " s/" + angle(j)),
                "damping_" + j.of + " += k");
            add("coulomb", "", upto(0.2 * strong, in), "friction_" + j.of + " += k");
            add("stribeck", "friction that is stronger near rest", upto(0.2 * strong, in),
                tau + " -= k*exp(-" + w + "^2/(8*rest_" + j.of + ")^2)*" + way);
            if (loads_[i])
                add("load_friction", "friction that grows with what the gear carries",
                    quoted("[0, 0.4]"), tau + " -= k*abs(h_" + j.of + ")*" + way);
            add("air_drag", "", upto(0.1 * strong / (fast * fast), in + " s^2/" + angle(j) + "^2"),
                tau + " -= k*" + w + "*abs(" + w + ")");
            add("armature", "inertia of the rotor, behind the gear",
                upto(inertia, j.joint.slides ? "kg" : "kg m^2"), "armature_" + j.of + " += k");
            add("weak_motor", "", quoted("[-0.5, 0.5]"), tau + " *= 1 - k");
            add("torque_limit", "a driver that limits the current: k is 1/limit",
                upto(10 / strong, "1/(" + in + ")"), tau + " /= max(1, k*abs(" + tau + "))");
            add("speed_limit", "torque that fades towards the speed without load",
                upto(5 / fast, "s/" + angle(j)),
                tau + " *= 1 - min(1, max(0, k*abs(" + w + ") - 0.5))");
            auto const ready = [&](std::string const& name, std::string const& kind,
                                   std::string const& of, std::string const& prior) {
                text += "[effect." + j.of + "_" + name + "]\nkind = " + quoted(kind) +
                        "\nof = " + of + "\nprior = " + prior + "\n";
            };
            ready("command_delay", "input_delay", quoted(tau), quoted("[0, 0.03] s"));
            ready("dead_band", "input_dead_band", quoted(tau), upto(0.1 * strong, in));
            ready("late_speed", "sensor_latency", "[" + quoted(w) + "]", quoted("[0, 0.05] s"));
            ready("offset", "sensor_bias", quoted("q_" + j.of),
                  quoted("[-0.05, 0.05] " + angle(j)));
        }
        return text;
    }

    described_robot const& robot_;
    base_parameters const& base_;
    double within_;
    std::shared_ptr<text_parts> parts_;
    std::set<std::string> used_;
    std::vector<bool> loads_; ///< which joints carry more than their own friction
    std::string body_;
    inline static std::array<std::string, 3> const axes{"x", "y", "z"};
};

} // namespace importing_detail

/// A model in text.
struct robot_text {
    std::string model; ///< in the format sivid-model-1
    std::string about; ///< what was decided, and which inertial constants can be known, for people
};

namespace importing_detail {
/// Says of which links the priors hold more than bodies: with less inertia about the joint than
/// their mass and centre have, (1 - w)^2 I < (1 + w)^2 |h|^2/m.
inline void add_limits(described_robot& r, double within) {
    for (auto const& j : r.joints) {
        auto const& c = j.inertial;
        auto const a = j.joint.axis, u = 1 + (a + 1) % 3, v = 1 + (a + 2) % 3;
        double const share = std::hypot(c[u], c[v]) / std::sqrt(c[0] * c[4 + a]);
        double const most = (1 - share) / (1 + share);
        if (!j.joint.slides && within > most)
            r.notes.push_back("assumed: " + in_quotes(j.link) + " may have inertias that no body " +
                              "has, where equations may divide by 0; none within " +
                              std::to_string(static_cast<int>(100 * std::max(most, 0.0))) + "%");
    }
}
} // namespace importing_detail

/// Writes the equations of a described robot, with the operations of `rigid_bodies`, as a model in
/// text. States are the joints' places and speeds, inputs their torques. The inertial constants
/// that can be known have priors: as far from the description as its author may be wrong, with
/// that of those constants that cannot be told from them.
/// @param within  the share of masses, of the centres' distances and of moments of inertia
/// @guarantee  a robot whose constants are within that share has, with its other constants as
///             described, values in the priors that move alike (to rounding, as files are)
[[nodiscard]] inline robot_text text_of_robot(described_robot r, double within) {
    importing_detail::add_limits(r, within);
    auto const base = base_parameters_of(r);
    importing_detail::robot_writer writer(r, base, within);
    robot_text result{writer(), {}};
    for (auto const& note : r.notes) result.about += "  " + note + "\n";
    result.about += writer.known_words() + "\n";
    for (auto const& line : writer.known_lines()) result.about += "  " + line + "\n";
    return result;
}

} // namespace sivid

#endif
