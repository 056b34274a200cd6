// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QSize>

#include <deque>

namespace asperity::studio {

/// Chooses how large the pictures of a moving view are, so that each is done in time, from how long
/// those before it took. Takes time to be proportional to the number of pixels.
class FramePacer {
  public:
    static constexpr double kBudget = 0.025;      ///< [s]: of the 33 ms of a frame, some are for Qt
    static constexpr double kSmallest = 1.0 / 8;  ///< of the full width and height

    /// At most `full`, at least kSmallest of it, both sides in proportion; 1 x 1 at least.
    QSize moving_size(QSize full) const;

    /// A picture of this size took that long. Slower than thought counts at once; faster only
    /// bit by bit, so that the size does not flutter.
    void took(QSize size, double seconds);
    /// Whether any picture told of its time.
    bool knows() const { return seconds_per_pixel_ > 0; }

  private:
    double seconds_per_pixel_ = 0;  ///< 0: nothing is known yet
};

/// Counts the frames of movements: how many a second over the last second, how long each took.
class FrameRate {
  public:
    /// A frame was shown at the time `now`, and `seconds` were spent on it. A pause of more than
    /// kPause begins a new movement.
    void shown(double now, double seconds);

    double frames_per_second() const;  ///< 0 before the second frame of a movement
    double milliseconds_per_frame() const;

  private:
    static constexpr double kPause = 0.25, kWindow = 1;  // [s]
    struct Entry {
        double now, seconds;
    };
    std::deque<Entry> entries_;
};

}  // namespace asperity::studio
