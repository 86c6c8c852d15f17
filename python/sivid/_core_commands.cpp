// SPDX-License-Identifier: MIT
// Models, and the commands of the program sivid with them.
#include "_core.hpp"

#include <sivid/app/app.hpp>
#include <sivid/app/robot_of_text.hpp>
#include <sivid/text/read_model.hpp>

#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace sivid_python {

namespace {

using sivid::app::robot;

/// A command in a thread of its own. The caller's thread, which Python knows, looks after signals
/// and progress every 50 ms, so that no thread of the search ever waits for Python.
class running_command {
public:
    running_command(robot const& r, std::vector<std::string> words, py::object progress)
        : progress_{std::move(progress)} {
        if (!progress_.is_none()) {
            host_.progress = [this](std::string const& line) {
                std::lock_guard const lock(mutex_);
                lines_.push_back(line);
            };
        }
        host_.interrupted = [this] { return stop_.load(); };
        worker_ = std::thread([this, &r, words = std::move(words)] {
            try {
                answer_ = sivid::app::run_within(host_, r, words);
            } catch (...) {
                failure_ = std::current_exception();
            }
            std::lock_guard const lock(mutex_);
            ended_ = true;
            end_.notify_one();
        });
    }
    ~running_command() {
        if (!worker_.joinable()) return;
        stop_ = true; // Python has failed: nobody waits for the answer
        py::gil_scoped_release const others;
        worker_.join();
    }
    running_command(running_command const&) = delete;
    running_command& operator=(running_command const&) = delete;

    /// @returns code, words, notices, and the exception that interrupted it, or None
    [[nodiscard]] py::tuple wait() {
        for (bool ended = false; !ended;) {
            std::vector<std::string> lines;
            {
                py::gil_scoped_release const others;
                std::unique_lock lock(mutex_);
                ended =
                    end_.wait_for(lock, std::chrono::milliseconds(50), [this] { return ended_; });
                lines.swap(lines_);
            }
            try {
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                for (auto const& line : lines)
                    if (!stop_.load()) progress_(line);
            } catch (py::error_already_set& e) {
                stop_ = true; // what is proved by now is written
                if (interruption_.is_none()) interruption_ = e.value();
            }
        }
        {
            py::gil_scoped_release const others;
            worker_.join();
        }
        if (failure_) std::rethrow_exception(failure_);
        return py::make_tuple(answer_.code, answer_.words, answer_.notices, interruption_);
    }

private:
    py::object progress_, interruption_ = py::none();
    sivid::app::host host_;
    std::atomic<bool> stop_{false};
    std::mutex mutex_;
    std::condition_variable end_;
    bool ended_ = false;
    std::vector<std::string> lines_; ///< that Python was not told yet
    sivid::app::command_answer answer_;
    std::exception_ptr failure_;
    std::thread worker_;
};

template <class List>
py::list names_and_units(List const& list) {
    py::list result;
    for (auto const& x : list) result.append(py::make_tuple(x.name, x.unit));
    return result;
}

py::dict decimals(sivid::allowed_disturbances::bounds const& all) {
    py::dict result;
    for (auto const& [name, most] : all) result[py::str(name)] = most.text();
    return result;
}

} // namespace

void add_commands(py::module_& m) {
    py::class_<robot, std::shared_ptr<robot>>(m, "Model")
        .def(py::init([](std::string text, std::string const& name) {
                 auto model = sivid::model_from_text(std::move(text), name);
                 return std::make_shared<robot>(
                     sivid::app::robot_of_text("sivid", name, std::move(model)));
             }),
             py::arg("text"), py::arg("name"), py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("name", [](robot const& r) { return r.model.about.name; })
        .def_property_readonly("time_unit", [](robot const& r) { return r.model.about.time_unit; })
        .def_property_readonly("states",
                               [](robot const& r) { return names_and_units(r.model.about.states); })
        .def_property_readonly("inputs",
                               [](robot const& r) { return names_and_units(r.model.about.inputs); })
        .def_property_readonly(
            "constants", [](robot const& r) { return names_and_units(r.model.about.constants); })
        .def_property_readonly(
            "outputs", [](robot const& r) { return names_and_units(r.model.about.channels); })
        .def_property_readonly("prior",
                               [](robot const& r) {
                                   py::dict result;
                                   for (auto const& u : r.prior)
                                       result[py::str(u.name)] =
                                           py::make_tuple(u.lower.text(), u.upper.text());
                                   return result;
                               })
        .def_property_readonly("disturbance",
                               [](robot const& r) { return decimals(r.disturbances.equations); })
        .def_property_readonly("error",
                               [](robot const& r) { return decimals(r.disturbances.channels); })
        .def_property_readonly("effects", [](robot const& r) {
            std::vector<std::string> names;
            for (auto const& e : r.effects) names.push_back(e.name);
            return names;
        });
    m.def(
        "run",
        [](std::shared_ptr<robot> const& r, std::vector<std::string> words, py::object progress) {
            return running_command(*r, std::move(words), std::move(progress)).wait();
        },
        py::arg("model"), py::arg("words"), py::arg("progress") = py::none());
}

} // namespace sivid_python
