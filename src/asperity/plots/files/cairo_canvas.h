// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/canvas.h>

struct _cairo;          // cairo_t
struct _cairo_surface;  // cairo_surface_t

namespace asperity::plots {

/// Throws Error(OutOfMemory | InputOutput) for a status of Cairo's that is none of success.
void check_cairo(int status);

/// Widths of texts in the type that CairoCanvas writes with: DejaVu Sans, or what the system has in
/// its place.
class CairoMeasure final : public TextMeasure {
  public:
    double width(std::string_view text, Font font) const override;
    double height(Font font) const override;
};

/// Draws on a surface of Cairo's, which must live as long.
class CairoCanvas final : public Canvas {
  public:
    /// `scale`: units of the surface to one of ours; `pixels`: of pictures to one of ours.
    CairoCanvas(_cairo_surface* surface, double scale, double pixels);
    ~CairoCanvas() override;
    CairoCanvas(const CairoCanvas&) = delete;
    CairoCanvas& operator=(const CairoCanvas&) = delete;

    void polyline(std::span<const Place> points, const Stroke& stroke) override;
    void polygon(std::span<const Place> points, Colour fill) override;
    void arc(Place centre, double radius, double from, double to, const Stroke& stroke) override;
    void disc(Place centre, double radius, Colour fill) override;
    void text(Place place, std::string_view text, Font font, Colour colour, TextAlign align,
              double turn) override;
    void picture(const Box& box, const Raster& raster) override;
    void push_clip(const Box& box) override;
    void pop_clip() override;
    double pixels_per_unit() const override { return pixels_; }
    /// Throws Error(OutOfMemory | InputOutput) when something could not be drawn.
    void check() const;

  private:
    void set(Colour colour);
    void draw(const Stroke& stroke);

    _cairo* cairo_;
    double pixels_;
};

}  // namespace asperity::plots
