// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/batch_set.h>

#include <algorithm>

namespace asperity {

bool BatchSet::add(BatchRange range) {
    if (range.begin >= range.end) return false;
    const auto after =
        std::lower_bound(ranges_.begin(), ranges_.end(), range.begin,
                         [](const BatchRange& r, std::uint64_t begin) { return r.begin < begin; });
    if (after != ranges_.end() && after->begin < range.end) return false;
    if (after != ranges_.begin() && std::prev(after)->end > range.begin) return false;
    auto added = ranges_.insert(after, range);
    // Neighbours without a gap become one
    if (std::next(added) != ranges_.end() && std::next(added)->begin == added->end) {
        added->end = std::next(added)->end;
        ranges_.erase(std::next(added));
    }
    if (added != ranges_.begin() && std::prev(added)->end == added->begin) {
        std::prev(added)->end = added->end;
        ranges_.erase(added);
    }
    return true;
}

bool BatchSet::add(const BatchSet& other) {
    BatchSet both = *this;
    for (const BatchRange& range : other.ranges_)
        if (!both.add(range)) return false;
    *this = std::move(both);
    return true;
}

bool BatchSet::contains(std::uint64_t batch) const {
    return std::any_of(ranges_.begin(), ranges_.end(),
                       [&](const BatchRange& r) { return r.begin <= batch && batch < r.end; });
}

std::vector<BatchRange> BatchSet::missing(std::uint64_t end) const {
    std::vector<BatchRange> gaps;
    std::uint64_t next = 0;
    for (const BatchRange& r : ranges_) {
        if (next < std::min(r.begin, end)) gaps.push_back({next, std::min(r.begin, end)});
        next = r.end;
    }
    if (next < end) gaps.push_back({next, end});
    return gaps;
}

std::uint64_t BatchSet::count() const {
    std::uint64_t sum = 0;
    for (const BatchRange& r : ranges_) sum += r.end - r.begin;
    return sum;
}

}  // namespace asperity
