// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_TRANSPORT_HPP
#define SIVID_CLUSTER_TRANSPORT_HPP

#include <sivid/cluster/identity.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace sivid::cluster {

/// Between the coordinator and a worker of its pool.
struct message {
    enum class kind : std::uint8_t {
        hello,   ///< to a worker: what the coordinator works on
        welcome, ///< back: who the worker is
        ask,     ///< a request
        answer,  ///< to the request with that number
        fault,   ///< back: the worker cannot go on; why
        stop,    ///< what is asked for is no longer wanted: end it soon
        end      ///< the service is over
    };
    kind what = kind::end;
    std::uint64_t number = 0; ///< of the request
    std::string body = {};
    identity who = {};      ///< in a welcome
    double seconds = 0;     ///< in an answer: of the processor that the worker took
    bool cut_short = false; ///< in an answer: told to stop, it need not have finished

    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = sizeof what + sizeof number + body.size();
        for (auto const& p : who.parts) sum += p.what.size() + p.value.size() + p.remedy.size();
        return sum;
    }
    template <class Archive>
    void serialize(Archive& a, unsigned) {
        a& what& number& body& who& seconds& cut_short;
    }
};

/// Carries messages to and from others, each of whom has a number from 0 on; what one of them sends
/// arrives in its order. Used by one thread.
class transport {
public:
    struct letter {
        std::size_t from = 0;
        message says;
    };

    virtual ~transport() = default;
    [[nodiscard]] virtual std::size_t others() const = 0;
    /// Does not wait for the other.
    virtual void send(std::size_t to, message says) = 0;
    /// What has arrived, if anything; does not wait.
    [[nodiscard]] virtual std::optional<letter> receive() = 0;
    /// For people: `rank 3`.
    [[nodiscard]] virtual std::string name_of(std::size_t other) const = 0;
};

/// Waits longer and longer, a millisecond at most, so that whoever works has the processor.
class patience {
public:
    void wait() {
        if (++rounds_ < 50) {
            std::this_thread::yield();
        } else {
            std::this_thread::sleep_for(
                std::chrono::microseconds(std::min<std::size_t>(20 * (rounds_ - 49), 1000)));
        }
    }
    void renew() { rounds_ = 0; }

private:
    std::size_t rounds_ = 0;
};

/// Between threads of one process: the first to the others, and each of these to the first.
class memory_transport {
    struct box_of_letters {
        std::mutex mutex;
        std::deque<transport::letter> waiting;
    };
    using boxes = std::vector<std::shared_ptr<box_of_letters>>;

    class end final : public transport {
    public:
        end(std::shared_ptr<box_of_letters> in, boxes out, std::size_t sender)
            : in_(std::move(in)), out_(std::move(out)), sender_(sender) {}
        [[nodiscard]] std::size_t others() const override { return out_.size(); }
        void send(std::size_t to, message says) override {
            std::lock_guard const alone(out_[to]->mutex);
            out_[to]->waiting.push_back({sender_, std::move(says)});
        }
        [[nodiscard]] std::optional<letter> receive() override {
            std::lock_guard const alone(in_->mutex);
            if (in_->waiting.empty()) return std::nullopt;
            auto first = std::move(in_->waiting.front());
            in_->waiting.pop_front();
            return first;
        }
        [[nodiscard]] std::string name_of(std::size_t other) const override {
            return std::string{"thread "} + std::to_string(other);
        }

    private:
        std::shared_ptr<box_of_letters> in_;
        boxes out_;
        std::size_t sender_;
    };

public:
    /// @param workers  besides the first
    explicit memory_transport(std::size_t workers) {
        auto const centre = std::make_shared<box_of_letters>();
        boxes all;
        for (std::size_t k = 0; k < workers; ++k) {
            all.push_back(std::make_shared<box_of_letters>());
            of_workers.push_back(std::make_unique<end>(all.back(), boxes{centre}, k));
        }
        of_first = std::make_unique<end>(centre, all, 0);
    }

    std::unique_ptr<transport> of_first;
    std::vector<std::unique_ptr<transport>> of_workers;
};

/// Those of one transport, then those of another.
class joined_transport final : public transport {
public:
    /// @param first, second  are referred to
    joined_transport(transport& first, transport& second) : first_(&first), second_(&second) {}
    [[nodiscard]] std::size_t others() const override {
        return first_->others() + second_->others();
    }
    void send(std::size_t to, message says) override {
        auto const n = first_->others();
        if (to < n) return first_->send(to, std::move(says));
        second_->send(to - n, std::move(says));
    }
    [[nodiscard]] std::optional<letter> receive() override {
        if (auto got = first_->receive()) return got;
        auto got = second_->receive();
        if (got) got->from += first_->others();
        return got;
    }
    [[nodiscard]] std::string name_of(std::size_t other) const override {
        auto const n = first_->others();
        return other < n ? first_->name_of(other) : second_->name_of(other - n);
    }

private:
    transport* first_;
    transport* second_;
};

} // namespace sivid::cluster

#endif
