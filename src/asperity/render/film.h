// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/image.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

/// What was seen in one pixel so far.
struct Pixel {
    Rgb mean;       ///< of the samples: linear radiance
    double m2 = 0;  ///< sum of squared differences of the samples' luminance from their mean
    std::uint32_t samples = 0;

    /// Takes one more sample (Welford 1962). Radiance must be finite.
    void add(Rgb radiance) {
        const double before = luminance(mean);
        ++samples;
        mean = mean + (1.0 / samples) * (radiance - mean);
        m2 += (luminance(radiance) - before) * (luminance(radiance) - luminance(mean));
    }

    /// Variance of one sample's luminance; 0 before the second sample.
    double variance() const { return samples > 1 ? m2 / (samples - 1.0) : 0.0; }
    /// Standard error of luminance(mean), as if samples were independent: better samples err less.
    double standard_error() const { return samples > 1 ? std::sqrt(variance() / samples) : 0.0; }
};

/// A picture that grows better: width x height pixels, row 0 on top.
///
/// Threads may change different pixels at a time. Pixels need not have equally many samples.
class Film {
  public:
    Film(int width, int height)
        : width_(width),
          height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    int width() const { return width_; }
    int height() const { return height_; }

    Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
    const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }
    const std::vector<Pixel>& pixels() const { return pixels_; }

    /// The means.
    Image image() const;

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_, height_;
    std::vector<Pixel> pixels_;
};

/// Relative noise of a picture: sqrt(sum of e^2 / sum of L^2) over the pixels with any variance,
/// e the standard error of the luminance L. 0 when there is none, infinite before the second
/// sample. The same bits for any number of threads.
double noise(const Film& film);

/// How two pictures differ: means over all pixels of the luminance. Throws Error(Usage, "image")
/// when their sizes differ.
struct ImageDifference {
    double mean_a = 0, mean_b = 0;
    double mean_absolute = 0;  ///< of |a - b|
    double rms = 0;
    double relative = 0;  ///< mean_absolute / mean_a; 0 when mean_a is 0
};
ImageDifference compare(const Image& a, const Image& b);

}  // namespace asperity
