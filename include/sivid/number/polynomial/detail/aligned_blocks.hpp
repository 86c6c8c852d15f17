// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_ALIGNED_BLOCKS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_ALIGNED_BLOCKS_HPP

#include <sivid/number/pack/detail/vectors.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>

namespace sivid::number_detail {

/// Aligned memory for temporaries, in multiples of a cache line. What is given back is kept for the
/// next one of its size, in lists of the thread's own; so arithmetic that makes the same
/// temporaries again and again allocates in its first round only. A block may be given back in
/// another thread than the one that took it.
class aligned_blocks {
public:
    static constexpr std::size_t line = 64;

    [[nodiscard]] static void* take(std::size_t lines) {
        if (lines < kept_sizes) {
            if (node* const first = lists_.first[lines]) {
                lists_.first[lines] = first->next;
                --lists_.kept[lines];
                return first;
            }
        }
        return make(lines);
    }
    static void give_back(void* block, std::size_t lines) noexcept {
        if (lines >= kept_sizes || !lists_.open || lists_.kept[lines] * lines >= most_kept)
            return free(block);
        ++lists_.kept[lines];
        lists_.first[lines] = ::new (block) node{lists_.first[lines]};
    }

private:
    /// Larger ones are not kept: their allocation costs little beside what is done with them.
    static constexpr std::size_t kept_sizes = 512;
    /// Cache lines that a list keeps: a thread that only gives back does not hoard.
    static constexpr std::size_t most_kept = 1U << 16;

    struct node {
        node* next;
    };
    /// Without constructor and destructor, so that reading it needs no check whether it is there.
    struct lists {
        std::array<node*, kept_sizes> first;
        std::array<std::size_t, kept_sizes> kept; ///< blocks in each list
        bool open;
    };
    /// Frees what the lists hold when the thread ends.
    struct keeper {
        keeper() { lists_.open = true; }
        ~keeper() {
            lists_.open = false;
            for (auto& list : lists_.first) {
                while (list != nullptr) {
                    node* const next = list->next;
                    free(list);
                    list = next;
                }
            }
        }
        keeper(keeper const&) = delete;
        keeper& operator=(keeper const&) = delete;
    };

    [[gnu::noinline]] static void* make(std::size_t lines) {
        static thread_local keeper const here;
        (void)here;
        return ::operator new (lines* line, std::align_val_t{line});
    }
    [[gnu::noinline]] static void free(void* block) noexcept {
        ::operator delete (block, std::align_val_t{line});
    }

    static inline constinit thread_local lists lists_{};
};

/// Numbers that are needed for a while; zeros at first.
template <class C>
class scratch {
public:
    scratch() = default;
    explicit scratch(std::size_t numbers) {
        take(numbers);
        std::uninitialized_fill_n(first_, numbers, C(0.0));
    }
    ~scratch() {
        if (first_ != nullptr) aligned_blocks::give_back(first_, lines_);
    }
    scratch(scratch const&) = delete;
    scratch& operator=(scratch const&) = delete;
    /// Makes room for so many, which have no value yet.
    void resize(std::size_t numbers) {
        if (first_ != nullptr) aligned_blocks::give_back(std::exchange(first_, nullptr), lines_);
        take(numbers);
    }
    [[nodiscard]] C& operator[](std::size_t i) { return first_[i]; }
    [[nodiscard]] C const& operator[](std::size_t i) const { return first_[i]; }
    [[nodiscard]] C* data() { return first_; }

private:
    void take(std::size_t numbers) {
        lines_ = std::max<std::size_t>(
            (numbers * sizeof(C) + aligned_blocks::line - 1) / aligned_blocks::line, 1);
        first_ = static_cast<C*>(aligned_blocks::take(lines_));
    }
    std::size_t lines_ = 0;
    C* first_ = nullptr;
};

/// So many numbers in a row, aligned to a cache line: the memory of what lives longer than an
/// operation. Zeros, or not set.
template <class C>
class workspace {
public:
    struct unset {};

    workspace() = default;
    workspace(std::size_t numbers, unset)
        : first_(static_cast<C*>(::operator new (std::max<std::size_t>(numbers, 1) * sizeof(C),
                                                 std::align_val_t{aligned_blocks::line}))) {}
    explicit workspace(std::size_t numbers) : workspace(numbers, unset{}) {
        std::uninitialized_fill_n(first_.get(), numbers, C(0.0));
    }

    [[nodiscard]] C* data() { return first_.get(); }
    [[nodiscard]] C const* data() const { return first_.get(); }

private:
    struct release {
        void operator()(C* p) const noexcept {
            ::operator delete (p, std::align_val_t{aligned_blocks::line});
        }
    };
    std::unique_ptr<C, release> first_;
};

} // namespace sivid::number_detail

#endif
