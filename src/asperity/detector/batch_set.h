// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace asperity {

/// Numbers of batches [begin, end).
struct BatchRange {
    std::uint64_t begin = 0, end = 0;
    std::uint64_t size() const { return end - begin; }
    bool operator==(const BatchRange&) const = default;
};

/// What both hold; an empty range at one of their ends if there is nothing.
inline BatchRange common(BatchRange a, BatchRange b) {
    const std::uint64_t begin = std::clamp(b.begin, a.begin, a.end);
    return {begin, std::clamp(b.end, begin, a.end)};
}

/// Which batches of a layer are done: ranges in order, with a gap between any two.
class BatchSet {
  public:
    BatchSet() = default;

    /// Adds all of these; false, and nothing is added, if one of them is there already or the range
    /// is empty.
    bool add(BatchRange range);
    /// Likewise, for the ranges of another set.
    bool add(const BatchSet& other);
    bool contains(std::uint64_t batch) const;
    std::uint64_t count() const;
    /// Those of [0, end) that are not in here.
    std::vector<BatchRange> missing(std::uint64_t end) const;
    /// The number after the largest one; 0 when there is none.
    std::uint64_t end() const { return ranges_.empty() ? 0 : ranges_.back().end; }
    std::uint64_t first_missing() const {
        return ranges_.empty() || ranges_.front().begin > 0 ? 0 : ranges_.front().end;
    }
    const std::vector<BatchRange>& ranges() const { return ranges_; }
    bool operator==(const BatchSet&) const = default;

  private:
    std::vector<BatchRange> ranges_;
};

}  // namespace asperity
