// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/files/write_plot.h>

#include <asperity/core/error.h>
#include <asperity/core/version.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/plots/files/cairo_canvas.h>

#include <fmt/format.h>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>

namespace asperity::plots {

namespace {

constexpr std::array kEndings = {"svg", "pdf", "png", "csv"};
constexpr const char* kWrongEnding = "a plot is written as .svg, .pdf, .png or .csv";
constexpr double kPointsPerUnit = 0.75;  ///< 72 points, 96 units an inch
/// Drawings can be enlarged: pictures in them are finer than any screen.
constexpr double kPixelsInDrawings = 3;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    try {
        static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    } catch (const std::bad_alloc&) {
        return CAIRO_STATUS_NO_MEMORY;
    }
}

struct Size {
    double width, height;
};

Surface make_surface(const std::string& ending, Size size, double scale, std::string* bytes) {
    cairo_surface_t* surface = nullptr;
    if (ending == "svg") {
        surface = cairo_svg_surface_create_for_stream(append, bytes, size.width, size.height);
        cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    } else if (ending == "pdf") {
        surface = cairo_pdf_surface_create_for_stream(append, bytes, kPointsPerUnit * size.width,
                                                      kPointsPerUnit * size.height);
        const std::string creator = std::string("Asperity ") + kVersion;
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, creator.c_str());
    } else {
        surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                             static_cast<int>(std::lround(scale * size.width)),
                                             static_cast<int>(std::lround(scale * size.height)));
    }
    Surface owned(surface, &cairo_surface_destroy);
    check_cairo(cairo_surface_status(surface));
    return owned;
}

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

bool is_known(const std::string& ending) {
    return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace

std::string plot_file_endings() {
    return fmt::format("{}", fmt::join(kEndings, ", "));
}

void check_plot_path(const std::string& path) {
    if (!is_known(ending_of(path))) throw Error(ErrorCode::Usage, kWrongEnding, path);
}

std::string plot_bytes(const Plot& plot, const PlotFileSettings& settings,
                       const std::string& ending) {
    if (!is_known(ending)) throw Error(ErrorCode::Usage, kWrongEnding, ending);
    if (ending == "csv") return csv_text(plot.table());
    const auto measure = std::make_shared<CairoMeasure>();
    const PlotStyle style = settings.dark ? PlotStyle::dark_screen(measure, settings.font_size)
                                          : PlotStyle::light(measure, settings.font_size);
    const double height =
        settings.height > 0 ? settings.height : std::ceil(plot.height_for(settings.width, style));
    Size size{settings.width, height};
    if (ending == "png")  // whole pixels
        size = {std::round(settings.scale * size.width) / settings.scale,
                std::round(settings.scale * size.height) / settings.scale};
    std::string bytes;
    const Surface surface = make_surface(ending, size, settings.scale, &bytes);
    const double scale = ending == "svg" ? 1 : ending == "pdf" ? kPointsPerUnit : settings.scale;
    {
        CairoCanvas canvas(surface.get(), scale,
                           ending == "png" ? settings.scale : kPixelsInDrawings);
        plot.paint(canvas, {0, 0, size.width, size.height}, style);
        canvas.check();
    }
    if (ending == "png")
        check_cairo(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
    cairo_surface_finish(surface.get());
    check_cairo(cairo_surface_status(surface.get()));
    return bytes;
}

void write_plot(const Plot& plot, const PlotFileSettings& settings, const std::string& path) {
    check_plot_path(path);
    const std::string bytes = plot_bytes(plot, settings, ending_of(path));
    io::AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

}  // namespace asperity::plots
