// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/bsdfs/export_source.h>
#include <asperity/formats/bsdfs/format_options.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// A format of BSDFs: a row of BsdfFormats. A new one is one file and one row in
/// builtin_formats.cpp, or an add() in a program of yours.
struct BsdfFormat {
    std::string name;                  ///< "rgl"
    std::vector<std::string> endings;  ///< {"bsdf"}, small letters; the first row with one wins
    std::string doc;                   ///< one sentence: who reads it, what it holds
    std::vector<FormatOption> options;

    /// Writes the file, whole or not at all (AtomicFile). Returns one sentence each on what the
    /// format could not hold or what was done to the data first. Null: read only. Throws
    /// Error(InputOutput, path), Error(Usage).
    using Remarks = std::vector<std::string>;
    std::function<Remarks(const ExportSource&, const FormatOptions&, const std::string& path)>
        write;

    /// True when a file that begins like this (up to kSniffedBytes) can only be of this format.
    std::function<bool(std::string_view head)> recognises;

    /// Reads a file as what the format's own readers make of it, interpolation included. Null:
    /// write only. Throws Error(InvalidInput, "path" or "path:line"), Error(InputOutput, path).
    std::function<std::unique_ptr<Bsdf>(const std::string& path)> read;
};

/// What BsdfFormat::recognises is shown at most.
inline constexpr std::size_t kSniffedBytes = 4096;

/// The formats a program knows. A value: make one, add to it, hand it on.
class BsdfFormats {
  public:
    /// Those that Asperity brings.
    BsdfFormats();

    /// Adds a row before the others, so that its endings win. Throws Error(Usage, name) when the
    /// name is taken.
    void add(BsdfFormat format);

    const std::vector<BsdfFormat>& rows() const& { return rows_; }
    /// Null when there is none of this name.
    const BsdfFormat* find(std::string_view name) const;

    /// The format that `path` shall be written in: `name`, or by its ending where `name` is empty.
    /// Throws Error(Usage, "format") or Error(Usage, path), naming what there is.
    const BsdfFormat& for_writing(const std::string& path, const std::string& name) const;

    /// True when the file exists and begins like one of the formats that can be read, or has an
    /// ending of one of those and is no result of ours.
    bool can_read(const std::string& path) const;
    /// Reads a file as a Bsdf, by its first bytes, else by its ending. Throws Error(InvalidInput).
    std::unique_ptr<Bsdf> read(const std::string& path) const;

  private:
    const BsdfFormat* for_reading(const std::string& path) const;

    std::vector<BsdfFormat> rows_;
};

}  // namespace asperity::io
