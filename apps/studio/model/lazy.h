// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <utility>

namespace asperity::studio {

/// A value that is made when it is first needed, by the thread that needs it.
template <class T>
class Lazy {
  public:
    explicit Lazy(std::function<T()> make) : make_(std::move(make)) {}

    /// Made here if it is not there yet; waits for another thread that makes it. Throws what
    /// making it throws, and tries again the next time.
    const T& get() const {
        const std::lock_guard lock(mutex_);
        if (!value_) {
            value_.emplace(make_());
            make_ = {};
        }
        return *value_;
    }

    /// Null as long as it is not made; never waits.
    const T* if_made() const {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        return lock && value_ ? &*value_ : nullptr;
    }

  private:
    mutable std::mutex mutex_;
    mutable std::function<T()> make_;
    mutable std::optional<T> value_;
};

}  // namespace asperity::studio
