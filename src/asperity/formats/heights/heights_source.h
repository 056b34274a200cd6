// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/length.h>
#include <asperity/core/run.h>
#include <asperity/surface/topography.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// What a user decides about reading a file of heights. Empty: the file decides.
struct HeightsOptions {
    std::string format;   ///< name of a row of HeightsFormats
    std::string channel;  ///< name or number, from 1
    std::string decimal;  ///< of texts: "point" or "comma"
};

/// A file of heights to be read: its bytes, what the user decided, progress and the wish to stop.
///
/// Copies share the bytes. Throws Error(InputOutput, path) when the file cannot be read and
/// Error(InvalidInput, path) for one above 16 GiB.
class HeightsSource {
  public:
    HeightsSource(const std::string& path, HeightsOptions options, Run& run);

    const std::string& path() const { return path_; }
    const HeightsOptions& options() const { return options_; }
    Run& run() const { return *run_; }
    /// Up to kSniffedHeights bytes of the beginning.
    std::string_view head() const { return head_; }
    /// The whole file, read at the first call, which tells its progress and throws Error(Stopped).
    std::span<const std::byte> bytes() const;
    std::string_view text() const;

    /// Calls row(j) for 0 <= j < ny, telling the progress. Throws Error(Stopped) when asked to
    /// stop.
    void for_each_row(int ny, const std::function<void(int)>& row) const;

    /// For loops that are no loops over rows. Waits while the run is paused; throws
    /// Error(Stopped, path).
    void throw_if_stopped() const;

    [[noreturn]] void refuse(const std::string& why) const;
    [[noreturn]] void refuse_line(std::size_t line, const std::string& why) const;

  private:
    std::string path_;
    HeightsOptions options_;
    Run* run_;
    std::string head_;
    std::shared_ptr<std::vector<std::byte>> bytes_;
};

inline constexpr std::size_t kSniffedHeights = 4096;

/// A grid of nx x ny heights of 0, spacing 1 cell. Throws Error(InvalidInput, path) for sides below
/// 2 or above kMaxSurfaceSide: compare with the bytes present before.
Topography empty_topography(std::uint64_t nx, std::uint64_t ny, const std::string& path);
/// The check of empty_topography alone.
void check_sides(std::uint64_t nx, std::uint64_t ny, const std::string& path);

/// Sets unit and spacing in metres and notes them: "heights in um from the header; spacing 0.366
/// um". Throws Error(InvalidInput, path) for a spacing that is no positive length.
void set_spacing(Topography& topography, double dx_metres, double dy_metres,
                 const std::string& heights_in, const std::string& path);
/// The same for a file that says in what the heights are, but not how far apart.
void set_heights_alone(Topography& topography, const std::string& heights_in);

}  // namespace asperity::io
