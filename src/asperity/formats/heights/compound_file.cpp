// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/compound_file.h>

#include <algorithm>

namespace asperity::io {
namespace {

constexpr std::string_view kMagic = "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1";
constexpr std::uint32_t kLastRegular = 0xfffffffa;  ///< a sector's largest number
constexpr std::uint64_t kHeaderTable = 76, kHeaderTableItems = 109;
constexpr std::uint64_t kEntryBytes = 128, kNameBytes = 64;

/// The sectors of a file and the table that chains them.
class Sectors {
  public:
    explicit Sectors(const BinaryView& view) : view_(view), shift_(view.little<std::uint16_t>(30)) {
        if (shift_ != 9 && shift_ != 12)
            view.refuse(fmt::format("sectors of 2^{} bytes are not known", shift_));
        const std::uint64_t items = bytes() / 4;
        for (std::uint64_t k = 0; k < kHeaderTableItems; ++k)
            add_table_sector(view.little<std::uint32_t>(kHeaderTable + 4 * k));
        auto next = view.little<std::uint32_t>(68);
        for (std::uint64_t k = 0; next <= kLastRegular; ++k) {
            if (k > view.size() / bytes()) view.refuse("the list of sectors runs in a circle");
            const std::uint64_t at = place(next);
            view.need(at, bytes());
            for (std::uint64_t i = 0; i + 1 < items; ++i)
                add_table_sector(view.little<std::uint32_t>(at + 4 * i));
            next = view.little<std::uint32_t>(at + bytes() - 4);
        }
    }

    std::uint64_t bytes() const { return std::uint64_t{1} << shift_; }

    /// The sectors from `first` on, one behind the other.
    std::vector<std::byte> chain(std::uint32_t first) const {
        std::vector<std::byte> all;
        for (std::uint32_t sector = first; sector <= kLastRegular; sector = next(sector)) {
            if (all.size() > view_.size()) view_.refuse("a chain of sectors runs in a circle");
            const std::uint64_t at = place(sector);
            if (at >= view_.size())
                view_.refuse(fmt::format("sector {} lies behind the end of the file", sector));
            // The last one may be cut
            const auto part = view_.part(at, std::min(bytes(), view_.size() - at));
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }

  private:
    std::uint64_t place(std::uint32_t sector) const {
        return (std::uint64_t{sector} + 1) << shift_;
    }

    void add_table_sector(std::uint32_t sector) {
        if (sector <= kLastRegular && table_.size() <= view_.size() / bytes())
            table_.push_back(sector);
    }

    std::uint32_t next(std::uint32_t sector) const {
        const std::uint64_t items = bytes() / 4;
        const std::uint64_t part = sector / items;
        if (part >= table_.size()) view_.refuse(fmt::format("sector {} is in no table", sector));
        return view_.little<std::uint32_t>(place(table_[static_cast<std::size_t>(part)]) +
                                           4 * (sector % items));
    }

    const BinaryView& view_;
    std::uint64_t shift_;
    std::vector<std::uint32_t> table_;  ///< sectors that hold the table
};

/// "ScopedContents" as 16-bit letters.
bool is_named(const BinaryView& directory, std::uint64_t at, std::string_view name) {
    if (directory.little<std::uint16_t>(at + kNameBytes) != 2 * (name.size() + 1)) return false;
    for (std::size_t k = 0; k < name.size(); ++k)
        if (directory.little<std::uint16_t>(at + 2 * k) !=
            static_cast<std::uint16_t>(static_cast<unsigned char>(name[k])))
            return false;
    return true;
}

}  // namespace

bool is_compound_file(std::string_view head) {
    return head.starts_with(kMagic);
}

std::vector<std::byte> read_compound_stream(const BinaryView& view, std::string_view name) {
    const Sectors sectors(view);
    const std::vector<std::byte> entries = sectors.chain(view.little<std::uint32_t>(48));
    const BinaryView directory(entries, view.path());
    for (std::uint64_t at = 0; at + kEntryBytes <= directory.size(); at += kEntryBytes) {
        if (!is_named(directory, at, name)) continue;
        const auto size = directory.little<std::uint64_t>(at + 120);
        if (size < view.little<std::uint32_t>(56))
            view.refuse(fmt::format("the stream {} of {} bytes is too short", name, size));
        std::vector<std::byte> stream = sectors.chain(directory.little<std::uint32_t>(at + 116));
        if (stream.size() < size)
            view.refuse(fmt::format("the stream {} has {} bytes of {}", name, stream.size(), size));
        stream.resize(static_cast<std::size_t>(size));
        return stream;
    }
    view.refuse(fmt::format("the file has no stream {}", name));
}

}  // namespace asperity::io
