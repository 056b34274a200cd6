// SPDX-License-Identifier: Apache-2.0
// Formats that are grids of angles: read from files written by hand, back and forth, and damaged.
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/formats/bsdfs/angle_table.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/test_files.h>

#include <fmt/format.h>

#include <array>

namespace asperity::io {
namespace {

const std::vector<std::string> kFormats = {"zemax", "speos-brdf", "speos-anisotropic", "lighttools",
                                           "csv",   "astm",       "openmaterial"};

ExportSource source_of(const std::string& spec) {
    Experiment experiment;
    experiment.illumination.theta_deg = {0, 25, 50, 75};
    experiment.detector.resolution = 48;
    return {parse_brdf_spec(spec), experiment, 2};
}

/// f of one channel for light in the plane y = 0 from +x; `theta_o` above 0 on the mirror side, at
/// `phi` beyond it.
double f_at(const Bsdf& bsdf, double theta_i, double theta_o, double phi = 0) {
    std::array<double, kMaxBsdfChannels> f{};
    bsdf.eval(from_spherical(radians(theta_i), 0),
              from_spherical(radians(theta_o), kPi + radians(phi)),
              std::span(f).first(static_cast<std::size_t>(bsdf.channels())));
    return f[0];
}

TEST(AngleFormats, GreyModelsComeBack) {
    const test::TemporaryFolder folder;
    const ExportSource source = source_of("ggx:alpha=0.4");
    const BsdfFormats formats;
    for (const std::string& name : kFormats) {
        const BsdfFormat& format = *formats.find(name);
        const std::string path = folder / ("a." + format.endings.front());
        format.write(source, FormatOptions(format.options, ""), path);
        const Fidelity fidelity = fidelity_of(source, format, path);
        EXPECT_LT(fidelity.mean_l1, 0.012) << name;
        EXPECT_LT(std::abs(fidelity.max_albedo_difference), 0.012) << name;
        // Its content says what it is, where its ending does not.
        EXPECT_EQ(formats.read(path)->channels(), 1) << name;
        EXPECT_NE(test::get(path).find("Asperity"), std::string::npos) << name;
    }
}

TEST(AngleFormats, ColoursKeepTheirOrder) {
    const test::TemporaryFolder folder;
    const ExportSource source = source_of("lambert:albedo=0.9/0.5/0.1");
    const BsdfFormats formats;
    for (const std::string& name : kFormats) {
        if (name == "speos-anisotropic") continue;  // one table for all
        const BsdfFormat& format = *formats.find(name);
        const std::string path = folder / ("a." + format.endings.front());
        format.write(source, FormatOptions(format.options, "step=10"), path);
        const auto file = formats.read(path);
        ASSERT_EQ(file->channels(), 3) << name;
        std::array<double, 3> f{};
        file->eval(from_spherical(0.5, 1), from_spherical(0.7, 2), f);
        const std::array<double, 3> expected = {0.9 / kPi, 0.5 / kPi, 0.1 / kPi};
        // The level of speos-brdf is the share of light, by the rule of trapezoids.
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(f[c], expected[c], 1e-3) << name << c;
    }
}

TEST(AngleFormats, AnisotropicLobesStandAtTheirAzimuth) {
    const test::TemporaryFolder folder;
    Experiment experiment;
    experiment.illumination.theta_deg = {0, 30, 60};
    experiment.illumination.phi_deg = {0, 30, 60, 90, 120, 150, 180, 210, 240, 270, 300, 330};
    experiment.detector.resolution = 32;
    const ExportSource source(parse_brdf_spec("ggx:alpha=0.5,alpha_y=0.25"), experiment, 2);
    for (const char* name : {"zemax", "speos-anisotropic", "csv", "astm"}) {
        const BsdfFormats formats;
        const BsdfFormat& format = *formats.find(name);
        const std::string path = folder / ("a." + format.endings.front());
        format.write(source, FormatOptions(format.options, ""), path);
        EXPECT_LT(fidelity_of(source, format, path).mean_l1, 0.08) << name;
    }
}

/// A table goes from format to format at the incidences it has, so that nothing is lost between
/// them.
TEST(AngleFormats, TablesKeepTheirIncidences) {
    const test::TemporaryFolder folder;
    AngleTable table;
    table.theta_i = {radians(10), radians(22.5), radians(67.5)};
    table.polar = even_angles(0, 90, 5);
    table.azimuth = even_angles(0, 355, 5);
    fill(table, *parse_brdf_spec("ggx:alpha=0.5"), {{1}}, 1);
    const ExportSource source(make_table_bsdf(table, "file:by-hand", "by hand"), {}, 2);
    const BsdfFormats formats;
    for (const std::string& name : kFormats) {
        const BsdfFormat& format = *formats.find(name);
        const std::string path = folder / ("a." + format.endings.front());
        format.write(source, FormatOptions(format.options, "step=5"), path);
        const std::vector<double> angles = format.read(path)->incident_angles();
        ASSERT_EQ(angles.size(), 3U) << name;
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(angles[k], table.theta_i[k], 1e-6) << name;
    }
    // Wrapped in what hears a stop, it is still asked
    asperity::Run run(1);
    EXPECT_EQ(until_stopped(make_table_bsdf(table, "t", "t"), run)->incident_angles().size(), 3U);
    EXPECT_TRUE(parse_brdf_spec("ggx:alpha=0.5")->incident_angles().empty());
}

TEST(Zemax, ByHand) {
    const test::TemporaryFolder folder;
    const auto file = [&](const std::string& type) {
        return "#made by hand\r\nSource  Measured\r\nSymmetry  PlaneSymmetrical\r\n"
               "SpectralContent  Monochrome\r\nScatterType  " +
               type +
               "\r\nSampleRotation  1\r\n0\r\n"
               "AngleOfIncidence  1\r\n40\t\r\nScatterAzimuth 3\r\n0\t90\t180\t\r\n"
               "ScatterRadial 3\r\n0\t20\t40\t\r\n\r\nMonochrome\r\nDataBegin\r\nTIS 0.9\r\n"
               "8\t4\t2\r\n8\t3\t1\r\n8\t6\t0\r\nDataEnd\r\n";
    };
    test::put(folder / "a.bsdf", file("BRDF"));
    const auto bsdf = BsdfFormats().read(folder / "a.bsdf");
    EXPECT_NEAR(f_at(*bsdf, 40, 40), 8, 1e-6);   // the mirror direction
    EXPECT_NEAR(f_at(*bsdf, 40, 20), 4, 1e-6);   // 20 degrees towards the normal
    EXPECT_NEAR(f_at(*bsdf, 40, 0), 2, 1e-6);    // the normal
    EXPECT_NEAR(f_at(*bsdf, 40, 60), 6, 1e-6);   // away from it
    EXPECT_NEAR(f_at(*bsdf, 40, 50), 7, 1e-6);   // halfway
    EXPECT_NEAR(f_at(*bsdf, 40, -10), 0, 1e-6);  // beyond the table
    // Straight beside the mirror direction, on either side.
    const Vec3 mirror = from_spherical(radians(40), kPi), side = {0, 1, 0};
    for (const double sign : {1.0, -1.0}) {
        double f = 0;
        bsdf->eval(from_spherical(radians(40), 0),
                   std::cos(radians(20)) * mirror + sign * std::sin(radians(20)) * side, {&f, 1});
        EXPECT_NEAR(f, 3, 1e-6);
    }
    test::put(folder / "t.bsdf", file("BTDF"));
    EXPECT_THROW(BsdfFormats().read(folder / "t.bsdf"), Error);
}

TEST(Speos, ByHand) {
    const test::TemporaryFolder folder;
    // Constant f: pi f sin cos over the hemisphere gives the percentage whatever the unit of the
    // values. Azimuth 0 is the side of the mirror direction.
    std::string text = "OPTIS - brdf surface file v8.0\n0\n\n4\nnote\n1\t0\n1\n2\t1\n0 40\n550\n";
    for (int incidence = 0; incidence < 2; ++incidence) {
        text += "50\n91\t5\n\t0\t90\t180\t270\t360\n";
        for (int theta = 0; theta <= 90; ++theta) text += fmt::format("{} 9 7 5 7 9\n", theta);
    }
    test::put(folder / "a.brdf", text + "End of file\n");
    const auto bsdf = BsdfFormats().read(folder / "a.brdf");
    // The mean over azimuths is 7: f = 0.5 / pi * value / 7.
    EXPECT_NEAR(f_at(*bsdf, 40, 30), 9.0 / 7 * 0.5 / kPi, 1e-4);
    EXPECT_NEAR(f_at(*bsdf, 40, -30), 5.0 / 7 * 0.5 / kPi, 1e-4);
    EXPECT_NEAR(f_at(*bsdf, 40, 30, 45), 8.0 / 7 * 0.5 / kPi, 1e-4);
}

TEST(LightTools, ByHand) {
    const test::TemporaryFolder folder;
    // Light comes from azimuth 90 degrees: the mirror direction is at 270.
    test::put(folder / "a.bsdf",
              "Symmetry Asymmetric\nSpectralContent Monochrome\nScatterAzimuth 4\n0 90 180 270\n"
              "ScatterRadial 2\n0 80\nDataBegin\nAOI 30\nPOI 90\nSide Front\nWavelength 550\n"
              "ScatterType BRDF\nTIS 0.5\n1 2\n1 3\n1 4\n1 5\nAOI 30\nPOI 90\nSide Back\n"
              "Wavelength 550\nScatterType BRDF\nTIS 0.5\n9 9\n9 9\n9 9\n9 9\nDataEnd\n");
    const auto bsdf = BsdfFormats().read(folder / "a.bsdf");
    EXPECT_NEAR(f_at(*bsdf, 30, 80), 5, 1e-6);
    EXPECT_NEAR(f_at(*bsdf, 30, -80), 3, 1e-6);
    EXPECT_NEAR(f_at(*bsdf, 30, 40), 3, 1e-6);  // halfway to the normal
    EXPECT_NEAR(f_at(*bsdf, 30, 80, 90), 2, 1e-6);
}

TEST(LongCsv, GoniometersInThePlane) {
    const test::TemporaryFolder folder;
    test::put(folder / "a.csv",
              " Incident_angle,Measure_angle, 450nm , 650nm\n30,-60,1,10\n30,0,2,20\n30,30,8,80\n"
              "30,60,4,40\n50,0,1,1\n50,50,3,3\n");
    const auto bsdf = BsdfFormats().read(folder / "a.csv");
    ASSERT_EQ(bsdf->channels(), 2);
    EXPECT_NEAR(f_at(*bsdf, 30, 30), 8, 1e-6);
    EXPECT_NEAR(f_at(*bsdf, 30, 0), 2, 1e-6);
    EXPECT_NEAR(f_at(*bsdf, 30, 45), 6, 1e-6);
    EXPECT_NEAR(f_at(*bsdf, 30, -30), 1.5, 1e-6);
    EXPECT_NEAR(f_at(*bsdf, 40, 40), 0.5 * (8 + 3), 1e-6);  // lobes move with the light
    // 30 degrees beside the mirror direction: as much as 30 before and 30 beyond it, on average.
    const Vec3 mirror = from_spherical(radians(30), kPi);
    std::array<double, 2> f{};
    bsdf->eval(from_spherical(radians(30), 0),
               std::cos(radians(30)) * mirror + Vec3{0, std::sin(radians(30)), 0}, f);
    EXPECT_NEAR(f[0], 0.5 * (2 + 4), 1e-6);
    EXPECT_NEAR(f[1], 10 * f[0], 1e-5);
}

void expect_refused(const std::string& path, const std::string& content, const std::string& word) {
    test::put(path, content);
    try {
        BsdfFormats().read(path);
        ADD_FAILURE() << content;
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

TEST(LongCsv, RefusesWhatCanBeReadTwoWays) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "a.csv", head = "theta_i,theta_o,phi_o,f\n";
    expect_refused(path, head + "0.1,0.2,0,1\n", "degrees or radians");
    expect_refused(path, "theta_i_deg,theta_o,phi_o,f\n1,2,0,1\n1,2,0,3\n", "two rows");
    expect_refused(path, "theta_i_deg,theta_o,phi_o,f\n1,2,0,1\n1,3,9,3\n", "combination");
    expect_refused(path, "theta_i_deg,theta_o,phi_o,f,gloss\n1,2,0,1,3\n", "gloss");
    expect_refused(path, "theta_i_deg,theta_o,phi_o\n1,2,0\n", "values");
    expect_refused(path, "theta_i_deg,theta_o,phi_o,f\n1,2,0\n", "columns");
    expect_refused(path, "theta_i_deg,theta_o,phi_o,f\n1,2,0,much\n", "much");
    expect_refused(path, "theta_i_deg,theta_o,phi_o,f\n95,2,0,1\n", "95");
    test::put(path,
              "theta_i_deg,theta_o,phi_o,f\n10,20,0,1\n10,20,180,3\n10,60,0,5\n10,60,180,7\n");
    const auto bsdf = BsdfFormats().read(path);
    EXPECT_NEAR(f_at(*bsdf, 10, 60), 7, 1e-6);  // phi_o is absolute, the light at 0
    EXPECT_NEAR(f_at(*bsdf, 10, -60), 5, 1e-6);
    EXPECT_NEAR(f_at(*bsdf, 10, 40, 90), 4, 1e-6);  // 0 .. 180 stand for both sides
    EXPECT_NEAR(f_at(*bsdf, 10, 40, -90), 4, 1e-6);
}

TEST(OpenMaterial, ByHand) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "a.json";
    const std::string head = R"({"brdf": {"wavelengths": [4.5e-7, 6.5e-7], "lookupTable": [)";
    test::put(path, head +
                        "[4.5e-7,0.5,0,0,1],[4.5e-7,0.5,1,0,2],[6.5e-7,0.5,0,0,3],"
                        "[6.5e-7,0.5,1,0,4]]}}");
    const auto bsdf = BsdfFormats().read(path);
    std::array<double, 2> f{};
    bsdf->eval(from_spherical(0.5, 0), from_spherical(1, 2), f);
    EXPECT_NEAR(f[0], 2, 1e-6);  // shorter wavelengths first
    EXPECT_NEAR(f[1], 4, 1e-6);
    expect_refused(path, head + "[4.5e-7,0.5,0,0,1],[6.5e-7,0.5,1,0,4]]}}", "wavelength");
    expect_refused(path, head + "[4.5e-7,0.5,0,0,null]]}}", "five numbers");
    expect_refused(path, R"({"lookupTable": 3})", "lookupTable");
    expect_refused(path, R"({"lookupTable": )", "JSON");
}

TEST(AngleFormats, CutFilesAreRefused) {
    const test::TemporaryFolder folder;
    const ExportSource source = source_of("ggx:alpha=0.4");
    const BsdfFormats formats;
    for (const std::string& name : kFormats) {
        const BsdfFormat& format = *formats.find(name);
        const std::string path = folder / "a";
        format.write(source, FormatOptions(format.options, "step=15"), path);
        const std::string whole = test::get(path);
        for (int k = 0; k < 40; ++k) {
            std::size_t end = whole.size() * static_cast<std::size_t>(k) / 40;
            // Lists of rows end where a line does only by chance: not there.
            while (end > 0 && whole[end - 1] == '\n') --end;
            test::put(path, whole.substr(0, end));
            EXPECT_THROW(format.read(path), Error) << name << " cut at " << end;
        }
    }
}

}  // namespace
}  // namespace asperity::io
