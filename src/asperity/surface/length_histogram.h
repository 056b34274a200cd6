// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace asperity {

/// Counts lengths in 2^FractionBits bins an octave, from 2^-24 to 2^16; shorter and longer ones go
/// into the first and the last bin. Counting is exact, so the order of adding does not matter.
/// Holds the 2^31 facets of the largest surface.
template <int FractionBits>
class LengthHistogram {
  public:
    static constexpr int kOctaves = 40;
    static constexpr int kBins = kOctaves << FractionBits;

    LengthHistogram() : counts_(kBins, 0) {}

    /// Bin of a length >= 0: the exponent and the first bits of the fraction of the double.
    static int bin(double length) {
        const auto bits = std::bit_cast<std::uint64_t>(length);
        const auto place = static_cast<std::int64_t>(bits >> kDropped) - kFirst;
        if (place < 0) return 0;
        return place < kBins ? static_cast<int>(place) : kBins - 1;
    }

    /// Smallest length of bin b; that of bin 0 is taken as 0. Bin kBins is the upper end.
    static double lower_end(int b) {
        if (b == 0) return 0;
        return std::bit_cast<double>(static_cast<std::uint64_t>(b + kFirst) << kDropped);
    }

    void add(double length) { ++counts_[static_cast<std::size_t>(bin(length))]; }

    LengthHistogram& operator+=(const LengthHistogram& other) {
        for (std::size_t b = 0; b < counts_.size(); ++b) counts_[b] += other.counts_[b];
        return *this;
    }

    const std::vector<std::uint32_t>& counts() const { return counts_; }

  private:
    static constexpr int kDropped = 52 - FractionBits;
    static constexpr std::int64_t kFirst = std::int64_t{1023 - 24} << FractionBits;

    std::vector<std::uint32_t> counts_;
};

/// Share of lengths below a given one, linear within a bin: made once from a full histogram.
template <int FractionBits>
class LengthRanks {
  public:
    using Histogram = LengthHistogram<FractionBits>;

    explicit LengthRanks(const Histogram& histogram) {
        below_.push_back(0);
        for (const std::uint32_t count : histogram.counts())
            below_.push_back(below_.back() + count);
    }

    std::uint64_t total() const { return below_.back(); }

    /// Number of lengths below the lower end of bin b, 0 <= b <= kBins.
    std::uint64_t below(int b) const { return below_[static_cast<std::size_t>(b)]; }

    /// Rank of `length` over the number of lengths, kept half a rank away from 0 and 1.
    double share(double length) const {
        const int b = Histogram::bin(length);
        const double low = Histogram::lower_end(b), high = Histogram::lower_end(b + 1);
        const double inside = std::min(1.0, (length - low) / (high - low));
        const auto first = static_cast<double>(below(b)), next = static_cast<double>(below(b + 1));
        const auto count = static_cast<double>(total());
        const double rank = first + inside * (next - first);
        return std::clamp(rank, 0.5, count - 0.5) / count;
    }

  private:
    std::vector<std::uint64_t> below_;
};

}  // namespace asperity
