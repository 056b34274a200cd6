// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/bsdfs/layers_exr.h>
#include <asperity/formats/test_files.h>
#include <asperity/gonio/test_layers.h>

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>

#include <numeric>
#include <set>

namespace asperity::io {
namespace {

using namespace asperity::test;

/// Reads one channel of one part, row by row.
std::vector<float> plane(Imf::MultiPartInputFile& file, int part, const std::string& channel) {
    Imf::InputPart input(file, part);
    const auto window = input.header().dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x + 1);
    const auto height = static_cast<std::size_t>(window.max.y + 1);
    EXPECT_NE(input.header().channels().findChannel(channel), nullptr) << channel;
    std::vector<float> values(width * height, -1.0F);
    Imf::FrameBuffer frame;
    frame.insert(channel,
                 Imf::Slice(Imf::FLOAT, static_cast<char*>(static_cast<void*>(values.data())),
                            sizeof(float), width * sizeof(float)));
    input.setFrameBuffer(frame);
    input.readPixels(0, window.max.y);
    return values;
}

std::set<std::string> channels_of(const Imf::Header& header) {
    std::set<std::string> names;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        names.insert(c.name());
    return names;
}

template <typename Attribute>
auto attribute(const Imf::Header& header, const std::string& name) {
    return header.typedAttribute<Attribute>(name).value();
}

/// Two layers; uneven energies over all cells, orders and channels, so that sums do not come out
/// round.
Measurement filled(DetectorKind kind, int resolution, std::vector<std::string> channels) {
    Measurement m = empty_measurement(kind, resolution, std::move(channels), {0, 30});
    m.layers[1].phi_i = radians(45);
    m.experiment.run.seed = 18446744073709551557ULL;
    for (Layer& layer : m.layers)
        for (int order = 0; order < 3; ++order)
            for (int c = 0; c < m.channels(); ++c)
                for (int cell = 0; cell < m.detector.cells(); ++cell)
                    add_rays(m, layer, order, c, cell,
                             (1 + (cell * 7 + order * 3 + c) % 11) * 0.0173 / (1 + order));
    return m;
}

TEST(LayersExr, HasOneNamedPartALayer) {
    const test::TemporaryFolder folder;
    const Measurement m = filled(DetectorKind::LatLong, 32, {"all"});
    write_layers_exr(m, folder / "a.exr");
    Imf::MultiPartInputFile file((folder / "a.exr").c_str());
    ASSERT_EQ(file.parts(), 2);
    EXPECT_EQ(file.header(0).name(), "theta_i=0.00,phi_i=0.00");
    EXPECT_EQ(file.header(1).name(), "theta_i=30.00,phi_i=45.00");
    EXPECT_EQ(file.header(1).dataWindow().max.x, 31);
    EXPECT_EQ(file.header(1).dataWindow().max.y, 15);
    EXPECT_EQ(channels_of(file.header(1)),
              (std::set<std::string>{"Y", "stderr.Y", "energy.Y", "bounce1.Y", "bounce2.Y",
                                     "bounce3.Y"}));
    EXPECT_EQ(folder.files(), 1);
}

TEST(LayersExr, AttributesTellHowItWasMeasured) {
    const test::TemporaryFolder folder;
    const Measurement m = filled(DetectorKind::EqualArea, 32, {"all"});
    write_layers_exr(m, folder / "a.exr");
    Imf::MultiPartInputFile file((folder / "a.exr").c_str());
    const Imf::Header& header = file.header(1);
    EXPECT_NEAR(attribute<Imf::DoubleAttribute>(header, "asperity:theta_i_deg"), 30, 1e-12);
    EXPECT_NEAR(attribute<Imf::DoubleAttribute>(header, "asperity:phi_i_deg"), 45, 1e-12);
    EXPECT_EQ(attribute<Imf::StringAttribute>(header, "asperity:quantity"), "brdf");
    EXPECT_EQ(attribute<Imf::StringAttribute>(header, "asperity:unit"), "1/sr");
    EXPECT_EQ(attribute<Imf::StringAttribute>(header, "asperity:seed"), "18446744073709551557");
    EXPECT_EQ(attribute<Imf::DoubleAttribute>(header, "asperity:rays"), 1000);
    EXPECT_EQ(attribute<Imf::IntAttribute>(header, "asperity:layer"), 2);
    EXPECT_EQ(attribute<Imf::StringAttribute>(header, "asperity:layout").substr(0, 11),
              "equal-area:");
    const auto edges = attribute<Imf::FloatVectorAttribute>(header, "asperity:theta_edges_deg");
    ASSERT_EQ(edges.size(), 17U);
    EXPECT_EQ(edges[0], 0.0F);
    EXPECT_NEAR(edges[4], 30, 1e-5);  // sin^2 = 4/16
    EXPECT_NEAR(edges[16], 90, 1e-5);
    EXPECT_NEAR(attribute<Imf::FloatVectorAttribute>(header, "asperity:albedo")[0],
                static_cast<float>(m.albedo(m.layers[1], 0)), 1e-7F);
}

TEST(LayersExr, EnergiesOfAPartSumToTheAlbedo) {
    const test::TemporaryFolder folder;
    const Measurement m = filled(DetectorKind::LatLong, 128, {"R", "G", "B"});
    write_layers_exr(m, folder / "a.exr");
    Imf::MultiPartInputFile file((folder / "a.exr").c_str());
    for (int part = 0; part < 2; ++part) {
        for (int c = 0; c < 3; ++c) {
            const auto energy =
                plane(file, part, "energy." + m.channel_names[static_cast<std::size_t>(c)]);
            const double albedo = m.albedo(m.layers[static_cast<std::size_t>(part)], c);
            EXPECT_NEAR(std::accumulate(energy.begin(), energy.end(), 0.0), albedo, 1e-7 * albedo);
        }
    }
}

TEST(LayersExr, RowsArePolarAnglesColumnsAzimuths) {
    const test::TemporaryFolder folder;
    Measurement m = empty_measurement(DetectorKind::LatLong, 8, {"all"}, {30});
    // Row 1 of 4 (22.5 .. 45 degrees), column 2 of 8 (90 .. 135 degrees).
    const int cell = m.detector.cell_of(from_spherical(radians(30), radians(100)));
    add_rays(m, m.layers[0], 1, 0, cell, 250);
    m.layers[0].stderr_energy[static_cast<std::size_t>(cell)] = 0.125F;
    write_layers_exr(m, folder / "a.exr");
    Imf::MultiPartInputFile file((folder / "a.exr").c_str());
    const std::size_t lit = 1 * 8 + 2;
    const auto f = plane(file, 0, "Y"), energy = plane(file, 0, "energy.Y");
    // Projected solid angle: (sin^2 45 - sin^2 22.5) / 2 * 2 pi / 8 = 0.353553 / 2 * 0.785398.
    const double f_lit = 0.25 / (0.353553391 / 2 * 0.785398163);
    for (std::size_t k = 0; k < f.size(); ++k) {
        EXPECT_NEAR(static_cast<double>(f[k]), k == lit ? f_lit : 0, 1e-6);
        EXPECT_NEAR(static_cast<double>(energy[k]), k == lit ? 0.25 : 0, 1e-9);
    }
    EXPECT_NEAR(static_cast<double>(plane(file, 0, "stderr.Y")[lit]), f_lit / 2, 1e-6);
    EXPECT_NEAR(static_cast<double>(plane(file, 0, "bounce2.Y")[lit]), f_lit, 1e-6);
    EXPECT_EQ(plane(file, 0, "bounce1.Y")[lit], 0.0F);
}

TEST(LayersExr, WavelengthsFollowTheSpectralLayout) {
    const test::TemporaryFolder folder;
    write_layers_exr(filled(DetectorKind::LatLong, 8, {"450nm", "550.5nm"}), folder / "a.exr");
    Imf::MultiPartInputFile file((folder / "a.exr").c_str());
    const auto names = channels_of(file.header(0));
    EXPECT_TRUE(names.contains("T.450,000000nm"));
    EXPECT_TRUE(names.contains("T.550,500000nm"));
    EXPECT_TRUE(names.contains("stderr.T.550,500000nm"));
    EXPECT_EQ(attribute<Imf::StringAttribute>(file.header(0), "spectralLayoutVersion"), "1.0");
}

TEST(LayersExr, NamesStayUniqueAndIsotropicOnesCarryNoAzimuth) {
    const test::TemporaryFolder folder;
    Measurement m = empty_measurement(DetectorKind::LatLong, 8, {"all"}, {30.0001, 30.0002, 60});
    m.experiment.illumination.isotropic = true;
    write_layers_exr(m, folder / "a.exr");
    Imf::MultiPartInputFile file((folder / "a.exr").c_str());
    ASSERT_EQ(file.parts(), 3);
    EXPECT_EQ(file.header(0).name(), "theta_i=30.00");
    EXPECT_EQ(file.header(1).name(), "theta_i=30.00,layer=2");
    EXPECT_EQ(file.header(2).name(), "theta_i=60.00");
    EXPECT_EQ(attribute<Imf::IntAttribute>(file.header(2), "asperity:isotropic"), 1);
}

TEST(LayersExr, FailuresAreReportedAndLeaveNothing) {
    const test::TemporaryFolder folder;
    const Measurement m = filled(DetectorKind::LatLong, 64, {"all"});
    test::expect_error(ErrorCode::InputOutput, "nowhere",
                       [&] { write_layers_exr(m, folder / "nowhere/a.exr"); });
    test::expect_error(ErrorCode::InputOutput, folder.path(),
                       [&] { write_layers_exr(m, folder.path()); });
    Measurement none = m;
    none.layers.clear();
    test::expect_error(ErrorCode::Usage, "no layer",
                       [&] { write_layers_exr(none, folder / "a.exr"); });
    EXPECT_EQ(folder.files(), 0);
}

// The room ends in the header, among the pixels, and in the last bytes, which OpenEXR writes to the
// tables of offsets while it closes the file.
TEST(LayersExr, FullDiskIsReportedAndLeavesNothing) {
    const test::TemporaryFolder folder;
    const Measurement m = filled(DetectorKind::LatLong, 64, {"all"});
    write_layers_exr(m, folder / "a.exr");
    const auto size = std::filesystem::file_size(folder / "a.exr");
    std::filesystem::remove(folder / "a.exr");
    for (const auto room : {std::uintmax_t{100}, size / 2, size - 1}) {
        const test::FileSizeLimit limit(room);
        test::expect_error(ErrorCode::InputOutput, "a.exr",
                           [&] { write_layers_exr(m, folder / "a.exr"); });
        EXPECT_EQ(folder.files(), 0) << room;
    }
}

}  // namespace
}  // namespace asperity::io
