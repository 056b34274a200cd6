// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/version.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/layers_exr.h>
#include <asperity/formats/exr/exr_stream.h>
#include <fmt/format.h>

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace asperity::io {

namespace {

/// Names of the channels of f: Y for one; R, G, B; and for wavelengths the names of Fichet et al.
/// 2021, "An OpenEXR layout for spectral images": "T.550,000000nm".
struct ChannelNames {
    std::vector<std::string> names;
    bool spectral = false;

    explicit ChannelNames(const std::vector<std::string>& channels) {
        for (const std::string& channel : channels) {
            double wavelength = 0;
            const char* end = channel.data() + channel.size();
            const auto [rest, error] = std::from_chars(channel.data(), end, wavelength);
            if (error == std::errc() && std::string_view(rest) == "nm") {
                std::string name = fmt::format("T.{:.6f}nm", wavelength);
                std::replace(name.begin() + 2, name.end(), '.', ',');
                names.push_back(name);
                spectral = true;
            } else {
                names.push_back(channels.size() == 1 ? "Y" : channel);
            }
        }
    }
};

/// One channel of a part: its name and its values, row by row.
struct Plane {
    std::string name;
    std::vector<float> values;
};

template <typename OfCell>
Plane make_plane(std::string name, int cells, OfCell&& of_cell) {
    Plane plane{std::move(name), std::vector<float>(static_cast<std::size_t>(cells))};
    for (int cell = 0; cell < cells; ++cell)
        plane.values[static_cast<std::size_t>(cell)] = static_cast<float>(of_cell(cell));
    return plane;
}

std::vector<std::string> plane_names(const Measurement& m) {
    std::vector<std::string> names;
    for (const std::string& channel : ChannelNames(m.channel_names).names) {
        names.push_back(channel);
        names.push_back("stderr." + channel);
        names.push_back("energy." + channel);
        for (int order = 0; order < m.orders(); ++order)
            names.push_back(fmt::format("bounce{}.{}", order + 1, channel));
    }
    return names;
}

/// All planes of a layer, in the order of plane_names().
std::vector<Plane> planes_of(const Measurement& m, const Layer& layer, const Run* until) {
    const std::vector<std::string> names = plane_names(m);
    const int cells = m.detector.cells(), columns = m.detector.columns();
    std::vector<Plane> planes;
    const auto add = [&](auto&& of_cell) {
        check_stop(until);
        planes.push_back(make_plane(names[planes.size()], cells, of_cell));
    };
    for (int c = 0; c < m.channels(); ++c) {
        add([&](int cell) { return m.brdf(layer, c, cell); });
        add([&](int cell) { return m.brdf_stderr(layer, c, cell); });
        add([&](int cell) { return m.energy(layer, c, cell); });
        for (int order = 0; order < m.orders(); ++order)
            add([&](int cell) {
                return m.energy(layer, order, c, cell) /
                       m.detector.projected_solid_angle(cell / columns);
            });
    }
    return planes;
}

/// "theta_i=30.00,phi_i=0.00", without azimuth when isotropic; incidences that differ by less than
/// the digits shown are told apart by their layer number.
std::vector<std::string> part_names(const Measurement& m) {
    std::vector<std::string> names;
    std::set<std::string> used;
    for (const Layer& layer : m.layers) {
        std::string name = fmt::format("theta_i={:.2f}", degrees(layer.theta_i));
        if (!m.experiment.illumination.isotropic)
            name += fmt::format(",phi_i={:.2f}", degrees(layer.phi_i));
        if (!used.insert(name).second) {
            name += fmt::format(",layer={}", layer.number);
            used.insert(name);
        }
        names.push_back(name);
    }
    return names;
}

std::vector<float> theta_edges_deg(const Detector& detector) {
    std::vector<float> edges;
    for (int row = 0; row <= detector.rows(); ++row)
        edges.push_back(static_cast<float>(degrees(detector.theta_edge(row))));
    return edges;
}

void describe(Imf::Header& header, const Measurement& m, const Layer& layer) {
    const auto text = [&](const char* name, const std::string& value) {
        header.insert(name, Imf::StringAttribute(value));
    };
    const auto number = [&](const char* name, double value) {
        header.insert(name, Imf::DoubleAttribute(value));
    };
    std::vector<float> albedo;
    for (int c = 0; c < m.channels(); ++c) albedo.push_back(static_cast<float>(m.albedo(layer, c)));

    text("asperity:version", m.version.empty() ? kVersion : m.version);
    text("asperity:quantity", "brdf");
    text("asperity:unit", "1/sr");
    text("asperity:layout",
         m.detector.kind() == DetectorKind::LatLong
             ? "latlong: rows uniform in theta_o, columns uniform in phi_o, cell centres"
             : "equal-area: rows uniform in sin^2 theta_o, columns uniform in phi_o, cell centres");
    header.insert("asperity:theta_edges_deg",
                  Imf::FloatVectorAttribute(theta_edges_deg(m.detector)));
    text("asperity:surface", m.surface_name);
    header.insert("asperity:layer", Imf::IntAttribute(layer.number));
    number("asperity:theta_i_deg", degrees(layer.theta_i));
    number("asperity:phi_i_deg", degrees(layer.phi_i));
    header.insert("asperity:isotropic",
                  Imf::IntAttribute(m.experiment.illumination.isotropic ? 1 : 0));
    number("asperity:rays", static_cast<double>(layer.rays));
    text("asperity:seed",
         fmt::format("{}", m.experiment.run.seed));  // 64 bits: no number type fits
    header.insert("asperity:channels", Imf::StringVectorAttribute(m.channel_names));
    header.insert("asperity:albedo", Imf::FloatVectorAttribute(albedo));
    text("asperity:bounces",
         fmt::format("bounce{} holds all reflections from {} up", m.orders(), m.orders()));
}

Imf::Header header_of(const Measurement& m, const Layer& layer, const std::string& name) {
    Imf::Header header(m.detector.columns(), m.detector.rows());
    header.setName(name);
    header.setType(Imf::SCANLINEIMAGE);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& channel : plane_names(m))
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    if (ChannelNames(m.channel_names).spectral)
        header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
    describe(header, m, layer);
    return header;
}

void write_part(Imf::MultiPartOutputFile& file, int part, const Measurement& m, const Layer& layer,
                const Run* until) {
    std::vector<Plane> planes = planes_of(m, layer, until);
    const std::size_t columns = static_cast<std::size_t>(m.detector.columns());
    Imf::FrameBuffer frame;
    for (Plane& plane : planes)
        frame.insert(
            plane.name,
            Imf::Slice(Imf::FLOAT, static_cast<char*>(static_cast<void*>(plane.values.data())),
                       sizeof(float), columns * sizeof(float)));
    Imf::OutputPart output(file, part);
    output.setFrameBuffer(frame);
    // As many rows as are compressed together
    constexpr int kRows = 16;
    for (int row = 0; row < m.detector.rows(); row += kRows) {
        check_stop(until);
        output.writePixels(std::min(kRows, m.detector.rows() - row));
    }
}

void write_parts(Imf::OStream& stream, const Measurement& m, const Run* until) {
    const std::vector<std::string> names = part_names(m);
    std::vector<Imf::Header> headers;
    for (std::size_t k = 0; k < m.layers.size(); ++k)
        headers.push_back(header_of(m, m.layers[k], names[k]));
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t k = 0; k < m.layers.size(); ++k)
        write_part(file, static_cast<int>(k), m, m.layers[k], until);
}

}  // namespace

void write_layers_exr(const Measurement& measurement, const std::string& path, const Run* until) {
    if (measurement.layers.empty())
        throw Error(ErrorCode::Usage, "there is no layer to write", path);
    write_exr(
        path, [&](Imf::OStream& stream) { write_parts(stream, measurement, until); }, until);
}

BsdfFormat layers_exr_format() {
    const auto write = [](const ExportSource& source, const FormatOptions&,
                          const std::string& path) -> BsdfFormat::Remarks {
        if (!source.measurement())
            throw Error(ErrorCode::Usage, "layers needs a measurement", "format");
        write_layers_exr(*source.measurement(), path, source.watched());
        return {};
    };
    return {
        "layers", {"exr"}, "all layers as a multi-part EXR: f, errors, energies and bounce orders",
        {},       write,   {},
        {}};
}

}  // namespace asperity::io
