// SPDX-License-Identifier: Apache-2.0
// All cells of all layers as plain text, a line each, which every program reads.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>

#include <fmt/format.h>

namespace asperity::io {
namespace {

std::string head_of(const ExportSource& source, const Measurement& m) {
    std::string text;
    for (const std::string& line : source.provenance()) text += "# " + line + "\n";
    text +=
        "# degrees; theta_o and phi_o are the middles of cells; f in 1/sr without a cosine, "
        "its standard error, the rays of full energy that it comes from (below 10 the error is a "
        "rough one), the projected solid angle of the cell in sr\n"
        "layer,theta_i,phi_i,theta_o,phi_o,solid_angle";
    for (const std::string& channel : m.channel_names)
        text += fmt::format(",f_{0},stderr_{0},rays_{0}", channel);
    return text + "\n";
}

std::string lines_of(const Measurement& m, const Layer& layer, int row) {
    std::string text;
    for (int column = 0; column < m.detector.columns(); ++column) {
        const int cell = row * m.detector.columns() + column;
        text += fmt::format(
            "{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", layer.number, degrees(layer.theta_i),
            degrees(layer.phi_i), degrees(m.detector.theta_centre(row)),
            degrees(m.detector.phi_centre(column)), m.detector.projected_solid_angle(row));
        for (int c = 0; c < m.channels(); ++c)
            text += fmt::format(",{:.7g},{:.3g},{:.3g}", m.brdf(layer, c, cell),
                                m.brdf_stderr(layer, c, cell),
                                m.energy(layer, c, cell) * static_cast<double>(layer.rays));
        text += '\n';
    }
    return text;
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions&,
                          const std::string& path) {
    const Measurement* m = source.measurement();
    if (!m) throw Error(ErrorCode::Usage, "layers-csv needs a measurement", "format");
    AtomicFile file(path, source.watched());
    file.write(head_of(source, *m));
    for (const Layer& layer : m->layers)
        for (int row = 0; row < m->detector.rows(); ++row) file.write(lines_of(*m, layer, row));
    file.commit();
    return {};
}

}  // namespace

BsdfFormat layers_csv_format() {
    return {
        "layers-csv", {"csv"}, "all cells of all layers with their errors, a line each", {}, write,
        {},           {}};
}

}  // namespace asperity::io
