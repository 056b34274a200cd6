// SPDX-License-Identifier: Apache-2.0
// A hand-made measurement and a PNG reader of its own for the tests of pictures.
#pragma once

#include <asperity/core/energy.h>
#include <asperity/gonio/measurement.h>
#include <asperity/io/canvas.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>

#include <csignal>
#include <string>
#include <vector>

namespace asperity::io::test {

/// A measurement without energy: one layer a polar angle, 1000 rays each, three bounce orders.
inline Measurement empty_measurement(DetectorKind kind, int resolution,
                                     std::vector<std::string> channels,
                                     const std::vector<double>& theta_deg) {
    Measurement m;
    m.experiment.detector = {kind, resolution, 3};
    m.experiment.run.bounces = 8;
    m.experiment.illumination.theta_deg = theta_deg;
    m.detector = Detector(m.experiment.detector);
    m.channel_names = std::move(channels);
    m.surface_name = "hand-made";
    const auto cells = static_cast<std::size_t>(m.detector.cells());
    const std::size_t n = m.channel_names.size();
    int number = 0;
    for (const double theta : theta_deg) {
        Layer layer;
        layer.number = ++number;
        layer.theta_i = radians(theta);
        layer.rays = 1000;
        layer.energy.assign(3 * n * cells, 0);
        layer.escaped.assign(n, 0);
        layer.escaped_by_bounce.assign(8 * n, 0);
        layer.stderr_energy.assign(n * cells, 0.0F);
        m.layers.push_back(layer);
    }
    return m;
}

/// Adds `rays` rays of full energy to a cell.
inline void add_rays(Measurement& m, Layer& layer, int order, int channel, int cell, double rays) {
    const auto slice = static_cast<std::size_t>(order * m.channels() + channel);
    const auto cells = static_cast<std::size_t>(m.detector.cells());
    const auto energy = static_cast<std::uint64_t>(rays * static_cast<double>(kRayEnergy));
    layer.energy[slice * cells + static_cast<std::size_t>(cell)] += energy;
    layer.escaped[static_cast<std::size_t>(channel)] += energy;
}

/// While it lives, files of this process can grow to `bytes` and no further, like a full disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(std::uintmax_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{static_cast<rlim_t>(bytes), before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
};

/// A PNG as libpng reads it.
struct ReadPng {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;

    explicit ReadPng(const std::string& path) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return;
        image.format = PNG_FORMAT_RGB;
        bytes.resize(PNG_IMAGE_SIZE(image));
        if (png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) == 0) return;
        width = static_cast<int>(image.width);
        height = static_cast<int>(image.height);
    }

    std::vector<int> at(int x, int y) const {
        const std::size_t k = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x));
        return {bytes.at(k), bytes.at(k + 1), bytes.at(k + 2)};
    }
};

/// A colour as bytes.
inline std::vector<int> rgb(Colour c) {
    Canvas one(1, 1, c);
    return {one.bytes()[0], one.bytes()[1], one.bytes()[2]};
}

}  // namespace asperity::io::test
