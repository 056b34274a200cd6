// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

#include <QImage>
#include <QObject>
#include <QSize>

#include <cstdint>
#include <functional>
#include <memory>

namespace asperity::studio {

/// One picture of one view, made pass by pass.
class Painting {
  public:
    virtual ~Painting() = default;
    /// One pass over all pixels; hears run.stop_requested() within a few milliseconds. False when
    /// it was stopped, or when no further pass would better the picture. May throw.
    virtual bool pass(Run& run) = 0;
    /// What was painted so far, 8-bit, of the size asked for. After the first pass at least.
    virtual QImage image() const = 0;
    /// Samples that every pixel has after so many passes: as many, unless it is told here.
    virtual int samples(int passes) const { return passes; }
};

/// Begins a painting of `size` pixels. Holds copies of (or shared pointers to) all it needs, for it
/// is called and used by another thread. Takes a few milliseconds: all that takes longer belongs
/// into the first pass. May throw.
using BeginPainting = std::function<std::unique_ptr<Painting>(QSize size)>;

/// A picture that a Painter gives: `image` may be smaller than `full`, to be shown enlarged.
struct Frame {
    QImage image;
    QSize full;
    int passes = 0;
    int samples = 0;         ///< of every pixel; 0 while some have none
    bool moving = false;     ///< made while the view was moving
    std::uint64_t wish = 0;  ///< what Painter::paint() gave for it
    double seconds = 0;      ///< its first pass took, or all passes so far of a still view
};

/// Paints the latest view wished for in a thread of its own.
///
/// While the view moves, each wish gets one pass, at a resolution chosen so that a frame takes at
/// most a 30th of a second; a frame under way is finished first, so that something moves. Once it
/// is still, the full resolution, pass after pass, until the next wish; only a moving view breaks
/// off its first pass.
class Painter : public QObject {
    Q_OBJECT

  public:
    explicit Painter(QObject* parent = nullptr);
    ~Painter() override;  ///< stops; returns within 100 ms

    /// Gives the number of the wish, counted up; Frame::wish tells which one a frame belongs to.
    std::uint64_t paint(BeginPainting begin, QSize full, bool moving);
    void stop();  ///< keeps the last frame

    /// Frames per second and milliseconds per frame over the last second of movement, or the last
    /// frame when still. The thesis' Frame Stats.
    double frames_per_second() const;
    double milliseconds_per_frame() const;

  signals:
    /// In the thread this object lives in.
    void frame_ready(const asperity::studio::Frame& frame);
    /// What a painting threw; there will be no frame of it.
    void failed(const QString& sentence);

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace asperity::studio
