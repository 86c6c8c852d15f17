// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_SUPPORT_THREADS_HPP
#define SIVID_TESTS_SUPPORT_THREADS_HPP

#include <sivid/executor.hpp>

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace support {

/// Tasks in so many threads of the standard library, which sanitizers know. Tasks must not throw.
inline sivid::executor threads(std::size_t count) {
    return {count, [count](std::size_t tasks, sivid::executor::task const& work) {
                std::atomic<std::size_t> next = 0;
                std::vector<std::jthread> all;
                for (std::size_t t = 0; t < count; ++t) {
                    all.emplace_back([&] {
                        for (auto k = next++; k < tasks; k = next++) work(k);
                    });
                }
            }};
}

} // namespace support

#endif
