// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/heights/heights_source.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// One grid of a file, not read yet.
struct HeightsChannel {
    std::string name;                  ///< as the file has it, or "heights"
    std::uint64_t nx = 0, ny = 0;      ///< as the file claims, unchecked
    std::string other;                 ///< empty: heights; else what it holds: "image", "in V"
    std::function<Topography()> read;  ///< throws Error(InvalidInput, path), Error(Stopped, path)
};

/// A format of heights: a row of HeightsFormats. A new one is one file and one row in
/// builtin_heights.cpp, or an add() in a program of yours.
struct HeightsFormat {
    std::string name;                  ///< "gsf"
    std::vector<std::string> endings;  ///< {"gsf"}, small letters; the first row with one wins
    std::string doc;                   ///< one sentence: whose it is, what is read
    /// True when a file that begins like this can only be of this format. Null: by ending alone.
    std::function<bool(std::string_view head)> recognises;
    /// The channels of the file, in its order. Compares every claimed size with the bytes present
    /// before it allocates. Null: write only.
    std::function<std::vector<HeightsChannel>(const HeightsSource&)> open;
    /// Writes the file, whole or not at all. Null: read only.
    std::function<void(const Heightfield&, const std::string& path)> write;
};

/// The formats of heights a program knows. A value: make one, add to it, hand it on.
class HeightsFormats {
  public:
    /// Those that Asperity brings.
    HeightsFormats();

    /// Adds a row before the others, so that it is tried first. Throws Error(Usage, name) when the
    /// name is taken.
    void add(HeightsFormat format);

    const std::vector<HeightsFormat>& rows() const& { return rows_; }
    /// Null when there is none of this name.
    const HeightsFormat* find(std::string_view name) const;

    /// The format of a file: options().format, else by its first bytes, else by its ending. Throws
    /// Error(Usage, "format") and Error(InvalidInput, path).
    const HeightsFormat& for_reading(const HeightsSource& source) const;
    /// By the ending. Throws Error(Usage, path).
    const HeightsFormat& for_writing(const std::string& path) const;

    /// All channels of the file; Topography::read may be called after `source` is gone.
    std::vector<HeightsChannel> list(const HeightsSource& source) const;
    /// The channel that options().channel names, or the one channel of heights. Throws
    /// Error(InvalidInput, path) where several are there and none is chosen; what reading throws.
    Topography read(const HeightsSource& source) const;

  private:
    std::vector<HeightsFormat> rows_;
};

/// The formats that Asperity brings, in the order in which they are tried.
std::vector<HeightsFormat> builtin_heights();

/// "txt" of "a/b.TXT": small letters, no dot.
std::string ending_of(const std::string& path);

}  // namespace asperity::io
