// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_LENDING_POOL_HPP
#define SIVID_PAVING_RUN_DETAIL_LENDING_POOL_HPP

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace sivid {

/// Things to borrow that are for one thread at a time: there are as many as threads have asked for
/// at once.
template <class T>
class lending_pool {
public:
    /// @param make  a further one; called by several threads at once
    explicit lending_pool(std::function<T()> make) : make_(std::move(make)) {}

    /// One of them, given back at the end of its life.
    class loan {
    public:
        explicit loan(lending_pool& from) : from_(&from), lent_(from.take()) {}
        loan(loan const&) = delete;
        loan& operator=(loan const&) = delete;
        ~loan() { from_->give_back(std::move(lent_)); }

        [[nodiscard]] T& operator*() { return lent_; }

    private:
        lending_pool* from_;
        T lent_;
    };
    [[nodiscard]] loan borrow() { return loan(*this); }

private:
    [[nodiscard]] T take() {
        {
            std::lock_guard const guard(mutex_);
            if (!free_.empty()) {
                auto one = std::move(free_.back());
                free_.pop_back();
                return one;
            }
        }
        return make_();
    }
    void give_back(T one) {
        std::lock_guard const guard(mutex_);
        free_.push_back(std::move(one));
    }

    std::function<T()> make_;
    std::mutex mutex_;
    std::vector<T> free_;
};

} // namespace sivid

#endif
