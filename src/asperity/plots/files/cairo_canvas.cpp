// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/files/cairo_canvas.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>

#include <cairo.h>

#include <algorithm>
#include <memory>
#include <string>

namespace asperity::plots {

namespace {

using ScaledFont = std::unique_ptr<cairo_scaled_font_t, decltype(&cairo_scaled_font_destroy)>;

/// Not fitted to pixels: the same layout at any scale. Cairo keeps those in use.
ScaledFont scaled_font(Font font) {
    cairo_font_face_t* face =
        cairo_toy_font_face_create("DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                                   font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_matrix_t size, upright;
    cairo_matrix_init_scale(&size, font.size, font.size);
    cairo_matrix_init_identity(&upright);
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    ScaledFont scaled(cairo_scaled_font_create(face, &size, &upright, options),
                      &cairo_scaled_font_destroy);
    cairo_font_options_destroy(options);
    cairo_font_face_destroy(face);
    return scaled;
}

}  // namespace

void check_cairo(int status) {
    if (status == CAIRO_STATUS_SUCCESS) return;
    if (status == CAIRO_STATUS_NO_MEMORY || status == CAIRO_STATUS_INVALID_SIZE)
        throw Error(ErrorCode::OutOfMemory, "the plot is too large");
    throw Error(ErrorCode::InputOutput,
                std::string("the plot could not be drawn: ") +
                    cairo_status_to_string(static_cast<cairo_status_t>(status)));
}

double CairoMeasure::width(std::string_view text, Font font) const {
    cairo_text_extents_t extents{};
    cairo_scaled_font_text_extents(scaled_font(font).get(), std::string(text).c_str(), &extents);
    return extents.x_advance;
}

double CairoMeasure::height(Font font) const {
    cairo_font_extents_t extents{};
    cairo_scaled_font_extents(scaled_font(font).get(), &extents);
    return extents.ascent + extents.descent;
}

CairoCanvas::CairoCanvas(_cairo_surface* surface, double scale, double pixels)
    : cairo_(cairo_create(surface)), pixels_(pixels) {
    cairo_scale(cairo_, scale, scale);
}

CairoCanvas::~CairoCanvas() {
    cairo_destroy(cairo_);
}

void CairoCanvas::check() const {
    check_cairo(cairo_status(cairo_));
}

void CairoCanvas::set(Colour colour) {
    cairo_set_source_rgba(cairo_, colour.r, colour.g, colour.b, colour.a);
}

void CairoCanvas::draw(const Stroke& stroke) {
    set(stroke.colour);
    cairo_set_line_width(cairo_, stroke.width);
    const bool dashed = !stroke.dashes.empty();
    cairo_set_line_cap(cairo_, dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cairo_, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
    cairo_stroke(cairo_);
}

void CairoCanvas::polyline(std::span<const Place> points, const Stroke& stroke) {
    for (const Place point : points) cairo_line_to(cairo_, point.x, point.y);
    draw(stroke);
}

void CairoCanvas::polygon(std::span<const Place> points, Colour fill) {
    for (const Place point : points) cairo_line_to(cairo_, point.x, point.y);
    cairo_close_path(cairo_);
    set(fill);
    cairo_fill(cairo_);
}

void CairoCanvas::arc(Place centre, double radius, double from, double to, const Stroke& stroke) {
    // Cairo's angles run with the y axis, which points down
    cairo_new_sub_path(cairo_);
    cairo_arc_negative(cairo_, centre.x, centre.y, radius, -from, -to);
    if (to - from >= 2 * kPi) cairo_close_path(cairo_);
    draw(stroke);
}

void CairoCanvas::disc(Place centre, double radius, Colour fill) {
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, centre.x, centre.y, radius, 0, 2 * kPi);
    set(fill);
    cairo_fill(cairo_);
}

void CairoCanvas::text(Place place, std::string_view text, Font font, Colour colour,
                       TextAlign align, double turn) {
    const std::string words(text);
    const ScaledFont scaled = scaled_font(font);
    cairo_font_extents_t line{};
    cairo_text_extents_t extents{};
    cairo_scaled_font_extents(scaled.get(), &line);
    cairo_scaled_font_text_extents(scaled.get(), words.c_str(), &extents);
    const double share = align == TextAlign::Left ? 0 : align == TextAlign::Centre ? 0.5 : 1;
    cairo_save(cairo_);
    cairo_translate(cairo_, place.x, place.y);
    cairo_rotate(cairo_, -radians(turn));
    cairo_move_to(cairo_, -share * extents.x_advance, (line.ascent - line.descent) / 2);
    cairo_set_font_face(cairo_, cairo_scaled_font_get_font_face(scaled.get()));
    cairo_set_font_size(cairo_, font.size);
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_scaled_font_get_font_options(scaled.get(), options);
    cairo_set_font_options(cairo_, options);
    cairo_font_options_destroy(options);
    set(colour);
    cairo_show_text(cairo_, words.c_str());
    cairo_restore(cairo_);
    cairo_new_path(cairo_);
}

void CairoCanvas::picture(const Box& box, const Raster& raster) {
    if (raster.width < 1 || raster.height < 1) return;
    std::vector<std::uint32_t> pixels = raster.argb;
    cairo_surface_t* image = cairo_image_surface_create_for_data(
        reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_ARGB32, raster.width,
        raster.height, cairo_format_stride_for_width(CAIRO_FORMAT_ARGB32, raster.width));
    cairo_save(cairo_);
    cairo_rectangle(cairo_, box.left, box.top, box.width, box.height);
    cairo_clip(cairo_);
    cairo_translate(cairo_, box.left, box.top);
    cairo_scale(cairo_, box.width / raster.width, box.height / raster.height);
    cairo_set_source_surface(cairo_, image, 0, 0);
    cairo_paint(cairo_);
    cairo_restore(cairo_);
    // Files keep a copy of what they still need when the pixels go
    cairo_surface_finish(image);
    cairo_surface_destroy(image);
}

void CairoCanvas::push_clip(const Box& box) {
    cairo_save(cairo_);
    cairo_rectangle(cairo_, box.left, box.top, box.width, box.height);
    cairo_clip(cairo_);
}

void CairoCanvas::pop_clip() {
    cairo_restore(cairo_);
}

}  // namespace asperity::plots
